#pragma once

#include <vector>

#include "welkin/io/image_file.h"

/// The texels of parts that are written, whether they lie in memory or are drawn (WritePart::draw).
namespace welkin::io {

/// Rows of a part, band by band, on one thread: of parts that are drawn, one band is in memory.
class PartRows {
 public:
  explicit PartRows(const WritePart& part) : part_(&part) {}

  /// `count` rows from row y on, until the next call.
  ImageView<const float> rows(int y, int count);

 private:
  const WritePart* part_;
  Image band_;
};

/// The same for a large band, by all threads: the rows where they lie, or drawn into `memory`.
ImageView<const float> draw_rows(const WritePart& part, int y, int count, Image& memory);

/// Draws every part that is to be drawn as a whole, and has it refer to the pictures that are returned.
std::vector<Image> draw_parts(std::vector<WritePart>& parts);

}  // namespace welkin::io
