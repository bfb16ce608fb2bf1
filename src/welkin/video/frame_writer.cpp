#include "welkin/video/frame_writer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/video/pixmap.h"
#include "welkin/video/yuv.h"

namespace welkin::video {
namespace {

std::string chroma_name(const StreamInfo& info) {
  const bool deep = info.bits > 8;
  const std::string bits = deep ? std::to_string(info.bits) : "";
  switch (info.chroma) {
    case Chroma::c420jpeg:
    case Chroma::c420mpeg2:
    case Chroma::c420paldv:
      if (deep) return "420p" + bits;
      return info.chroma == Chroma::c420jpeg    ? "420jpeg"
             : info.chroma == Chroma::c420mpeg2 ? "420mpeg2"
                                                : "420paldv";
    case Chroma::c422:
      return deep ? "422p" + bits : "422";
    case Chroma::c444:
      return deep ? "444p" + bits : "444";
    case Chroma::mono:
      break;
  }
  return "mono" + bits;
}

std::string y4m_header(const StreamInfo& info) {
  std::string text = "YUV4MPEG2 W" + std::to_string(info.width) + " H" + std::to_string(info.height);
  const int rate = info.rate_numerator > 0 ? info.rate_numerator : 25;
  text += " F" + std::to_string(rate) + ":" +
          std::to_string(info.rate_numerator > 0 ? info.rate_denominator : 1) + " Ip A" +
          std::to_string(info.aspect_numerator) + ":" + std::to_string(info.aspect_denominator) + " C" +
          chroma_name(info);
  return text + (info.full_range ? " XCOLORRANGE=FULL\n" : " XCOLORRANGE=LIMITED\n");
}

/// What lies outside of 0 … 1, and is no number.
io::WriteReport clipped_of(ImageView<const float> frame) {
  io::WriteReport report;
  for (int y = 0; y < frame.height; ++y) {
    const float* const row = frame.row(y);
    for (int i = 0; i < frame.width * frame.channels; ++i) {
      report.above += row[i] > 1 ? 1 : 0;
      report.below += row[i] < 0 ? 1 : 0;
      report.not_finite += std::isnan(row[i]) ? 1 : 0;
    }
  }
  return report;
}

/// Grey of a colour, by BT.709's weights.
Image grey_of(ImageView<const float> frame) {
  Image grey(frame.width, frame.height, 1);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const float* const rgb = frame.at(x, y);
      *grey.at(x, y) = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
    }
  }
  return grey;
}

bool holds(StreamKind kind, int bits) {
  if (kind == StreamKind::pfm) return bits == 32;
  if (kind == StreamKind::ppm) return bits == 8 || bits == 16;
  return bits >= 8 && bits <= 16 && bits % 2 == 0;
}

}  // namespace

FrameWriter::FrameWriter(WriteBytes write, const StreamInfo& info, const StreamColour& colour)
    : write_(std::move(write)), info_(info), colour_(colour) {
  require(info.width > 0 && info.height > 0, "frames have a width and a height of 1 or more");
  require(info.channels == 1 || info.channels == 3, "frames have one channel or three");
  require(info.kind != StreamKind::y4m || (info.channels == 1) == (info.chroma == Chroma::mono),
          "frames of one channel are mono, and mono frames have one channel");
  if (!holds(info.kind, info.bits))
    throw Error(ErrorKind::bad_request, std::string(name_of(info.kind)) + " holds no values of " +
                                            std::to_string(info.bits) + " bits");
}

io::WriteReport FrameWriter::encode(ImageView<const float> frame, std::vector<std::byte>& stored) const {
  if (frame.width != info_.width || frame.height != info_.height)
    throw Error(ErrorKind::mismatch, "a frame of " + std::to_string(frame.width) + "×" +
                                         std::to_string(frame.height) + " in a stream of " +
                                         std::to_string(info_.width) + "×" + std::to_string(info_.height));
  if (frame.channels != info_.channels) {
    require(frame.channels == 3, "a frame has the stream's channels, or R G B");
    return encode(grey_of(frame).view(), stored);
  }
  if (info_.kind != StreamKind::y4m) return encode_pixmap(info_, colour_, frame, stored);
  const std::string header = frame_header();
  stored.resize(header.size() + yuv_bytes(info_));
  std::copy_n(std::as_bytes(std::span(header)).begin(), header.size(), stored.begin());
  encode_yuv(info_, colour_, frame, std::span(stored).subspan(header.size()));
  return clipped_of(frame);
}

std::string FrameWriter::frame_header() const {
  return info_.kind == StreamKind::y4m ? "FRAME\n" : pixmap_header(info_);
}

void FrameWriter::put(std::span<const std::byte> stored) {
  if (!begun_ && info_.kind == StreamKind::y4m) {
    const std::string header = y4m_header(info_);
    write_(std::as_bytes(std::span(header)));
  }
  begun_ = true;
  write_(stored);
}

}  // namespace welkin::video
