#include <cmath>
#include <nlohmann/json.hpp>

#include "welkin/io/glb/container.h"
#include "welkin/io/rgbd_cube_cases.h"
#include "welkin/io/test_readers.h"

namespace welkin::io {
namespace {

using namespace test;

WriteOptions with_irradiance() {
  WriteOptions options;
  for (int i = 0; i < 27; ++i) options.irradiance.push_back(i / 8.0);
  return options;
}

Bytes written(const Cube& cube, const WriteOptions& options = with_irradiance()) {
  MemorySink sink;
  write(sink, "glb", cube.parts, options);
  return sink.take();
}

/// The file as the specification takes it apart.
struct TakenApart {
  nlohmann::json json;
  std::size_t binary_at = 0;
};

std::uint32_t word(const Bytes& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return value;
}

TakenApart taken_apart(const Bytes& bytes) {
  EXPECT_EQ(word(bytes, 8), bytes.size());
  const std::size_t length = word(bytes, 12);
  EXPECT_EQ(length % 4, 0u);
  const char* text = reinterpret_cast<const char*>(bytes.data()) + 20;
  return {nlohmann::json::parse(text, text + length), 28 + length};
}

/// The file with another JSON, of any length.
Bytes with_json(const Bytes& bytes, const nlohmann::json& json) {
  std::string text = json.dump();
  while (text.size() % 4 != 0) text += ' ';
  const std::string whole(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto words = [](std::initializer_list<std::size_t> values) {
    std::string stored;
    for (const std::size_t value : values) {
      for (int i = 0; i < 4; ++i) stored += static_cast<char>(value >> (8 * i) & 0xFF);
    }
    return stored;
  };
  const std::string binary = whole.substr(20 + word(bytes, 12));
  const std::string changed = whole.substr(0, 8) + words({20 + text.size() + binary.size(), text.size()}) +
                              whole.substr(16, 4) + text + binary;
  const auto stored = std::as_bytes(std::span(changed));
  return {stored.begin(), stored.end()};
}

Bytes changed(const std::function<void(nlohmann::json& json, nlohmann::json& light)>& change) {
  const Bytes bytes = written(cube(4, 2));
  nlohmann::json json = taken_apart(bytes).json;
  change(json, json["extensions"]["EXT_lights_image_based"]["lights"][0]);
  return with_json(bytes, json);
}

TEST(Glb, LiesAsBabylonReadsIt) {
  const Bytes bytes = written(cube(8, 3));
  const auto [json, binary_at] = taken_apart(bytes);
  EXPECT_EQ(json["asset"]["version"], "2.0");
  const auto& light = json["extensions"]["EXT_lights_image_based"]["lights"][0];
  EXPECT_EQ(json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"], 0);
  EXPECT_EQ(light["specularImageSize"], 8);
  ASSERT_EQ(light["irradianceCoefficients"].size(), 9u);
  EXPECT_EQ(light["irradianceCoefficients"][8], (std::vector<double>{3, 3.125, 3.25}));
  ASSERT_EQ(light["specularImages"].size(), 3u);
  for (int level = 0; level < 3; ++level) {
    for (int face = 0; face < 6; ++face) {
      const std::size_t index =
          light["specularImages"][static_cast<std::size_t>(level)][static_cast<std::size_t>(face)];
      const auto& view = json["bufferViews"][json["images"][index]["bufferView"].get<std::size_t>()];
      const std::size_t at = view["byteOffset"], length = view["byteLength"];
      EXPECT_EQ(at % 4, 0u);
      const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(binary_at + at);
      const Bytes png(first, first + static_cast<std::ptrdiff_t>(length));
      ReadOptions as_stored;
      as_stored.colour = Colour::linear;
      const Image stored = raw_picture(png, as_stored);
      const int size = 8 >> level;
      ASSERT_EQ(stored.width(), size);
      ASSERT_EQ(stored.channels(), 4);
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          const float* p = stored.at(x, size - 1 - y);  // upside down
          for (int c = 0; c < 3; ++c) {
            const float value = value_at(level, face, x, y, c);
            EXPECT_NEAR(std::pow(p[c], 2.2f) / p[3], value, 0.006f * value + 0.001f);
          }
        }
      }
    }
  }
}

TEST(Glb, ReadsWhatItWrote) {
  WriteOptions options = with_irradiance();
  options.attributes["welkin.lobe"] = "ggx µ";
  const Cube made = cube(8, 2);
  const Bytes bytes = written(made, options);
  const auto reader = open(bytes, "sky.glb");
  EXPECT_EQ(reader->info().format, "glb");
  EXPECT_EQ(reader->info().levels, 2);
  EXPECT_EQ(reader->info().faces, 6);
  EXPECT_EQ(reader->info().attributes.at("welkin.lobe"), "ggx µ");
  for (std::size_t i = 0; i < made.images.size(); ++i) {
    const Image read = read_part(*reader, i);
    for (int k = 0; k < 3 * read.width() * read.height(); ++k) {
      const float value = made.images[i].at(0, 0)[k];
      ASSERT_NEAR(read.at(0, 0)[k], value, 0.006f * value + 0.001f);
    }
  }
}

TEST(Glb, OtherProgramsLightsAreTurnedAndScaled) {
  const Bytes bytes = changed([](auto&, auto& light) {
    light["intensity"] = 3;
    light["rotation"] = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};  // a quarter turn about +Y: +Z to +X
  });
  const auto reader = open(bytes, "sky.glb");
  const auto& attributes = reader->info().attributes;
  EXPECT_EQ(attributes.at("welkin.roughness"), "0,1");
  // Along +X of the scene the cube's +Z is seen, along +Z its +X: −X, reversed.
  std::istringstream rows(attributes.at("welkin.orientation"));
  double m[9];
  for (double& value : m) rows >> value;
  EXPECT_NEAR(m[6], 1, 1e-6);
  EXPECT_NEAR(m[2], 1, 1e-6);
  EXPECT_NEAR(m[4], 1, 1e-6);
  EXPECT_NEAR(read_part(*reader, 0).at(2, 1)[1], 3 * value_at(0, 0, 2, 1, 1), 0.02f);
}

std::string message_of(const Bytes& bytes) {
  try {
    const auto reader = open(bytes, "bad.glb");
    for (std::size_t i = 0; i < reader->info().parts.size(); ++i) read_part(*reader, i);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Glb, DamagedAndForeignFilesAreToldApart) {
  const auto says = [](const std::string& part, const auto& change) {
    const std::string message = message_of(changed(change));
    EXPECT_NE(message.find(part), std::string::npos) << message << "\n  not: " << part;
  };
  says("without an image-based light", [](auto& json, auto&) { json.erase("extensions"); });
  says("without an image-based light",
       [](auto& json, auto&) { json["extensions"]["EXT_lights_image_based"]["lights"] = 3; });
  says("specularImageSize", [](auto&, auto& light) { light["specularImageSize"] = 1e9; });
  says("power of two", [](auto&, auto& light) { light["specularImageSize"] = 6; });
  says("is 4×4, not 8×8", [](auto&, auto& light) { light["specularImageSize"] = 8; });
  says("specularImages", [](auto&, auto& light) { light.erase("specularImages"); });
  says("six faces", [](auto&, auto& light) { light["specularImages"][1].push_back(0); });
  says("there isn't", [](auto&, auto& light) { light["specularImages"][0][0] = 99; });
  says("other files", [](auto& json, auto&) { json["images"][0] = {{"uri", "face.png"}}; });
  says("passes the end", [](auto& json, auto&) { json["bufferViews"][0]["byteLength"] = 1ull << 60; });
  says("passes the end", [](auto& json, auto&) { json["bufferViews"][0]["byteOffset"] = 1ull << 63; });
  says("lies nowhere", [](auto& json, auto&) { json["bufferViews"] = nullptr; });
  says("another buffer", [](auto& json, auto&) { json["bufferViews"][0]["buffer"] = 1; });
  says("rotation", [](auto&, auto& light) { light["rotation"] = {0, 0, 0, 0}; });
  says("intensity", [](auto&, auto& light) { light["intensity"] = -1; });

  const Bytes bytes = written(cube(4, 2));
  for (std::size_t size = 4; size < bytes.size(); size += 7)
    EXPECT_NE(message_of(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))), "")
        << size;
}

TEST(Glb, RefusesWhatNoSceneLoads) {
  const auto message = [](const Cube& cube, const WriteOptions& options) -> std::string {
    try {
      written(cube, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(cube(6, 1), with_irradiance()).find("power of two"), std::string::npos);
  EXPECT_NE(message(cube(4, 1), {}).find("harmonics"), std::string::npos);
}

}  // namespace
}  // namespace welkin::io
