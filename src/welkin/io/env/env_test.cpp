#include <cmath>
#include <nlohmann/json.hpp>

#include "welkin/io/env/manifest.h"
#include "welkin/io/rgbd_cube_cases.h"
#include "welkin/io/test_readers.h"

namespace welkin::io {
namespace {

using namespace test;

Bytes written(const Cube& cube, const WriteOptions& options = {}, WriteReport* report = nullptr) {
  MemorySink sink;
  const WriteReport done = write(sink, "env", cube.parts, options);
  if (report != nullptr) *report = done;
  return sink.take();
}

/// The file as Babylon.js's loader takes it apart: magic, JSON, zero byte, images.
struct TakenApart {
  nlohmann::json json;
  std::size_t images_at = 0;
};

TakenApart taken_apart(const Bytes& bytes) {
  const char* text = reinterpret_cast<const char*>(bytes.data());
  const std::string manifest(text + 8);
  return {nlohmann::json::parse(manifest), 8 + manifest.size() + 1};
}

TEST(Env, LiesAsBabylonReadsIt) {
  WriteOptions options;
  for (int i = 0; i < 27; ++i) options.irradiance.push_back(i / 8.0);
  const Bytes bytes = written(cube(4, 3), options);
  const unsigned char magic[8] = {0x86, 0x16, 0x87, 0x96, 0xf6, 0xd6, 0x96, 0x36};
  ASSERT_EQ(std::memcmp(bytes.data(), magic, 8), 0);
  const auto [json, images_at] = taken_apart(bytes);
  EXPECT_EQ(json["version"], 2);
  EXPECT_EQ(json["width"], 4);
  EXPECT_EQ(json["imageType"], "image/png");
  EXPECT_EQ(json["specular"]["lodGenerationScale"], 0.8);
  EXPECT_EQ(json["irradiance"]["x"], (std::vector<double>{0, 0.125, 0.25}));
  EXPECT_EQ(json["irradiance"]["xy"], (std::vector<double>{3, 3.125, 3.25}));
  const auto& mipmaps = json["specular"]["mipmaps"];
  ASSERT_EQ(mipmaps.size(), 18u);
  std::size_t next = 0;
  for (int level = 0; level < 3; ++level) {
    for (int face = 0; face < 6; ++face) {
      const auto& entry = mipmaps[static_cast<std::size_t>(6 * level + face)];
      ASSERT_EQ(entry["position"], next);
      const std::size_t length = entry["length"];
      const Bytes png(bytes.begin() + static_cast<std::ptrdiff_t>(images_at + next),
                      bytes.begin() + static_cast<std::ptrdiff_t>(images_at + next + length));
      next += length;
      ReadOptions as_stored;
      as_stored.colour = Colour::linear;
      const Image stored = raw_picture(png, as_stored);
      const int size = 4 >> level;
      ASSERT_EQ(stored.width(), size);
      ASSERT_EQ(stored.channels(), 4);
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          const float* p = stored.at(x, size - 1 - y);  // upside down
          for (int c = 0; c < 3; ++c) {
            // fromRGBD: toLinearSpace(rgb) / a.
            const float value = value_at(level, face, x, y, c), read = std::pow(p[c], 2.2f) / p[3];
            EXPECT_NEAR(read, value, 0.006f * value + 0.001f);
          }
        }
      }
    }
  }
  EXPECT_EQ(images_at + next, bytes.size());
}

TEST(Env, ReadsWhatItWrote) {
  WriteOptions options;
  options.attributes["welkin.lobe"] = "ggx µ";
  WriteReport report;
  const Cube made = cube(8, 4);
  const Bytes bytes = written(made, options, &report);
  const auto reader = open(bytes, "sky.env");
  const FileInfo& info = reader->info();
  EXPECT_EQ(info.format, "env");
  EXPECT_EQ(info.levels, 4);
  EXPECT_EQ(info.faces, 6);
  EXPECT_EQ(info.attributes.at("welkin.lobe"), "ggx µ");
  ASSERT_EQ(info.parts.size(), made.images.size());
  double error = 0, all = 0;
  for (std::size_t i = 0; i < made.images.size(); ++i) {
    const Image read = read_part(*reader, i);
    for (int y = 0; y < read.height(); ++y) {
      for (int x = 0; x < 3 * read.width(); ++x) {
        const auto value = static_cast<double>(made.images[i].at(0, y)[x]);
        error += std::pow(static_cast<double>(read.at(0, y)[x]) - value, 2);
        all += value * value;
      }
    }
  }
  EXPECT_NEAR(report.relative_rmse(), std::sqrt(error / all), 1e-7);
  EXPECT_LT(report.relative_rmse(), 0.005);
}

/// A file of another program says what Babylon.js's loader takes for granted.
TEST(Env, OtherProgramsFilesAreBabylonsDefault) {
  Bytes bytes = written(cube(4, 3));
  const auto reader = open(bytes, "sky.env");
  const auto& attributes = reader->info().attributes;
  EXPECT_EQ(attributes.at("welkin.convention"), "babylon");
  EXPECT_EQ(attributes.at("welkin.orientation"), "-1 0 0 0 1 0 0 0 1");
  EXPECT_EQ(attributes.at("welkin.roughness").substr(0, 4), "0,0.");
}

std::string message_of(const Bytes& bytes) {
  try {
    const auto reader = open(bytes, "bad.env");
    read_part(*reader, 0);
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
}

Bytes with_manifest(const std::string& json, std::size_t images = 0) {
  Bytes bytes(8);
  std::memcpy(bytes.data(), env::kMagic, 8);
  const Bytes text = bytes_of(json);
  bytes.insert(bytes.end(), text.begin(), text.end());
  bytes.resize(bytes.size() + 1 + images);
  return bytes;
}

TEST(Env, RefusesHostileFiles) {
  const Bytes sound = written(cube(2, 2));
  for (std::size_t length = 1; length < sound.size(); length += 7) {
    const Bytes cut(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_NE(message_of(cut), "read") << length;
  }
  const auto says = [](const std::string& json, const std::string& cause) {
    const std::string message = message_of(with_manifest(json, 4));
    EXPECT_NE(message.find(cause), std::string::npos) << json << ": " << message;
  };
  says("", "is no JSON object");
  says("[1]", "is no JSON object");
  says(std::string(100000, '['), "is no JSON object");
  says("{}", "has no version");
  says(R"({"version":3})", "of version 3: 1 and 2 are read");
  says(R"({"version":2})", "has no width");
  says(R"({"version":2,"width":-4})", "has no width");
  says(R"({"version":2,"width":3})", "are 3 wide, no power of two");
  says(R"({"version":2,"width":1073741824})", "are 1073741824 wide");
  says(R"({"version":2,"width":2})", "take 12 images, not 0");
  const auto of_one = [](const std::string& entry) {
    std::string list;
    for (int i = 0; i < 6; ++i) list += (i > 0 ? "," : "") + entry;
    return R"({"version":1,"width":1,"specular":{"mipmaps":[)" + list + "]}}";
  };
  says(of_one(R"({"position":0})"), "image 0 has no position or no length");
  says(of_one(R"({"position":0,"length":5})"), "image 0, of 5 bytes");
  says(of_one(R"({"position":18446744073709551615,"length":2})"), "passes the end of the file");
  says(of_one(R"({"position":2,"length":18446744073709551615})"), "passes the end of the file");
  says(of_one(R"({"position":0,"length":4})"), "its image is neither PNG nor WebP");
}

TEST(Env, RefusesImagesOfAnotherSize) {
  // Level 1's images in the place of level 0's.
  Bytes bytes = written(cube(2, 2));
  auto [json, images_at] = taken_apart(bytes);
  json["specular"]["mipmaps"][0] = json["specular"]["mipmaps"][6];
  const std::string text = json.dump();
  Bytes changed = with_manifest(text);
  changed.insert(changed.end(), bytes.begin() + static_cast<std::ptrdiff_t>(images_at), bytes.end());
  EXPECT_NE(message_of(changed).find("its image is 1×1, not 2×2"), std::string::npos) << message_of(changed);
}

TEST(Env, WritesWhatBabylonTakes) {
  const auto refusal = [](const Cube& made) -> std::string {
    try {
      written(made);
    } catch (const Error& error) {
      return error.what();
    }
    return "written";
  };
  EXPECT_NE(refusal(cube(4, 2)).find("all 3 levels of faces of 4, not 2"), std::string::npos);
  EXPECT_NE(refusal(cube(6, 3)).find("a power of two"), std::string::npos);
  Cube flat = cube(4, 3);
  flat.parts.resize(1);
  EXPECT_NE(refusal(flat).find("one cube texture"), std::string::npos);
  EXPECT_EQ(refusal(cube(1, 1)), "written");
}

}  // namespace
}  // namespace welkin::io
