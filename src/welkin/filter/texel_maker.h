#pragma once

#include <memory>

#include "welkin/filter/resample.h"
#include "welkin/image/texel_walk.h"

/// What resample() does, for some texels at a time: for maps that needn't lie in memory. Internal to the
/// library.
namespace welkin {

/// Texels of a chart, as a picture shows them: texel (x, y) of the picture is the chart's at `walk`.
struct ChartPart {
  int chart = 0;
  TexelWalk walk;

  ChartPart from(int x, int y) const { return {chart, walk.from(x, y)}; }
};

/// Makes a map's texels.
class TexelMaker {
 public:
  virtual ~TexelMaker() = default;

  /// Rows of a chart that are best made together.
  virtual int rows() const = 0;
  /// Fills a picture of texels. The same texels come out bit for bit, whichever are asked for together. From
  /// several threads at once.
  virtual void make(const ChartPart& part, ImageView<float> out) const = 0;
};

/// Those that resample() would make of the source, which must outlive this; the borders are the caller's.
/// What is made for all of them, the plan of Filter::automatic and its pyramid, is made here; of the monitor
/// only `cancelled` is asked, and here alone. Throws as resample().
std::unique_ptr<TexelMaker> make_texels(const Map& source, const MapFrame& target,
                                        const ResampleOptions& options);

}  // namespace welkin
