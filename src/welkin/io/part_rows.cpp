#include "welkin/io/part_rows.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

namespace welkin::io {
namespace {

ImageView<const float> rows_in_memory(const WritePart& part, int y, int count) {
  return part.image.part(0, y, part.image.width, count);
}

/// The first `count` rows of `memory`, which is reallocated when it is too small.
ImageView<float> band_of(const WritePart& part, int count, Image& memory) {
  const ImageView<const float>& image = part.image;
  if (memory.empty() || memory.height() < count) memory = Image(image.width, count, image.channels);
  assert(memory.width() == image.width && memory.channels() == image.channels);
  return memory.view().part(0, 0, image.width, count);
}

}  // namespace

ImageView<const float> PartRows::rows(int y, int count) {
  assert(y >= 0 && count > 0 && y + count <= part_->image.height);
  if (!part_->draw) return rows_in_memory(*part_, y, count);
  const ImageView<float> band = band_of(*part_, count, band_);
  part_->draw(y, band);
  return band;
}

ImageView<const float> draw_rows(const WritePart& part, int y, int count, Image& memory) {
  assert(y >= 0 && count > 0 && y + count <= part.image.height);
  if (!part.draw) return rows_in_memory(part, y, count);
  const ImageView<float> band = band_of(part, count, memory);
  // Pieces that begin where `draw` likes them to; the first may be shorter.
  const int rows = part.rows_at_once > 1 ? part.rows_at_once : 32, before = y / rows * rows;
  tbb::parallel_for(tbb::blocked_range<int>(before / rows, (y + count - 1) / rows + 1, 1),
                    [&](const tbb::blocked_range<int>& range) {
                      for (int i = range.begin(); i < range.end(); ++i) {
                        const int first = std::max(y, i * rows), end = std::min(y + count, (i + 1) * rows);
                        part.draw(first, band.part(0, first - y, band.width, end - first));
                      }
                    });
  return band;
}

std::vector<Image> draw_parts(std::vector<WritePart>& parts) {
  std::vector<Image> drawn;
  for (WritePart& part : parts) {
    if (!part.draw) continue;
    part.image = draw_rows(part, 0, part.image.height, drawn.emplace_back());
    part.draw = nullptr;
  }
  return drawn;
}

}  // namespace welkin::io
