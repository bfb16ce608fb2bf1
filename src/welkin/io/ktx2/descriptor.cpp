#include "welkin/io/ktx2/descriptor.h"

#include <bit>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"

namespace welkin::io::ktx2 {
namespace {

constexpr std::uint32_t kVersion = 2;  // of the block's layout: that of specification 1.3 and 1.4
constexpr std::uint32_t kModelRgbsda = 1, kPrimariesBt709 = 1, kTransferLinear = 1, kTransferSrgb = 2,
                        kFlagPremultiplied = 1;
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

std::vector<Sample> samples_of(const TexelFormat& format, Colour colour) {
  constexpr auto kOne = std::bit_cast<std::uint32_t>(1.0f), kMinusOne = std::bit_cast<std::uint32_t>(-1.0f);
  if (format.type == PixelType::rgb9e5) return shared_exponent_samples();
  if (format.type == PixelType::r11g11b10) {
    return {{0, 11, 0, qualifier::is_float, 0, kOne},
            {11, 11, 1, qualifier::is_float, 0, kOne},
            {22, 10, 2, qualifier::is_float, 0, kOne}};
  }
  const bool floats = format.type == PixelType::half || format.type == PixelType::float32;
  const std::uint32_t bits = 8 * format.type_size();
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

}  // namespace

std::vector<std::byte> written_descriptor(const TexelFormat& format, Colour colour) {
  const std::vector<Sample> samples = samples_of(format, colour);
  const auto block_bytes = static_cast<std::uint32_t>(4 * (kBlockWords + kSampleWords * samples.size()));
  const std::uint32_t transfer = colour == Colour::srgb ? kTransferSrgb : kTransferLinear;
  std::vector<std::uint32_t> words = {4 + block_bytes,
                                      0,  // Khronos's basic descriptor
                                      kVersion | block_bytes << 16,
                                      kModelRgbsda | kPrimariesBt709 << 8 | transfer << 16,
                                      0,  // blocks of one texel
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
  if (model != kModelRgbsda)
    fail("is of colour model " + std::to_string(model) + ", not " + format_name(format.number), 12);
  if (word(4) != 0) fail("is of blocks, not " + format_name(format.number), 16);
  // 0 stands for any in files that are supercompressed, by older specifications.
  if (const std::uint32_t texel = word(5) & 0xff; texel != 0 && texel != format.bytes())
    fail("is of texels of " + std::to_string(texel) + " bytes, not " + format_name(format.number), 20);

  Descriptor parsed;
  if (format.srgb || transfer == kTransferSrgb) parsed.colour = Colour::srgb;
  if (transfer > kTransferSrgb)
    parsed.notes.push_back("transfer function " + std::to_string(transfer) +
                           " of its data format descriptor is not undone");
  if (primaries > kPrimariesBt709)
    parsed.notes.push_back("primaries " + std::to_string(primaries) +
                           " of its data format descriptor are not converted");
  if (flags & kFlagPremultiplied) parsed.notes.push_back("colour is multiplied by alpha");
  return parsed;
}

}  // namespace welkin::io::ktx2
