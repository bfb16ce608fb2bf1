#include "welkin/map/borders.h"

#include "welkin/base/error.h"
#include "welkin/map/own_texels.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

namespace welkin {
namespace {

using sphere::AnyParameterization;

using Texel = BorderTexel;

enum class Fill : std::uint8_t { exact, interpolated, unknown };

/// Which texels of a row are valid.
class RowMask {
 public:
  explicit RowMask(int width)
      : u_(sphere::padded(static_cast<std::size_t>(width)), 0.5f), v_(u_.size()), mask_(u_.size()) {
    for (int x = 0; x < width; ++x) {
      u_[static_cast<std::size_t>(x)] = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
    }
  }
  void find_valid(const AnyParameterization& p, const Level& level, int chart, int row) {
    std::fill(v_.begin(), v_.end(), (static_cast<float>(row) + 0.5f) / static_cast<float>(level.height()));
    p.kernels().valid(p.self(), chart, u_.data(), v_.data(), mask_.data(),
                      static_cast<std::size_t>(level.width()));
  }
  bool valid(int x) const { return mask_[static_cast<std::size_t>(x)] > 0; }

 private:
  std::vector<float> u_, v_, mask_;
};

/// Texels of the charts that are not valid, but within kBorder (in both axes) of one that is.
void collect_rim(const AnyParameterization& p, const Level& level, std::vector<Texel>& texels) {
  const int width = level.width(), height = level.height();
  RowMask row(width);
  const std::size_t stride = static_cast<std::size_t>(width);
  std::vector<std::uint8_t> valid(stride * static_cast<std::size_t>(height));
  for (int chart = 0; chart < level.charts(); ++chart) {
    bool all = true;
    for (int y = 0; y < height; ++y) {
      row.find_valid(p, level, chart, y);
      for (int x = 0; x < width; ++x) {
        valid[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)] = row.valid(x);
        all = all && row.valid(x);
      }
    }
    if (all) continue;
    const auto near = [&](int x, int y) {
      for (int j = std::max(0, y - kBorder); j <= std::min(height - 1, y + kBorder); ++j) {
        for (int i = std::max(0, x - kBorder); i <= std::min(width - 1, x + kBorder); ++i) {
          if (valid[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)]) return true;
        }
      }
      return false;
    };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!valid[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)] && near(x, y)) {
          texels.push_back({chart, x, y});
        }
      }
    }
  }
}

void collect_borders(const Level& level, std::vector<Texel>& texels) {
  const int width = level.width(), height = level.height();
  for (int chart = 0; chart < level.charts(); ++chart) {
    for (int y = -kBorder; y < height + kBorder; ++y) {
      const bool inside = y >= 0 && y < height;
      for (int x = -kBorder; x < width + kBorder; ++x) {
        if (inside && x == 0) x = width;
        texels.push_back({chart, x, y});
      }
    }
  }
}

Vec3d direction_of(const AnyParameterization& p, const Level& level, const Texel& t) {
  const double u = (t.x + 0.5) / level.width(), v = (t.y + 0.5) / level.height();
  return p.to_sphere(t.chart, clamp(u, -1.0, 2.0), clamp(v, -1.0, 2.0));
}

/// Where the map has a texel's value: in texels of a chart, 0 at the first one's centre.
struct Position {
  int chart;
  double x, y;
};

Position position_of(const AnyParameterization& p, const Level& level, const Vec3d& direction) {
  const auto position = p.from_sphere(direction);
  return {static_cast<int>(position.chart), position.u * level.width() - 0.5,
          position.v * level.height() - 0.5};
}

/// Weights of Keys' cubic (a = −½) for texels −1, 0, 1, 2 of a fraction.
void cubic_weights(double f, double* w) {
  const double g = 1 - f;
  w[0] = -0.5 * f * g * g;
  w[1] = 1 + f * f * (1.5 * f - 2.5);
  w[2] = 1 + g * g * (1.5 * g - 2.5);
  w[3] = -0.5 * g * f * f;
}

/// Later passes read so many texels past a chart's edge.
constexpr int kReach = 2;

/// How much of a parameterization's charts is valid, and whether they cover the sphere.
struct Extent {
  bool full_charts;  ///< all of every chart
  bool whole_world;  ///< and every direction is in one
};

/// First pass: only texels inside charts that are valid are read. Sets `position` of what is known.
Fill first_value(const AnyParameterization& p, const Level& level, const Texel& t, const Extent& extent,
                 Position& position, float* out) {
  const Vec3d d = direction_of(p, level, t);
  if (!p.covers(d)) return Fill::unknown;
  position = position_of(p, level, d);
  const auto [chart, x, y] = position;
  const double near_x = std::round(x), near_y = std::round(y);
  const auto inside = [&, chart = chart](int i, int j) {
    return i >= 0 && i < level.width() && j >= 0 && j < level.height() &&
           (extent.full_charts || p.valid(chart, (i + 0.5) / level.width(), (j + 0.5) / level.height()));
  };
  const ImageView<const float> source = level.chart(chart);
  const double tolerance = 1e-6;
  if (std::fabs(x - near_x) < tolerance && std::fabs(y - near_y) < tolerance &&
      inside(static_cast<int>(near_x), static_cast<int>(near_y))) {
    std::copy_n(source.at(static_cast<int>(near_x), static_cast<int>(near_y)), level.channels(), out);
    return Fill::exact;
  }
  // A later pass overwrites what lies farther out, and none reads it before.
  if (extent.whole_world &&
      (t.x < -kReach || t.x >= level.width() + kReach || t.y < -kReach || t.y >= level.height() + kReach))
    return Fill::interpolated;
  const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
  const double fx = x - ix, fy = y - iy;
  double total = 0;
  double sum[kMaxChannels] = {};
  const int channels = level.channels();
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double weight = (i ? fx : 1 - fx) * (j ? fy : 1 - fy) + 1e-9;
      if (!inside(ix + i, iy + j)) continue;
      total += weight;
      const float* texel = source.at(ix + i, iy + j);
      for (int c = 0; c < channels; ++c) sum[c] += weight * static_cast<double>(texel[c]);
    }
  }
  if (total <= 0) return Fill::unknown;
  for (int c = 0; c < channels; ++c) out[c] = static_cast<float>(sum[c] / total);
  return Fill::interpolated;
}

/// The texel before a position whose Catmull–Rom kernel reads kReach texels past the edge at most.
int texel_before(double x, int size) {
  return static_cast<int>(std::floor(clamp(x, -1.0, static_cast<double>(size))));
}

/// Later passes: the whole Catmull–Rom kernel, borders included, clamped to the range of the texels that it
/// reads.
void later_value(const Level& level, const Position& position, float* out) {
  const double x = clamp(position.x, -1.0, static_cast<double>(level.width()));
  const double y = clamp(position.y, -1.0, static_cast<double>(level.height()));
  const int ix = texel_before(x, level.width()), iy = texel_before(y, level.height());
  double wx[4], wy[4];
  cubic_weights(x - ix, wx);
  cubic_weights(y - iy, wy);
  const ImageView<const float> source = level.chart(position.chart);
  // Four channels at a time: past the last there is always something to be read.
  for (int first = 0; first < level.channels(); first += 4) {
    double sum[4] = {};
    float minimum[4], maximum[4];
    std::copy_n(source.at(ix, iy) + first, 4, minimum);
    std::copy_n(minimum, 4, maximum);
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const float* value = source.at(ix + i - 1, iy + j - 1) + first;
        const double weight = wx[i] * wy[j];
        for (int c = 0; c < 4; ++c) {
          sum[c] += weight * static_cast<double>(value[c]);
          minimum[c] = value[c] < minimum[c] ? value[c] : minimum[c];
          maximum[c] = maximum[c] < value[c] ? value[c] : maximum[c];
        }
      }
    }
    for (int c = 0; c < std::min(4, level.channels() - first); ++c)
      out[first + c] = clamp(static_cast<float>(sum[c]), minimum[c], maximum[c]);
  }
}

/// Whether the kernel there reads texels of the chart alone, which no pass changes.
bool reads_chart_alone(const Level& level, const Position& position) {
  const int ix = texel_before(position.x, level.width()), iy = texel_before(position.y, level.height());
  return ix >= 1 && iy >= 1 && ix + 2 < level.width() && iy + 2 < level.height();
}

/// Texels without a value take the mean of their neighbours that have one, ring by ring. Texels inside a
/// chart that are neither valid nor in `known` have none and get none.
void fill_from_neighbours(const AnyParameterization& p, Level& level, bool whole,
                          const std::vector<Texel>& known, std::vector<Texel> missing) {
  if (missing.empty()) return;
  const int channels = level.channels(), width = level.width(), height = level.height();
  std::vector<std::uint8_t> unknown;
  const std::ptrdiff_t stride = width + 2 * kBorder;
  const auto index = [&](int chart, int x, int y) {
    return static_cast<std::size_t>(((chart * (height + 2 * kBorder)) + y + kBorder) * stride + x + kBorder);
  };
  unknown.resize(index(level.charts() - 1, width + kBorder - 1, height + kBorder - 1) + 1);
  if (!whole) {
    RowMask row(width);
    for (int chart = 0; chart < level.charts(); ++chart) {
      for (int y = 0; y < height; ++y) {
        row.find_valid(p, level, chart, y);
        for (int x = 0; x < width; ++x) unknown[index(chart, x, y)] = row.valid(x) ? 0 : 1;
      }
    }
    for (const Texel& t : known) unknown[index(t.chart, t.x, t.y)] = 0;
  }
  for (const Texel& t : missing) unknown[index(t.chart, t.x, t.y)] = 1;
  while (!missing.empty()) {
    std::vector<Texel> later, now;
    std::vector<float> values;
    for (const Texel& t : missing) {
      std::vector<double> sum(static_cast<std::size_t>(channels));
      int count = 0;
      for (int y = std::max(t.y - 1, -kBorder); y <= std::min(t.y + 1, height + kBorder - 1); ++y) {
        for (int x = std::max(t.x - 1, -kBorder); x <= std::min(t.x + 1, width + kBorder - 1); ++x) {
          if (unknown[index(t.chart, x, y)]) continue;
          ++count;
          for (int c = 0; c < channels; ++c) {
            sum[static_cast<std::size_t>(c)] += static_cast<double>(level.chart(t.chart).at(x, y)[c]);
          }
        }
      }
      if (count == 0) {
        later.push_back(t);
        continue;
      }
      now.push_back(t);
      for (int c = 0; c < channels; ++c) {
        values.push_back(static_cast<float>(sum[static_cast<std::size_t>(c)] / count));
      }
    }
    if (now.empty()) break;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Texel& t = now[i];
      std::copy_n(values.data() + i * static_cast<std::size_t>(channels), channels,
                  level.chart(t.chart).at(t.x, t.y));
      unknown[index(t.chart, t.x, t.y)] = 0;
    }
    missing = std::move(later);
  }
}

/// Whether all of the border are texels of the map: past a pole, those of the opposite meridian.
bool repeats_latlong(const AnyParameterization& p, const Level& level) {
  return p.traits().latlong_grid && level.width() % 2 == 0 &&
         std::min(level.width(), level.height()) >= kBorder;
}

void repeat_latlong(Level& grid) {
  const ImageView<float> chart = grid.chart(0);
  const int width = grid.width(), height = grid.height(), n = grid.channels();
  const std::ptrdiff_t half = static_cast<std::ptrdiff_t>(width / 2) * n, row_length = 2 * half;
  const auto copy = [](float* to, const float* from, std::ptrdiff_t values) {
    std::memcpy(to, from, static_cast<std::size_t>(values) * sizeof(float));
  };
  for (int b = 0; b < kBorder; ++b) {
    for (const auto& [to, from] : {std::pair(chart.row(-1 - b), chart.row(b)),
                                   std::pair(chart.row(height + b), chart.row(height - 1 - b))}) {
      copy(to, from + half, half);
      copy(to + half, from, half);
    }
  }
  const std::ptrdiff_t border = static_cast<std::ptrdiff_t>(kBorder) * n;
  for (int y = -kBorder; y < height + kBorder; ++y) {
    float* at = chart.row(y);
    copy(at - border, at + row_length - border, border);
    copy(at + row_length, at, border);
  }
}

}  // namespace

void fill_borders(const AnyParameterization& p, Level& level, RimTexels rim) {
  require(level.charts() == p.charts(), "a level has another number of charts than its parameterization");
  if (repeats_latlong(p, level)) {
    repeat_latlong(level);
    return;
  }
  std::vector<Texel> texels;
  const bool whole = p.full_charts();
  if (!whole) collect_rim(p, level, texels);
  std::optional<OwnTexels> own;
  if (rim != RimTexels::made) own.emplace(p, level, texels);
  collect_borders(level, texels);

  const std::size_t channels = static_cast<std::size_t>(level.channels());
  std::vector<float> values(texels.size() * channels);
  std::vector<Fill> fills(texels.size());
  std::vector<Position> positions(texels.size());
  const auto for_all = [&](const auto& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels.size(), 1024), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
    });
  };
  const auto scatter = [&] {
    for (std::size_t i = 0; i < texels.size(); ++i) {
      if (fills[i] == Fill::unknown) continue;
      std::copy_n(values.data() + i * channels, channels,
                  level.chart(texels[i].chart).at(texels[i].x, texels[i].y));
    }
  };
  const Extent extent{whole, whole && p.whole_world()};
  for_all([&](std::size_t i) {
    fills[i] = first_value(p, level, texels[i], extent, positions[i], values.data() + i * channels);
  });
  scatter();
  std::vector<Texel> known, missing;
  bool any_interpolated = false;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    (fills[i] == Fill::unknown ? missing : known).push_back(texels[i]);
    if (fills[i] == Fill::interpolated) any_interpolated = true;
  }
  fill_from_neighbours(p, level, whole, known, std::move(missing));
  // The first of these reads the bilinear values of the first pass beside an edge, the second what it has put
  // there.
  for (int pass = 0; any_interpolated && pass < 2; ++pass) {
    for_all([&](std::size_t i) {
      if (fills[i] != Fill::interpolated) return;
      later_value(level, positions[i], values.data() + i * channels);
      if (whole && reads_chart_alone(level, positions[i])) fills[i] = Fill::exact;
    });
    scatter();
  }
  if (own && (rim == RimTexels::kept || own->are_light(level)))
    own->put_back(level, rim == RimTexels::measured);
}

}  // namespace welkin
