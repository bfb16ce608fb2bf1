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

  /// The same as rows_to_orders for NearField: orders as [order][part][reach + row + reach], row by row.
  /// `orders` is at [0][2·channel][reach]; `step` values from one order to the next, `part` from one part to
  /// the next.
  void (*rows_to_near)(const FftPlan& plan, float* lanes, float* work, const float* factors, int last,
                       int pack, int rows, std::ptrdiff_t step, std::ptrdiff_t part, float* orders);
  /// One order of the result's rows, laid out in the same way, from that of the masses.
  void (*near[3])(const NearField& field, int order, const float* from, std::ptrdiff_t part, float* to,
                  std::ptrdiff_t to_part);
  /// Rows 8·pack … and rows/2 + 8·pack … of a channel, [column][16], from orders; returns where they are.
  float* (*near_to_rows)(const FftPlan& plan, const float* orders, int last, int pack, int rows,
                         std::ptrdiff_t step, std::ptrdiff_t part, const float* turn, float* lanes,
                         float* work);

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
