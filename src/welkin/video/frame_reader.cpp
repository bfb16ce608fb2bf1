#include "welkin/video/frame_reader.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

#include "welkin/base/error.h"
#include "welkin/video/pixmap.h"
#include "welkin/video/yuv.h"

namespace welkin::video {
namespace {

constexpr std::string_view kY4m = "YUV4MPEG2", kFrame = "FRAME";
constexpr std::size_t kLongestLine = 4096;
constexpr int kLongestSide = 1 << 20;

struct ChromaName {
  std::string_view name;
  Chroma chroma;
  int bits;
};

constexpr ChromaName kChromas[] = {
    {"420", Chroma::c420jpeg, 8},       {"420jpeg", Chroma::c420jpeg, 8},  {"420mpeg2", Chroma::c420mpeg2, 8},
    {"420paldv", Chroma::c420paldv, 8}, {"422", Chroma::c422, 8},          {"444", Chroma::c444, 8},
    {"mono", Chroma::mono, 8},          {"420p10", Chroma::c420mpeg2, 10}, {"422p10", Chroma::c422, 10},
    {"444p10", Chroma::c444, 10},       {"420p12", Chroma::c420mpeg2, 12}, {"422p12", Chroma::c422, 12},
    {"444p12", Chroma::c444, 12},       {"420p14", Chroma::c420mpeg2, 14}, {"422p14", Chroma::c422, 14},
    {"444p14", Chroma::c444, 14},       {"420p16", Chroma::c420mpeg2, 16}, {"422p16", Chroma::c422, 16},
    {"444p16", Chroma::c444, 16},       {"mono10", Chroma::mono, 10},      {"mono12", Chroma::mono, 12},
    {"mono16", Chroma::mono, 16}};

[[noreturn]] void damaged(const std::string& cause) {
  throw Error(ErrorKind::damaged, cause);
}
[[noreturn]] void unsupported(const std::string& cause) {
  throw Error(ErrorKind::unsupported, cause);
}

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// `a:b`, neither negative.
void read_ratio(std::string_view text, int& numerator, int& denominator) {
  const std::size_t colon = text.find(':');
  const auto a = whole_number(text.substr(0, colon)),
             b = whole_number(colon == text.npos ? std::string_view() : text.substr(colon + 1));
  if (!a || !b || *a < 0 || *b < 0) damaged("its header's '" + std::string(text) + "' is no ratio");
  if (*b == 0) return;  // not said
  numerator = *a;
  denominator = *b;
}

void read_chroma(std::string_view name, StreamInfo& info) {
  const auto found =
      std::find_if(std::begin(kChromas), std::end(kChromas), [&](const auto& c) { return c.name == name; });
  if (found == std::end(kChromas))
    unsupported("its chroma is '" + std::string(name) +
                "': 420, 422, 444 and mono of 8 to 16 bits are read (ffmpeg -pix_fmt yuv420p)");
  info.chroma = found->chroma;
  info.bits = found->bits;
  info.channels = found->chroma == Chroma::mono ? 1 : 3;
}

StreamInfo y4m_info(const std::string& line) {
  StreamInfo info;
  std::istringstream words(line);
  std::string word;
  words >> word;
  while (words >> word) {
    const std::string_view value = std::string_view(word).substr(1);
    switch (word[0]) {
      case 'W':
      case 'H': {
        const auto side = whole_number(value);
        if (!side || *side < 1 || *side > kLongestSide)
          damaged("its header's '" + word + "' is no side of 1 … " + std::to_string(kLongestSide));
        (word[0] == 'W' ? info.width : info.height) = *side;
        break;
      }
      case 'F':
        read_ratio(value, info.rate_numerator, info.rate_denominator);
        break;
      case 'A':
        read_ratio(value, info.aspect_numerator, info.aspect_denominator);
        break;
      case 'I':
        if (value != "p" && value != "?")
          unsupported("its frames are interlaced: deinterlace them first (ffmpeg -vf bwdif)");
        break;
      case 'C':
        read_chroma(value, info);
        break;
      case 'X':
        if (value == "COLORRANGE=FULL") info.full_range = true;
        break;
      default:
        break;
    }
  }
  if (info.width == 0 || info.height == 0) damaged("its header has no width or no height");
  return info;
}

/// What a FrameReader is.
class StreamReader {
 public:
  StreamReader(ReadBytes read, std::string name, const StreamColour& colour, std::uint64_t max_bytes)
      : read_(std::move(read)), name_(std::move(name)), colour_(colour) {
    guard([&] {
      const std::string magic = characters(2);
      if (is_pixmap(magic)) {
        header_ = read_pixmap_header(magic[1], [this] { return next_byte(); });
        pending_ = true;
      } else {
        const std::string rest = magic == kY4m.substr(0, 2) ? characters(kY4m.size() - 2) : "";
        if (magic + rest != kY4m) unsupported("is no stream of frames: y4m, PPM (P5, P6) and PFM are read");
        header_.info = y4m_info("YUV4MPEG2" + line());
      }
      check_size(max_bytes);
    });
  }

  const StreamInfo& info() const { return header_.info; }

  bool take(std::vector<std::byte>& stored) {
    bool any = false;
    guard([&] {
      if (!begin_frame()) return;
      stored.resize(header_.info.kind == StreamKind::y4m ? yuv_bytes(header_.info) : pixmap_bytes(header_));
      const std::size_t had = read_(stored);
      if (had < stored.size())
        damaged("frame " + std::to_string(frames_) + " ends after " + std::to_string(had) + " of " +
                std::to_string(stored.size()) + " bytes");
      ++frames_;
      any = true;
    });
    return any;
  }

  void decode(std::span<const std::byte> stored, ImageView<float> frame) const {
    require(frame.width == info().width && frame.height == info().height && frame.channels == info().channels,
            "a frame has the stream's size and channels");
    if (header_.info.kind == StreamKind::y4m) {
      decode_yuv(header_.info, colour_, stored, frame);
    } else {
      decode_pixmap(header_, colour_, stored, frame);
    }
  }

 private:
  static bool is_pixmap(const std::string& magic) {
    return magic == "P5" || magic == "P6" || magic == "PF" || magic == "Pf";
  }

  template <class Body>
  void guard(const Body& body) const {
    try {
      body();
    } catch (const Error& error) {
      if (!error.file().empty()) throw;
      throw in_file(name_, error);
    }
  }

  void check_size(std::uint64_t max_bytes) const {
    const std::uint64_t bytes = sizeof(float) * static_cast<std::uint64_t>(header_.info.width) *
                                static_cast<std::uint64_t>(header_.info.height) *
                                static_cast<std::uint64_t>(header_.info.channels);
    if (bytes > max_bytes)
      throw Error(ErrorKind::too_large, "frames of " + std::to_string(header_.info.width) + "×" +
                                            std::to_string(header_.info.height) + " need " +
                                            std::to_string(bytes) + " bytes, over the limit of " +
                                            std::to_string(max_bytes));
  }

  std::optional<unsigned char> next_byte() {
    std::byte byte;
    if (read_({&byte, 1}) == 0) return std::nullopt;
    return std::to_integer<unsigned char>(byte);
  }

  /// The next ones, fewer at the stream's end.
  std::string characters(std::size_t count) {
    std::string text(count, '\0');
    text.resize(read_(std::as_writable_bytes(std::span(text))));
    return text;
  }

  /// To the end of the line.
  std::string line() {
    std::string text;
    while (const auto byte = next_byte()) {
      if (*byte == '\n') return text;
      text += static_cast<char>(*byte);
      if (text.size() > kLongestLine) damaged("its header has no end");
    }
    damaged("it ends within a header");
  }

  /// What stands before a frame's pixels; false at the stream's end.
  bool begin_frame() {
    if (std::exchange(pending_, false)) return true;
    const std::string number = std::to_string(frames_);
    if (header_.info.kind == StreamKind::y4m) {
      const std::string magic = characters(kFrame.size());
      if (magic.empty()) return false;
      if (magic != kFrame) damaged("frame " + number + " does not begin with FRAME");
      line();
      return true;
    }
    std::string magic = characters(1);
    while (magic == "\n" || magic == " ") magic = characters(1);
    if (magic.empty()) return false;
    magic += characters(1);
    if (!is_pixmap(magic)) damaged("frame " + number + " is no pixmap");
    const PixmapHeader next = read_pixmap_header(magic[1], [this] { return next_byte(); });
    const StreamInfo &a = header_.info, &b = next.info;
    if (a.kind != b.kind || a.width != b.width || a.height != b.height || a.channels != b.channels)
      damaged("frame " + number + " is " + std::to_string(b.width) + "×" + std::to_string(b.height) +
              " of another kind or size than frame 0, of " + std::to_string(a.width) + "×" +
              std::to_string(a.height));
    if (b.largest != a.largest || next.little_endian != header_.little_endian)
      damaged("frame " + number + " stores its values in another way than frame 0");
    return true;
  }

  ReadBytes read_;
  std::string name_;
  StreamColour colour_;
  PixmapHeader header_;
  bool pending_ = false;  ///< the first pixmap's header has been read
  std::uint64_t frames_ = 0;
};

}  // namespace

class FrameReader::State : public StreamReader {
 public:
  using StreamReader::StreamReader;
};

FrameReader::FrameReader(ReadBytes read, std::string name, const StreamColour& colour,
                         std::uint64_t max_bytes)
    : state_(std::make_unique<State>(std::move(read), std::move(name), colour, max_bytes)) {}
FrameReader::~FrameReader() = default;
FrameReader::FrameReader(FrameReader&&) noexcept = default;
FrameReader& FrameReader::operator=(FrameReader&&) noexcept = default;

const StreamInfo& FrameReader::info() const {
  return state_->info();
}

bool FrameReader::take(std::vector<std::byte>& stored) {
  return state_->take(stored);
}

void FrameReader::decode(std::span<const std::byte> stored, ImageView<float> frame) const {
  state_->decode(stored, frame);
}

}  // namespace welkin::video
