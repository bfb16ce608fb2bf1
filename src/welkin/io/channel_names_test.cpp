#include "welkin/io/channel_names.h"

#include <gtest/gtest.h>

namespace welkin::io {
namespace {

TEST(ChannelNames, WhatTheyHold) {
  for (const char* red : {"R", "r", "Red", "red", "V.Combined.R", "a.b.c.RED"})
    EXPECT_EQ(meaning_of_channel(red), "R") << red;
  EXPECT_EQ(meaning_of_channel("alpha"), "A");
  EXPECT_EQ(meaning_of_channel("Luminance"), "Y");
  EXPECT_EQ(meaning_of_channel("l.depth"), "Z");
  for (const char* other : {"", ".", "R.", "reds", "re", "id", "R.x1", "RY"})
    EXPECT_EQ(meaning_of_channel(other), "") << other;
}

TEST(ChannelNames, TheirLayers) {
  EXPECT_EQ(layer_of_channel("R"), "");
  EXPECT_EQ(layer_of_channel("V.Combined.R"), "V.Combined");
  EXPECT_EQ(layer_of_channel(".R"), "");
  EXPECT_EQ(layer_of_channel("R."), "R");
  const std::vector<std::string> channels{"b.R", "R", "b.G", "a.b.R", "b.R.x"};
  const std::vector<ChannelLayer> layers = layers_of_channels(channels);
  ASSERT_EQ(layers.size(), 4u);
  const std::pair<std::string, std::vector<int>> expected[] = {
      {"b", {0, 2}}, {"", {1}}, {"a.b", {3}}, {"b.R", {4}}};
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_EQ(layers[i].name, expected[i].first);
    EXPECT_EQ(layers[i].members, expected[i].second);
  }
}

TEST(ChannelNames, OneAmongSeveralThatHoldTheSame) {
  const std::vector<std::string> channels{"l.red", "l.r", "l.R", "l.g", "l.green", "l.id"};
  const std::vector<int> all{0, 1, 2, 3, 4, 5}, some{4, 3, 1};
  EXPECT_EQ(channel_that_is("R", channels, all), 2);
  EXPECT_EQ(channel_that_is("R", channels, some), 1);
  EXPECT_EQ(channel_that_is("G", channels, all), 3);
  EXPECT_EQ(channel_that_is("G", channels, some), 4);
  EXPECT_EQ(channel_that_is("B", channels, all), -1);
}

}  // namespace
}  // namespace welkin::io
