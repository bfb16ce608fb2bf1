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
}

}  // namespace
}  // namespace welkin::io
