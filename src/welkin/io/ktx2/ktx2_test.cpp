// KTX2 as a format: what is written is read back; layouts, orders, keys and descriptors are those of the
// specification. What other readers make of our files: tests/ktx2.

#include <algorithm>
#include <cmath>
#include <memory>

#include "welkin/io/byte_order.h"
#include "welkin/io/ktx2/ktx2_test_files.h"

namespace welkin::io::test {
namespace {

/// How far a stored value may be from x.
float tolerance(PixelType type, float x, float largest_of_texel) {
  if (type == PixelType::half) return std::max(x * 0x1p-11f, 0x1p-25f);  // half a step, also of denormals
  if (type == PixelType::rgb9e5) return largest_of_texel * 0x1p-9f;      // half a step of its 9 bits
  if (type == PixelType::r11g11b10) return x * 0x1p-6f;                  // blue's 5 bits
  return 0;
}

TEST(Ktx2, KeepsEveryPictureOfEveryKind) {
  using enum PixelType;
  for (const Kind& kind : kKinds) {
    for (const auto type : {float32, half, rgb9e5, r11g11b10}) {
      for (const std::string compression : {"none", "zstd"}) {
        for (const int channels : {1, 2, 3, 4}) {
          const bool packed = type == rgb9e5 || type == r11g11b10;
          if (packed && channels % 2 == 0) continue;
          SCOPED_TRACE(kind.name + " " + std::string(name_of(type)) + " " + compression);
          const Texture texture(kind.width, kind.height, kind.levels, kind.layers, kind.faces, channels);
          WriteOptions options;
          options.type = type;
          options.compression = compression;
          const Bytes bytes = texture.encoded(options);
          const auto reader = open(bytes, "a.ktx2");
          const FileInfo& info = reader->info();
          EXPECT_EQ(info.format, "ktx2");
          EXPECT_EQ(info.levels, kind.levels);
          EXPECT_EQ(info.layers, kind.layers == 1 ? 0 : kind.layers);
          EXPECT_EQ(info.faces, kind.faces);
          EXPECT_EQ(info.colour, Colour::linear);
          // Without alpha of its own a file says that alpha, which is 1, is straight.
          EXPECT_EQ(info.notes.empty(), packed || channels % 2 == 0);
          ASSERT_EQ(info.parts.size(), texture.parts().size());
          for (std::size_t i = 0; i < info.parts.size(); ++i) {
            const PartInfo& part = info.parts[i];
            const WritePart& written = texture.parts()[i];
            EXPECT_EQ(part.level, written.level);
            EXPECT_EQ(part.layer, written.layer);
            EXPECT_EQ(part.face, written.face);
            EXPECT_EQ(part.type, type);
            EXPECT_EQ(part.compression, compression);
            EXPECT_EQ(part.channels, names_of(packed ? 3 : 4));
            ASSERT_EQ(part.width, written.image.width);
            ASSERT_EQ(part.height, written.image.height);
            const Image image = read_part(*reader, i);
            for (int y = 0; y < part.height; ++y) {
              for (int x = 0; x < part.width; ++x) {
                const float* in = written.image.at(x, y);
                const float largest = *std::max_element(in, in + std::min(channels, 3));
                for (int k = 0; k < (packed ? 3 : 4); ++k) {
                  const float expected = k == 3         ? (channels % 2 == 0 ? in[channels - 1] : 1.0f)
                                         : channels < 3 ? in[0]
                                                        : in[k];
                  ASSERT_NEAR(image.at(x, y)[k], expected, tolerance(type, expected, largest))
                      << part.name << " " << x << " " << y << " " << k;
                }
              }
            }
          }
        }
      }
    }
  }
}

TEST(Ktx2, NamesSayWhatThePicturesAre) {
  const auto names = [](const Texture& texture) {
    std::vector<std::string> all;
    for (const PartInfo& part : info_of(texture.encoded()).parts) all.push_back(part.name);
    return all;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(Texture(2, 2, 1, 1, 1, 3)), (Names{""}));
  EXPECT_EQ(names(Texture(2, 2, 2, 1, 1, 3)), (Names{"level 0", "level 1"}));
  EXPECT_EQ(names(Texture(2, 2, 1, 1, 6, 3)), (Names{"+X", "-X", "+Y", "-Y", "+Z", "-Z"}));
  EXPECT_EQ(names(Texture(2, 2, 1, 2, 1, 3)), (Names{"layer 0", "layer 1"}));
  const Names all = names(Texture(2, 2, 2, 2, 6, 3));
  ASSERT_EQ(all.size(), 24u);
  EXPECT_EQ(all[1], "level 0 layer 0 -X");
  EXPECT_EQ(all[18], "level 1 layer 1 +X");
}

TEST(Ktx2, PartsMayComeInAnyOrder) {
  const Texture texture(4, 4, 2, 2, 6, 3);
  std::vector<WritePart> shuffled = texture.parts();
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  EXPECT_EQ(encoded_parts(shuffled), texture.encoded());
}

TEST(Ktx2, SameInputSameBytes) {
  const Texture texture(64, 64, 7, 1, 6, 3);
  for (const std::string compression : {"none", "zstd"}) {
    WriteOptions options;
    options.compression = compression;
    EXPECT_EQ(texture.encoded(options), texture.encoded(options));
  }
}

TEST(Ktx2, LevelsLieSmallestFirstAndAligned) {
  using enum PixelType;
  for (const auto& [type, alignment] :
       {std::pair{float32, 16u}, std::pair{half, 8u}, std::pair{rgb9e5, 4u}}) {
    for (const std::string key : {"a", "bc", "def", "ghij"}) {
      WriteOptions options;
      options.type = type;
      options.attributes[key] = "1";
      const Bytes bytes = Texture(8, 8, 4, 1, 6, 3).encoded(options);
      std::uint64_t end = bytes.size();
      for (std::size_t level = 0; level < 4; ++level) {
        const auto offset = long_word(bytes, 80 + 24 * level), size = long_word(bytes, 88 + 24 * level);
        EXPECT_EQ(offset % alignment, 0u);
        EXPECT_EQ(offset + size, end) << "the levels follow each other, and level 0 ends the file";
        EXPECT_EQ(size, long_word(bytes, 96 + 24 * level));
        end = offset;
      }
      const std::uint64_t keys_end = word(bytes, 56) + word(bytes, 60);
      EXPECT_LT(end - keys_end, alignment);
      for (std::uint64_t i = keys_end; i < end; ++i) EXPECT_EQ(bytes[i], std::byte{0});
    }
  }
}

TEST(Ktx2, HeaderIsTheSpecifications) {
  const Bytes cube = Texture(8, 8, 3, 1, 6, 3).encoded();
  const std::vector<std::uint32_t> words = {109, 4, 8, 8, 0, 0, 6, 3, 0};
  for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(word(cube, 12 + 4 * i), words[i]) << i;
  EXPECT_EQ(word(cube, 48), 80u + 3 * 24);
  EXPECT_EQ(word(cube, 52), word(cube, word(cube, 48)));
  EXPECT_EQ(word(cube, 56), word(cube, 48) + word(cube, 52)) << "keys follow the descriptor";
  EXPECT_EQ(long_word(cube, 64), 0u);
  EXPECT_EQ(long_word(cube, 72), 0u);

  WriteOptions options;
  options.type = PixelType::half;
  const Bytes array = Texture(4, 2, 1, 3, 1, 3).encoded(options);
  const std::vector<std::uint32_t> array_words = {97, 2, 4, 2, 0, 3, 1, 1, 0};
  for (std::size_t i = 0; i < array_words.size(); ++i)
    EXPECT_EQ(word(array, 12 + 4 * i), array_words[i]) << i;
}

TEST(Ktx2, RowsOfFacesAreStoredAsTheyAreGiven) {
  const Texture texture(4, 4, 1, 1, 6, 4);
  const Bytes bytes = texture.encoded();
  const std::uint64_t at = long_word(bytes, 80);
  for (std::size_t face = 0; face < 6; ++face) {
    for (int y = 0; y < 4; ++y) {
      const std::byte* row = bytes.data() + at + face * 256 + static_cast<std::size_t>(y) * 64;
      EXPECT_EQ(std::memcmp(row, texture.parts()[face].image.row(y), 64), 0) << face << " " << y;
    }
  }
}

TEST(Ktx2, AttributesAreKeysSortedAndPadded) {
  WriteOptions options;
  options.attributes = {{"welkin.lobe", "ggx"},
                        {"Zebra", ""},
                        {"\xc3\xa9t\xc3\xa9", "line\nend \xe2\x88\x9a \\ \"quoted\""},
                        {"KTXorientation", "lu"},
                        {"ktxnothing", "x"}};
  const Bytes bytes = Texture(2, 2, 1, 1, 1, 3).encoded(options);
  const auto attributes = info_of(bytes).attributes;
  auto expected = options.attributes;
  expected.erase("ktxnothing");
  expected["KTXorientation"] = "rd";
  expected["KTXwriter"] = attributes.at("KTXwriter");
  EXPECT_EQ(attributes, expected);
  EXPECT_EQ(attributes.at("KTXwriter").find("welkin "), 0u);

  std::vector<std::string> order;
  const std::size_t end = word(bytes, 56) + word(bytes, 60);
  for (std::size_t at = word(bytes, 56); at < end;) {
    const std::size_t length = word(bytes, at);
    EXPECT_EQ(at % 4, 0u);
    order.emplace_back(reinterpret_cast<const char*>(&bytes[at + 4]));
    EXPECT_EQ(bytes[at + 4 + length - 1], std::byte{0}) << "values end with a zero";
    for (at += 4 + length; at % 4 != 0; ++at) EXPECT_EQ(bytes[at], std::byte{0});
  }
  EXPECT_EQ(order, (std::vector<std::string>{"KTXorientation", "KTXwriter", "Zebra", "welkin.lobe",
                                             "\xc3\xa9t\xc3\xa9"}));
}

TEST(Ktx2, AttributesThatCannotBeKeysAreRefused) {
  const Texture texture(2, 2, 1, 1, 1, 3);
  const auto message = [&](const std::string& key, const std::string& value) {
    WriteOptions options;
    options.attributes = {{key, value}};
    return error_of([&] { texture.encoded(options); });
  };
  EXPECT_NE(message("", "x").find("cannot be a key"), std::string::npos);
  EXPECT_NE(message(std::string("a\0b", 3), "x").find("'a' holds a zero byte"), std::string::npos);
  EXPECT_NE(message("a", std::string("b\0c", 3)).find("'a' holds a zero byte"), std::string::npos);
}

TEST(Ktx2, IncompleteAndContradictoryTexturesAreRefused) {
  const auto message = [](std::vector<WritePart> parts, const WriteOptions& options = {}) {
    return error_of([&] { encoded_parts(parts, options); });
  };
  const Texture cube(4, 4, 3, 1, 6, 3), array(4, 4, 1, 3, 1, 3), alpha(4, 4, 1, 1, 1, 4);
  auto parts = cube.parts();
  parts.erase(parts.begin() + 9);
  EXPECT_NE(message(parts).find("no picture for level 1 -Y"), std::string::npos) << message(parts);
  parts = cube.parts();
  parts.push_back(parts[7]);
  EXPECT_NE(message(parts).find("two pictures for level 1 -X"), std::string::npos) << message(parts);
  parts = array.parts();
  parts.erase(parts.begin());
  EXPECT_NE(message(parts).find("no picture for level 0 layer 0"), std::string::npos) << message(parts);
  parts = cube.parts();
  parts[6].image.width = 1;
  EXPECT_NE(message(parts).find("level 1 +X is 1×2, not 2×2"), std::string::npos) << message(parts);
  parts = cube.parts();
  for (int face = 0; face < 6; ++face) {
    parts.push_back(parts[static_cast<std::size_t>(12 + face)]);
    parts.back().level = 3;
  }
  EXPECT_NE(message(parts).find("4 levels, of which 4×4 has at most 3"), std::string::npos) << message(parts);
  parts = Texture(4, 4, 1, 1, 6, 3).parts();
  for (WritePart& part : parts) part.image.height = 2;
  EXPECT_NE(message(parts).find("must be square, not 4×2"), std::string::npos) << message(parts);
  parts = alpha.parts();
  parts[0].face = 6;
  EXPECT_NE(message(parts).find("no place in a texture"), std::string::npos) << message(parts);

  WriteOptions options;
  options.type = PixelType::rgb9e5;
  EXPECT_NE(
      message(alpha.parts(), options).find("KTX2 of rgb9e5 holds the channels Y or R G B without alpha"),
      std::string::npos);
  options.type = PixelType::uint8;
  EXPECT_NE(message(array.parts(), options)
                .find("KTX2 holds no uint8 pixels (one of: float, half, rgb9e5, "
                      "r11g11b10, bc6h, uastc-hdr)"),
            std::string::npos);
  options.type.reset();
  options.compression = "zip";
  EXPECT_NE(message(array.parts(), options).find("unknown KTX2 compression 'zip'"), std::string::npos);
}

TEST(Ktx2, LossesAreCountedOnceForEachValue) {
  Image image(2, 2, 3);
  for (int i = 0; i < 4; ++i) image.at(i % 2, i / 2)[0] = i < 3 ? 1e6f : 1.0f;
  image.at(1, 1)[1] = -1;
  image.at(1, 1)[2] = std::numeric_limits<float>::infinity();
  const auto report_of = [&](PixelType type) {
    WriteOptions options;
    options.type = type;
    WriteReport report;
    encoded("ktx2", image, options, &report);
    return std::vector{report.above, report.below, report.not_finite};
  };
  using Counts = std::vector<std::uint64_t>;
  EXPECT_EQ(report_of(PixelType::float32), (Counts{0, 0, 0}));
  EXPECT_EQ(report_of(PixelType::half), (Counts{3, 0, 0}));
  EXPECT_EQ(report_of(PixelType::r11g11b10), (Counts{3, 1, 0}));
  EXPECT_EQ(report_of(PixelType::rgb9e5), (Counts{3, 1, 1}));
}

TEST(Ktx2, ValuesThatAreSaidToBeSrgbAreDecoded) {
  const Image image = noise(7, 5, 4);
  WriteOptions options;
  options.colour = Colour::srgb;
  const Bytes bytes = encoded("ktx2", image, options);
  EXPECT_EQ(info_of(bytes).colour, Colour::srgb);
  const Image again = decoded(bytes);
  ReadOptions as_stored;
  as_stored.colour = Colour::linear;
  const Image stored = decoded(bytes, as_stored);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(again.at(x, y)[k], image.at(x, y)[k], 2e-7);
        if (k == 3) {
          EXPECT_EQ(stored.at(x, y)[k], image.at(x, y)[k]) << "alpha is linear";
        }
      }
      EXPECT_GT(stored.at(x, y)[0], image.at(x, y)[0]);
    }
  }
}

TEST(Ktx2, DescriptorSaysWhatATexelIs) {
  struct Sample {
    std::uint32_t offset, bits, channel, lower, upper;
  };
  constexpr std::uint32_t kOne = 0x3f800000, kMinusOne = 0xbf800000;
  const auto check = [](PixelType type, std::uint32_t texel, const std::vector<Sample>& samples) {
    WriteOptions options;
    options.type = type;
    const Bytes bytes = Texture(2, 2, 1, 1, 1, 3).encoded(options);
    const std::size_t at = word(bytes, 48);
    EXPECT_EQ(word(bytes, at), 28 + 16 * samples.size());
    EXPECT_EQ(word(bytes, at + 4), 0u);
    EXPECT_EQ(word(bytes, at + 8), 2 | (24 + 16 * samples.size()) << 16);
    EXPECT_EQ(word(bytes, at + 12), 0x010101u) << "RGBSDA, BT709, LINEAR, straight alpha";
    EXPECT_EQ(word(bytes, at + 16), 0u);
    EXPECT_EQ(word(bytes, at + 20), texel);
    EXPECT_EQ(word(bytes, at + 24), 0u);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Sample& sample = samples[i];
      const std::size_t entry = at + 28 + 16 * i;
      EXPECT_EQ(word(bytes, entry), sample.offset | (sample.bits - 1) << 16 | sample.channel << 24) << i;
      EXPECT_EQ(word(bytes, entry + 4), 0u);
      EXPECT_EQ(word(bytes, entry + 8), sample.lower) << i;
      EXPECT_EQ(word(bytes, entry + 12), sample.upper) << i;
    }
  };
  // Channels with the qualifiers: 0x80 float, 0x40 signed, 0x20 exponent; 15 is alpha.
  check(PixelType::float32, 16,
        {{0, 32, 0xc0, kMinusOne, kOne},
         {32, 32, 0xc1, kMinusOne, kOne},
         {64, 32, 0xc2, kMinusOne, kOne},
         {96, 32, 0xcf, kMinusOne, kOne}});
  check(PixelType::half, 8,
        {{0, 16, 0xc0, kMinusOne, kOne},
         {16, 16, 0xc1, kMinusOne, kOne},
         {32, 16, 0xc2, kMinusOne, kOne},
         {48, 16, 0xcf, kMinusOne, kOne}});
  check(PixelType::r11g11b10, 4, {{0, 11, 0x80, 0, kOne}, {11, 11, 0x81, 0, kOne}, {22, 10, 0x82, 0, kOne}});
  check(PixelType::rgb9e5, 4,
        {{0, 9, 0, 0, 8448},
         {27, 5, 0x20, 15, 31},
         {9, 9, 1, 0, 8448},
         {27, 5, 0x21, 15, 31},
         {18, 9, 2, 0, 8448},
         {27, 5, 0x22, 15, 31}});
}

/// Textures of two channels, as tables are: R and G alone, in either order, plain and packed by zstd.
TEST(Ktx2, KeepsTwoChannelsAsTwo) {
  const Image image = noise(5, 3, 2, 7);
  for (const PixelType type : {PixelType::half, PixelType::float32}) {
    for (const std::string compression : {"none", "zstd"}) {
      for (const auto& names : {std::vector<std::string>{"R", "G"}, std::vector<std::string>{"G", "R"}}) {
        WriteOptions options;
        options.type = type;
        options.compression = compression;
        const WritePart part{"", image.view(), names};
        const Bytes bytes = encoded_parts({&part, 1}, options);
        // VK_FORMAT_R16G16_SFLOAT and VK_FORMAT_R32G32_SFLOAT, and the bytes of a value.
        EXPECT_EQ(word(bytes, 12), type == PixelType::half ? 83u : 103u);
        EXPECT_EQ(word(bytes, 16), type == PixelType::half ? 2u : 4u);
        const auto reader = open(bytes, "a.ktx2");
        ASSERT_EQ(reader->info().parts.size(), 1u);
        EXPECT_EQ(reader->info().parts[0].channels, (std::vector<std::string>{"R", "G"}));
        EXPECT_EQ(reader->info().parts[0].type, type);
        const Image again = read_part(*reader, 0);
        for (int y = 0; y < 3; ++y) {
          for (int x = 0; x < 5; ++x) {
            for (int k = 0; k < 2; ++k) {
              const float wanted = image.at(x, y)[names[0] == "R" ? k : 1 - k];
              EXPECT_NEAR(again.at(x, y)[k], wanted, tolerance(type, wanted, wanted))
                  << x << " " << y << " " << k;
            }
          }
        }
      }
    }
  }
  // Packed types have three.
  WriteOptions packed;
  packed.type = PixelType::rgb9e5;
  const WritePart part{"", image.view(), {"R", "G"}};
  EXPECT_THROW(encoded_parts({&part, 1}, packed), Error);
}

TEST(Ktx2, CountsWhatTwoChannelsLose) {
  Image image(300, 1, 2);
  *image.at(0, 0) = 1e6f;
  image.at(299, 0)[1] = -1e6f;
  MemorySink sink;
  WriteOptions options;
  options.type = PixelType::half;
  const WritePart part{"", image.view(), {"R", "G"}};
  EXPECT_EQ(write(sink, "ktx2", {&part, 1}, options).above, 2u);
}

}  // namespace
}  // namespace welkin::io::test
