#include "welkin/video/yuv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "welkin/base/parallel.h"
#include "welkin/io/colour/srgb_encoder.h"
#include "welkin/io/colour/transfer.h"

namespace welkin::video {
namespace {

/// The weights of R′ and B′ in Y′.
struct Luma {
  float r, b;
  float g() const { return 1 - r - b; }
};

Luma luma_of(YuvMatrix matrix) {
  switch (matrix) {
    case YuvMatrix::bt709:
      return {0.2126f, 0.0722f};
    case YuvMatrix::bt2020:
      return {0.2627f, 0.0593f};
    case YuvMatrix::bt601:
      break;
  }
  return {0.299f, 0.114f};
}

/// value = (code − offset)/scale: 0 … 1 of luma, −½ … ½ of chroma.
struct Codes {
  float offset, scale;
  int largest;

  float value(int code) const { return (static_cast<float>(code) - offset) / scale; }
  int code(float value) const {
    return std::clamp(static_cast<int>(value * scale + offset + 0.5f), 0, largest);
  }
};

Codes luma_codes(const StreamInfo& info) {
  const int largest = (1 << info.bits) - 1;
  const auto unit = static_cast<float>(1 << (info.bits - 8));
  if (info.full_range) return {0, static_cast<float>(largest), largest};
  return {16 * unit, 219 * unit, largest};
}

Codes chroma_codes(const StreamInfo& info) {
  const int largest = (1 << info.bits) - 1;
  const auto unit = static_cast<float>(1 << (info.bits - 8));
  if (info.full_range) return {128 * unit, static_cast<float>(largest), largest};
  return {128 * unit, 224 * unit, largest};
}

/// How chroma is sampled along one side: every `step` of luma, sample i at luma sample step·i + shift.
struct Sampling {
  int step;
  float shift;

  int count(int luma) const { return (luma + step - 1) / step; }
};

Sampling across(Chroma chroma) {
  if (chroma == Chroma::c444) return {1, 0};
  return {2, chroma == Chroma::c420jpeg ? 0.5f : 0.0f};
}

Sampling down(Chroma chroma) {
  if (chroma == Chroma::c444 || chroma == Chroma::c422) return {1, 0};
  return {2, chroma == Chroma::c420paldv ? 0.0f : 0.5f};
}

struct PlaneSizes {
  std::size_t luma, chroma;  ///< values
  int width, height;         ///< of chroma
};

PlaneSizes sizes_of(const StreamInfo& info) {
  PlaneSizes sizes{static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height), 0, 0, 0};
  if (info.chroma == Chroma::mono) return sizes;
  sizes.width = across(info.chroma).count(info.width);
  sizes.height = down(info.chroma).count(info.height);
  sizes.chroma = static_cast<std::size_t>(sizes.width) * static_cast<std::size_t>(sizes.height);
  return sizes;
}

/// Stored values of a plane.
template <class T>
class Plane {
 public:
  Plane(const std::byte* bytes, int width) : bytes_(bytes), width_(width) {}
  int at(int x, int y) const {
    T value;
    const std::size_t index =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    std::memcpy(&value, bytes_ + index * sizeof(T), sizeof(T));
    return value;
  }

 private:
  const std::byte* bytes_;
  int width_;
};

/// The two samples about a position, and the weight of the second.
struct Pair {
  int first, second;
  float weight;
};

Pair pair_at(const Sampling& sampling, int luma, int count) {
  const float at = (static_cast<float>(luma) - sampling.shift) / static_cast<float>(sampling.step);
  const int first = static_cast<int>(std::floor(at));
  return {std::clamp(first, 0, count - 1), std::clamp(first + 1, 0, count - 1),
          at - static_cast<float>(first)};
}

/// sRGB → linear for any value in 0 … 1, to 3e-8.
class ToLinear {
 public:
  ToLinear() {
    for (std::size_t i = 0; i < table_.size(); ++i)
      table_[i] = static_cast<float>(io::srgb_to_linear(static_cast<double>(i) / kPieces));
  }
  float operator()(float encoded) const {
    const float at = std::clamp(encoded, 0.0f, 1.0f) * kPieces;
    const int piece = static_cast<int>(at);
    const auto i = static_cast<std::size_t>(piece);
    return table_[i] + (table_[i + 1] - table_[i]) * (at - static_cast<float>(piece));
  }

 private:
  static constexpr int kPieces = 4096;
  std::array<float, kPieces + 2> table_;
};

const ToLinear& to_linear() {
  static const ToLinear table;
  return table;
}

float decoded(float encoded, bool linear) {
  return linear ? std::clamp(encoded, 0.0f, 1.0f) : to_linear()(encoded);
}

/// 0 … 1 → its code over the largest, to 8e-6 where it is encoded.
float encoded(float value, bool linear) {
  const float clipped = value > 0 ? std::min(value, 1.0f) : 0.0f;
  return linear ? clipped : static_cast<float>(io::srgb16_encoder()(clipped)) * (1.0f / 65535);
}

template <class T>
void decode_planes(const StreamInfo& info, const StreamColour& colour, std::span<const std::byte> bytes,
                   ImageView<float> out) {
  const PlaneSizes sizes = sizes_of(info);
  const Codes luma_code = luma_codes(info), chroma_code = chroma_codes(info);
  const Plane<T> luma(bytes.data(), info.width);
  if (info.chroma == Chroma::mono) {
    parallel_for(info.height, [&](int y) {
      for (int x = 0; x < info.width; ++x)
        *out.at(x, y) = decoded(luma_code.value(luma.at(x, y)), colour.linear);
    });
    return;
  }
  const Plane<T> blue(bytes.data() + sizes.luma * sizeof(T), sizes.width);
  const Plane<T> red(bytes.data() + (sizes.luma + sizes.chroma) * sizeof(T), sizes.width);
  const Sampling horizontal = across(info.chroma), vertical = down(info.chroma);
  std::vector<Pair> columns;
  for (int x = 0; x < info.width; ++x) columns.push_back(pair_at(horizontal, x, sizes.width));
  const Luma weights = luma_of(colour.matrix);
  const float to_r = 2 * (1 - weights.r), to_b = 2 * (1 - weights.b);
  const float r_in_g = to_r * weights.r / weights.g(), b_in_g = to_b * weights.b / weights.g();
  parallel_for(info.height, [&](int y) {
    const Pair row = pair_at(vertical, y, sizes.height);
    std::vector<float> chroma(2 * static_cast<std::size_t>(sizes.width));
    for (int x = 0; x < sizes.width; ++x) {
      const auto mixed = [&](const Plane<T>& plane) {
        const float a = chroma_code.value(plane.at(x, row.first)),
                    b = chroma_code.value(plane.at(x, row.second));
        return a + (b - a) * row.weight;
      };
      chroma[2 * static_cast<std::size_t>(x)] = mixed(blue);
      chroma[2 * static_cast<std::size_t>(x) + 1] = mixed(red);
    }
    for (int x = 0; x < info.width; ++x) {
      const Pair& column = columns[static_cast<std::size_t>(x)];
      const float* const a = &chroma[2 * static_cast<std::size_t>(column.first)];
      const float* const b = &chroma[2 * static_cast<std::size_t>(column.second)];
      const float cb = a[0] + (b[0] - a[0]) * column.weight, cr = a[1] + (b[1] - a[1]) * column.weight;
      const float value = luma_code.value(luma.at(x, y));
      float* const rgb = out.at(x, y);
      rgb[0] = decoded(value + to_r * cr, colour.linear);
      rgb[1] = decoded(value - r_in_g * cr - b_in_g * cb, colour.linear);
      rgb[2] = decoded(value + to_b * cb, colour.linear);
    }
  });
}

template <class T>
void store(std::span<std::byte> bytes, std::size_t index, int code) {
  const T value = static_cast<T>(code);
  std::memcpy(bytes.data() + index * sizeof(T), &value, sizeof(T));
}

/// Weights of luma samples −1 … +1 about a chroma sample's first, along one side: amid two of them it is
/// their mean, on one of them ¼ ½ ¼.
std::array<float, 3> averaging(const Sampling& sampling) {
  if (sampling.step == 1) return {0, 1, 0};
  if (sampling.shift > 0) return {0, 0.5f, 0.5f};
  return {0.25f, 0.5f, 0.25f};
}

template <class T>
void encode_planes(const StreamInfo& info, const StreamColour& colour, ImageView<const float> frame,
                   std::span<std::byte> bytes) {
  const PlaneSizes sizes = sizes_of(info);
  const Codes luma_code = luma_codes(info), chroma_code = chroma_codes(info);
  const auto width = static_cast<std::size_t>(info.width);
  if (info.chroma == Chroma::mono) {
    parallel_for(info.height, [&](int y) {
      for (int x = 0; x < info.width; ++x)
        store<T>(bytes, static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x),
                 luma_code.code(encoded(*frame.at(x, y), colour.linear)));
    });
    return;
  }
  const Luma weights = luma_of(colour.matrix);
  const float from_b = 1 / (2 * (1 - weights.b)), from_r = 1 / (2 * (1 - weights.r));
  const Sampling horizontal = across(info.chroma), vertical = down(info.chroma);
  const std::array<float, 3> along_row = averaging(horizontal), along_column = averaging(vertical);
  std::vector<float> blue(sizes.luma), red(sizes.luma);  // of every pixel
  parallel_for(info.height, [&](int y) {
    for (int x = 0; x < info.width; ++x) {
      const float* const rgb = frame.at(x, y);
      const float r = encoded(rgb[0], colour.linear), g = encoded(rgb[1], colour.linear),
                  b = encoded(rgb[2], colour.linear);
      const float value = weights.r * r + weights.g() * g + weights.b * b;
      const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      store<T>(bytes, i, luma_code.code(value));
      blue[i] = (b - value) * from_b;
      red[i] = (r - value) * from_r;
    }
  });
  parallel_for(sizes.height, [&](int y) {
    for (int x = 0; x < sizes.width; ++x) {
      float cb = 0, cr = 0;
      for (int j = -1; j <= 1; ++j) {
        const float row_weight = along_column[static_cast<std::size_t>(j + 1)];
        if (row_weight == 0) continue;
        const int from_y = std::clamp(y * vertical.step + j, 0, info.height - 1);
        for (int i = -1; i <= 1; ++i) {
          const float weight = row_weight * along_row[static_cast<std::size_t>(i + 1)];
          const int from_x = std::clamp(x * horizontal.step + i, 0, info.width - 1);
          const std::size_t at = static_cast<std::size_t>(from_y) * width + static_cast<std::size_t>(from_x);
          cb += weight * blue[at];
          cr += weight * red[at];
        }
      }
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(sizes.width) + static_cast<std::size_t>(x);
      store<T>(bytes, sizes.luma + at, chroma_code.code(cb));
      store<T>(bytes, sizes.luma + sizes.chroma + at, chroma_code.code(cr));
    }
  });
}

}  // namespace

std::vector<StoredPlane> stored_planes(const StreamInfo& info) {
  if (info.kind != StreamKind::y4m) return {{0, info.width, info.height, info.channels}};
  const PlaneSizes sizes = sizes_of(info);
  const std::size_t bytes = info.bits > 8 ? 2 : 1;
  std::vector<StoredPlane> planes{{0, info.width, info.height, 1}};
  for (std::size_t i = 0; i < 2 && sizes.chroma > 0; ++i)
    planes.push_back({(sizes.luma + i * sizes.chroma) * bytes, sizes.width, sizes.height, 1});
  return planes;
}

std::size_t yuv_bytes(const StreamInfo& info) {
  const PlaneSizes sizes = sizes_of(info);
  return (sizes.luma + 2 * sizes.chroma) * (info.bits > 8 ? 2 : 1);
}

void decode_yuv(const StreamInfo& info, const StreamColour& colour, std::span<const std::byte> planes,
                ImageView<float> out) {
  info.bits > 8 ? decode_planes<std::uint16_t>(info, colour, planes, out)
                : decode_planes<std::uint8_t>(info, colour, planes, out);
}

void encode_yuv(const StreamInfo& info, const StreamColour& colour, ImageView<const float> frame,
                std::span<std::byte> planes) {
  info.bits > 8 ? encode_planes<std::uint16_t>(info, colour, frame, planes)
                : encode_planes<std::uint8_t>(info, colour, frame, planes);
}

}  // namespace welkin::video
