#include "welkin/map_file/choose_channels.h"

#include <gtest/gtest.h>

#include <numeric>

#include "welkin/base/error.h"

namespace welkin::map_file {
namespace {

using Names = std::vector<std::string>;

struct File : io::FileInfo {
  File& part(const std::string& name, const Names& channels) {
    parts.emplace_back();
    parts.back().name = name;
    parts.back().channels = channels;
    return *this;
  }
  File& with_views(const Names& views) {
    parts.back().views = views;
    return *this;
  }
};

ChosenChannels choose(const File& file, const ReadMapOptions& options = {}) {
  std::vector<std::size_t> all(file.parts.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return choose_channels("test.exr", file, all, options);
}

/// `part: file's name→map's name …`, and the number of warnings behind `!` where there are any.
std::string text_of(const File& file, const ChosenChannels& chosen) {
  std::string text = std::to_string(chosen.picture) + ":";
  for (std::size_t i = 0; i < chosen.channels.size(); ++i) {
    const std::string& name =
        file.parts[chosen.picture].channels[static_cast<std::size_t>(chosen.channels[i])];
    text += " " + name + (name == chosen.names[i] ? "" : ">" + chosen.names[i]);
  }
  return chosen.warnings.empty() ? text : text + " !" + std::to_string(chosen.warnings.size());
}

std::string chosen(const File& file, const ReadMapOptions& options = {}) {
  return text_of(file, choose(file, options));
}

std::string of_one_part(const Names& channels) {
  return chosen(File().part("", channels));
}

ReadMapOptions layer(const std::string& name) {
  ReadMapOptions options;
  options.layer = name;
  return options;
}

ReadMapOptions channels(const Names& names) {
  ReadMapOptions options;
  options.channels = names;
  return options;
}

std::string error_of(const File& file, const ReadMapOptions& options) {
  try {
    choose(file, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ChooseChannels, FindsColourByTheEndOfNamesInTheOrderRgba) {
  EXPECT_EQ(of_one_part({"R", "G", "B"}), "0: R G B");
  EXPECT_EQ(of_one_part({"A", "B", "G", "R", "Z"}), "0: R G B A");
  EXPECT_EQ(of_one_part({"b", "g", "r"}), "0: r>R g>G b>B");
  EXPECT_EQ(of_one_part({"blue", "Green", "red", "alpha"}), "0: red>R Green>G blue>B alpha>A");
  EXPECT_EQ(of_one_part({"B", "G", "R", "b", "g", "r"}), "0: R G B") << "capitals first";
  EXPECT_EQ(of_one_part({"diffuse.B", "diffuse.G", "diffuse.R"}), "0: diffuse.R>R diffuse.G>G diffuse.B>B");
  EXPECT_EQ(of_one_part({"V.C.A", "V.C.B", "V.C.G", "V.C.R", "V.Depth.Z"}),
            "0: V.C.R>R V.C.G>G V.C.B>B V.C.A>A");
  EXPECT_EQ(of_one_part({"Z", "l.sub.b", "l.sub.g", "l.sub.r"}), "0: l.sub.r>R l.sub.g>G l.sub.b>B");
}

TEST(ChooseChannels, PlainColourComesBeforeLayersWithoutAWord) {
  EXPECT_EQ(of_one_part({"a.B", "a.G", "a.R", "B", "G", "R"}), "0: R G B");
}

TEST(ChooseChannels, OfSeveralLayersTheFinishedPictureIsReadAndTheOthersTold) {
  for (const char* name : {"ViewLayer.Combined", "beauty", "x.RGBA", "C", "default", "Color"}) {
    Names names;
    for (const std::string layer : {"Albedo", name}) {
      for (const char* suffix : {".B", ".G", ".R"}) names.push_back(layer + suffix);
    }
    const File file = File().part("", names);
    const ChosenChannels found = choose(file);
    EXPECT_EQ(file.parts[0].channels[static_cast<std::size_t>(found.channels[0])], std::string(name) + ".R");
    ASSERT_EQ(found.warnings.size(), 1u);
    EXPECT_NE(found.warnings[0].find("'" + std::string(name) + "' is read"), std::string::npos)
        << found.warnings[0];
    EXPECT_NE(found.warnings[0].find("'Albedo'"), std::string::npos) << found.warnings[0];
    EXPECT_NE(found.warnings[0].find("another layer can be named"), std::string::npos) << found.warnings[0];
  }
  // The first where no name says more, but not one of identifiers.
  EXPECT_EQ(of_one_part({"Crypto00.b", "Crypto00.g", "Crypto00.r", "d.B", "d.G", "d.R", "e.B", "e.G", "e.R"}),
            "0: d.R>R d.G>G d.B>B !1");
}

TEST(ChooseChannels, WhatHasNoColourIsReadAndTold) {
  EXPECT_EQ(of_one_part({"Y"}), "0: Y") << "grey is a picture";
  EXPECT_EQ(of_one_part({"A", "Y"}), "0: Y A");
  EXPECT_EQ(of_one_part({"G"}), "0: G") << "all that there is";
  EXPECT_EQ(of_one_part({"G", "R"}), "0: G R");
  EXPECT_EQ(of_one_part({"G", "R", "id"}), "0: G R id !1");
  EXPECT_EQ(of_one_part({"Z"}), "0: Z !1");
  EXPECT_EQ(of_one_part({"A"}), "0: A !1");
  EXPECT_EQ(of_one_part({"view.Depth.Z"}), "0: view.Depth.Z>Z !1");
  EXPECT_EQ(of_one_part({"X", "Y", "Z"}), "0: X Y Z !1");
  EXPECT_EQ(of_one_part({"N.X", "N.Y", "N.Z"}), "0: N.X>X N.Y>Y N.Z>Z !1");
  EXPECT_EQ(of_one_part({"0", "1", "2", "3"}), "0: 0 1 2 !1");
  EXPECT_EQ(of_one_part({"A", "Z", "u", "v"}), "0: u v !1");
  EXPECT_EQ(of_one_part({"Z", "l.Y"}), "0: l.Y>Y") << "grey before depth";
  EXPECT_EQ(of_one_part({"l.BY", "l.RY", "l.Y"}), "0: l.Y>Y !1") << "chroma is left out";
  const ChosenChannels depth = choose(File().part("", {"Z"}));
  EXPECT_EQ(depth.warnings[0], "holds no colour: Z, a depth, is read");
}

TEST(ChooseChannels, ThePartWithColourIsRead) {
  const File file = File().part("depth", {"Z"}).part("beauty", {"R", "G", "B"});
  EXPECT_EQ(chosen(file), "1: R G B");
  EXPECT_EQ(chosen(File().part("a", {"R", "G", "B"}).part("rgba", {"R", "G", "B", "A"})), "1: R G B A !1");
  EXPECT_EQ(chosen(File().part("a", {"R", "G", "B"}).part("b", {"R", "G", "B"})), "0: R G B !1");
  const ChosenChannels pages = choose(File().part("", {"R", "G", "B"}).part("", {"R", "G", "B"}));
  ASSERT_EQ(pages.warnings.size(), 1u);
  EXPECT_NE(pages.warnings[0].find("another part can be named: part 1"), std::string::npos)
      << pages.warnings[0];
}

TEST(ChooseChannels, DeepPartsAreLeftOutWhereOthersCanBeRead) {
  File file = File().part("deep", {"R", "G", "B"}).part("flat", {"Y"});
  file.parts[0].deep = true;
  EXPECT_EQ(chosen(file), "1: Y");
  file.parts[1].deep = true;
  EXPECT_EQ(chosen(file), "0: R G B");
}

TEST(ChooseChannels, ALayerIsNamedByAllOrSomeOfItsName) {
  const File file = File().part("", {"B", "G", "R", "V.Combined.B", "V.Combined.G", "V.Combined.R",
                                     "V.Depth.Z", "V.Diff.B", "V.Diff.G", "V.Diff.R"});
  EXPECT_EQ(chosen(file, layer("V.Diff")), "0: V.Diff.R>R V.Diff.G>G V.Diff.B>B");
  EXPECT_EQ(chosen(file, layer("Diff")), "0: V.Diff.R>R V.Diff.G>G V.Diff.B>B");
  EXPECT_EQ(chosen(file, layer("v.diff")), "0: V.Diff.R>R V.Diff.G>G V.Diff.B>B") << "whatever the case";
  EXPECT_EQ(chosen(file, layer("Depth")), "0: V.Depth.Z>Z") << "it was asked for: no warning";
  EXPECT_EQ(chosen(file, layer("V")), "0: V.Combined.R>R V.Combined.G>G V.Combined.B>B !1");
  EXPECT_NE(error_of(file, layer("Dif")).find("unknown layer 'Dif'"), std::string::npos);
  EXPECT_NE(error_of(file, layer("V.Dif")).find("V.Diff"), std::string::npos);
  EXPECT_NE(error_of(File().part("", {"R", "G", "B"}), layer("x")).find("has no layers"), std::string::npos);
}

TEST(ChooseChannels, ALayerCanBeAPartOrAView) {
  const File parts = File()
                         .part("main.left", {"R", "G", "B"})
                         .with_views({"left"})
                         .part("main.right", {"R", "G", "B"})
                         .with_views({"right"})
                         .part("aov", {"n.X", "n.Y", "n.Z", "d.B", "d.G", "d.R"});
  EXPECT_EQ(chosen(parts, layer("right")), "1: R G B");
  EXPECT_EQ(chosen(parts, layer("main.right")), "1: R G B");
  EXPECT_EQ(chosen(parts, layer("aov")), "2: d.R>R d.G>G d.B>B");
  EXPECT_EQ(chosen(parts, layer("aov/n")), "2: n.X>X n.Y>Y n.Z>Z");
  const File one =
      File().part("", {"B", "G", "R", "right.B", "right.G", "right.R"}).with_views({"left", "right"});
  EXPECT_EQ(chosen(one), "0: R G B");
  EXPECT_EQ(chosen(one, layer("left")), "0: R G B");
  EXPECT_EQ(chosen(one, layer("right")), "0: right.R>R right.G>G right.B>B");
}

TEST(ChooseChannels, NamedChannelsAreTakenAsNamed) {
  const File file =
      File().part("depth", {"Z"}).part("", {"A", "B", "G", "R", "d.B", "d.G", "d.R", "n.X", "n.Y"});
  EXPECT_EQ(chosen(file, channels({"Z"})), "0: Z");
  EXPECT_EQ(chosen(file, channels({"R"})), "1: R");
  EXPECT_EQ(chosen(file, channels({"d.R", "d.G", "d.B"})), "1: d.R>R d.G>G d.B>B");
  EXPECT_EQ(chosen(file, channels({"d.B", "d.G", "d.R", "A"})), "1: d.B>B d.G>G d.R>R A");
  EXPECT_EQ(chosen(file, channels({"n.Y", "n.X"})), "1: n.Y>Y n.X>X");
  EXPECT_EQ(chosen(file, channels({"n.X", "d.G", "R"})), "1: n.X d.G R");
  ReadMapOptions both = channels({"R", "B"});
  both.layer = "d";
  EXPECT_EQ(chosen(file, both), "1: d.R>R d.B>B");
  EXPECT_NE(error_of(file, channels({"Q"})).find("unknown channel 'Q'"), std::string::npos);
  EXPECT_NE(error_of(file, channels({"Z", "R"})).find("they lie in several"), std::string::npos);
}

TEST(ChooseChannels, ChannelsThatTheFileDeclares) {
  File file = File().part("", {"R", "G", "B", "A"});
  file.attributes["welkin.channels"] = "R,G,B";
  EXPECT_EQ(chosen(file), "0: R G B");
  file.attributes["welkin.channels"] = "R,Q";
  EXPECT_EQ(chosen(file), "0: R G B A") << "a declaration that doesn't fit";
}

TEST(ChooseChannels, FacesHaveTheSameChannelsByNameOrByKind) {
  const File file = File()
                        .part("px", {"px.B", "px.G", "px.R"})
                        .part("nx", {"nx.A", "nx.B", "nx.G", "nx.R"})
                        .part("py", {"Z", "px.R", "px.G", "px.B"})
                        .part("ny", {"Y"});
  const std::size_t first = 0;
  const ChosenChannels found = choose_channels("f", file, {&first, 1}, {});
  const auto like = [&](std::size_t i) { return channels_like(found, file.parts[0], "f", file, i); };
  EXPECT_EQ(like(2), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(like(0), (std::vector<int>{2, 1, 0}));
  EXPECT_THROW(like(1), Error) << "one with alpha";
  EXPECT_THROW(like(3), Error);
}

TEST(ChooseChannels, LayersAreListedWithAllTheirChannels) {
  const File file = File().part("", {"A", "d.B", "B", "d.R", "d.G", "d.id"});
  const std::vector<ImageLayer> layers = layers_of(file, 0);
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].name, "");
  EXPECT_EQ(layers[0].members, (std::vector<int>{0, 2}));
  EXPECT_EQ(layers[1].name, "d");
  EXPECT_EQ(layers[1].members, (std::vector<int>{1, 3, 4, 5}));
  EXPECT_EQ(layers[1].kind, LayerKind::colour);
}

}  // namespace
}  // namespace welkin::map_file
