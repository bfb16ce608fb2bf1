#include "view_stream.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/io/process.h"
#include "welkin/map/borders.h"
#include "welkin/sphere/convention.h"

namespace welkin::cli {
namespace {

constexpr const char* kStandardInput = "standard input";
/// Of decimal rates, the denominator; 1001 is that of NTSC's.
constexpr int kRateUnit = 1000;

}  // namespace

void StreamFlags::add(Command command) {
  command.add_option(
      "--stream", kind,
      "IN and OUT that are - are streams of frames, as ffmpeg pipes them: y4m, ppm, pfm is the kind "
      "of OUT; that of IN is known by its bytes");
  command.add_option("--rate", rate,
                     "Of a y4m, frames a second: 25, 30000/1001. Default: the input's, or 25");
  command.add_option("--matrix", matrix, "Of a y4m, how colours become Y′CbCr: bt601, bt709, bt2020")
      .show_default();
}

void StreamFlags::check_unused(const Command& command) const {
  if (asked()) return;
  for (const char* option : {"--rate", "--matrix"}) {
    if (command.option(option).given()) throw UsageError(std::string(option) + ": is for --stream");
  }
}

video::StreamKind StreamFlags::parse_kind() const {
  return parse_option("--stream", [&] { return video::stream_kind_from_name(kind); });
}

video::StreamColour StreamFlags::colour() const {
  return {parse_option("--matrix", [&] { return video::yuv_matrix_from_name(matrix); }), false};
}

std::optional<std::pair<int, int>> StreamFlags::parse_rate() const {
  if (rate.empty()) return std::nullopt;
  const std::size_t slash = rate.find('/');
  const std::optional<double> above = parse_number(rate.substr(0, slash));
  const std::optional<double> below = slash == std::string::npos ? 1.0 : parse_number(rate.substr(slash + 1));
  constexpr double kLargest = 1e6;
  const bool sound = above && below && *above > 0 && *below > 0 && *above <= kLargest && *below <= kLargest;
  if (!sound) throw UsageError("--rate: '" + rate + "' is no number of frames a second, as 25 or 30000/1001");
  const bool whole = *above == std::floor(*above) && *below == std::floor(*below);
  int numerator = static_cast<int>(std::lround(whole ? *above : *above / *below * kRateUnit));
  int denominator = whole ? static_cast<int>(*below) : kRateUnit;
  const int common = std::gcd(numerator, denominator);
  numerator /= common;
  denominator /= common;
  if (numerator == 0) throw UsageError("--rate: '" + rate + "' is too few frames a second");
  return std::pair{numerator, denominator};
}

WorldStream::WorldStream(const ReadFlags& read, const StreamFlags& flags)
    : read_(read),
      reader_(&io::read_standard_input, kStandardInput, {flags.colour().matrix, read.colour == "linear"}) {
  const ReadMapOptions options = read.parse();
  const MapFileInfo seen = inspect_picture({info().width, info().height},
                                           default_channel_names(info().channels), kStandardInput, options);
  if (!seen.shape)
    throw Error(ErrorKind::bad_request, kStandardInput,
                fmt::format("cannot tell which parameterization {}×{} is; name it with --from", info().width,
                            info().height));
  const MapShape& shape = *seen.shape;
  orientation_ = orientation_for(convention_from_name(read.convention.empty() ? "native" : read.convention),
                                 shape.parameterization);
  const bool one_picture = shape.layout.kind == LayoutKind::picture && shape.layout.name.empty();
  const bool as_it_is = read.faces.empty() && read.border == 0 && read.channels.empty() && !options.eye &&
                        seen.stereo != io::Stereo::top_bottom && seen.stereo != io::Stereo::left_right;
  if (one_picture && as_it_is) plain_ = shape;
}

std::vector<std::byte> WorldStream::as_file(ImageView<const float> frame) const {
  const io::WritePart part{.name = {}, .image = frame, .channels = default_channel_names(frame.channels)};
  io::MemorySink sink;
  io::write(sink, "pfm", {&part, 1});
  return sink.take();
}

Map WorldStream::world(std::span<const std::byte> stored) const {
  if (plain_) {
    Map map(plain_->parameterization, info().width, info().height, info().channels);
    map.channel_names = default_channel_names(info().channels);
    map.orientation = orientation_;
    reader_.decode(stored, map.level.chart(0));
    fill_borders(map, RimTexels::measured);
    return map;
  }
  Image frame(info().width, info().height, info().channels);
  reader_.decode(stored, frame.view());
  const std::vector<std::byte> file = as_file(frame.view());
  MapReader opened(file, kStandardInput, read_.parse());
  if (!read_.faces.empty()) opened.set_faces(read_.faces);
  opened.set_orientation(orientation_);
  return opened.read();
}

std::optional<StoredFrames> StoredFrames::make(const WorldStream& worlds, const MapFrame& seen,
                                               const video::StreamInfo& out) {
  const video::StreamInfo& in = worlds.info();
  const bool alike = in.kind == out.kind && in.bits == 8 && out.bits == 8 && in.channels == out.channels &&
                     in.full_range == out.full_range &&
                     (in.kind == video::StreamKind::y4m || in.largest == 255) && in.chroma == out.chroma &&
                     in.kind != video::StreamKind::pfm;
  // Of 4:2:0 with chroma amid four pixels, a plane of chroma is the picture at half the size.
  const bool centred = in.kind == video::StreamKind::ppm || in.chroma == video::Chroma::c420jpeg ||
                       in.chroma == video::Chroma::c444 || in.chroma == video::Chroma::mono;
  if (!alike || !centred || !worlds.plain_shape()) return std::nullopt;
  StoredFrames frames;
  frames.from_ = video::stored_planes(in);
  frames.to_ = video::stored_planes(out);
  const Layout layout = layouts_of(seen.parameterization).front();
  for (std::size_t i = 0; i < std::min<std::size_t>(frames.from_.size(), 2); ++i) {
    const video::StoredPlane &a = frames.from_[i], &b = frames.to_[i];
    const std::uint8_t black = i == 0 && in.kind == video::StreamKind::y4m && !in.full_range ? 16
                               : i == 0                                                      ? 0
                                                                                             : 128;
    // Of an odd size the last column of chroma stands for one pixel, which halving a picture doesn't know.
    if (i == 1 && (in.width % a.width != 0 || out.width % b.width != 0 || in.height % a.height != 0 ||
                   out.height % b.height != 0))
      return std::nullopt;
    MapFrame target = seen;
    target.size = {b.width, b.height};
    frames.remaps_.emplace_back(
        MapFrame(worlds.plain_shape()->parameterization, {a.width, a.height}, worlds.orientation()), target,
        layout, black);
  }
  frames.bytes_ = frames.to_.back().offset + static_cast<std::size_t>(frames.to_.back().width) *
                                                 static_cast<std::size_t>(frames.to_.back().height) *
                                                 static_cast<std::size_t>(frames.to_.back().channels);
  return frames;
}

void StoredFrames::apply(std::span<const std::byte> taken, const std::string& header,
                         std::vector<std::byte>& made) const {
  made.resize(header.size() + bytes_);
  const auto characters = std::as_bytes(std::span(header));
  std::copy(characters.begin(), characters.end(), made.begin());
  for (std::size_t i = 0; i < from_.size(); ++i) {
    const video::StoredPlane &a = from_[i], &b = to_[i];
    const auto* from = reinterpret_cast<const std::uint8_t*>(taken.data() + a.offset);
    auto* to = reinterpret_cast<std::uint8_t*>(made.data() + header.size() + b.offset);
    remaps_[std::min(i, remaps_.size() - 1)].apply(
        {from, a.width, a.height, a.channels, std::ptrdiff_t{a.channels} * a.width},
        {to, b.width, b.height, b.channels, std::ptrdiff_t{b.channels} * b.width});
  }
}

}  // namespace welkin::cli
