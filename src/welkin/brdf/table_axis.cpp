#include "welkin/brdf/table_axis.h"

#include "welkin/base/error.h"

namespace welkin::brdf {

double texel_coordinate(int i, int count, TexelPlacement placement) {
  require(i >= 0 && i < count, "a table's axis has no such texel");
  if (count == 1) return 0.5;
  if (placement == TexelPlacement::centres) return (i + 0.5) / count;
  return static_cast<double>(i) / (count - 1);
}

}  // namespace welkin::brdf
