// What headers say that is unusual: obeyed, told, or refused by name.

#include <ImfStandardAttributes.h>
#include <ImfStringVectorAttribute.h>

#include <array>

#include "welkin/base/error.h"
#include "welkin/io/exr/exr_test_files.h"

namespace welkin::io {
namespace {

using namespace exr_test;
using namespace std::string_literals;

const std::map<std::string, Imf::PixelType> kRgb{{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}};

TestPart small_part(Imf::Compression compression = Imf::ZIP_COMPRESSION) {
  return part_of({{0, 0}, {39, 19}}, {{0, 0}, {39, 19}}, compression, kRgb);
}

/// An attribute as the file has it.
std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  std::string bytes = name + '\0' + type + '\0';
  for (std::size_t shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(value.size() >> shift & 0xff);
  return bytes + value;
}

/// A file of the library's without its attribute 'type', and with `inserted` before its channels; the table
/// of chunks, which starts behind the header, follows the change of length.
std::vector<std::byte> with_attribute(const TestPart& part, const std::string& inserted) {
  const Folder folder;
  write_file(folder / "a.exr", {part});
  const auto before = bytes_of_file(folder / "a.exr");
  std::string text(reinterpret_cast<const char*>(before.data()), before.size());
  const std::size_t header = 8;
  const std::string type = attribute("type", "string", part.tiled ? "tiledimage" : "scanlineimage");
  std::ptrdiff_t growth = static_cast<std::ptrdiff_t>(inserted.size());
  if (const auto at = text.find(type); at != std::string::npos) {
    text.erase(at, type.size());
    growth -= static_cast<std::ptrdiff_t>(type.size());
  }
  text.insert(header, inserted);
  // Offsets point behind the table; its first entry to its own end.
  std::size_t table = header;
  std::uint64_t first = 0;
  for (std::size_t chunks = 1; table + 8 < text.size(); ++table) {
    std::memcpy(&first, text.data() + table, 8);
    const std::uint64_t now = first + static_cast<std::uint64_t>(growth);
    if (now <= table || (now - table) % 8 != 0 || now - table > 800) continue;
    chunks = (now - table) / 8;
    for (std::size_t i = 0; i < chunks; ++i) {
      std::uint64_t offset;
      std::memcpy(&offset, text.data() + table + 8 * i, 8);
      offset += static_cast<std::uint64_t>(growth);
      std::memcpy(text.data() + table + 8 * i, &offset, 8);
    }
    break;
  }
  std::vector<std::byte> bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

std::vector<std::string> warnings_of(std::span<const std::byte> bytes) {
  return open(bytes, "test.exr")->info().parts[0].warnings;
}

std::string error_of(std::span<const std::byte> bytes) {
  try {
    const auto reader = open(bytes, "test.exr");
    read_all(*reader);
  } catch (const Error& error) {
    return std::string(name_of(error.kind())) + ": " + error.what();
  }
  return "no error";
}

/// Every value as in a file without the change.
void expect_same_pixels(std::span<const std::byte> bytes, const TestPart& part) {
  const Folder folder;
  write_file(folder / "same.exr", {part});
  const Image expected = read_all(*open(std::filesystem::path(folder / "same.exr")));
  const Image image = read_all(*open(bytes, "test.exr"));
  ASSERT_EQ(image.width(), expected.width());
  for (int y = 0; y < image.height(); ++y) {
    for (int i = 0; i < 3 * image.width(); ++i)
      ASSERT_EQ(bits(image.at(0, y)[i]), bits(expected.at(0, y)[i]));
  }
}

TEST(ExrHeader, FilesWithoutATypeAreReadByTheirFlags) {
  for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    TestPart part = small_part(compression);
    for (const bool tiled : {false, true}) {
      if (tiled) make_tiled(part, 16, 16);
      const auto bytes = with_attribute(part, "");
      EXPECT_TRUE(warnings_of(bytes).empty());
      expect_same_pixels(bytes, part);
    }
  }
}

TEST(ExrHeader, ATypeThatContradictsTheFlagsIsTold) {
  for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    TestPart part = small_part(compression);
    for (const bool tiled : {false, true}) {
      if (tiled) make_tiled(part, 16, 16);
      for (const std::string type : {tiled ? "scanlineimage" : "tiledimage", "painting"}) {
        const auto bytes = with_attribute(part, attribute("type", "string", type));
        const auto warnings = warnings_of(bytes);
        ASSERT_EQ(warnings.size(), 1u);
        EXPECT_NE(warnings[0].find("'type' says '" + type + "'"), std::string::npos) << warnings[0];
        expect_same_pixels(bytes, part);
      }
    }
  }
}

TEST(ExrHeader, PixelsThatAreNotSquareAreTold) {
  TestPart part = small_part();
  part.header.pixelAspectRatio() = 2;
  const Folder folder;
  write_file(folder / "a.exr", {part});
  const auto warnings = warnings_of(bytes_of_file(folder / "a.exr"));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "the pixels' aspect ratio is 2, which is not obeyed");
}

TEST(ExrHeader, ADataWindowOutsideTheDisplayWindowIsBlackAndTold) {
  const Folder folder;
  const Imath::Box2i display({-8, 4}, {15, 15});
  struct Case {
    Imath::Box2i data;
    bool outside;
  };
  for (const Case& c : {Case{{{100, 100}, {120, 110}}, true}, Case{{{-40, 4}, {-9, 15}}, true},
                        Case{{{16, 4}, {16, 4}}, true}, Case{{{15, 15}, {30, 30}}, false},
                        Case{{{-30, -30}, {-8, 4}}, false}, Case{{{0, 8}, {0, 8}}, false}}) {
    for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
      write_file(folder / "w.exr", {part_of(display, c.data, compression, kRgb)});
      const auto reader = open(std::filesystem::path(folder / "w.exr"));
      const Image image = read_all(*reader);
      int lit = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) lit += image.at(x, y)[0] != 0;
      }
      const int width = std::min(c.data.max.x, 15) - std::max(c.data.min.x, -8) + 1;
      const int height = std::min(c.data.max.y, 15) - std::max(c.data.min.y, 4) + 1;
      EXPECT_EQ(lit, c.outside ? 0 : width * height);
      const std::vector<std::string>& warnings = reader->info().parts[0].warnings;
      EXPECT_EQ(warnings.size(), c.outside ? 1u : 0u);
      for (const std::string& warning : warnings)
        EXPECT_NE(warning.find("all texels are 0"), std::string::npos) << warning;
    }
  }
}

TEST(ExrHeader, ViewsAndEnvmapsArePartByPart) {
  const Folder folder;
  std::vector<TestPart> parts{small_part(), small_part(), small_part()};
  const std::array<const char*, 3> names{"depth", "left", "right"};
  for (std::size_t i = 0; i < 3; ++i) parts[i].header.setName(names[i]);
  parts[1].header.setView("left");
  parts[2].header.setView("right");
  Imf::addEnvmap(parts[1].header, Imf::ENVMAP_LATLONG);
  write_file(folder / "v.exr", parts);
  const auto info = open(std::filesystem::path(folder / "v.exr"))->info();
  EXPECT_TRUE(info.parts[0].views.empty());
  EXPECT_FALSE(info.parts[0].envmap);
  EXPECT_EQ(info.parts[1].views, (std::vector<std::string>{"left"}));
  EXPECT_EQ(info.parts[1].envmap, "latlong");
  EXPECT_EQ(info.parts[2].views, (std::vector<std::string>{"right"}));

  TestPart one = small_part();
  Imf::addMultiView(one.header, {"left", "right"});
  write_file(folder / "one.exr", {one});
  EXPECT_EQ(open(std::filesystem::path(folder / "one.exr"))->info().parts[0].views,
            (std::vector<std::string>{"left", "right"}));
}

/// The value of the first attribute of that name and type.
void set_value(std::vector<std::byte>& bytes, const std::string& name_and_type, std::uint8_t value) {
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t at = text.find(name_and_type);
  ASSERT_NE(at, std::string::npos);
  bytes[at + name_and_type.size() + 4] = std::byte{value};
}

TEST(ExrHeader, NewerCompressionsAreRefusedByName) {
  const Folder folder;
  write_file(folder / "a.exr", {small_part()});
  auto bytes = bytes_of_file(folder / "a.exr");
  for (const int htj2k : {10, 11}) {
    set_value(bytes, "compression\0compression\0"s, static_cast<std::uint8_t>(htj2k));
    EXPECT_EQ(error_of(bytes),
              "unsupported: test.exr: htj2k compression, of OpenEXR 3.4, is not read: write the file with "
              "another, as `oiiotool IN.exr --compression zip -o OUT.exr` does");
  }
  for (const int unknown : {12, 200}) {
    set_value(bytes, "compression\0compression\0"s, static_cast<std::uint8_t>(unknown));
    const std::string error = error_of(bytes);
    EXPECT_NE(error.find("a compression newer than OpenEXR 3.4"), std::string::npos) << error;
    EXPECT_EQ(error.find(std::to_string(unknown)), std::string::npos) << error;
  }
}

TEST(ExrHeader, AnUnknownEnvmapIsIgnoredAndTold) {
  const Folder folder;
  TestPart part = small_part();
  Imf::addEnvmap(part.header, Imf::ENVMAP_CUBE);
  write_file(folder / "a.exr", {part});
  auto bytes = bytes_of_file(folder / "a.exr");
  set_value(bytes, "envmap\0envmap\0"s, 7);
  ASSERT_EQ(warnings_of(bytes).size(), 1u);
  EXPECT_NE(warnings_of(bytes)[0].find("'envmap'"), std::string::npos);
  expect_same_pixels(bytes, small_part());
}

TEST(ExrHeader, DamagedViewsAreRefused) {
  const auto damaged = [](const std::string& value) {
    return error_of(with_attribute(small_part(), attribute("multiView", "stringvector", value)));
  };
  EXPECT_EQ(damaged("\4\0\0\0left"s), "no error");
  EXPECT_NE(damaged("\5\0\0\0left"s).find("damaged: "), std::string::npos);
  EXPECT_NE(damaged("\xff\xff\xff\xffleft"s).find("damaged: "), std::string::npos);
  EXPECT_NE(damaged("\4\0"s).find("damaged: "), std::string::npos);
}

}  // namespace
}  // namespace welkin::io
