#pragma once

#include "welkin/lobe/lobe.h"
#include "welkin/prefilter/fft.h"
#include "welkin/prefilter/legendre.h"
#include "welkin/prefilter/near_field.h"
#include "welkin/prefilter/point_grid.h"
#include "welkin/prefilter/sampled_group.h"

/// The inner loops of pre-filtering, compiled once per instruction set. `parts` are the real and imaginary
/// parts of up to three channels: 2, 4 or 6 values side by side.
///
/// Orders of a row transform are laid out [order m][pack][parity][part][8 lanes]: for each northern latitude,
/// parity 0 is the row plus its mirror image about the equator, parity 1 the row less its mirror image.
namespace welkin::prefilter {

/// Rows of a lat-long picture, and how they spread onto rows of points.
struct SpreadRows {
  ImageView<const float> picture;
  const RowSpread& down;
  const ColumnSpread& along;
  /// Of each row of the picture, to be found out in passing; null: not wanted. Then the picture has a whole
  /// number of rows for each row of points, and RowValues::kMostChannels at most.
  RowValues* values = nullptr;

  /// Values of work space that the kernel needs.
  std::size_t work() const {
    const int chunk = along.columns > 128 ? along.columns : 128;
    return static_cast<std::size_t>(picture.channels) *
               static_cast<std::size_t>(picture.width + 2 * along.reach + 18 * chunk) * 16 +
           4096;
  }
};

/// A strided view of the orders of rows of points for NearField: rows follow each other, those of the
/// northern half and their mirror images.
struct NearOrders {
  float* values;         ///< of the order 0
  std::ptrdiff_t order;  ///< from one order to the next, in values
  std::ptrdiff_t part;   ///< from one part to the next
  std::ptrdiff_t half;   ///< from the northern rows to the southern
};

/// A strided view of the orders of a pack of NearField's results, ready for the transform along the rows:
/// [channel][column][16].
struct NearColumns {
  float* lanes;
  std::ptrdiff_t channel;  ///< from one channel to the next, in values
  int length;              ///< columns
  const float* phases;     ///< see HarmonicLevel
};

struct Kernels {
  /// Weights of the pack's points: channel after channel, [column][16]. `work`: 16·(width + 2)·channels + 64
  /// values.
  void (*spread_rows)(const SpreadRows& rows, int pack, float* lanes, float* work);

  /// Transforms one channel of a pack, in place, and writes the orders 0 … degree, times `factors`, of part
  /// 2·channel and the next. `work` has as many values as the rows. `orders` is at [0][pack][0][2·channel].
  void (*rows_to_orders)(const FftPlan& plan, float* lanes, float* work, const float* factors, int degree,
                         int packs, int parts, float* orders);
  /// The reverse: fills `lanes`, [column][16], and returns where the result is: `lanes` or `work`.
  float* (*orders_to_rows)(const FftPlan& plan, const float* orders, int degree, int packs, int parts,
                           float* lanes, float* work);

  /// The same as rows_to_orders for NearField: one channel of a pack. `orders.values` is at its first part.
  void (*rows_to_near)(const FftPlan& plan, float* lanes, float* work, const float* factors, int last,
                       const NearOrders& orders);
  /// One order of all channels of a pack of the result's rows, from that of the points: `points.values` is at
  /// the pack's first row. Index channels − 1.
  void (*near[3])(const NearField& field, int pack, int order, const NearOrders& points,
                  const NearColumns& results);
  /// Transforms [column][16] back; returns where the result is: `lanes` or `work`.
  float* (*to_rows)(const FftPlan& plan, float* lanes, float* work);

  /// Of a SampledLobe.
  lobe::PointSums sampled_sums;
  /// The same of all lobes of a group: values[(i · channels + c) · members + k] is set to lobe k's.
  void (*group_sums)(const SampledGroup& group, const lobe::Points& points, const float* x, const float* y,
                     const float* z, float* values, std::size_t count);

  /// See legendre_impl.h; index channels − 1.
  void (*analyse[3])(const Latitudes& latitudes, const Recurrence& r, int degree, const float* rows,
                     float* work, float* out);
  void (*synthesise[3])(const Latitudes& latitudes, const Recurrence& r, int degree,
                        const float* coefficients, float* rows);
};

const Kernels& kernels_baseline();
#ifdef WELKIN_HAS_AVX2
const Kernels& kernels_avx2();
#endif

/// For the best instruction set of this processor.
const Kernels& kernels();

}  // namespace welkin::prefilter
