#include "welkin/io/colour/icc_profile.h"

#include <lcms2.h>
#include <lcms2_plugin.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/colour/colour_space.h"
#include "welkin/io/colour/transfer.h"

namespace welkin::io {
namespace {

using Profile = std::unique_ptr<void, decltype(&cmsCloseProfile)>;
using Transform = std::unique_ptr<void, decltype(&cmsDeleteTransform)>;
using ToneCurve = std::unique_ptr<cmsToneCurve, decltype(&cmsFreeToneCurve)>;

/// Profiles of pictures have kilobytes; a table of 33³ colours a few hundred.
constexpr std::size_t kLargest = std::size_t{16} << 20;

/// All that Little CMS may ask for while a profile is opened, freed or not: tables that a profile claims, or
/// names over and over, are made before their bytes are missed.
constexpr std::uint64_t kMostMemory = std::uint64_t{128} << 20;

/// Steps from values to colours and pieces of their curves, each of which costs time at each pixel. Real
/// profiles have a few.
constexpr std::size_t kMostPieces = 1024;

/// The tags of tables, in the order of which the first serves, before a matrix and curves.
constexpr cmsTagSignature kTables[] = {cmsSigDToB1Tag, cmsSigAToB1Tag, cmsSigAToB0Tag};

/// What a context has asked for, bytes.
using Memory = std::atomic<std::uint64_t>;

bool may_take(cmsContext context, cmsUInt32Number size) {
  auto* const taken = static_cast<Memory*>(cmsGetContextUserData(context));
  return taken == nullptr || taken->fetch_add(size) + size <= kMostMemory;
}
void* take(cmsContext context, cmsUInt32Number size) {
  return may_take(context, size) ? std::malloc(size) : nullptr;
}
void* take_again(cmsContext context, void* memory, cmsUInt32Number size) {
  return may_take(context, size) ? std::realloc(memory, size) : nullptr;
}
void give_back(cmsContext, void* memory) {
  std::free(memory);
}

/// A context of one's own: no other code's error handlers, no plug-ins but the one that counts memory.
cmsContext counting_context(Memory& taken) {
  cmsPluginMemHandler handler{};
  handler.base = {cmsPluginMagicNumber, LCMS_VERSION, cmsPluginMemHandlerSig, nullptr};
  handler.MallocPtr = take;
  handler.FreePtr = give_back;
  handler.ReallocPtr = take_again;
  return cmsCreateContext(&handler, &taken);
}

/// Linear, with BT.709's primaries; null without memory.
Profile linear_bt709(cmsContext context) {
  const cmsCIExyY white{kBt709.white[0], kBt709.white[1], 1};
  const cmsCIExyYTRIPLE primaries{{kBt709.red[0], kBt709.red[1], 1},
                                  {kBt709.green[0], kBt709.green[1], 1},
                                  {kBt709.blue[0], kBt709.blue[1], 1}};
  const ToneCurve line(cmsBuildGamma(context, 1), cmsFreeToneCurve);
  if (line == nullptr) return {nullptr, cmsCloseProfile};
  cmsToneCurve* curves[3] = {line.get(), line.get(), line.get()};
  return {cmsCreateRGBProfileTHR(context, &white, &primaries, curves), cmsCloseProfile};
}

/// How many elements and pieces of curves a tag of type multiProcessElementsType has (ICC.1:2022, 10.16),
/// each element and curve as often as it is named; of no other type any. Counting stops past `most`.
std::size_t pieces_of(std::span<const std::byte> tag, std::size_t most) {
  constexpr std::uint32_t kElements = 0x6d706574, kCurveSet = 0x63767374;  // `mpet`, `cvst`
  const auto word = [&](std::size_t at) {
    return at + 4 > tag.size() ? 0 : load<std::uint32_t>(&tag[at], std::endian::big);
  };
  const auto half_word = [&](std::size_t at) { return word(at) >> 16; };
  if (word(0) != kElements) return 0;
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < word(12) && pieces <= most; ++i, ++pieces) {
    const std::size_t element = word(16 + 8 * i);
    if (word(element) != kCurveSet) continue;
    for (std::size_t c = 0; c < half_word(element + 8) && pieces <= most; ++c)
      pieces += 1 + half_word(element + word(element + 12 + 8 * c) + 8);
  }
  return pieces;
}

std::string description(cmsHPROFILE profile) {
  char text[128] = "";
  cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", text, sizeof text);
  return text;
}

}  // namespace

struct IccProfile::Implementation {
  Memory taken = 0;
  std::unique_ptr<_cmsContext_struct, decltype(&cmsDeleteContext)> context{counting_context(taken),
                                                                           cmsDeleteContext};
  Profile profile{nullptr, cmsCloseProfile};
  Transform transform{nullptr, cmsDeleteTransform};
  std::string name;
  int channels = 3;
  std::optional<CodePoints> code_points;

  [[noreturn]] void fail(const char* cause) const {
    if (taken > kMostMemory)
      throw Error(ErrorKind::too_large,
                  "it takes more than " + std::to_string(kMostMemory >> 20) + " MiB of memory");
    throw Error(ErrorKind::damaged, cause);
  }

  /// Before Little CMS reads them, which takes long too.
  void check_pieces() const {
    std::vector<std::byte> tag(cmsReadRawTag(profile.get(), cmsSigDToB1Tag, nullptr, 0));
    tag.resize(
        cmsReadRawTag(profile.get(), cmsSigDToB1Tag, tag.data(), static_cast<cmsUInt32Number>(tag.size())));
    if (pieces_of(tag, kMostPieces) > kMostPieces)
      throw Error(ErrorKind::unsupported,
                  "its curves have more than " + std::to_string(kMostPieces) + " pieces and steps");
  }

  /// Throws unless whole values become colours.
  void check_colours() const {
    for (int corner = 0; corner < 8; ++corner) {
      const std::array<float, 3> in{static_cast<float>(corner & 1), static_cast<float>(corner >> 1 & 1),
                                    static_cast<float>(corner >> 2)};
      std::array<float, 3> out{};
      convert(in.data(), out.data(), 1);
      if (!std::all_of(out.begin(), out.end(), [](float value) { return std::isfinite(value); }))
        fail("its numbers make no colours");
    }
  }

  void convert(const float* in, float* out, std::size_t pixels) const {
    cmsDoTransform(transform.get(), in, out, static_cast<cmsUInt32Number>(pixels));
  }
  const cmsToneCurve* curve(int channel) const {
    static constexpr cmsTagSignature kCurves[] = {cmsSigRedTRCTag, cmsSigGreenTRCTag, cmsSigBlueTRCTag};
    return static_cast<const cmsToneCurve*>(cmsReadTag(profile.get(), kCurves[channel]));
  }
};

IccProfile::IccProfile(std::span<const std::byte> bytes) : self_(std::make_unique<Implementation>()) {
  if (bytes.size() > kLargest) throw Error(ErrorKind::too_large, "it is too large to be one");
  Implementation& self = *self_;
  if (self.context == nullptr) throw std::bad_alloc();
  self.profile.reset(
      cmsOpenProfileFromMemTHR(self.context.get(), bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
  if (self.profile == nullptr) self.fail("it is malformed");
  // From the header (ICC.1:2022, 7.2.8): Little CMS would give any number as an enumerator.
  constexpr std::size_t kColourSpaceAt = 16;
  const auto space = load<std::uint32_t>(&bytes[kColourSpaceAt], std::endian::big);
  if (space != std::uint32_t{cmsSigRgbData} && space != std::uint32_t{cmsSigGrayData})
    throw Error(ErrorKind::unsupported, "it is not of grey or R G B");
  self.channels = space == std::uint32_t{cmsSigGrayData} ? 1 : 3;
  self.name = description(self.profile.get());
  // Little CMS 2.14 doesn't know the tag: its signature, reserved zeros, and four code points.
  std::array<std::uint8_t, 12> tag{};
  constexpr auto kCicp = static_cast<cmsTagSignature>(0x63696370);
  if (cmsReadRawTag(self.profile.get(), kCicp, tag.data(), tag.size()) == tag.size())
    self.code_points = CodePoints{tag[8], tag[9]};
  self.check_pieces();
  const Profile target = linear_bt709(self.context.get());
  if (target == nullptr) self.fail("it is malformed");
  self.transform.reset(cmsCreateTransformTHR(
      self.context.get(), self.profile.get(), self.channels == 1 ? TYPE_GRAY_FLT : TYPE_RGB_FLT, target.get(),
      TYPE_RGB_FLT, INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE));
  if (self.transform == nullptr) self.fail("it lacks what turns its values into colours");
  self.check_colours();
}

IccProfile::~IccProfile() = default;
IccProfile::IccProfile(IccProfile&&) noexcept = default;

int IccProfile::channels() const {
  return self_->channels;
}
const std::string& IccProfile::name() const {
  return self_->name;
}
std::optional<IccProfile::CodePoints> IccProfile::code_points() const {
  return self_->code_points;
}

bool IccProfile::has_primaries() const {
  const auto has = [&](cmsTagSignature tag) { return cmsIsTag(self_->profile.get(), tag) != 0; };
  return self_->channels == 1 ||
         (std::none_of(std::begin(kTables), std::end(kTables), has) &&
          cmsIsMatrixShaper(self_->profile.get()) != 0 && self_->curve(0) != nullptr &&
          self_->curve(1) != nullptr && self_->curve(2) != nullptr);
}

Matrix3 IccProfile::to_bt709() const {
  // Curves lead from 0 to 0 and from 1 to 1, so the primaries at full show the columns.
  Matrix3 matrix;
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<float, 3> in{}, out{};
    in[k] = 1;
    self_->convert(in.data(), out.data(), 1);
    for (std::size_t i = 0; i < 3; ++i) matrix.rows[i][k] = static_cast<double>(out[i]);
  }
  return matrix;
}

bool IccProfile::is_srgb() const {
  constexpr int kSteps = 16;
  for (int k = 0; k <= kSteps; ++k) {
    for (int hue = 0; hue < (self_->channels == 1 ? 1 : 4); ++hue) {
      const auto stored = static_cast<float>(k) / kSteps;
      // Grey, then each primary beside a dark grey, so that a matrix shows.
      std::array<float, 3> in{stored, stored, stored};
      for (int c = 0; hue > 0 && c < 3; ++c) in[static_cast<std::size_t>(c)] = c == hue - 1 ? stored : 0.2f;
      std::array<float, 3> out{};
      self_->convert(in.data(), out.data(), 1);
      for (std::size_t c = 0; c < 3; ++c) {
        const double srgb = srgb_to_linear(static_cast<double>(in[self_->channels == 1 ? 0 : c]));
        if (!(std::fabs(static_cast<double>(out[c]) - srgb) < 1e-3)) return false;  // NaN too
      }
    }
  }
  return true;
}

void IccProfile::to_linear(ImageView<float> pixels, int r, int g, int b, bool keep_primaries) const {
  const bool curves = keep_primaries && self_->channels == 3 && has_primaries();
  const int at[3] = {r, g, b};
  parallel_for(pixels.height, [&](int y) {
    const auto count = static_cast<std::size_t>(pixels.width);
    const auto step = static_cast<std::size_t>(pixels.channels);
    const auto channels = static_cast<std::size_t>(self_->channels);
    float* const row = pixels.row(y);
    if (curves) {
      for (int c = 0; c < 3; ++c) {
        const cmsToneCurve* const curve = self_->curve(c);
        for (std::size_t x = 0; x < count; ++x) {
          float& value = row[x * step + static_cast<std::size_t>(at[c])];
          if (!std::isnan(value)) value = cmsEvalToneCurveFloat(curve, value);
        }
      }
      return;
    }
    std::vector<float> in(count * channels), out(3 * count);
    for (std::size_t x = 0; x < count; ++x) {
      for (std::size_t c = 0; c < channels; ++c)
        in[x * channels + c] = row[x * step + static_cast<std::size_t>(at[c])];
    }
    self_->convert(in.data(), out.data(), count);
    for (std::size_t x = 0; x < count; ++x) {
      // A table has an entry for NaN as well.
      const auto first = in.begin() + static_cast<std::ptrdiff_t>(x * channels);
      const bool unknown = std::any_of(first, first + static_cast<std::ptrdiff_t>(channels),
                                       [](float value) { return std::isnan(value); });
      if (unknown)
        std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(3 * x), 3,
                    std::numeric_limits<float>::quiet_NaN());
      for (std::size_t c = 0; c < 3; ++c) row[x * step + static_cast<std::size_t>(at[c])] = out[3 * x + c];
    }
  });
}

}  // namespace welkin::io
