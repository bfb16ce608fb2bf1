#include "welkin/io/ktx2/descriptor.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/texels/format_names.h"

namespace welkin::io::ktx2 {

using namespace texels;

namespace {

constexpr std::uint32_t kVersion = 2;  // of the block's layout: that of specification 1.3 and 1.4
constexpr std::uint32_t kModelRgbsda = 1, kModelBc6h = 133, kModelAstc = 162, kPrimariesBt709 = 1,
                        kTransferLinear = 1, kTransferSrgb = 2, kFlagPremultiplied = 1;
constexpr std::size_t kBlockWords = 6, kSampleWords = 4;

/// How a sample's bits are a number.
namespace qualifier {
constexpr std::uint32_t linear = 0x10, exponent = 0x20, is_signed = 0x40, is_float = 0x80;
}

struct Sample {
  std::uint32_t bit_offset, bits, channel, qualifiers, lower, upper;
};

std::uint32_t channel_number(char name) {
  constexpr std::uint32_t kAlpha = 15;
  return name == 'A' ? kAlpha : name == 'R' ? 0 : name == 'G' ? 1 : 2;
}

/// Nine bits of mantissa for each channel, and for each the five bits of exponent that all have in common.
/// `upper` is 1 as a mantissa of 256 with the exponent 16; the exponent's `lower` is its bias.
std::vector<Sample> shared_exponent_samples() {
  constexpr std::uint32_t kOne = 16 << 9 | 256, kBias = 15, kLargest = 31;
  std::vector<Sample> samples;
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    samples.push_back({9 * channel, 9, channel, 0, 0, kOne});
    samples.push_back({27, 5, channel, qualifier::exponent, kBias, kLargest});
  }
  return samples;
}

/// The whole block is one sample, of colour.
std::vector<Sample> block_samples(bool is_signed) {
  constexpr auto kOne = std::bit_cast<std::uint32_t>(1.0f), kMinusOne = std::bit_cast<std::uint32_t>(-1.0f);
  return {{0, 128, 0, qualifier::is_float | (is_signed ? qualifier::is_signed : 0), is_signed ? kMinusOne : 0,
           kOne}};
}

std::uint32_t model_of(const TexelFormat& format) {
  switch (format.type) {
    case PixelType::bc6h:
      return kModelBc6h;
    case PixelType::uastc_hdr:
      return kModelUastcHdr;
    case PixelType::astc_hdr:
      return kModelAstc;
    default:
      return kModelRgbsda;
  }
}

/// Sides of the texels that are stored together, less one, a byte each.
std::uint32_t block_word(const TexelFormat& format) {
  const auto side = static_cast<std::uint32_t>(format.block() - 1);
  return side | side << 8;
}

std::vector<Sample> samples_of(const TexelFormat& format, Colour colour) {
  constexpr auto kOne = std::bit_cast<std::uint32_t>(1.0f), kMinusOne = std::bit_cast<std::uint32_t>(-1.0f);
  if (format.coding == Coding::blocks) return block_samples(format.is_signed);
  if (format.type == PixelType::rgb9e5) return shared_exponent_samples();
  if (format.type == PixelType::r11g11b10) {
    return {{0, 11, 0, qualifier::is_float, 0, kOne},
            {11, 11, 1, qualifier::is_float, 0, kOne},
            {22, 10, 2, qualifier::is_float, 0, kOne}};
  }
  const bool floats = format.type == PixelType::half || format.type == PixelType::float32;
  const std::uint32_t bits = 8 * format.type_size;
  std::vector<Sample> samples;
  for (const char name : format.channels) {
    Sample sample{bits * static_cast<std::uint32_t>(samples.size()),
                  bits,
                  channel_number(name),
                  floats ? qualifier::is_float | qualifier::is_signed : 0,
                  floats ? kMinusOne : 0,
                  floats ? kOne : (1u << bits) - 1};
    if (name == 'A' && colour == Colour::srgb) sample.qualifiers |= qualifier::linear;
    samples.push_back(sample);
  }
  return samples;
}

/// Those of the specification's section "Transfer functions", by number.
struct Transfer {
  std::uint32_t number;
  const char* name;
  Curve curve;  ///< none: it is not undone
  double gamma;
};
constexpr Transfer kTransfers[] = {
    {3, "ITU-R BT.709", Curve::bt709, 1},
    {4, "NTSC", Curve::gamma, 2.2},
    {5, "S-Log", Curve::none, 1},
    {6, "S-Log2", Curve::none, 1},
    {7, "ITU-R BT.1886", Curve::gamma, 2.4},
    {8, "HLG", Curve::hlg, 1},
    {9, "HLG", Curve::hlg, 1},
    {10, "PQ", Curve::pq, 1},
    {11, "the OETF of PQ", Curve::none, 1},
    {12, "DCI-P3", Curve::gamma, 2.6},
    {13, "PAL", Curve::none, 1},
    {14, "625-line PAL", Curve::none, 1},
    {15, "SMPTE ST 240", Curve::none, 1},
    {16, "ACEScc", Curve::none, 1},
    {17, "ACEScct", Curve::none, 1},
    {18, "Adobe RGB", Curve::gamma, 563.0 / 256},
};

void set_transfer(std::uint32_t number, Descriptor& parsed) {
  const auto found = std::find_if(std::begin(kTransfers), std::end(kTransfers),
                                  [&](const Transfer& each) { return each.number == number; });
  const bool known = found != std::end(kTransfers);
  if (known && found->curve != Curve::none) {
    parsed.curve = found->curve;
    parsed.gamma = found->gamma;
    return;
  }
  parsed.warnings.push_back("the transfer function of its data format descriptor, " +
                            std::string(known ? found->name : "which is unknown") + ", is not undone");
}

constexpr double kD65[2] = {0.3127, 0.3290}, kAcesWhite[2] = {0.32168, 0.33767};

/// Those of the specification's section "Color primaries", by number.
struct Primaries {
  std::uint32_t number;
  const char* name;
  std::optional<Chromaticities> xy;  ///< nothing: they are not converted
};
const Primaries kPrimaries[] = {
    {2, "BT.601 (EBU)", Chromaticities{{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, {kD65[0], kD65[1]}}},
    {3, "BT.601 (SMPTE)", Chromaticities{{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, {kD65[0], kD65[1]}}},
    {4, "BT.2020", Chromaticities{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {kD65[0], kD65[1]}}},
    {5, "CIE XYZ", {}},
    {6, "ACES AP0",
     Chromaticities{{0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {kAcesWhite[0], kAcesWhite[1]}}},
    {7, "ACES AP1",
     Chromaticities{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {kAcesWhite[0], kAcesWhite[1]}}},
    {8, "NTSC of 1953", Chromaticities{{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, {0.310, 0.316}}},
    {9, "525-line PAL", {}},
    {10, "Display P3", Chromaticities{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {kD65[0], kD65[1]}}},
    {11, "Adobe RGB", Chromaticities{{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {kD65[0], kD65[1]}}},
};

void set_primaries(std::uint32_t number, Descriptor& parsed) {
  const auto found = std::find_if(std::begin(kPrimaries), std::end(kPrimaries),
                                  [&](const Primaries& each) { return each.number == number; });
  const bool known = found != std::end(kPrimaries);
  if (known) parsed.primaries = found->xy;
  if (parsed.primaries) return;
  parsed.warnings.push_back("the primaries of its data format descriptor, " +
                            std::string(known ? found->name : "which are unknown") + ", are not converted");
}

}  // namespace

std::vector<std::byte> written_descriptor(const TexelFormat& format, Colour colour, bool premultiplied) {
  const std::vector<Sample> samples = samples_of(format, colour);
  const auto block_bytes = static_cast<std::uint32_t>(4 * (kBlockWords + kSampleWords * samples.size()));
  const std::uint32_t transfer = colour == Colour::srgb ? kTransferSrgb : kTransferLinear;
  std::vector<std::uint32_t> words = {4 + block_bytes,
                                      0,  // Khronos's basic descriptor
                                      kVersion | block_bytes << 16,
                                      model_of(format) | kPrimariesBt709 << 8 | transfer << 16 |
                                          (premultiplied ? kFlagPremultiplied : 0) << 24,
                                      block_word(format),
                                      static_cast<std::uint32_t>(format.bytes()),
                                      0};  // one plane
  for (const Sample& sample : samples) {
    words.push_back(sample.bit_offset | (sample.bits - 1) << 16 | sample.channel << 24 |
                    sample.qualifiers << 24);
    words.insert(words.end(), {0, sample.lower, sample.upper});
  }
  const auto bytes = std::as_bytes(std::span(words));
  return {bytes.begin(), bytes.end()};
}

Descriptor parse_descriptor(std::span<const std::byte> bytes, std::uint64_t offset,
                            const TexelFormat& format) {
  const auto fail = [&](const std::string& cause, std::size_t at) {
    throw Error(ErrorKind::damaged,
                "the data format descriptor " + cause + " (byte " + std::to_string(offset + at) + ")");
  };
  const auto word = [&](std::size_t i) { return load_native<std::uint32_t>(bytes.data() + 4 * i); };
  if (bytes.size() < 4 * (1 + kBlockWords)) fail("is too short", bytes.size());
  if (word(0) != bytes.size()) fail("states another size than the index", 0);
  const std::uint32_t block_bytes = word(2) >> 16;
  if (word(1) != 0 || block_bytes < 4 * kBlockWords || block_bytes > bytes.size() - 4)
    fail("does not begin with a basic block", 4);

  const std::uint32_t model = word(3) & 0xff, primaries = word(3) >> 8 & 0xff,
                      transfer = word(3) >> 16 & 0xff, flags = word(3) >> 24;
  if (model != model_of(format))
    fail("is of colour model " + std::to_string(model) + ", not " + format_name(format.number), 12);
  if (word(4) != block_word(format))
    fail("is of blocks of another size than those of " + format_name(format.number), 16);
  // 0 stands for any in files that are supercompressed, by older specifications.
  if (const std::uint32_t texel = word(5) & 0xff; texel != 0 && texel != format.bytes())
    fail("is of texels of " + std::to_string(texel) + " bytes, not " + format_name(format.number), 20);

  Descriptor parsed;
  if (format.srgb || transfer == kTransferSrgb) parsed.colour = Colour::srgb;
  parsed.premultiplied = (flags & kFlagPremultiplied) != 0;
  if (transfer > kTransferSrgb && !format.srgb) set_transfer(transfer, parsed);
  if (primaries > kPrimariesBt709) set_primaries(primaries, parsed);
  return parsed;
}

}  // namespace welkin::io::ktx2
