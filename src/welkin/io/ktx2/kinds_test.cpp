// KTX2's less common texels, and what a file says of its colours, alpha and channels.

#include <array>
#include <bit>
#include <cmath>
#include <functional>

#include "welkin/io/format.h"
#include "welkin/io/ktx2/ktx2_test_files.h"
#include "welkin/io/texels/format_names.h"
#include "welkin/io/texels/formats.h"

namespace welkin::io::test {
namespace {

/// A texture of one row of these texels.
Bytes row(std::uint32_t format, const Bytes& texels, std::function<void(OtherFile&)> change = {}) {
  const texels::TexelFormat* found = texels::find_format(format);
  OtherFile file;
  file.format = format;
  file.type_size = found == nullptr ? 1 : found->type_size;
  file.texel_bytes = found == nullptr ? texels.size() : found->bytes();
  file.width = static_cast<std::uint32_t>(texels.size() / file.texel_bytes);
  if (change) change(file);
  return file_of(file, texels);
}

template <class T>
Bytes texels_of(std::initializer_list<T> values) {
  Bytes bytes;
  for (const T value : values) append(bytes, value);
  return bytes;
}

void expect_values(const Bytes& file, const std::vector<std::string>& channels,
                   const std::vector<double>& values) {
  EXPECT_EQ(info_of(file).parts[0].channels, channels);
  const Image image = decoded(file);
  ASSERT_EQ(static_cast<std::size_t>(image.width() * image.channels()), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(image.at(0, 0)[i], static_cast<float>(values[i])) << i;
}

const std::vector<std::string> kR{"R"}, kRg{"R", "G"}, kRgb{"R", "G", "B"}, kRgba{"R", "G", "B", "A"},
    kY{"Y"};

TEST(Ktx2Kinds, SignedIntegersReachMinusOneTwice) {
  const auto bytes = texels_of<std::int8_t>({127, 0, -127, -128, 64, -1, 1, 2, 3, 4, 5, 6});
  std::vector<double> values;
  for (const double k : {127., 0., -127., -127., 64., -1., 1., 2., 3., 4., 5., 6.}) values.push_back(k / 127);
  expect_values(row(10, bytes), kR, values);
  expect_values(row(17, bytes), kRg, values);
  expect_values(row(24, bytes), kRgb, values);
  expect_values(row(38, bytes), kRgba, values);
  const std::vector<double> turned = {values[2], values[1], values[0], values[3]};
  expect_values(row(45, Bytes(bytes.begin(), bytes.begin() + 4)), kRgba, turned);
  const auto words = texels_of<std::int16_t>({32767, -32768, -32767, 1});
  const std::vector<double> of_words = {1, -1, -1, 1.0 / 32767};
  expect_values(row(71, words), kR, of_words);
  expect_values(row(78, words), kRg, of_words);
  expect_values(row(92, words), kRgba, of_words);
  EXPECT_EQ(info_of(row(92, words)).parts[0].type, PixelType::float32);
}

TEST(Ktx2Kinds, FieldsAreCountedFromTheMostSignificantBit) {
  const double n5 = 31, n6 = 63, n4 = 15;
  // 1·2^11 + 2·2^5 + 3 and the like: 1, 2, 3 from the top.
  expect_values(row(4, texels_of<std::uint16_t>({1 << 11 | 2 << 5 | 3})), kRgb, {1 / n5, 2 / n6, 3 / n5});
  expect_values(row(5, texels_of<std::uint16_t>({1 << 11 | 2 << 5 | 3})), kRgb, {3 / n5, 2 / n6, 1 / n5});
  expect_values(row(2, texels_of<std::uint16_t>({0x1234})), kRgba, {1 / n4, 2 / n4, 3 / n4, 4 / n4});
  expect_values(row(3, texels_of<std::uint16_t>({0x1234})), kRgba, {3 / n4, 2 / n4, 1 / n4, 4 / n4});
  expect_values(row(1000340000, texels_of<std::uint16_t>({0x1234})), kRgba, {2 / n4, 3 / n4, 4 / n4, 1 / n4});
  expect_values(row(1000340001, texels_of<std::uint16_t>({0x1234})), kRgba, {4 / n4, 3 / n4, 2 / n4, 1 / n4});
  const auto fives = texels_of<std::uint16_t>({1 << 11 | 2 << 6 | 3 << 1 | 1});
  expect_values(row(6, fives), kRgba, {1 / n5, 2 / n5, 3 / n5, 1});
  expect_values(row(7, fives), kRgba, {3 / n5, 2 / n5, 1 / n5, 1});
  const auto alpha_first = texels_of<std::uint16_t>({0 << 15 | 1 << 10 | 2 << 5 | 3});
  expect_values(row(8, alpha_first), kRgba, {1 / n5, 2 / n5, 3 / n5, 0});
  expect_values(row(1000470000, alpha_first), kRgba, {3 / n5, 2 / n5, 1 / n5, 0});
  expect_values(row(1, texels_of<std::uint8_t>({0x12, 0xf0})), kRg, {1 / n4, 2 / n4, 1, 0});
}

TEST(Ktx2Kinds, TenBitsAndPackedBytes) {
  const double n = 1023;
  const auto word = texels_of<std::uint32_t>({2u << 30 | 1023 << 20 | 5 << 10 | 7});
  expect_values(row(58, word), kRgba, {1, 5 / n, 7 / n, 2 / 3.0});
  expect_values(row(64, word), kRgba, {7 / n, 5 / n, 1, 2 / 3.0});
  EXPECT_EQ(info_of(row(58, word)).parts[0].type, PixelType::uint16);
  // Signed: 1023 is −1 of 511, 512 is −512, clamped to −1; alpha of two bits is −1, 0 or 1.
  const auto negative = texels_of<std::uint32_t>({2u << 30 | 1023 << 20 | 512 << 10 | 511, 1u << 30 | 3});
  expect_values(row(59, negative), kRgba, {-1 / 511.0, -1, 1, -1, 0, 0, 3 / 511.0, 1});
  expect_values(row(65, negative), kRgba, {1, -1, -1 / 511.0, -1, 3 / 511.0, 0, 0, 1});
  const auto bytes = texels_of<std::uint32_t>({4u << 24 | 3 << 16 | 2 << 8 | 1});
  expect_values(row(51, bytes), kRgba, {1 / 255.0, 2 / 255.0, 3 / 255.0, 4 / 255.0});
  expect_values(row(52, texels_of<std::uint32_t>({0x80ff017f})), kRgba, {1, 1 / 127.0, -1 / 127.0, -1});
  const Bytes srgb = row(57, bytes, [](OtherFile& file) { file.transfer = 2; });
  EXPECT_EQ(info_of(srgb).colour, Colour::srgb);
  EXPECT_FLOAT_EQ(decoded(srgb).at(0, 0)[0], 1 / 255.0f / 12.92f);
  EXPECT_EQ(decoded(srgb).at(0, 0)[3], 4 / 255.0f);
}

TEST(Ktx2Kinds, DoublesAreNarrowed) {
  const auto values = texels_of<double>({0.1, -1e30, 1e300, 4});
  EXPECT_EQ(decoded(row(112, values)).at(0, 0)[0], 0.1f);
  expect_values(row(115, values), kRg, {0.1f, -1e30f, INFINITY, 4});
  expect_values(row(121, values), kRgba, {0.1f, -1e30f, INFINITY, 4});
}

/// A block of one colour, as ASTC HDR, as UASTC HDR, and as that without a VkFormat. Only the first has
/// alpha.
TEST(Ktx2Kinds, AstcHdrIsDecoded) {
  const auto block = texels_of<std::uint64_t>({~std::uint64_t{3}, 0x3800400038003c00});
  const auto file = [&](std::uint32_t format, std::uint32_t model) {
    return row(format, block, [&](OtherFile& other) {
      other.type_size = 1;
      other.texel_bytes = 16;
      other.width = 1;
      other.model = model;
      other.block = 0x0303;
    });
  };
  expect_values(file(1000066000, 162), kRgba, {1, 0.5, 2, 0.5});
  expect_values(file(1000066000, 167), kRgb, {1, 0.5, 2});
  expect_values(file(0, 167), kRgb, {1, 0.5, 2});
  EXPECT_EQ(info_of(file(1000066000, 162)).parts[0].type, PixelType::astc_hdr);
  EXPECT_EQ(info_of(file(0, 167)).parts[0].type, PixelType::uastc_hdr);
  EXPECT_NE(error_of([&] { open(file(1000066000, 133), "a.ktx2"); }).find("colour model 133"),
            std::string::npos);
}

TEST(Ktx2Kinds, ChannelsOfEveryFormatCanBeTakenAlone) {
  const Bytes file = row(58, texels_of<std::uint32_t>({2u << 30 | 1023 << 20 | 5 << 10 | 7}));
  const auto reader = open(file, "a.ktx2");
  Image image(1, 1, 2);
  reader->read(0, std::vector<int>{3, 1}, image.view());
  EXPECT_EQ(image.at(0, 0)[0], 2 / 3.0f);
  EXPECT_EQ(image.at(0, 0)[1], 5 / 1023.0f);
}

TEST(Ktx2Kinds, OthersAreRefusedByNameWithARemedy) {
  const auto message = [](std::uint32_t format, std::uint32_t model = 1, std::uint32_t scheme = 0) {
    return error_of([&] {
      open(row(format, Bytes(16), [&](OtherFile& file) { file.model = model, file.scheme = scheme; }),
           "a.ktx2");
    });
  };
  const auto expect = [](const std::string& text, std::initializer_list<const char*> words) {
    for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
    EXPECT_EQ(text.find("VkFormat 1"), std::string::npos) << text;
  };
  expect(message(0, 166), {"Basis Universal (UASTC)", "`ktx transcode --target rgba8"});
  expect(message(0, 163), {"Basis Universal (ETC1S", "`ktx transcode --target rgba8"});
  expect(message(0, 163, 1), {"BasisLZ", "`ktx transcode --target rgba8"});
  expect(message(0, 168), {"UASTC HDR 6×6", "basisu -unpack"});
  expect(message(1000066004), {"VK_FORMAT_ASTC_6x6_SFLOAT_BLOCK", "ASTC HDR", "decompress it"});
  expect(message(1000066013), {"VK_FORMAT_ASTC_12x12_SFLOAT_BLOCK"});
  expect(message(157), {"VK_FORMAT_ASTC_4x4_UNORM_BLOCK", "(ASTC)"});
  expect(message(131), {"VK_FORMAT_BC1_RGB_UNORM_BLOCK", "(BC, S3TC)"});
  expect(message(147), {"ETC2"});
  expect(message(153), {"EAC"});
  expect(message(1000054001), {"PVRTC1_4BPP"});
  expect(message(1000156003), {"VK_FORMAT_G8_B8R8_2PLANE_420_UNORM", "video"});
  expect(message(1000156000), {"VK_FORMAT_G8B8G8R8_422_UNORM", "video"});
  expect(message(1000156033), {"VK_FORMAT_G16_B16_R16_3PLANE_444_UNORM"});
  expect(message(1000330000), {"VK_FORMAT_G8_B8R8_2PLANE_444_UNORM"});
  expect(message(1000288029), {"VK_FORMAT_ASTC_6x6x6_SFLOAT_BLOCK_EXT"});
  expect(message(124), {"VK_FORMAT_D16_UNORM, depth"});
  expect(message(126), {"VK_FORMAT_D32_SFLOAT, depth"});
  expect(message(130), {"VK_FORMAT_D32_SFLOAT_S8_UINT, depth"});
  expect(message(127), {"a stencil"});
  expect(message(13), {"VK_FORMAT_R8_UINT, whole numbers", "UNORM or SFLOAT"});
  expect(message(99), {"VK_FORMAT_R32_SINT, whole numbers", "SNORM or SFLOAT"});
  expect(message(11), {"USCALED", "forbids"});
  expect(message(1234567), {"a VkFormat that has no name here", "are not read"});
  EXPECT_EQ(message(1234567).find("1234567"), std::string::npos);
  const std::string slices = error_of([] {
    open(row(9, Bytes(4), [](OtherFile& file) { file.width = 2, file.height = 1, file.depth = 2; }),
         "a.ktx2");
  });
  expect(slices, {"three dimensions (2×1×2)", "ktx extract --all"});
}

Declared declared_of(const Bytes& file) {
  return ktx2_format().open({file, "a.ktx2", {}})->declared();
}

TEST(Ktx2Kinds, AlphaIsStraightUnlessTheFlagSaysOtherwise) {
  const auto with_flags = [](std::uint32_t format, std::uint32_t flags) {
    return row(format, Bytes(texels::find_format(format)->bytes()),
               [&](OtherFile& file) { file.flags = flags; });
  };
  EXPECT_EQ(declared_of(with_flags(109, 0)).alpha, AlphaKind::straight);
  EXPECT_EQ(declared_of(with_flags(109, 1)).alpha, AlphaKind::associated);
  EXPECT_EQ(declared_of(with_flags(43, 1)).alpha, AlphaKind::associated);
  EXPECT_EQ(declared_of(with_flags(106, 0)).alpha, AlphaKind::associated) << "there is none";
}

// Colours in memory are multiplied by alpha; where the map has none, A is 1 and either is true.
TEST(Ktx2Kinds, WrittenAlphaIsFlaggedAsMultiplied) {
  for (const int channels : {1, 2, 3, 4}) {
    const Bytes bytes = encoded("ktx2", noise(3, 2, channels));
    const std::uint32_t flags = word(bytes, word(bytes, 48) + 12) >> 24;
    EXPECT_EQ(flags, channels % 2 == 0 ? 1u : 0u);
    EXPECT_EQ(declared_of(bytes).alpha, channels % 2 == 0 ? AlphaKind::associated : AlphaKind::straight);
  }
}

// There is nothing to multiply by then, and no note of it.
TEST(Ktx2Kinds, AlphaThatWasAddedIsNoAlpha) {
  for (const char* channels : {"R,G,B", "R,G,B,A"}) {
    WriteOptions options;
    options.attributes["welkin.channels"] = channels;
    const Bytes bytes = encoded("ktx2", noise(3, 2, 3), options);
    const bool added = std::string(channels) == "R,G,B";
    EXPECT_EQ(declared_of(bytes).alpha, added ? AlphaKind::associated : AlphaKind::straight);
    EXPECT_EQ(info_of(bytes).notes.empty(), added);
  }
}

TEST(Ktx2Kinds, TransferAndPrimariesAreDeclared) {
  const auto with = [](std::uint32_t transfer, std::uint32_t primaries) {
    return row(91, Bytes(8), [&](OtherFile& file) { file.transfer = transfer, file.primaries = primaries; });
  };
  const auto curve = [&](std::uint32_t transfer) { return declared_of(with(transfer, 1)).curve; };
  EXPECT_EQ(curve(1), Curve::none);
  EXPECT_EQ(curve(2), Curve::none);
  EXPECT_EQ(info_of(with(2, 1)).colour, Colour::srgb);
  EXPECT_EQ(curve(3), Curve::bt709);
  EXPECT_EQ(curve(8), Curve::hlg);
  EXPECT_EQ(curve(9), Curve::hlg);
  EXPECT_EQ(curve(10), Curve::pq);
  EXPECT_EQ(info_of(with(10, 1)).colour, Colour::linear);
  for (const auto& [number, gamma] : {std::pair{4u, 2.2}, {7u, 2.4}, {12u, 2.6}, {18u, 2.19921875}}) {
    EXPECT_EQ(curve(number), Curve::gamma);
    EXPECT_EQ(declared_of(with(number, 1)).gamma, gamma);
  }
  for (const std::uint32_t number : {3u, 7u, 8u, 10u, 12u})
    EXPECT_TRUE(info_of(with(number, 1)).warnings.empty());
  for (const std::uint32_t number : {5u, 11u, 13u, 16u, 99u}) {
    EXPECT_EQ(curve(number), Curve::none);
    ASSERT_EQ(info_of(with(number, 1)).warnings.size(), 1u);
    EXPECT_NE(info_of(with(number, 1)).warnings[0].find("is not undone"), std::string::npos);
  }
  EXPECT_FALSE(declared_of(with(1, 0)).primaries);
  EXPECT_FALSE(declared_of(with(1, 1)).primaries);
  const Chromaticities bt2020{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};
  EXPECT_EQ(declared_of(with(1, 4)).primaries, bt2020);
  const Chromaticities p3{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}};
  EXPECT_EQ(declared_of(with(1, 10)).primaries, p3);
  for (const std::uint32_t number : {5u, 9u, 77u}) {
    EXPECT_FALSE(declared_of(with(1, number)).primaries);
    EXPECT_NE(info_of(with(1, number)).warnings.at(0).find("are not converted"), std::string::npos);
  }
}

TEST(Ktx2Kinds, SwizzleIsObeyed) {
  const auto swizzled = [](std::uint32_t format, const Bytes& texels, const std::string& letters) {
    return row(format, texels, [&](OtherFile& file) { file.keys = key("KTXswizzle", letters + '\0'); });
  };
  const double n = 255;
  const auto four = texels_of<std::uint8_t>({10, 20, 30, 40});
  const Bytes one{std::byte{10}}, two{std::byte{10}, std::byte{20}};
  expect_values(swizzled(37, four, "rgba"), kRgba, {10 / n, 20 / n, 30 / n, 40 / n});
  expect_values(swizzled(37, four, "bgra"), kRgba, {30 / n, 20 / n, 10 / n, 40 / n});
  expect_values(swizzled(37, four, "rgb1"), kRgb, {10 / n, 20 / n, 30 / n});
  expect_values(swizzled(37, four, "a0r0"), kRgba, {40 / n, 0, 10 / n, 0});
  expect_values(swizzled(9, one, "rrr1"), kY, {10 / n});
  expect_values(swizzled(9, one, "r001"), kR, {10 / n});
  expect_values(swizzled(16, two, "rrrg"), {"Y", "A"}, {10 / n, 20 / n});
  expect_values(swizzled(16, two, "rgb1"), kRg, {10 / n, 20 / n});
  expect_values(swizzled(16, two, "g1ra"), kRgb, {20 / n, 1, 10 / n});
  const Bytes straight = row(16, two, [](OtherFile& file) {
    file.keys = key("KTXswizzle", std::string("rrrg") + '\0');
    file.flags = 0;
  });
  EXPECT_EQ(declared_of(straight).alpha, AlphaKind::straight);
  // sRGB says how values are stored, and stays with them.
  const Bytes srgb = swizzled(43, four, "a001");
  EXPECT_EQ(decoded(srgb).at(0, 0)[0], 40 / 255.0f);
  for (const char* letters : {"rgb", "rgbaa", "xyzw", "RGBA"}) {
    const Bytes file = swizzled(37, four, letters);
    EXPECT_NE(info_of(file).warnings.at(0).find("not four of rgba01"), std::string::npos);
    expect_values(file, kRgba, {10 / n, 20 / n, 30 / n, 40 / n});
  }
  ReadOptions options;
  options.max_bytes = 12;
  EXPECT_THROW(open(swizzled(9, one, "rg0r"), "a", options), Error) << "four floats for one byte";
}

TEST(Ktx2Kinds, MapRangeIsWarnedOf) {
  const Bytes file =
      row(9, Bytes(1), [](OtherFile& other) { other.keys = key("KTXmapRange", std::string(8, '\1')); });
  EXPECT_NE(info_of(file).warnings.at(0).find("KTXmapRange"), std::string::npos);
}

TEST(Ktx2Kinds, DamageIsSurvived) {
  for (const std::uint32_t format : {4u, 38u, 58u, 121u, 1u})
    expect_damage_is_survived(row(format, Bytes(2 * texels::find_format(format)->bytes()),
                                  [](OtherFile& file) { file.keys = key("KTXswizzle", "rrr1"); }));
}

}  // namespace
}  // namespace welkin::io::test
