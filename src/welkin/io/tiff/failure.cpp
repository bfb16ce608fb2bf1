#include "welkin/io/tiff/failure.h"

namespace welkin::io {
namespace {

/// A part of libtiff's message (4.5, all of its decoders), and what it means. `@` is the field that the
/// message names in quotes. The first that fits is taken.
struct Meaning {
  std::string_view part, words;
};

constexpr Meaning kMeanings[] = {
    {"compression support is not configured", "its compression is not built into libtiff here"},
    {"decoding is not implemented", "its compression cannot be decoded by libtiff"},
    {"requested compression method is not", "its compression is not built into libtiff here"},
    {"beyond the", "it needs more memory than is allowed"},
    {"libjpeg to allocate", "it needs more memory than is allowed"},
    {"Out of memory", "there is not enough memory"},
    {"ailed to allocate", "there is not enough memory"},
    {"annot allocate", "there is not enough memory"},
    {"No space for", "there is not enough memory"},
    {"IFD loop", "its directories form a loop"},
    {"more than", "it has too many directories"},
    {"is missing required", "the field @ is missing"},
    {"Missing needed", "a field is missing"},
    {"different values per", "its samples differ in @"},
    {"\"Predictor\" not supported", "its predictor does not fit its samples"},
    {"\"Predictor\" value", "its predictor is unknown"},
    {"Incorrect count for", "the field @ is malformed"},
    {"Incompatible type for", "the field @ is malformed"},
    {"Incorrect value for", "the field @ is malformed"},
    {"Sanity check on size of", "the field @ is malformed"},
    {"during reading of", "the field @ lies outside the file"},
    {"Bad value", "the field @ is malformed"},
    {"ad magic", "its first bytes are not those of a TIFF"},
    {"bad version", "its header is malformed"},
    {"bad BigTIFF", "its header is malformed"},
    {"read TIFF header", "its header is cut off"},
    {"read TIFF directory", "its directory lies outside the file or is cut off"},
    {"accessing TIFF directory", "its directory lies outside the file or is cut off"},
    {"Failed to read", "its directory lies outside the file or is cut off"},
    {"fetching directory", "its directory lies outside the file or is cut off"},
    {"annot handle zero", "its strips or tiles have no size"},
    {"zero strip", "its strips or tiles have no size"},
    {"nteger overflow", "its size is impossible"},
    {"byte count", "its strips or tiles have impossible sizes"},
    {"strip arrays", "its strips or tiles have impossible sizes"},
    {"offset/size for strile", "the places of its strips or tiles lie outside the file"},
    {"not allowed for JPEG", "its JPEG data are of a kind that libtiff does not decode"},
    {"nsupported", "its data are of a kind that libtiff does not decode"},
    {"JPEG", "its JPEG data are damaged or of another size than the picture"},
    {"ubsampling", "its chroma subsampling is not read"},
    {"Not enough data", "its data end early"},
    {"Only decoded", "its data end early"},
    {"Premature", "its data end early"},
    {"ead error", "its data end early"},
    {"Seek error", "its data lie outside the file"},
    {"Buffer too small", "its data end early"},
    {"short ", "its data end early"},
    {"orrupt", "its data are damaged"},
    {"ecoding error", "its data are damaged"},
    {"ZLib error", "its data are damaged"},
    {"decoding:", "its data are damaged"},
    {"decompress", "its data are damaged"},
    {"Bad code word", "its data are damaged"},
    {"ad Fax Lines", "its data are damaged"},
    {"Invalid data", "its data are damaged"},
    {"iblzma", "its data are damaged"},
    {"Unexpected", "its data do not fit the picture"},
};

/// What stands between the first two quotes.
std::string quoted(std::string_view message) {
  const std::size_t first = message.find('"');
  if (first == std::string_view::npos) return "of a directory";
  const std::size_t end = message.find('"', first + 1);
  if (end == std::string_view::npos) return "of a directory";
  return std::string(message.substr(first + 1, end - first - 1));
}

}  // namespace

std::string tiff_failure(std::string_view message) {
  for (const Meaning& meaning : kMeanings) {
    if (message.find(meaning.part) == std::string_view::npos) continue;
    std::string words(meaning.words);
    if (const std::size_t at = words.find('@'); at != std::string::npos)
      words.replace(at, 1, quoted(message));
    return words;
  }
  return {};
}

}  // namespace welkin::io
