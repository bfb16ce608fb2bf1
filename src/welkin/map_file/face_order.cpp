#include "welkin/map_file/face_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace welkin::map_file {
namespace {

constexpr int kFaces = 6, kTurns = 4, kStates = kFaces * kTurns;
/// Sums that differ by less are of worlds that are alike, or of ways to turn one world.
constexpr float kAsWell = 1.05f;

/// Which picture each chart has, and turned how: picture · kTurns + quarter turns.
using States = std::array<int, kFaces>;

class OrderSearch {
 public:
  OrderSearch(const std::vector<Image>& pictures, const Layout& layout, const std::vector<EdgeTexel>& texels)
      : layout_(layout), sums_(static_cast<std::size_t>(kFaces * kFaces * kStates * kStates)) {
    std::vector<Image> charts = blank_small_faces(kStates);
    for (int state = 0; state < kStates; ++state) {
      const auto picture = static_cast<std::size_t>(state / kTurns);
      LayoutCell cell = layout.cells[picture];
      cell.quarter_turns = (cell.quarter_turns + state % kTurns) & 3;
      copy_from_cell(cell, pictures[picture].view(), charts[static_cast<std::size_t>(state)].view());
    }
    for (const EdgeTexel& t : texels) {
      for (int a = 0; a < kStates; ++a) {
        const float value = *charts[static_cast<std::size_t>(a)].at(t.x, t.y);
        for (int b = 0; b < kStates; ++b) {
          const float other = *charts[static_cast<std::size_t>(b)].at(t.other_x, t.other_y);
          sum(t.face, a, t.other_face, b) += std::fabs(value - other);
        }
      }
    }
  }

  /// Fills the members below.
  void run() {
    least = next = std::numeric_limits<float>::max();
    place(
        0, 0, [this](float sum) { least = std::min(least, sum); }, least);
    int preferred = std::numeric_limits<int>::max();
    place(
        0, 0,
        [&](float sum) {
          if (sum > kAsWell * least) {
            next = std::min(next, sum);
          } else if (const int strangeness = strangeness_of_states(); strangeness < preferred) {
            preferred = strangeness;
            best = states_;
          }
        },
        next);
  }

  float least = 0, next = 0;
  States best{};

 private:
  float& sum(int chart, int state, int other_chart, int other_state) {
    if (chart > other_chart) return sum(other_chart, other_state, chart, state);
    return sums_[static_cast<std::size_t>(((chart * kFaces + other_chart) * kStates + state) * kStates +
                                          other_state)];
  }

  /// Places every picture that is left into this chart and those after it; sums that reach `bound` are not
  /// followed.
  template <class Found>
  void place(int chart, float so_far, const Found& found, const float& bound) {
    if (chart == kFaces) return found(so_far);
    for (int state = 0; state < kStates; ++state) {
      const auto placed = states_.begin() + chart;
      if (std::any_of(states_.begin(), placed, [&](int other) { return other / kTurns == state / kTurns; }))
        continue;
      float total = so_far;
      // Opposite charts have no edge, and their sums are 0.
      for (int other = 0; other < chart; ++other)
        total += sum(other, states_[static_cast<std::size_t>(other)], chart, state);
      if (total >= bound) continue;
      *placed = state;
      place(chart + 1, total, found, bound);
    }
  }

  int strangeness_of_states() const {
    constexpr int kSide = 64, kTopOrBottom = 8;
    constexpr int kPy = 2, kNy = 3;
    int strangeness = 0, moved = 0, moved_in_engines = 0;
    for (int chart = 0; chart < kFaces; ++chart) {
      const int state = states_[static_cast<std::size_t>(chart)];
      if (state % kTurns != 0) strangeness += chart == kPy || chart == kNy ? kTopOrBottom : kSide;
      const int own = layout_.cells[static_cast<std::size_t>(state / kTurns)].chart;
      // In the worlds of engines +X and −X change places.
      const int engines = own < kPy ? 1 - own : own;
      if (own != chart) ++moved;
      if (engines != chart) ++moved_in_engines;
    }
    return strangeness + std::min(moved, moved_in_engines);
  }

  const Layout& layout_;
  std::vector<float> sums_;
  States states_{};
};

}  // namespace

FaceOrder find_face_order(const std::vector<Image>& pictures, const Layout& layout,
                          const sphere::AnyParameterization& p, const std::vector<EdgeTexel>& texels) {
  OrderSearch search(pictures, layout, texels);
  search.run();
  const std::vector<std::string> names = chart_names(p);
  std::array<std::string, kFaces> faces;
  for (int chart = 0; chart < kFaces; ++chart) {
    const int state = search.best[static_cast<std::size_t>(chart)], turns = state % kTurns;
    faces[static_cast<std::size_t>(state / kTurns)] =
        names[static_cast<std::size_t>(chart)] + (turns == 0 ? "" : ":" + std::to_string(90 * turns));
  }
  FaceOrder order;
  for (const std::string& face : faces) order.faces += (order.faces.empty() ? "" : ",") + face;
  const auto count = static_cast<double>(texels.size());
  order.step = static_cast<double>(search.least) / count;
  order.next_step = static_cast<double>(search.next) / count;
  return order;
}

}  // namespace welkin::map_file
