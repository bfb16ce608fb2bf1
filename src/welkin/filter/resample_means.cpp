// Filter::automatic over the blocks of a chart. It is over 400 lines because the texels of a block share
// their corners and what they see of the source, and each is made in the way that these allow.

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "welkin/base/parallel.h"
#include "welkin/filter/footprint.h"
#include "welkin/filter/overlap_means.h"
#include "welkin/filter/resample_job.h"
#include "welkin/filter/texel_samples.h"
#include "welkin/map/pyramid.h"

namespace welkin {
namespace {

/// Texels of the target along a block's side. Blocks lie on a grid of the chart, so that a texel is made in
/// the same way whatever else is asked for.
constexpr int kBlock = 24, kSmallestBlock = 8;
constexpr int kAround = 1;                        ///< of a block's texels, whose corners show how even it is
constexpr int kLines = kBlock + 1 + 2 * kAround;  ///< of corners
/// Source texels along the narrowest footprint from which a level of the pyramid is read instead.
constexpr double kNarrowest = 8;
/// The rule of sides where what is seen is uneven, at least.
constexpr int kUnevenRule = 3;
/// Parts of a texel's edge that are straight, by how much steps along such edges change, source texels: a
/// chord is off by an eighth of that over the square of their number, at most 0.005.
int chords_for(float bend) {
  return bend < 0.03f ? 1 : bend < 0.15f ? 2 : bend < 0.6f ? 4 : 8;
}
/// The same of edges that may be traced exactly for the texel on the other side.
int many_chords_for(float bend) {
  return bend < 0.005f ? 1 : 8;
}

class MeanMaker final : public TexelMaker {
 public:
  explicit MeanMaker(ResampleJob whole)
      : job_(std::move(whole)),
        footprints_(footprints_of(job_.source, job_.target, job_.to_source)),
        level_(level_for(job_.source, footprints_.narrow, coarse_)),
        view_(view_of(level_)),
        means_(job_.source.parameterization, level_, is_reconstructed(footprints_.narrow),
               !job_.options.allow_ringing, job_.options.allow_ringing ? 1 : parts_for(footprints_.typical)),
        samples_(job_, view_),
        outline_(job_.source.parameterization, means_.size(), job_.target, job_.to_source) {}

  int rows() const override { return kBlock; }

  void make(const ChartPart& part, ImageView<float> out) const override {
    if (part.walk.as_it_is()) return make(part.chart, part.walk.start_x, part.walk.start_y, out);
    const auto [x, y, width, height] = texels_of(part.walk, out.width, out.height);
    Image image(width, height, out.channels, PixelContents::unset);
    make(part.chart, x, y, image.view());
    TexelWalk walk = part.walk;
    walk.start_x -= x;
    walk.start_y -= y;
    copy_walked(image.view(), walk, out);
  }

 private:
  /// A block's corners in the source, in texels or parts of them (OverlapMeans), one more row and column
  /// around.
  struct Corners {
    float chart[kLines][kLines], x[kLines][kLines], y[kLines][kLines], weight[kLines][kLines];
  };

  /// What a thread works with.
  struct Work {
    Work(const MeanMaker& maker) : batch(maker.job_), overlaps(maker.means_) {}
    Batch batch;
    Corners corners;
    float bend[kLines][kLines], across[kBlock][kBlock], down[kBlock][kBlock];
    std::uint8_t even[kBlock][kBlock];  ///< quadrilaterals, as their neighbours are
    bool any_hard = false;              ///< in `texels`
    OverlapMeans::Work overlaps;
    ReconstructedTexels texels;  ///< under the part of a block that is made
    std::vector<OutlineLoop> loops;
    /// Texels whose sides take the same rules.
    struct Alike {
      std::vector<Quadrilateral> areas;
      std::vector<float*> targets;
    };
    Alike alike[kQuadratureRules][kQuadratureRules];
    std::vector<float> means;
  };

  static const Level& level_for(const Map& source, double narrow, std::vector<Level>& coarse) {
    // All texels are read from one level: then a source texel's light is shared among them and not counted
    // twice, nor left out.
    int level = 0;
    while (narrow >= 2 * kNarrowest && std::isfinite(narrow)) {
      narrow /= 2;
      ++level;
    }
    if (level == 0) return source.level;
    coarse = make_pyramid(source, level);
    return coarse.empty() ? source.level : coarse.back();
  }

  void make(int chart, int x, int y, ImageView<float> out) const {
    std::unique_ptr<Work> borrowed = borrow();
    Work& work = *borrowed;
    const auto [width, height] = job_.target.size;
    for (int top = y / kBlock * kBlock; top < y + out.height; top += kBlock) {
      for (int left = x / kBlock * kBlock; left < x + out.width; left += kBlock) {
        Block block{chart, left, top, std::min(kBlock, width - left), std::min(kBlock, height - top)};
        const int from_x = std::max(left, x), from_y = std::max(top, y);
        const int to_x = std::min(left + block.width, x + out.width),
                  to_y = std::min(top + block.height, y + out.height);
        block.fill(*this, work, from_x, from_y,
                   out.part(from_x - x, from_y - y, to_x - from_x, to_y - from_y));
      }
    }
    give_back(std::move(borrowed));
  }

  std::unique_ptr<Work> borrow() const {
    const std::scoped_lock lock(mutex_);
    if (idle_.empty()) return std::make_unique<Work>(*this);
    std::unique_ptr<Work> work = std::move(idle_.back());
    idle_.pop_back();
    return work;
  }

  void give_back(std::unique_ptr<Work> work) const {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(work));
  }

  struct Block {
    int chart, x, y, width, height;

    /// The block's texels from (from_x, from_y) on that `out` has room for.
    void fill(const MeanMaker& maker, Work& work, int from_x, int from_y, ImageView<float> out) const {
      maker.locate(*this, work);
      measure_bends(work);
      fill_part({0, 0, width, height}, maker, work, {from_x - x, from_y - y, out.width, out.height}, out);
    }

    struct Part {
      int x, y, width, height;
    };

    /// How much steps change from one to the next at every corner, in texels; infinite where it is no corner
    /// of an even texel.
    void measure_bends(Work& work) const {
      const Corners& c = work.corners;
      const int rows = height + 1 + 2 * kAround, columns = width + 1 + 2 * kAround;
      constexpr float kInfinite = 1e30f;
      for (int j = kAround; j < rows - kAround; ++j) {
        for (int i = kAround; i < columns - kAround; ++i) {
          const auto bent = [&](const float(&v)[kLines][kLines]) {
            return std::max(std::fabs(v[j][i - 1] + v[j][i + 1] - 2 * v[j][i]),
                            std::fabs(v[j - 1][i] + v[j + 1][i] - 2 * v[j][i]));
          };
          const float chart = c.chart[j][i];
          const bool alike = c.chart[j][i - 1] == chart && c.chart[j][i + 1] == chart &&
                             c.chart[j - 1][i] == chart && c.chart[j + 1][i] == chart && c.weight[j][i] > 0;
          const float bend = std::max(bent(c.x), bent(c.y));
          work.bend[j][i] = alike && bend < kInfinite ? bend : kInfinite;
        }
      }
      for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
          const int a = j + kAround, b = i + kAround;
          const auto length = [&](int r, int k, int down, int right) {
            return std::max(std::fabs(c.x[r + down][k + right] - c.x[r][k]),
                            std::fabs(c.y[r + down][k + right] - c.y[r][k]));
          };
          work.across[j][i] = std::max(length(a, b, 0, 1), length(a + 1, b, 0, 1));
          work.down[j][i] = std::max(length(a, b, 1, 0), length(a, b + 1, 1, 0));
          const float bend = std::max(std::max(work.bend[a][b], work.bend[a][b + 1]),
                                      std::max(work.bend[a + 1][b], work.bend[a + 1][b + 1]));
          constexpr float kBend = 0.1f, kRounding = 0.004f;
          work.even[j][i] =
              bend < kBend * std::max({work.across[j][i], work.down[j][i], 0.05f}) + kRounding ? 1 : 0;
        }
      }
    }

    /// The texels of a part that are asked for.
    void fill_part(const Part& part, const MeanMaker& maker, Work& work, const Part& asked,
                   ImageView<float> out) const {
      const int left = std::max(part.x, asked.x),
                right = std::min(part.x + part.width, asked.x + asked.width);
      const int top = std::max(part.y, asked.y),
                bottom = std::min(part.y + part.height, asked.y + asked.height);
      if (left >= right || top >= bottom) return;
      const bool reconstructed = maker.means_.reconstructed();
      const bool by_points = reconstructed && reconstruct(part, maker, work);
      if (reconstructed && !by_points && (part.width > kSmallestBlock || part.height > kSmallestBlock)) {
        const int half_x = (part.width + 1) / 2, half_y = (part.height + 1) / 2;
        for (const int k : {0, 1, 2, 3}) {
          const int px = k % 2 * half_x, py = k / 2 * half_y;
          fill_part({part.x + px, part.y + py, std::min(half_x, part.width - px),
                     std::min(half_y, part.height - py)},
                    maker, work, asked, out);
        }
        return;
      }
      const Corners& corners = work.corners;
      for (auto& rules : work.alike) {
        for (Work::Alike& each : rules) {
          each.areas.clear();
          each.targets.clear();
        }
      }
      for (int row = top; row < bottom; ++row) {
        for (int column = left; column < right; ++column) {
          float* const to = out.at(column - asked.x, row - asked.y);
          if (work.even[row][column] != 0) {
            const Quadrilateral area = quadrilateral(corners, column + kAround, row + kAround);
            int across = rule_for(work.across[row][column]), down = rule_for(work.down[row][column]);
            const std::int32_t hard = by_points && work.any_hard ? hard_in(work.texels, area) : 0;
            if (by_points && across >= 0 && down >= 0 && hard < kLights) {
              if (hard > 0) {
                across = std::max(across, kUnevenRule);
                down = std::max(down, kUnevenRule);
              }
              Work::Alike& alike = work.alike[across][down];
              alike.areas.push_back(area);
              alike.targets.push_back(to);
              continue;
            }
            maker.outline_even(*this, column, row, corners, work);
          } else if (maker.samples_.is_outside(chart, x + column, y + row) ||
                     (none_covered(corners, row, column) &&
                      maker.samples_.misses(chart, x + column, y + row, work.batch))) {
            maker.samples_.leave(chart, x + column, y + row, work.batch, to);
            continue;
          } else if (maker.samples_.huge() || !maker.outline_.trace(chart, x + column, y + row, work.loops)) {
            maker.samples_.sample(chart, x + column, y + row, work.batch, work.overlaps.sum, to);
            continue;
          }
          if (!maker.means_.mean(work.loops, work.texels, work.overlaps, to))
            maker.samples_.sample(chart, x + column, y + row, work.batch, work.overlaps.sum, to);
        }
      }
      for (int across = 0; across < kQuadratureRules; ++across) {
        for (int down = 0; down < kQuadratureRules; ++down)
          make_alike(work.alike[across][down], across, down, maker, work);
      }
    }

    /// Whether the source shows none of a texel's corners and of its neighbours'.
    static bool none_covered(const Corners& corners, int row, int column) {
      for (int j = row; j <= row + 1 + 2 * kAround; ++j) {
        for (int i = column; i <= column + 1 + 2 * kAround; ++i) {
          if (corners.weight[j][i] >= 0) return false;
        }
      }
      return true;
    }

    static void make_alike(const Work::Alike& alike, int across, int down, const MeanMaker& maker,
                           Work& work) {
      if (alike.areas.empty()) return;
      const std::size_t channels = maker.job_.channels();
      work.means.resize(alike.areas.size() * channels + 8);
      maker.means_.kernels().means(work.texels, quadrature_rule(across), quadrature_rule(down),
                                   alike.areas.data(), alike.areas.size(), work.means.data());
      for (std::size_t k = 0; k < alike.areas.size(); ++k) {
        const float* from = work.means.data() + k * channels;
        float* const to = alike.targets[k];
        float lowest = 0;
        for (std::size_t c = 0; c < channels; ++c) {
          to[c] = from[c];
          lowest = std::min(lowest, from[c]);
        }
        if (!(lowest < 0) || maker.job_.options.allow_ringing) continue;
        const Quadrilateral& q = alike.areas[k];
        maker.means_.lift(work.texels.chart, std::min({q.x[0], q.x[1], q.x[2], q.x[3]}),
                          std::min({q.y[0], q.y[1], q.y[2], q.y[3]}),
                          std::max({q.x[0], q.x[1], q.x[2], q.x[3]}),
                          std::max({q.y[0], q.y[1], q.y[2], q.y[3]}), to);
      }
    }

    /// Reconstructs what the part's even texels see, if that is one small piece of one chart.
    bool reconstruct(const Part& part, const MeanMaker& maker, Work& work) const {
      const Corners& c = work.corners;
      float low_x = 1e30f, low_y = 1e30f, high_x = -1e30f, high_y = -1e30f, chart_seen = -1;
      float longest = 0;
      const auto see = [&](int a, int b) {
        low_x = std::min(low_x, c.x[a][b]);
        high_x = std::max(high_x, c.x[a][b]);
        low_y = std::min(low_y, c.y[a][b]);
        high_y = std::max(high_y, c.y[a][b]);
      };
      for (int j = part.y; j < part.y + part.height; ++j) {
        for (int i = part.x; i < part.x + part.width; ++i) {
          if (work.even[j][i] == 0) continue;
          const int a = j + kAround, b = i + kAround;
          if (chart_seen >= 0 && c.chart[a][b] != chart_seen) return false;
          chart_seen = c.chart[a][b];
          see(a, b);
          see(a + 1, b + 1);
          // Neighbours see the others.
          if (i + 1 == part.x + part.width || work.even[j][i + 1] == 0) see(a, b + 1);
          if (j + 1 == part.y + part.height || work.even[j + 1][i] == 0) see(a + 1, b);
          longest = std::max({longest, work.across[j][i], work.down[j][i]});
        }
      }
      if (chart_seen < 0) return false;
      const int left = std::clamp(static_cast<int>(std::floor(low_x)), 0, maker.means_.size().width - 1),
                right = std::clamp(static_cast<int>(std::floor(high_x)), 0, maker.means_.size().width - 1);
      const int top = std::clamp(static_cast<int>(std::floor(low_y)), 0, maker.means_.size().height - 1),
                bottom = std::clamp(static_cast<int>(std::floor(high_y)), 0, maker.means_.size().height - 1);
      const int columns = right - left + 1, rows = bottom - top + 1;
      if (static_cast<float>(columns * rows) >
          3.0f * static_cast<float>(part.width * part.height) * std::max(1.0f, longest * longest) + 256)
        return false;
      work.texels.reset(static_cast<int>(chart_seen), left, top, columns, rows, maker.view_.channels);
      maker.means_.reconstruct(work.texels, work.overlaps);
      work.any_hard = std::any_of(work.texels.hard.begin(), work.texels.hard.end(),
                                  [](std::uint8_t each) { return each != 0; });
      if (work.any_hard) work.texels.count_hard();
      return true;
    }

    static Quadrilateral quadrilateral(const Corners& corners, int column, int row) {
      Quadrilateral q;
      for (int k = 0; k < 4; ++k) {
        q.x[k] = corners.x[row + k / 2][column + k % 2];
        q.y[k] = corners.y[row + k / 2][column + k % 2];
        q.weight[k] = corners.weight[row + k / 2][column + k % 2];
      }
      return q;
    }

    static std::int32_t hard_in(const ReconstructedTexels& texels, const Quadrilateral& q) {
      const auto cell = [](float position, int first, int size) {
        return std::clamp(static_cast<int>(std::floor(position)), first, first + size - 1);
      };
      const int left = cell(std::min({q.x[0], q.x[1], q.x[2], q.x[3]}), texels.x, texels.width),
                right = cell(std::max({q.x[0], q.x[1], q.x[2], q.x[3]}), texels.x, texels.width);
      const int top = cell(std::min({q.y[0], q.y[1], q.y[2], q.y[3]}), texels.y, texels.height),
                bottom = cell(std::max({q.y[0], q.y[1], q.y[2], q.y[3]}), texels.y, texels.height);
      return texels.hard_in(left, top, right, bottom);
    }
  };

  void locate(const Block& block, Work& work) const {
    Corners& corners = work.corners;
    const int columns = block.width + 1 + 2 * kAround, rows = block.height + 1 + 2 * kAround;
    const float across = 1.0f / static_cast<float>(job_.target.size.width),
                down = 1.0f / static_cast<float>(job_.target.size.height);
    Batch& batch = work.batch;
    const int rows_at_once = kBatch / columns;
    for (int first = 0; first < rows; first += rows_at_once) {
      const int last = std::min(rows, first + rows_at_once);
      int i = 0;
      for (int row = first; row < last; ++row) {
        const float v = static_cast<float>(block.y - kAround + row) * down;
        for (int column = 0; column < columns; ++column, ++i) {
          batch.u[i] = static_cast<float>(block.x - kAround + column) * across;
          batch.v[i] = v;
        }
      }
      const std::size_t count = static_cast<std::size_t>(i);
      batch.locate(block.chart, count);
      batch.weigh(block.chart, count);
      const float* covered = job_.source_is_whole ? nullptr : batch.covered(count);
      i = 0;
      for (int row = first; row < last; ++row) {
        for (int column = 0; column < columns; ++column, ++i) {
          corners.chart[row][column] = batch.chart[i];
          corners.x[row][column] = batch.source_u[i] * static_cast<float>(means_.size().width);
          corners.y[row][column] = batch.source_v[i] * static_cast<float>(means_.size().height);
          corners.weight[row][column] = covered == nullptr || covered[i] > 0 ? batch.weight[i] : -1.0f;
        }
      }
    }
  }

  /// The outline of an even texel, by chords.
  void outline_even(const Block& block, int column, int row, const Corners& corners, Work& work) const {
    Batch& batch = work.batch;
    const float across = 1.0f / static_cast<float>(job_.target.size.width),
                down = 1.0f / static_cast<float>(job_.target.size.height);
    constexpr int kCorner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    constexpr int kBeside[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    // Edges are bent, or not, for the texels on both sides.
    int chords[4], first[4], points = 0;
    for (int k = 0; k < 4; ++k) {
      const int* a = kCorner[k];
      const int* b = kCorner[(k + 1) % 4];
      const float bend = std::max(work.bend[row + kAround + a[1]][column + kAround + a[0]],
                                  work.bend[row + kAround + b[1]][column + kAround + b[0]]);
      const int beside_x = column + kBeside[k][0], beside_y = row + kBeside[k][1];
      const bool even = beside_x >= 0 && beside_x < block.width && beside_y >= 0 && beside_y < block.height &&
                        work.even[beside_y][beside_x] != 0;
      chords[k] = even ? chords_for(bend) : many_chords_for(bend);
      first[k] = points;
      for (int i = 1; i < chords[k]; ++i, ++points) {
        const float t = static_cast<float>(i) / static_cast<float>(chords[k]);
        batch.u[points] =
            (static_cast<float>(block.x + column + a[0]) + t * static_cast<float>(b[0] - a[0])) * across;
        batch.v[points] =
            (static_cast<float>(block.y + row + a[1]) + t * static_cast<float>(b[1] - a[1])) * down;
      }
    }
    if (points > 0) batch.locate(block.chart, static_cast<std::size_t>(points));
    work.loops.resize(1);
    OutlineLoop& loop = work.loops[0];
    loop.chart = static_cast<int>(corners.chart[row + kAround][column + kAround]);
    loop.points.clear();
    for (int k = 0; k < 4; ++k) {
      const int r = row + kAround + kCorner[k][1], c = column + kAround + kCorner[k][0];
      loop.points.push_back({static_cast<double>(corners.x[r][c]), static_cast<double>(corners.y[r][c])});
      for (int at = first[k]; at < first[k] + chords[k] - 1; ++at) {
        if (static_cast<int>(batch.chart[at]) != loop.chart) continue;
        loop.points.push_back({static_cast<double>(batch.source_u[at]) * means_.size().width,
                               static_cast<double>(batch.source_v[at]) * means_.size().height});
      }
    }
  }

  const ResampleJob job_;
  const FootprintSides footprints_;
  std::vector<Level> coarse_;
  const Level& level_;  ///< what is read
  const LevelView view_;
  const OverlapMeans means_;
  const TexelSamples samples_;
  const Outline outline_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Work>> idle_;
};

}  // namespace

std::unique_ptr<TexelMaker> make_means(ResampleJob job) {
  return std::make_unique<MeanMaker>(std::move(job));
}

}  // namespace welkin
