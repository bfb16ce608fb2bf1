// DDS and KTX 1: what is written is read back, and what other writers make is read. What they share with KTX2
// is tested there.

#include <algorithm>
#include <cmath>
#include <memory>

#include "welkin/io/ktx2/ktx2_test_files.h"
#include "welkin/texture/astc_hdr.h"
#include "welkin/texture/bc6h.h"

namespace welkin::io::test {
namespace {

Bytes encoded_as(const std::string& extension, std::span<const WritePart> parts,
                 const WriteOptions& options) {
  const TemporaryFolder folder;
  write(folder / ("texture." + extension), parts, options);
  return file_bytes(folder / ("texture." + extension));
}

std::string message_of(const Bytes& bytes) {
  try {
    const auto reader = open(bytes, "a");
    for (std::size_t i = 0; i < reader->info().parts.size(); ++i) read_part(*reader, i);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// Every container stores the same texels: each picture is the one that KTX2 gives.
TEST(TextureContainers, KeepEveryPictureOfEveryKind) {
  using enum PixelType;
  for (const std::string extension : {"dds", "ktx"}) {
    for (const Kind& kind : kKinds) {
      for (const auto type : {float32, half, rgb9e5, r11g11b10, bc6h}) {
        for (const int channels : {1, 2, 3, 4}) {
          if (is_packed(type) && channels % 2 == 0) continue;
          SCOPED_TRACE(extension + " " + kind.name + " " + std::string(name_of(type)) + " " +
                       std::to_string(channels));
          const Texture texture(kind.width, kind.height, kind.levels, kind.layers, kind.faces, channels);
          WriteOptions options;
          options.type = type;
          options.texture_quality = TextureQuality::fast;
          const Bytes bytes = encoded_as(extension, texture.parts(), options),
                      other = texture.encoded(options);
          const auto reader = open(bytes, "a"), expected = open(other, "b");
          const FileInfo& info = reader->info();
          EXPECT_EQ(info.format, extension);
          EXPECT_EQ(info.levels, kind.levels);
          EXPECT_EQ(info.layers, kind.layers == 1 ? 0 : kind.layers);
          EXPECT_EQ(info.faces, kind.faces);
          EXPECT_TRUE(info.warnings.empty());
          ASSERT_EQ(info.parts.size(), expected->info().parts.size());
          for (std::size_t i = 0; i < info.parts.size(); ++i) {
            const PartInfo& part = info.parts[i];
            EXPECT_EQ(part.name, expected->info().parts[i].name);
            EXPECT_EQ(part.type, type);
            ASSERT_EQ(part.width, expected->info().parts[i].width);
            const Image image = read_part(*reader, i), same = read_part(*expected, i);
            for (int y = 0; y < part.height; ++y) {
              for (int x = 0; x < part.width; ++x) {
                for (int k = 0; k < image.channels(); ++k)
                  ASSERT_EQ(image.at(x, y)[k], same.at(x, y)[k]) << part.name;
              }
            }
          }
        }
      }
    }
  }
}

/// What encoding and decoding a picture as blocks makes of it.
Image coded(ImageView<const float> picture, PixelType type) {
  std::vector<std::byte> blocks(bc6h_bytes(picture.width, picture.height));
  Image image(picture.width, picture.height, 3);
  if (type == PixelType::bc6h) {
    encode_bc6h(picture, TextureQuality::fast, blocks);
    decode_bc6h(blocks, false, image.view());
  } else {
    encode_uastc_hdr(picture, TextureQuality::fast, blocks);
    decode_astc_hdr(blocks, image.view());
  }
  return image;
}

/// Blocks are those of texture/, whatever the picture's size, and decode as those do.
TEST(Ktx2, StoresBlocks) {
  for (const PixelType type : {PixelType::bc6h, PixelType::uastc_hdr}) {
    for (const Kind& kind : kKinds) {
      for (const std::string compression : {"none", "zstd"}) {
        for (const int channels : {1, 3}) {
          SCOPED_TRACE(kind.name + " " + compression);
          const Texture texture(kind.width, kind.height, kind.levels, kind.layers, kind.faces, channels);
          WriteOptions options;
          options.type = type;
          options.texture_quality = TextureQuality::fast;
          options.compression = compression;
          const Bytes bytes = texture.encoded(options);
          const auto reader = open(bytes, "a.ktx2");
          ASSERT_EQ(reader->info().parts.size(), texture.parts().size());
          for (std::size_t i = 0; i < texture.parts().size(); ++i) {
            const PartInfo& part = reader->info().parts[i];
            EXPECT_EQ(part.type, type);
            EXPECT_EQ(part.channels, names_of(3));
            const Image expected = coded(texture.parts()[i].image, type);
            const Image image = read_part(*reader, i);
            for (int y = 0; y < part.height; ++y) {
              for (int x = 0; x < 3 * part.width; ++x) ASSERT_EQ(image.at(0, y)[x], expected.at(0, y)[x]);
            }
          }
        }
      }
    }
  }
}

/// As basis_universal writes it and three.js asks for it: the VkFormat of ASTC, colour model 167, Zstandard.
TEST(Ktx2, DescribesUastcHdr) {
  const Texture texture(8, 8, 1, 1, 6, 3);
  WriteOptions options;
  options.type = PixelType::uastc_hdr;
  const Bytes bytes = texture.encoded(options);
  const std::size_t descriptor = word(bytes, 48);
  EXPECT_EQ(word(bytes, 12), 1000066000u);
  EXPECT_EQ(word(bytes, 16), 1u);
  EXPECT_EQ(word(bytes, 44), 2u);
  EXPECT_EQ(word(bytes, descriptor), 44u);
  EXPECT_EQ(word(bytes, descriptor + 12), 167u | 1u << 8 | 1u << 16);
  EXPECT_EQ(word(bytes, descriptor + 16), 0x0303u);
  EXPECT_EQ(word(bytes, descriptor + 20), 16u);
  EXPECT_EQ(word(bytes, descriptor + 28), 127u << 16 | 0x80u << 24);
  EXPECT_EQ(word(bytes, descriptor + 36), 0u);
  EXPECT_EQ(word(bytes, descriptor + 40), 0x3f800000u);
}

/// Khronos Data Format Specification 1.3, table of the BC6H descriptors: one sample of 128 bits, model 133,
/// blocks of 4×4.
TEST(Ktx2, DescribesBc6h) {
  const Texture texture(8, 8, 1, 1, 6, 3);
  WriteOptions options;
  options.type = PixelType::bc6h;
  const Bytes bytes = texture.encoded(options);
  const std::size_t descriptor = word(bytes, 48);
  EXPECT_EQ(word(bytes, 12), 143u);
  EXPECT_EQ(word(bytes, 16), 1u);
  EXPECT_EQ(word(bytes, descriptor), 44u);
  EXPECT_EQ(word(bytes, descriptor + 12) & 0xff, 133u);
  EXPECT_EQ(word(bytes, descriptor + 16), 0x0303u);
  EXPECT_EQ(word(bytes, descriptor + 20), 16u);
  EXPECT_EQ(word(bytes, descriptor + 28), 127u << 16 | 0x80u << 24);
  EXPECT_EQ(word(bytes, descriptor + 40), 0x3f800000u);
  // A level begins at a multiple of its blocks.
  EXPECT_EQ(long_word(bytes, 80) % 16, 0u);
  EXPECT_EQ(long_word(bytes, 88), 6u * 4 * 16);
}

/// A file of one picture by its header's words.
Bytes dds_of(const std::vector<std::pair<std::size_t, std::uint32_t>>& fields, std::size_t pixels,
             bool modern = false) {
  Bytes bytes(modern ? 148 : 128);
  const auto put = [&](std::size_t word, std::uint32_t value) { std::memcpy(&bytes[4 * word], &value, 4); };
  put(0, 0x20534444);
  put(1, 124);
  put(2, 0x1007);
  put(3, 1);
  put(4, 1);
  put(19, 32);
  for (const auto& [word, value] : fields) put(word, value);
  for (std::size_t i = 0; i < pixels; ++i) bytes.push_back(static_cast<std::byte>(i + 1));
  return bytes;
}
constexpr std::uint32_t kDx10 = 0x30315844;

TEST(Dds, ReadsTheHeadersOfDirect3d9) {
  // A8R8G8B8: bytes B G R A.
  const Bytes bgra =
      dds_of({{20, 0x41}, {22, 32}, {23, 0xff0000}, {24, 0xff00}, {25, 0xff}, {26, 0xff000000}}, 4);
  ReadOptions linear;
  linear.colour = Colour::linear;
  EXPECT_EQ(info_of(bgra).parts[0].channels, names_of(4));
  EXPECT_EQ(info_of(bgra).colour, Colour::srgb);
  const Image pixel = decoded(bgra, linear);
  EXPECT_FLOAT_EQ(pixel.at(0, 0)[0], 3.0f / 255 * (4.0f / 255));  // straight alpha is multiplied
  // X8R8G8B8, and 24 bits.
  EXPECT_EQ(
      info_of(dds_of({{20, 0x40}, {22, 32}, {23, 0xff0000}, {24, 0xff00}, {25, 0xff}}, 4)).parts[0].channels,
      names_of(3));
  const Image bgr =
      decoded(dds_of({{20, 0x40}, {22, 24}, {23, 0xff0000}, {24, 0xff00}, {25, 0xff}}, 3), linear);
  EXPECT_FLOAT_EQ(bgr.at(0, 0)[0], 3.0f / 255);
  EXPECT_FLOAT_EQ(bgr.at(0, 0)[2], 1.0f / 255);
  EXPECT_EQ(info_of(dds_of({{20, 0x20000}, {22, 8}, {23, 0xff}}, 1)).parts[0].channels, names_of(1));
  EXPECT_EQ(info_of(dds_of({{20, 4}, {21, 113}}, 8)).parts[0].type, PixelType::half);
  EXPECT_EQ(info_of(dds_of({{20, 4}, {21, 116}}, 16)).parts[0].type, PixelType::float32);
}

TEST(Dds, WritesTheOlderHeaderWhereItSuffices) {
  const auto four_cc = [](PixelType type, int layers, int channels) {
    WriteOptions options;
    options.type = type;
    return word(encoded_as("dds", Texture(4, 4, 1, layers, 6, channels).parts(), options), 84);
  };
  EXPECT_EQ(four_cc(PixelType::half, 1, 3), 113u);
  EXPECT_EQ(four_cc(PixelType::float32, 1, 3), 116u);
  EXPECT_EQ(four_cc(PixelType::half, 2, 3), kDx10);
  EXPECT_EQ(four_cc(PixelType::half, 1, 4), kDx10);
  EXPECT_EQ(four_cc(PixelType::bc6h, 1, 3), kDx10);
}

/// Faces are complete chains, one behind the other.
TEST(Dds, StoresFaceByFace) {
  WriteOptions options;
  options.type = PixelType::float32;
  const Texture texture(2, 2, 2, 1, 6, 3);
  const Bytes bytes = encoded_as("dds", texture.parts(), options);
  ASSERT_EQ(bytes.size(), 128u + 6 * (4 + 1) * 16);
  const WritePart& second_face = *std::find_if(texture.parts().begin(), texture.parts().end(),
                                               [](const WritePart& part) { return part.face == 1; });
  EXPECT_EQ(load_native<float>(&bytes[128 + 5 * 16]), second_face.image.at(0, 0)[0]);
}

TEST(Dds, RefusesByName) {
  const auto expect = [](const Bytes& bytes, const std::string& cause) {
    EXPECT_NE(message_of(bytes).find(cause), std::string::npos) << message_of(bytes);
  };
  expect(dds_of({{20, 4}, {21, 0x31545844}}, 8), "texels of BC1");
  expect(dds_of({{20, 4}, {21, kDx10}, {32, 98}, {33, 3}, {35, 1}}, 16, true), "texels of BC7");
  expect(dds_of({{20, 4}, {21, kDx10}, {32, 3}, {33, 3}, {35, 1}}, 16, true), "DXGI_FORMAT 3");
  expect(dds_of({{20, 4}, {21, 113}, {28, 0x200 | 0x400}}, 8), "not all faces");
  expect(dds_of({{20, 4}, {21, 113}, {28, 0x200000}}, 8), "three dimensions");
  expect(dds_of({{20, 4}, {21, 113}}, 7), "ends early (byte 135): the last picture ends at byte 136");
  expect(dds_of({{20, 4}, {21, 113}, {7, 3}}, 8), "3 levels, of which 1×1 has at most 1");
  expect(dds_of({{1, 100}, {20, 4}, {21, 113}}, 8), "not 124");
  expect(dds_of({{3, 0}, {20, 4}, {21, 113}}, 8), "out of range");
  expect(dds_of({{3, 1 << 20}, {4, 1 << 20}, {20, 4}, {21, 113}}, 8), "over the limit");
  expect(dds_of({{20, 4}, {21, kDx10}, {32, 10}, {33, 3}, {35, 0xffffffff}}, 16, true),
         "pictures, more than");
  expect(bytes_of("DDS 0"), "ends early");
}

/// As cmgen writes them: half R G B A, little-endian, a size of one face before each level.
Bytes ktx_of(std::uint32_t type, std::uint32_t type_size, std::uint32_t format, std::uint32_t internal,
             std::uint32_t faces, std::uint32_t image_size, const Bytes& pixels, bool swapped = false) {
  Bytes bytes = bytes_of("\xabKTX 11\xbb\r\n\x1a\n");
  const auto put = [&](std::uint32_t value) {
    const std::uint32_t turned = swapped ? swap_bytes(value) : value;
    append(bytes, turned);
  };
  for (const std::uint32_t field :
       {0x04030201u, type, type_size, format, internal, 0x1908u, 1u, 1u, 0u, 0u, faces, 1u, 0u, image_size})
    put(field);
  bytes.insert(bytes.end(), pixels.begin(), pixels.end());
  return bytes;
}

TEST(Ktx1, ReadsWhatOthersWrite) {
  Bytes halves;
  for (int face = 0; face < 6; ++face) {
    for (const unsigned half : {0x3c00u + static_cast<unsigned>(face), 0x4000u, 0x3800u, 0x3c00u})
      append(halves, static_cast<std::uint16_t>(half));
  }
  for (const std::uint32_t size : {8u, 48u}) {  // of one face, and of all, as some say
    const Bytes bytes = ktx_of(0x140b, 2, 0x1908, 0x881a, 6, size, halves);
    const auto reader = open(bytes, "a");
    EXPECT_EQ(reader->info().faces, 6);
    EXPECT_EQ(read_part(*reader, 3).at(0, 0)[0], 1 + 3 * 0x1p-10f);
  }
  // The other byte order.
  Bytes big(8);
  const std::uint32_t one = swap_bytes(std::uint32_t{0x3f800000});
  std::memcpy(big.data(), &one, 4);
  std::memcpy(big.data() + 4, &one, 4);
  EXPECT_EQ(decoded(ktx_of(0x1406, 4, 0x8227, 0x8230, 1, 8, big, true)).at(0, 0)[0], 1.0f);
  // Rows of three bytes are padded.
  const Bytes rgb = {std::byte{255}, std::byte{0}, std::byte{51}, std::byte{0}};
  EXPECT_EQ(decoded(ktx_of(0x1401, 1, 0x1907, 0x8051, 1, 4, rgb)).at(0, 0)[2], 0.2f);
}

/// Filament's reader aborts at the type that OpenGL names.
TEST(Ktx1, WritesThePackedTypeThatFilamentReads) {
  WriteOptions options;
  options.type = PixelType::r11g11b10;
  const Bytes bytes = encoded_as("ktx", Texture(2, 2, 1, 1, 6, 3).parts(), options);
  EXPECT_EQ(word(bytes, 16), 0x8c3au);
  EXPECT_EQ(word(bytes, 28), 0x8c3au);
}

TEST(Ktx1, KeepsAttributes) {
  WriteOptions options;
  options.attributes = {{"sh", "1 2 3\n4 5 6"}, {"welkin.lobe", "ggx"}};
  const FileInfo info = info_of(encoded_as("ktx", Texture(2, 2, 1, 1, 6, 3).parts(), options));
  EXPECT_EQ(info.attributes.at("sh"), "1 2 3\n4 5 6");
  EXPECT_EQ(info.attributes.at("welkin.lobe"), "ggx");
}

TEST(Ktx1, RefusesDamage) {
  const auto expect = [](const Bytes& bytes, const std::string& cause) {
    EXPECT_NE(message_of(bytes).find(cause), std::string::npos) << message_of(bytes);
  };
  const Bytes eight(8);
  expect(ktx_of(0x140b, 2, 0x1908, 0x881a, 5, 8, eight), "5 faces, neither 1 nor 6");
  expect(ktx_of(0x140b, 2, 0x1908, 0x881a, 1, 9, eight), "level 0 has 9 bytes, not the 8");
  expect(ktx_of(0x140b, 2, 0x1908, 0x881a, 1, 8, Bytes(7)), "ends early");
  expect(ktx_of(0, 1, 0, 0x83f0, 1, 8, eight), "compressed texels");
  expect(ktx_of(0x1405, 4, 0x1908, 0x8814, 1, 8, eight), "are not read");
  Bytes keys = ktx_of(0x140b, 2, 0x1908, 0x881a, 1, 8, eight);
  const std::uint32_t huge = 0xfffffff0;
  std::memcpy(&keys[60], &huge, 4);
  expect(keys, "the key/value data ends at byte");
}

/// Every byte of a small file changed, and the file cut at every length: an error or a picture, never more.
TEST(TextureContainers, SurviveDamage) {
  for (const std::string extension : {"dds", "ktx"}) {
    for (const PixelType type : {PixelType::half, PixelType::bc6h}) {
      WriteOptions options;
      options.type = type;
      const Bytes whole = encoded_as(extension, Texture(4, 4, 2, 1, 6, 3).parts(), options);
      for (std::size_t i = 0; i < std::min<std::size_t>(whole.size(), 200); ++i) {
        for (const unsigned value : {0u, 1u, 6u, 0x7fu, 0xffu}) {
          Bytes damaged = whole;
          damaged[i] = static_cast<std::byte>(value);
          message_of(damaged);
        }
        message_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(i)));
      }
      EXPECT_EQ(message_of(whole), "");
    }
  }
}

}  // namespace
}  // namespace welkin::io::test
