#include "welkin/io/unread_formats.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <vector>

#include "welkin/io/byte_order.h"

namespace welkin::io {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagick = "convert it to PNG, for instance by ImageMagick's `magick`";
constexpr std::string_view kDevelop = "develop it to EXR or TIFF, for instance by `darktable-cli`";
constexpr std::string_view kUnpack = "unpack it and name the picture inside";
constexpr std::string_view kFrame =
    "take a picture out of it, for instance by `ffmpeg -i VIDEO -frames:v 1 a.png`";

struct Known {
  std::size_t at;         ///< byte offset of the mark
  std::string_view mark;  ///< bytes
  std::string_view name;  ///< with its article
  std::string_view remedy;
};

/// Those with a mark at a place of its own. The first that fits is told.
constexpr Known kKnown[] = {
    {0, "PVR\3"sv, "a PVR texture", "convert it, for instance by `PVRTexToolCLI -d`"},
    {0, "\x13\xab\xa1\x5c"sv, "an ASTC texture",
     "convert it to EXR by `astcenc -dh` or to PNG by `astcenc -dl`"},
    {0, "VTF\0"sv, "a texture of Valve's (VTF)", "convert it, for instance by VTFEdit"},
    {0, "8BPS\0\1"sv, "a Photoshop document (PSD)", "save it as EXR or TIFF"},
    {0, "8BPS\0\2"sv, "a large Photoshop document (PSB)", "save it as EXR or TIFF"},
    {0, "gimp xcf"sv, "a GIMP document", "export it as EXR, TIFF or PNG"},
    {0, "BLENDER"sv, "a Blender document", "save the image in it as EXR or HDR"},
    {0, "GIF87a"sv, "a GIF picture", kMagick},
    {0, "GIF89a"sv, "a GIF picture", kMagick},
    {0, "qoif"sv, "a QOI picture", kMagick},
    {0, "\x53\x80\xf6\x34"sv, "a Softimage picture (PIC)", kMagick},
    {0, "\0\0\1\0"sv, "an icon", kMagick},
    {0, "SDPX"sv, "a DPX picture", "convert it to EXR, for instance by OpenImageIO's `oiiotool IN -o OUT`"},
    {0, "XPDS"sv, "a DPX picture", "convert it to EXR, for instance by OpenImageIO's `oiiotool IN -o OUT`"},
    {0, "\0\0\0\x0cjP  \r\n\x87\n"sv, "a JPEG 2000 picture",
     "convert it to TIFF, for instance by `opj_decompress`"},
    {0, "\xff\x4f\xff\x51"sv, "a JPEG 2000 codestream",
     "convert it to TIFF, for instance by `opj_decompress`"},
    {0, "II\xbc\1"sv, "a JPEG XR picture", "convert it to TIFF, for instance by `JxrDecApp`"},
    {0, "SIMPLE  ="sv, "a FITS picture", "convert it to TIFF or PFM"},
    {0, "\x93NUMPY"sv, "an array of NumPy", "write it as EXR or PFM"},
    {0, "FUJIFILMCCD-RAW"sv, "a camera's raw file (RAF)", kDevelop},
    {0, "IIRO"sv, "a camera's raw file (ORF)", kDevelop},
    {0, "IIRS"sv, "a camera's raw file (ORF)", kDevelop},
    {0, "MMOR"sv, "a camera's raw file (ORF)", kDevelop},
    {0, "IIU\0"sv, "a camera's raw file (RW2)", kDevelop},
    {4, "ftypcrx "sv, "a camera's raw file (CR3)", kDevelop},
    {0, "PK\3\4"sv, "a ZIP archive", kUnpack},
    {0, "\x1f\x8b\x08"sv, "a gzip archive", kUnpack},
    {0, "7z\xbc\xaf\x27\x1c"sv, "a 7z archive", kUnpack},
    {0,
     "\xfd"
     "7zXZ\0"sv,
     "an xz archive", kUnpack},
    {0, "\x28\xb5\x2f\xfd"sv, "a Zstandard archive", kUnpack},
    {0, "Rar!\x1a\7"sv, "a RAR archive", kUnpack},
    {257, "ustar"sv, "a tar archive", kUnpack},
    {0, "%PDF-"sv, "a PDF document", "make pictures of its pages, for instance by `pdftoppm -png`"},
    {8, "AVI LIST"sv, "a video (AVI)", kFrame},
    {0, "\x1a\x45\xdf\xa3"sv, "a video (Matroska or WebM)", kFrame},
    {4, "ftypqt  "sv, "a video (QuickTime)", kFrame},
    {4, "ftypisom"sv, "a video (MP4)", kFrame},
    {4, "ftypiso2"sv, "a video (MP4)", kFrame},
    {4, "ftypiso5"sv, "a video (MP4)", kFrame},
    {4, "ftypiso6"sv, "a video (MP4)", kFrame},
    {4, "ftypmp4"sv, "a video (MP4)", kFrame},
    {4, "ftypavc1"sv, "a video (MP4)", kFrame},
    {4, "ftypM4V"sv, "a video (MP4)", kFrame},
    {4, "ftypdash"sv, "a video (MP4)", kFrame},
    {4, "ftyp3g"sv, "a video (3GP)", kFrame},
    {0, "version https://git-lfs.github.com/spec/v1"sv, "a pointer of Git LFS in place of the picture",
     "run `git lfs pull` where it was cloned"},
};

std::string_view text_of(std::span<const std::byte> bytes, std::size_t longest) {
  return {reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), longest)};
}

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Whether `text` goes on so, in capitals or small letters.
bool begins(std::string_view text, std::string_view small) {
  return text.size() >= small.size() &&
         std::equal(small.begin(), small.end(), text.begin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

std::string told(std::string_view name, std::string_view remedy) {
  return std::string(name) + ", which is not read; " + std::string(remedy);
}

bool is_bmp(std::string_view text) {
  // The size of its second header, by which its kinds differ.
  constexpr int kSizes[] = {12, 16, 40, 52, 56, 64, 108, 124};
  if (!text.starts_with("BM") || text.size() < 18) return false;
  return text.substr(15, 3) == "\0\0\0"sv &&
         std::count(std::begin(kSizes), std::end(kSizes), static_cast<unsigned char>(text[14])) > 0;
}

/// TGA has no mark: either its footer, or fields that fit each other and the length.
bool is_tga(std::span<const std::byte> bytes) {
  constexpr std::string_view kFooter = "TRUEVISION-XFILE.\0"sv;
  constexpr std::size_t kHeader = 18, kMostBehind = 1 << 16;
  const auto at = [&](std::size_t i) { return std::to_integer<std::uint32_t>(bytes[i]); };
  if (bytes.size() < kHeader) return false;
  if (text_of(bytes, bytes.size()).ends_with(kFooter)) return true;
  const std::uint32_t map = at(1), type = at(2), map_length = at(5) | at(6) << 8, map_bits = at(7),
                      width = at(12) | at(13) << 8, height = at(14) | at(15) << 8, bits = at(16);
  constexpr std::uint32_t kBits[] = {8, 15, 16, 24, 32};
  const auto is_depth = [&](std::uint32_t n) {
    return std::count(std::begin(kBits), std::end(kBits), n) > 0;
  };
  const bool palette = type == 1 || type == 9;
  if (!palette && type != 2 && type != 3 && type != 10 && type != 11) return false;
  if (map != (palette ? 1u : 0u) ||
      (palette ? !is_depth(map_bits) || map_length == 0 : map_length != 0 || map_bits != 0))
    return false;
  if (width == 0 || height == 0 || !is_depth(bits) || (at(17) & 0xc0) != 0) return false;
  if (type > 3) return true;
  const std::uint64_t end = kHeader + at(0) + std::uint64_t{map_length} * ((map_bits + 7) / 8) +
                            std::uint64_t{width} * height * ((bits + 7) / 8);
  return end <= bytes.size() && bytes.size() - end <= kMostBehind;
}

bool is_basis(std::string_view text) {
  // `sB`, version 0x10…0x1f, size of the header 77.
  return text.size() > 6 && text.starts_with("sB") && (text[2] & 0xf0) == 0x10 &&
         text.substr(3, 3) == "\0\x4d\0"sv;
}

std::optional<std::string> unread_text(std::string_view text) {
  std::string_view rest = text;
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
  const auto holds = [&](std::string_view word) { return rest.find(word) != std::string_view::npos; };
  if (begins(rest, "<!doctype html") || begins(rest, "<html") || begins(rest, "<head"))
    return told("a web page (HTML) in place of the picture",
                "download the picture itself, not the page that shows it");
  if (begins(rest, "<?xml") || begins(rest, "<svg") || begins(rest, "<!--")) {
    if (holds("<svg")) return told("an SVG drawing", "draw it as PNG, for instance by `rsvg-convert`");
    return told("an XML text", "see what it says: servers answer so in place of a file");
  }
  if (begins(rest, "{")) {
    if (holds("\"asset\""))
      return told("a glTF model",
                  "name the picture of its environment, or pack its image-based light into a .glb");
    return told("a JSON text", "see what it says: servers answer so in place of a file");
  }
  const bool printable = std::none_of(text.begin(), text.end(), [](unsigned char c) {
    return (c < 32 && !is_space(static_cast<char>(c))) || c == 127;
  });
  constexpr std::size_t kFewest = 16;
  if (!printable || text.size() < kFewest) return {};
  std::string line(text.substr(0, std::min<std::size_t>(text.find_first_of("\r\n"), 40)));
  return told("a text ('" + line + "')", "see what it says: servers answer so in place of a file");
}

/// The entries of a TIFF's directory, as far as they are needed here; all reads stay inside.
class Directory {
 public:
  Directory(std::span<const std::byte> bytes, std::endian order, std::size_t at)
      : bytes_(bytes), order_(order) {
    if (at >= bytes.size() || bytes.size() - at < 2) return;
    const std::size_t count = load<std::uint16_t>(&bytes[at], order);
    first_ = at + 2;
    count_ = std::min(count, (bytes.size() - first_) / kEntry);
  }
  /// The values, shorts or longs, of a tag; none when there is no such tag.
  std::vector<std::uint32_t> values(std::uint16_t tag) const {
    constexpr std::size_t kMost = 16;
    std::vector<std::uint32_t> values;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t at = first_ + i * kEntry;
      if (load<std::uint16_t>(&bytes_[at], order_) != tag) continue;
      const std::size_t size = load<std::uint16_t>(&bytes_[at + 2], order_) == 3 ? 2 : 4;
      const std::size_t count = std::min<std::size_t>(load<std::uint32_t>(&bytes_[at + 4], order_), kMost);
      const std::size_t from = count * size <= 4 ? at + 8 : load<std::uint32_t>(&bytes_[at + 8], order_);
      if (from > bytes_.size() || bytes_.size() - from < count * size) return {};
      for (std::size_t k = 0; k < count; ++k) {
        values.push_back(size == 2 ? load<std::uint16_t>(&bytes_[from + 2 * k], order_)
                                   : load<std::uint32_t>(&bytes_[from + 4 * k], order_));
      }
      return values;
    }
    return values;
  }
  std::uint32_t value(std::uint16_t tag) const {
    const auto all = values(tag);
    return all.empty() ? 0 : all.front();
  }

 private:
  static constexpr std::size_t kEntry = 12;
  std::span<const std::byte> bytes_;
  std::endian order_;
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace

std::optional<std::string> camera_raw(std::span<const std::byte> bytes) {
  const std::string_view text = text_of(bytes, 16);
  if (text.size() < 16 || (!text.starts_with("II*\0"sv) && !text.starts_with("MM\0*"sv))) return {};
  if (text.substr(8, 2) == "CR") return told("a camera's raw file (CR2)", kDevelop);
  constexpr std::uint16_t kPhotometric = 262, kSubDirectories = 330, kDngVersion = 50706;
  constexpr std::uint32_t kFilterArray = 32803, kLinearRaw = 34892;
  const std::endian order = text.starts_with("II") ? std::endian::little : std::endian::big;
  const Directory main(bytes, order, load<std::uint32_t>(&bytes[4], order));
  if (!main.values(kDngVersion).empty()) return told("a camera's raw file (DNG)", kDevelop);
  const auto is_raw = [&](const Directory& directory) {
    const std::uint32_t photometric = directory.value(kPhotometric);
    return photometric == kFilterArray || photometric == kLinearRaw;
  };
  bool raw = is_raw(main);
  for (const std::uint32_t at : main.values(kSubDirectories))
    raw = raw || is_raw(Directory(bytes, order, at));
  if (!raw) return {};
  return told("a camera's raw file (NEF, ARW or the like)", kDevelop);
}

std::optional<std::string> unread_format(std::span<const std::byte> bytes) {
  constexpr std::size_t kSearched = 4096;
  const std::string_view text = text_of(bytes, kSearched);
  for (const Known& known : kKnown) {
    if (text.size() > known.at && text.substr(known.at).starts_with(known.mark))
      return told(known.name, known.remedy);
  }
  if (text.size() >= 3 && text[0] == 'P' && is_space(text[2])) {
    if (text[1] >= '1' && text[1] <= '6') return told("a PNM picture (PBM, PGM or PPM)", kMagick);
    if (text[1] == '7') return told("a PAM picture", kMagick);
    if (text[1] == 'H' || text[1] == 'h') return told("a portable half map (PHM)", "write it as PFM or EXR");
  }
  if (is_bmp(text)) return told("a BMP picture", kMagick);
  if (is_basis(text)) return told("a Basis texture", "unpack it by `basisu -unpack`");
  if (is_tga(bytes)) return told("a TGA picture", kMagick);
  if (text.find_first_not_of('\0') == std::string_view::npos)
    return "nothing but zeros, as a download that was broken off leaves; fetch the file again";
  return unread_text(text);
}

}  // namespace welkin::io
