#pragma once

#include "welkin/lobe/lobe.h"
#include "welkin/prefilter/fft.h"
#include "welkin/prefilter/legendre.h"
#include "welkin/prefilter/moments.h"
#include "welkin/prefilter/near_field.h"

/// The inner loops of pre-filtering, compiled once per instruction set. `parts` are the real and imaginary
/// parts of up to three channels: 2, 4 or 6 values side by side.
///
/// Orders of a row transform are laid out [order m][pack][parity][part][8 lanes]: for each northern latitude,
/// parity 0 is the row plus its mirror image about the equator, parity 1 the row less its mirror image.
namespace welkin::prefilter {

/// Masses of rows of a lat-long picture; see RowSpread and ColumnSpread.
struct SpreadRows {
  const float* texels;        ///< of row 0
  std::ptrdiff_t row_stride;  ///< in values
  int width, channels;
  int height;        ///< rows of masses
  const int* first;  ///< see RowSpread
  const RowSpread::Tap* taps;
  int columns;  ///< of the picture for one of the masses'
  const float* along;
  int along_count;
  int reach;  ///< columns before a mass's own first one that it takes in

  /// Where not null: a picture of height × width/columns texels to fill, see MomentPlan::reduces.
  float* reduced;
  std::ptrdiff_t reduced_stride;
  int picture_height;
  const float* shares;  ///< of each row of the picture in a texel of `reduced`, over its columns

  /// Values of work space that the kernel needs.
  std::size_t work() const {
    return static_cast<std::size_t>(channels) *
               static_cast<std::size_t>(width + 2 * reach + 18 * (columns > 128 ? columns : 128)) * 16 +
           4096;
  }
};

/// Orders of rows of masses for NearField: rows follow each other, those of the northern half and their
/// mirror images.
struct NearOrders {
  float* values;         ///< of the order 0
  std::ptrdiff_t order;  ///< from one order to the next, in values
  std::ptrdiff_t part;   ///< from one part to the next
  std::ptrdiff_t half;   ///< from the northern rows to the southern
};

/// Orders of a pack of NearField's results, ready for the transform along the rows: [channel][column][16].
struct NearColumns {
  float* lanes;
  std::ptrdiff_t channel;  ///< from one channel to the next, in values
  int length;              ///< columns
  const float* turn;       ///< see HarmonicLevel
};

struct Kernels {
  /// Masses of the pack's rows: channel after channel, [column][16]. `work`: 16·(width + 2)·channels + 64
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
  /// One order of all channels of a pack of the result's rows, from that of the masses: `masses.values` is at
  /// the pack's first row. Index channels − 1.
  void (*near[3])(const NearField& field, int pack, int order, const NearOrders& masses,
                  const NearColumns& results);
  /// Transforms [column][16] back; returns where the result is: `lanes` or `work`.
  float* (*to_rows)(const FftPlan& plan, float* lanes, float* work);

  /// Of a SampledLobe.
  lobe::PointSums sampled_sums;

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
