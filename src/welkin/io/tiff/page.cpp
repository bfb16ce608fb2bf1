#include "welkin/io/tiff/page.h"

#include <algorithm>
#include <set>

#include "welkin/base/error.h"
#include "welkin/io/text_attributes.h"
#include "welkin/io/tiff/declare.h"
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
    {COMPRESSION_CCITTRLE, "ccitt-rle", 0},
    {COMPRESSION_CCITTRLEW, "ccitt-rle-w", 0},
    {COMPRESSION_CCITTFAX3, "ccitt-fax3", 0},
    {COMPRESSION_CCITTFAX4, "ccitt-fax4", 0},
    {COMPRESSION_OJPEG, "old-jpeg", 0},
    {COMPRESSION_NEXT, "next", 0},
    {COMPRESSION_THUNDERSCAN, "thunderscan", 0},
    {COMPRESSION_PIXARLOG, "pixarlog", 0},
    {COMPRESSION_JBIG, "jbig", 0},
    {COMPRESSION_JP2000, "jpeg-2000", 0},
    {33003, "jpeg-2000", 0},
    {33005, "jpeg-2000", 0},
    {50002, "jpeg-xl", 0},
};

const Compression* find_compression(int code) {
  const auto* found = std::find_if(std::begin(kCompressions), std::end(kCompressions),
                                   [&](const Compression& each) { return each.code == code; });
  return found == std::end(kCompressions) ? nullptr : found;
}

/// What pixels are; for messages.
std::string name_of_photometric(int photometric) {
  switch (photometric) {
    case PHOTOMETRIC_MINISWHITE:
    case PHOTOMETRIC_MINISBLACK:
      return "grey";
    case PHOTOMETRIC_RGB:
      return "RGB";
    case PHOTOMETRIC_PALETTE:
      return "palette";
    case PHOTOMETRIC_MASK:
      return "transparency mask";
    case PHOTOMETRIC_SEPARATED:
      return "CMYK";
    case PHOTOMETRIC_YCBCR:
      return "YCbCr";
    case PHOTOMETRIC_CIELAB:
      return "CIE L*a*b*";
    case PHOTOMETRIC_ICCLAB:
      return "ICC L*a*b*";
    case PHOTOMETRIC_ITULAB:
      return "ITU L*a*b*";
    case PHOTOMETRIC_CFA:
      return "colour filter array";
    case PHOTOMETRIC_LOGL:
      return "LogL";
    case PHOTOMETRIC_LOGLUV:
      return "LogLuv";
    default:
      return "unknown";
  }
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

/// Names by the attribute that Welkin writes; none where it doesn't fit.
std::vector<std::string> said_names(int samples, TiffPage& page) {
  const auto said = page.attributes.find(kTiffChannels);
  if (said == page.attributes.end()) return {};
  std::vector<std::string> names = split(said->second);
  page.attributes.erase(said);
  const std::set<std::string> distinct(names.begin(), names.end());
  if (static_cast<int>(names.size()) != samples || distinct.size() != names.size() || distinct.count("") != 0)
    return {};
  return names;
}

/// Names the channels: Y or R G B, then A where a sample is said to be alpha, then S4, S5… by position.
void name_samples(TIFF* tiff, int photometric, int samples, TiffPage& page) {
  std::vector<std::string> names = {"Y"};
  if (photometric == PHOTOMETRIC_RGB) names = {"R", "G", "B"};
  names.resize(std::min(names.size(), static_cast<std::size_t>(samples)));
  const std::size_t colours = names.size();
  std::uint16_t extra_count = 0;
  std::uint16_t* extra = nullptr;
  TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &extra_count, &extra);
  for (std::size_t k = colours; k < static_cast<std::size_t>(samples); ++k) {
    const int kind = k - colours < extra_count ? extra[k - colours] : EXTRASAMPLE_UNSPECIFIED;
    const bool alpha = !page.associated && (kind == EXTRASAMPLE_ASSOCALPHA || kind == EXTRASAMPLE_UNASSALPHA);
    if (alpha) page.associated = kind == EXTRASAMPLE_ASSOCALPHA;
    names.push_back(alpha ? "A" : std::string("S").append(std::to_string(k + 1)));
  }
  const std::vector<std::string> said = said_names(samples, page);
  page.part.channels = said.empty() ? names : said;
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

/// Grey or RGB samples that libtiff hands over as they are; others only its RGBA conversion can read.
bool is_grey_or_rgb(int photometric) {
  return photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_MINISWHITE ||
         photometric == PHOTOMETRIC_RGB;
}

/// Whether libtiff's RGBA conversion can read the pixels.
bool can_convert(TIFF* tiff) {
  char why[1024] = {};
  TIFFRGBAImage image{};
  if (TIFFRGBAImageOK(tiff, why) == 0 || TIFFRGBAImageBegin(&image, tiff, 1, why) == 0) return false;
  TIFFRGBAImageEnd(&image);
  return true;
}

/// Throws when a strip or a tile lies outside the file.
void check_blocks(TIFF* tiff, const Source& source, const TiffPage& page) {
  const std::uint64_t size = source.bytes.size();
  const std::uint32_t count = page.tiled ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t offset = TIFFGetStrileOffset(tiff, i), bytes = TIFFGetStrileByteCount(tiff, i);
    if (bytes == 0 || (offset <= size && bytes <= size - offset)) continue;
    const std::string block = (page.tiled ? "tile " : "strip ") + std::to_string(i);
    throw Error(ErrorKind::damaged, source.name,
                block +
                    (offset >= size ? " begins at byte " + std::to_string(offset) + ", past the file's end"
                                    : ", at byte " + std::to_string(offset) + ", passes the file's end") +
                    " (byte " + std::to_string(size) +
                    "); the file was cut off, or its directory is damaged");
  }
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
  const auto throw_error = [&](ErrorKind kind, const std::string& cause) {
    throw Error(kind, source.name, cause + " (directory at byte " + std::to_string(page.directory) + ")");
  };
  const auto fail = [&](const std::string& cause) { throw_error(ErrorKind::damaged, cause); };
  const auto refuse = [&](const std::string& cause) {
    throw_error(ErrorKind::unsupported,
                cause + ", which is not read; convert it to RGB of 16-bit integers or floats");
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
  const Compression* known = find_compression(compression);
  if (TIFFIsCODECConfigured(static_cast<std::uint16_t>(compression)) == 0) {
    throw_error(ErrorKind::unsupported, (known != nullptr ? "compressed by " + std::string(known->name) +
                                                                ", which libtiff does not decode here"
                                                          : "compressed in a way that is not known here") +
                                            "; write it again with another compression");
  }
  const std::uint64_t stored = static_cast<std::uint64_t>(width) * height *
                               static_cast<std::uint64_t>(samples) * static_cast<std::uint64_t>(bits) / 8;
  if (known != nullptr && known->best_ratio > 0 && photometric != PHOTOMETRIC_YCBCR &&
      stored / known->best_ratio > source.bytes.size()) {
    fail(std::to_string(source.bytes.size()) + " bytes cannot hold " + std::to_string(width) + "×" +
         std::to_string(height) + " pixels");
  }

  page.part.width = static_cast<int>(width);
  page.part.height = static_cast<int>(height);
  page.part.compression = known != nullptr ? known->name : "unnamed";
  page.stored_samples = samples;
  page.planar = samples > 1 && field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) ==
                                   PLANARCONFIG_SEPARATE;
  read_text(tiff, page);
  read_blocks(tiff, source, page);
  check_blocks(tiff, source, page);

  const bool sgi_log = compression == COMPRESSION_SGILOG || compression == COMPRESSION_SGILOG24;
  if (sgi_log && (photometric == PHOTOMETRIC_LOGLUV || photometric == PHOTOMETRIC_LOGL) && !page.planar) {
    const bool colour = photometric == PHOTOMETRIC_LOGLUV;
    if (samples != (colour ? 3 : 1)) fail("LogLuv of " + std::to_string(samples) + " samples");
    page.samples = {TiffSamples::Kind::floating, 32};
    page.decoding = colour ? TiffDecoding::xyz : TiffDecoding::samples;
    page.part.type = PixelType::float32;
    page.part.channels = colour ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
    page.notes.push_back(colour ? "LogLuv, converted to linear RGB of sRGB primaries and white"
                                : "LogL luminance");
    declare_tiff_page(tiff, false, page);
    return page;
  }
  // choose_tiff_conversions has made libtiff hand over RGB.
  if (compression == COMPRESSION_JPEG && photometric == PHOTOMETRIC_YCBCR) photometric = PHOTOMETRIC_RGB;
  if (is_grey_or_rgb(photometric)) {
    const auto type = tiff_samples(bits, format);
    if (!type) refuse("a picture of " + name_of_tiff_samples(bits, format));
    page.samples = *type;
    page.part.type = type->type();
    page.inverted = photometric == PHOTOMETRIC_MINISWHITE;
    if (page.inverted && type->kind != TiffSamples::Kind::unsigned_integer)
      refuse("a picture of " + type->name() + " of which 0 is white");
    if (!type->plain()) page.notes.push_back(type->name());
    // Samples beside grey are not inverted with it.
    if (!type->plain() || (page.inverted && samples > 1)) page.decoding = TiffDecoding::unpack;
    if (type->kind == TiffSamples::Kind::signed_integer)
      page.warnings.push_back(type->name() +
                              " are read as linear values, the largest as 1; negative ones are kept");
    name_samples(tiff, photometric, samples, page);
    declare_tiff_page(tiff, true, page);
    return page;
  }
  const std::string kind = name_of_photometric(photometric);
  if (!can_convert(tiff))
    refuse("a picture of " + kind + " pixels and " + name_of_tiff_samples(bits, format));
  page.attributes.erase(kTiffChannels);
  page.decoding = TiffDecoding::rgba;
  page.part.type = PixelType::uint8;
  page.part.channels = {"R", "G", "B"};
  std::uint16_t extra_count = 0;
  std::uint16_t* extra = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &extra_count, &extra) == 1 && extra_count > 0) {
    page.part.channels.push_back("A");
    page.associated = true;  // by libtiff, whatever it was
  }
  check_size(source, width, height, 4);
  const bool exact = photometric == PHOTOMETRIC_PALETTE || photometric == PHOTOMETRIC_YCBCR;
  (exact ? page.notes : page.warnings)
      .push_back(kind + " pixels of " + std::to_string(bits) + " bits, converted to 8-bit RGB" +
                 (exact ? "" : " without regard to their profile"));
  declare_tiff_page(tiff, exact, page);
  return page;
}

}  // namespace welkin::io
