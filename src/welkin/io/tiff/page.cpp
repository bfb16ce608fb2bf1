#include "welkin/io/tiff/page.h"

#include <algorithm>
#include <optional>
#include <set>

#include "welkin/base/error.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/text_attributes.h"
#include "welkin/io/tiff/tiff.h"

namespace welkin::io {
namespace {

template <class T>
T field(TIFF* tiff, std::uint32_t tag, T otherwise) {
  T value = otherwise;
  return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? value : otherwise;
}

struct Compression {
  std::uint16_t code;
  const char* name;
  std::uint64_t best_ratio;  ///< uncompressed bytes per byte at most; 0: no useful bound
};
constexpr Compression kCompressions[] = {
    {COMPRESSION_NONE, "none", 1},
    {COMPRESSION_LZW, "lzw", 4096},
    {COMPRESSION_ADOBE_DEFLATE, "zip", 1032},
    {COMPRESSION_DEFLATE, "zip", 1032},
    {COMPRESSION_PACKBITS, "packbits", 64},
    {COMPRESSION_JPEG, "jpeg", 0},
    {COMPRESSION_LZMA, "lzma", 0},
    {COMPRESSION_ZSTD, "zstd", 0},
    {COMPRESSION_WEBP, "webp", 0},
    {COMPRESSION_LERC, "lerc", 0},
    {COMPRESSION_SGILOG, "sgilog", 0},
    {COMPRESSION_SGILOG24, "sgilog24", 0},
};

const Compression* find_compression(int code) {
  const auto* found = std::find_if(std::begin(kCompressions), std::end(kCompressions),
                                   [&](const Compression& each) { return each.code == code; });
  return found == std::end(kCompressions) ? nullptr : found;
}

/// Nothing when the samples have no PixelType.
std::optional<PixelType> sample_type(int bits, int format) {
  if (format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID) {
    if (bits == 8) return PixelType::uint8;
    if (bits == 16) return PixelType::uint16;
    if (bits == 32) return PixelType::uint32;
  }
  if (format == SAMPLEFORMAT_IEEEFP) {
    if (bits == 16) return PixelType::half;
    if (bits == 32 || bits == 64) return PixelType::float32;
  }
  return {};
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char c : text) {
    if (c == ',') {
      names.emplace_back();
    } else {
      names.back() += c;
    }
  }
  return names;
}

/// Y or R G B, then A where a sample is said to be alpha, then S4, S5… by position.
std::vector<std::string> names_of_samples(TIFF* tiff, int photometric, int samples, TiffPage& page) {
  const auto said = page.attributes.find(kTiffChannels);
  if (said != page.attributes.end()) {
    std::vector<std::string> names = split(said->second);
    page.attributes.erase(said);
    const std::set<std::string> distinct(names.begin(), names.end());
    if (static_cast<int>(names.size()) == samples && distinct.size() == names.size() &&
        distinct.count("") == 0) {
      return names;
    }
  }
  std::vector<std::string> names = {"Y"};
  if (photometric == PHOTOMETRIC_RGB) names = {"R", "G", "B"};
  names.resize(std::min(names.size(), static_cast<std::size_t>(samples)));
  const std::size_t colours = names.size();
  std::uint16_t extra_count = 0;
  std::uint16_t* extra = nullptr;
  TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &extra_count, &extra);
  bool has_alpha = false;
  for (std::size_t k = colours; k < static_cast<std::size_t>(samples); ++k) {
    const int kind = k - colours < extra_count ? extra[k - colours] : EXTRASAMPLE_UNSPECIFIED;
    const bool alpha = !has_alpha && (kind == EXTRASAMPLE_ASSOCALPHA || kind == EXTRASAMPLE_UNASSALPHA);
    if (alpha && kind == EXTRASAMPLE_ASSOCALPHA) page.notes.push_back("colours are multiplied by alpha");
    has_alpha = has_alpha || alpha;
    names.push_back(alpha ? "A" : std::string("S").append(std::to_string(k + 1)));
  }
  return names;
}

void read_text(TIFF* tiff, TiffPage& page) {
  constexpr std::pair<std::uint32_t, const char*> kTags[] = {{TIFFTAG_ARTIST, "Artist"},
                                                             {TIFFTAG_COPYRIGHT, "Copyright"},
                                                             {TIFFTAG_DATETIME, "DateTime"},
                                                             {TIFFTAG_MAKE, "Make"},
                                                             {TIFFTAG_MODEL, "Model"},
                                                             {TIFFTAG_SOFTWARE, "Software"},
                                                             {TIFFTAG_HOSTCOMPUTER, "HostComputer"},
                                                             {TIFFTAG_DOCUMENTNAME, "DocumentName"}};
  char* text = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) == 1) {
    parse_attribute_lines(text, "ImageDescription", page.attributes);
  }
  for (const auto& [tag, name] : kTags) {
    if (TIFFGetField(tiff, tag, &text) == 1) page.attributes.emplace(name, text);
  }
  if (TIFFGetField(tiff, TIFFTAG_PAGENAME, &text) == 1) page.part.name = text;
}

/// The rectangle that libtiff decodes at a time, whose memory is checked like that of a picture.
void read_blocks(TIFF* tiff, const Source& source, TiffPage& page) {
  page.tiled = TIFFIsTiled(tiff) != 0;
  std::uint32_t width = static_cast<std::uint32_t>(page.part.width);
  std::uint32_t height = static_cast<std::uint32_t>(page.part.height);
  if (page.tiled) {
    width = field<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0);
    height = field<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0);
    check_size(source, width, height, static_cast<std::uint64_t>(page.stored_samples));
  } else {
    height = std::clamp(field<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP, height), 1u, height);
  }
  page.block_width = static_cast<int>(width);
  page.block_height = static_cast<int>(height);
}

/// Grey or RGB samples that libtiff hands over as they are; false when only its RGBA conversion can read
/// them.
bool has_plain_samples(int photometric, int bits) {
  const bool grey_or_rgb = photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_MINISWHITE ||
                           photometric == PHOTOMETRIC_RGB;
  return grey_or_rgb && bits >= 8;
}

}  // namespace

void choose_tiff_conversions(TIFF* tiff) {
  const int photometric = field<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  const int compression = field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  if (compression == COMPRESSION_SGILOG || compression == COMPRESSION_SGILOG24) {
    TIFFSetField(tiff, TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT);
  }
  if (compression == COMPRESSION_JPEG && photometric == PHOTOMETRIC_YCBCR) {
    TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
  }
}

TiffPage understand_tiff_page(TIFF* tiff, const Source& source) {
  TiffPage page;
  page.directory = TIFFCurrentDirOffset(tiff);
  const auto fail = [&](const std::string& cause) {
    throw Error(ErrorKind::damaged, source.name,
                cause + " (directory at byte " + std::to_string(page.directory) + ")");
  };
  const std::uint32_t width = field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
  const std::uint32_t height = field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
  const int samples = field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  check_size(source, width, height, static_cast<std::uint64_t>(samples));
  choose_tiff_conversions(tiff);
  const int bits = field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
  const int format = field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  const int compression = field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  int photometric = field<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  if (TIFFIsCODECConfigured(static_cast<std::uint16_t>(compression)) == 0) {
    fail("compression " + std::to_string(compression) + " is not known here");
  }
  const Compression* known = find_compression(compression);
  const std::uint64_t stored = static_cast<std::uint64_t>(width) * height *
                               static_cast<std::uint64_t>(samples) * static_cast<std::uint64_t>(bits) / 8;
  if (known != nullptr && known->best_ratio > 0 && photometric != PHOTOMETRIC_YCBCR &&
      stored / known->best_ratio > source.bytes.size()) {
    fail(std::to_string(source.bytes.size()) + " bytes cannot hold " + std::to_string(width) + "×" +
         std::to_string(height) + " pixels");
  }

  page.part.width = static_cast<int>(width);
  page.part.height = static_cast<int>(height);
  page.part.compression = known != nullptr ? known->name : std::to_string(compression);
  page.stored_samples = samples;
  page.planar = samples > 1 && field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) ==
                                   PLANARCONFIG_SEPARATE;
  read_text(tiff, page);
  read_blocks(tiff, source, page);
  const int orientation = field<std::uint16_t>(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  if (orientation != ORIENTATION_TOPLEFT) {
    page.notes.push_back("its orientation of " + std::to_string(orientation) + " is not applied");
  }

  const bool sgi_log = compression == COMPRESSION_SGILOG || compression == COMPRESSION_SGILOG24;
  if (sgi_log && (photometric == PHOTOMETRIC_LOGLUV || photometric == PHOTOMETRIC_LOGL) && !page.planar) {
    const bool colour = photometric == PHOTOMETRIC_LOGLUV;
    if (samples != (colour ? 3 : 1)) fail("LogLuv of " + std::to_string(samples) + " samples");
    page.decoding = colour ? TiffDecoding::xyz : TiffDecoding::samples;
    page.part.type = PixelType::float32;
    page.part.channels = colour ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
    page.notes.push_back(colour ? "LogLuv, converted to linear RGB of sRGB primaries and white"
                                : "LogL luminance");
    return page;
  }
  // choose_tiff_conversions has made libtiff hand over RGB.
  if (compression == COMPRESSION_JPEG && photometric == PHOTOMETRIC_YCBCR) photometric = PHOTOMETRIC_RGB;
  if (has_plain_samples(photometric, bits)) {
    const auto type = sample_type(bits, format);
    if (!type) fail("samples of " + std::to_string(bits) + " bits and format " + std::to_string(format));
    page.part.type = *type;
    page.inverted = photometric == PHOTOMETRIC_MINISWHITE;
    if (page.inverted && format == SAMPLEFORMAT_IEEEFP) fail("floats of which 0 is white");
    if (bits == 64) {
      page.decoding = TiffDecoding::doubles;
      page.notes.push_back("64-bit floats, read as 32-bit ones");
    }
    page.part.channels = names_of_samples(tiff, photometric, samples, page);
    return page;
  }
  char why[1024] = {};
  if (TIFFRGBAImageOK(tiff, why) == 0) fail(why);
  page.attributes.erase(kTiffChannels);
  page.decoding = TiffDecoding::rgba;
  page.part.type = PixelType::uint8;
  page.part.channels = {"R", "G", "B"};
  std::uint16_t extra_count = 0;
  std::uint16_t* extra = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &extra_count, &extra) == 1 && extra_count > 0) {
    page.part.channels.push_back("A");
  }
  check_size(source, width, height, 4);
  page.notes.push_back("photometric interpretation " + std::to_string(photometric) + " of " +
                       std::to_string(bits) + " bits, converted to 8-bit RGB");
  return page;
}

}  // namespace welkin::io
