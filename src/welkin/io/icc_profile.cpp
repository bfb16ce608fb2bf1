#include "welkin/io/icc_profile.h"

#include <lcms2.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/colour_space.h"
#include "welkin/io/transfer.h"

namespace welkin::io {
namespace {

using Profile = std::unique_ptr<void, decltype(&cmsCloseProfile)>;
using Transform = std::unique_ptr<void, decltype(&cmsDeleteTransform)>;
using ToneCurve = std::unique_ptr<cmsToneCurve, decltype(&cmsFreeToneCurve)>;

/// Profiles of pictures have kilobytes; a table of 33³ colours a few hundred.
constexpr std::size_t kLargest = std::size_t{16} << 20;

/// Linear, with BT.709's primaries.
Profile linear_bt709(cmsContext context) {
  const cmsCIExyY white{kBt709.white[0], kBt709.white[1], 1};
  const cmsCIExyYTRIPLE primaries{{kBt709.red[0], kBt709.red[1], 1},
                                  {kBt709.green[0], kBt709.green[1], 1},
                                  {kBt709.blue[0], kBt709.blue[1], 1}};
  const ToneCurve line(cmsBuildGamma(context, 1), cmsFreeToneCurve);
  if (line == nullptr) throw std::bad_alloc();
  cmsToneCurve* curves[3] = {line.get(), line.get(), line.get()};
  Profile profile(cmsCreateRGBProfileTHR(context, &white, &primaries, curves), cmsCloseProfile);
  if (profile == nullptr) throw std::bad_alloc();
  return profile;
}

std::string description(cmsHPROFILE profile) {
  char text[128] = "";
  cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", text, sizeof text);
  return text;
}

}  // namespace

struct IccProfile::Implementation {
  // Contexts of one's own: no other code's error handlers, no plug-ins.
  std::unique_ptr<_cmsContext_struct, decltype(&cmsDeleteContext)> context{cmsCreateContext(nullptr, nullptr),
                                                                           cmsDeleteContext};
  Profile profile{nullptr, cmsCloseProfile};
  Transform transform{nullptr, cmsDeleteTransform};
  std::string name;
  int channels = 3;
  std::optional<CodePoints> code_points;

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
  if (self.profile == nullptr) throw Error(ErrorKind::damaged, "it is malformed");
  const cmsColorSpaceSignature space = cmsGetColorSpace(self.profile.get());
  if (space != cmsSigRgbData && space != cmsSigGrayData)
    throw Error(ErrorKind::unsupported, "it is not of grey or R G B");
  self.channels = space == cmsSigGrayData ? 1 : 3;
  self.name = description(self.profile.get());
  // Little CMS 2.14 doesn't know the tag: its signature, reserved zeros, and four code points.
  std::array<std::uint8_t, 12> tag{};
  constexpr auto kCicp = static_cast<cmsTagSignature>(0x63696370);
  if (cmsReadRawTag(self.profile.get(), kCicp, tag.data(), tag.size()) == tag.size())
    self.code_points = CodePoints{tag[8], tag[9]};
  const Profile target = linear_bt709(self.context.get());
  self.transform.reset(cmsCreateTransformTHR(
      self.context.get(), self.profile.get(), self.channels == 1 ? TYPE_GRAY_FLT : TYPE_RGB_FLT, target.get(),
      TYPE_RGB_FLT, INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE));
  if (self.transform == nullptr)
    throw Error(ErrorKind::damaged, "it lacks what turns its values into colours");
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
  return self_->channels == 1 ||
         (cmsIsMatrixShaper(self_->profile.get()) != 0 && self_->curve(0) != nullptr &&
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
  double largest = 0;
  for (int k = 0; k <= kSteps; ++k) {
    for (int hue = 0; hue < (self_->channels == 1 ? 1 : 4); ++hue) {
      const auto stored = static_cast<float>(k) / kSteps;
      // Grey, then each primary beside a dark grey, so that a matrix shows.
      std::array<float, 3> in{stored, stored, stored};
      for (int c = 0; hue > 0 && c < 3; ++c) in[static_cast<std::size_t>(c)] = c == hue - 1 ? stored : 0.2f;
      std::array<float, 3> out{};
      self_->convert(in.data(), out.data(), 1);
      for (std::size_t c = 0; c < 3; ++c)
        largest = std::max(largest,
                           std::fabs(static_cast<double>(out[c]) -
                                     srgb_to_linear(static_cast<double>(in[self_->channels == 1 ? 0 : c]))));
    }
  }
  return largest < 1e-3;
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
          value = cmsEvalToneCurveFloat(curve, value);
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
      for (std::size_t c = 0; c < 3; ++c) row[x * step + static_cast<std::size_t>(at[c])] = out[3 * x + c];
    }
  });
}

}  // namespace welkin::io
