#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/video/frame_reader.h"
#include "welkin/video/frame_writer.h"

namespace welkin::video::test {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

FrameReader reader_of(const Bytes& bytes, const StreamColour& colour = {},
                      std::uint64_t max_bytes = std::uint64_t{1} << 30) {
  auto at = std::make_shared<std::size_t>(0);
  return FrameReader(
      [bytes, at](std::span<std::byte> to) {
        const std::size_t count = std::min(to.size(), bytes.size() - *at);
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(*at), count, to.begin());
        *at += count;
        return count;
      },
      "pipe", colour, max_bytes);
}

std::vector<Image> frames_of(FrameReader& reader) {
  std::vector<Image> frames;
  Bytes stored;
  while (reader.take(stored)) {
    frames.emplace_back(reader.info().width, reader.info().height, reader.info().channels);
    reader.decode(stored, frames.back().view());
  }
  return frames;
}

/// Not the same in any two frames, rows or channels.
Image frame(int number, int width, int height, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c)
        image.at(x, y)[c] = 0.05f + 0.01f * static_cast<float>(x + 3 * y) + 0.1f * static_cast<float>(c) +
                            0.02f * static_cast<float>(number);
    }
  }
  return image;
}

Bytes written(const StreamInfo& info, int frames) {
  Bytes all, stored;
  FrameWriter writer(
      [&](std::span<const std::byte> bytes) { all.insert(all.end(), bytes.begin(), bytes.end()); }, info);
  for (int i = 0; i < frames; ++i) {
    const io::WriteReport report =
        writer.encode(frame(i, info.width, info.height, info.channels).view(), stored);
    EXPECT_EQ(report.above + report.below + report.not_finite, 0u);
    writer.put(stored);
  }
  return all;
}

StreamInfo info_of(StreamKind kind, int bits, int channels, Chroma chroma = Chroma::c444) {
  StreamInfo info;
  info.kind = kind;
  info.width = 9;
  info.height = 5;
  info.bits = bits;
  info.channels = channels;
  info.chroma = chroma;
  info.rate_numerator = 30000;
  info.rate_denominator = 1001;
  return info;
}

TEST(FrameStream, FramesComeBack) {
  for (const StreamInfo& info :
       {info_of(StreamKind::y4m, 8, 3), info_of(StreamKind::y4m, 10, 3), info_of(StreamKind::y4m, 16, 3),
        info_of(StreamKind::y4m, 8, 1, Chroma::mono), info_of(StreamKind::ppm, 8, 3),
        info_of(StreamKind::ppm, 16, 3), info_of(StreamKind::ppm, 8, 1), info_of(StreamKind::pfm, 32, 3),
        info_of(StreamKind::pfm, 32, 1)}) {
    SCOPED_TRACE(std::string(name_of(info.kind)) + " " + std::to_string(info.bits) + " " +
                 std::to_string(info.channels));
    FrameReader reader = reader_of(written(info, 3));
    EXPECT_EQ(reader.info().kind, info.kind);
    EXPECT_EQ(reader.info().bits, info.bits);
    EXPECT_EQ(reader.info().width, 9);
    EXPECT_EQ(reader.info().height, 5);
    if (info.kind == StreamKind::y4m) {
      EXPECT_EQ(reader.info().rate_numerator, 30000);
      EXPECT_EQ(reader.info().rate_denominator, 1001);
      EXPECT_EQ(reader.info().chroma, info.chroma);
    }
    const std::vector<Image> frames = frames_of(reader);
    ASSERT_EQ(frames.size(), 3u);
    for (int i = 0; i < 3; ++i) {
      const Image wanted = frame(i, 9, 5, info.channels);
      // A step of sRGB is at most 2.3 times one of light here.
      const float tolerance =
          info.kind == StreamKind::pfm ? 0 : 4.0f / static_cast<float>(1 << info.bits) + 2e-5f;
      for (int y = 0; y < 5; ++y) {
        for (int k = 0; k < 9 * info.channels; ++k)
          ASSERT_NEAR(frames[static_cast<std::size_t>(i)].view().row(y)[k], wanted.view().row(y)[k],
                      tolerance)
              << i << " " << y << " " << k;
      }
    }
  }
}

TEST(FrameStream, HeadersAreReadAsProgramsWriteThem) {
  FrameReader film = reader_of(
      bytes_of("YUV4MPEG2 W2 H2 F24:1 Ip A0:0 C420jpeg XYSCSS=420JPEG XCOLORRANGE=FULL\nFRAME Ix\n") +
      Bytes(6, std::byte{128}));
  EXPECT_TRUE(film.info().full_range);
  EXPECT_EQ(film.info().aspect_denominator, 0);
  EXPECT_EQ(frames_of(film).size(), 1u);

  FrameReader pixmaps = reader_of(bytes_of("P6 # by hand\n# two\n1\t1\n255\nabcP6\n1 1\n255\ndef"));
  const std::vector<Image> frames = frames_of(pixmaps);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_GT(frames[1].at(0, 0)[0], frames[0].at(0, 0)[2]);
}

TEST(FrameStream, LinearIsNotDecoded) {
  FrameReader reader = reader_of(bytes_of("P5 1 1 255\n") + Bytes{std::byte{51}}, {YuvMatrix::bt601, true});
  EXPECT_FLOAT_EQ(*frames_of(reader).at(0).at(0, 0), 0.2f);
}

TEST(FrameStream, CountsWhatIsClipped) {
  StreamInfo info = info_of(StreamKind::y4m, 8, 3);
  info.width = 3;
  info.height = 1;
  Image image(3, 1, 3);
  image.at(0, 0)[0] = 2;
  image.at(1, 0)[1] = -1;
  image.at(2, 0)[2] = NAN;
  for (const StreamKind kind : {StreamKind::y4m, StreamKind::ppm}) {
    info.kind = kind;
    Bytes stored;
    const io::WriteReport report = FrameWriter([](auto) {}, info).encode(image.view(), stored);
    EXPECT_EQ(report.above, 1u);
    EXPECT_EQ(report.below, 1u);
    EXPECT_EQ(report.not_finite, 1u);
  }
}

std::string message_of(const Bytes& bytes) {
  try {
    FrameReader reader = reader_of(bytes);
    frames_of(reader);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FrameStream, DamageIsTold) {
  const auto says = [](const std::string& part, const Bytes& bytes) {
    const std::string message = message_of(bytes);
    EXPECT_NE(message.find(part), std::string::npos) << message << "\n  not: " << part;
    EXPECT_EQ(message.find("pipe: "), 0u) << message;
  };
  const auto text = [&](const std::string& part, const std::string& stream) { says(part, bytes_of(stream)); };
  text("no stream of frames", "");
  text("no stream of frames", "RIFF");
  text("no width", "YUV4MPEG2 H2\n");
  text("'W0'", "YUV4MPEG2 W0 H2\n");
  text("'W99999999999'", "YUV4MPEG2 W99999999999 H2\n");
  text("interlaced", "YUV4MPEG2 W2 H2 It\n");
  text("chroma is '411'", "YUV4MPEG2 W2 H2 C411\n");
  text("within a header", "YUV4MPEG2 W2");
  text("has no end", "YUV4MPEG2 " + std::string(5000, 'x'));
  text("frame 0 does not begin", "YUV4MPEG2 W2 H2\nframe\n");
  text("frame 0 ends after 3 of 6", "YUV4MPEG2 W2 H2\nFRAME\nabc");
  text("width 'x'", "P6 x ");
  text("width '0'", "P6 0 1 255\n");
  text("largest value '70000'", "P6 1 1 70000\n");
  text("scale '0'", "PF 1 1 0\n");
  text("within a header", "P6 1 1");
  text("frame 1 is no pixmap", "P5 1 1 255\naXY");
  text("than frame 0", "P5 1 1 255\naP5 2 1 255\nab");
  text("another way", "P5 1 1 255\naP5 1 1 100\na");
  text("frame 1 ends after 0 of 1", "P5 1 1 255\naP5 1 1 255\n");
  EXPECT_THROW(reader_of(bytes_of("P6 100000 100000 255\n")), Error);
}

TEST(FrameStream, WritersRefuseWhatTheyCannotHold) {
  const auto refuses = [](StreamInfo info) { EXPECT_THROW(FrameWriter([](auto) {}, info), Error); };
  refuses(info_of(StreamKind::y4m, 9, 3));
  refuses(info_of(StreamKind::y4m, 8, 1, Chroma::c444));
  refuses(info_of(StreamKind::ppm, 10, 3));
  refuses(info_of(StreamKind::pfm, 8, 3));
  Bytes stored;
  EXPECT_THROW(
      FrameWriter([](auto) {}, info_of(StreamKind::ppm, 8, 3)).encode(frame(0, 4, 4, 3).view(), stored),
      Error);
}

}  // namespace
}  // namespace welkin::video::test
