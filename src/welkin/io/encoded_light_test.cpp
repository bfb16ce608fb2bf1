#include "welkin/io/encoded_light.h"

#include <cmath>

#include "welkin/io/test_readers.h"

namespace welkin::io {
namespace {

using namespace test;

Image light(int channels = 3) {
  Image image(5, 4, channels);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5 * channels; ++x)
      image.at(0, y)[x] = 0.01f * std::pow(1.4f, static_cast<float>(x + y));
  }
  return image;
}

Bytes png(const Image& image, const std::string& encoding, WriteOptions options = {},
          WriteReport* report = nullptr) {
  options.encoding = LightEncoding::from_name(encoding);
  const WritePart part{
      "", image.view(),
      image.channels() == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"}};
  MemorySink sink;
  const WriteReport done = write(sink, "png", {&part, 1}, options);
  if (report != nullptr) *report = done;
  return sink.take();
}

TEST(EncodedLight, ComesBackWithoutBeingNamed) {
  const Image image = light();
  for (const std::string& name : light_encoding_names()) {
    WriteReport report;
    const Bytes bytes = png(image, name, {}, &report);
    const auto reader = open(bytes, "light.png");
    EXPECT_EQ(reader->info().parts[0].channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(reader->info().colour, Colour::linear);
    EXPECT_TRUE(reader->info().warnings.empty());
    const Image read = read_part(*reader);
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 15; ++x)
        EXPECT_NEAR(read.at(0, y)[x], std::min(image.at(0, y)[x], name == "rgbm" ? 6.0f : 1e9f), 0.05f)
            << name;
    }
    EXPECT_GT(report.relative_rmse(), 0) << name;
  }
}

/// The bytes are those of the encoding, whatever alpha is, and nothing says that they are colours.
TEST(EncodedLight, BytesAreTheEncodings) {
  Image bright(1, 1, 3);
  for (int c = 0; c < 3; ++c) bright.at(0, 0)[c] = c == 0 ? 64.0f : 1.0f;
  const Bytes bytes = png(bright, "rgbp");
  ReadOptions as_stored;
  as_stored.colour = Colour::linear;
  const Image stored = raw_picture(bytes, as_stored);
  EXPECT_EQ(std::lround(255 * stored.at(0, 0)[0]), 255);
  EXPECT_EQ(std::lround(255 * stored.at(0, 0)[1]), 32);  // 255/8
  EXPECT_EQ(stored.at(0, 0)[3], 0);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const char* chunk : {"gAMA", "sRGB", "cHRM", "iCCP"})
    EXPECT_EQ(text.find(chunk), std::string::npos) << chunk;
}

TEST(EncodedLight, IsReadAsAsked) {
  // The same bytes under another name.
  const Bytes bytes = png(light(), "rgbm");
  ReadOptions options;
  options.encoding = LightEncoding::from_name("rgbm,range=12");
  const Image twice = read_part(*open(bytes, "light.png", options)),
              once = read_part(*open(bytes, "light.png"));
  for (int x = 0; x < 15; ++x) EXPECT_FLOAT_EQ(twice.at(0, 1)[x], 2 * once.at(0, 1)[x]);
}

TEST(EncodedLight, GreyIsWrittenAsColours) {
  const Image grey = light(1);
  const Image read = read_part(*open(png(grey, "rgbd"), "light.png"));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(read.at(4, 3)[c], *grey.at(4, 3), 0.005f);
}

TEST(EncodedLight, RefusesWhatHoldsNone) {
  const auto refusal = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const Error& error) {
      return error.what();
    }
    return "done";
  };
  const Image image = light();
  const WritePart part{"", image.view(), {"R", "G", "B"}};
  WriteOptions options;
  MemorySink plain;
  write(plain, "png", {&part, 1}, options);
  ReadOptions asked;
  asked.encoding = LightEncoding::from_name("rgbe");
  const std::string unfit = refusal([&] { open(plain.bytes(), "light.png", asked); });
  EXPECT_NE(unfit.find("light.png: is no picture of R, G, B and A of 8 bits each"), std::string::npos)
      << unfit;
  options.encoding = LightEncoding::from_name("rgbd");
  MemorySink sink;
  EXPECT_NE(refusal([&] { write(sink, "exr", {&part, 1}, options); }).find("PNG is"), std::string::npos);
  options.type = PixelType::uint16;
  EXPECT_NE(refusal([&] {
              write(sink, "png", {&part, 1}, options);
            }).find("is of 8 bits"),
            std::string::npos);
  options.type = {};
  options.colour = Colour::srgb;
  EXPECT_NE(refusal([&] { write(sink, "png", {&part, 1}, options); }).find("not sRGB"), std::string::npos);
  // What a file says of itself is not trusted.
  WriteOptions lying;
  lying.attributes[kEncodingKey] = "rgbd";
  MemorySink liar;
  write(liar, "png", {&part, 1}, lying);
  EXPECT_FALSE(open(liar.bytes(), "light.png")->info().warnings.empty());
  lying.attributes[kEncodingKey] = "rgbx";
  MemorySink unknown;
  write(unknown, "png", {&part, 1}, lying);
  EXPECT_FALSE(open(unknown.bytes(), "light.png")->info().warnings.empty());
}

}  // namespace
}  // namespace welkin::io
