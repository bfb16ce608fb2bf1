#include "welkin/image/drawing.h"

#include <algorithm>

#include "welkin/image/font.h"

namespace welkin {

void blend(Image& picture, int x, int y, const Rgb& color, double cover) {
  if (x < 0 || y < 0 || x >= picture.width() || y >= picture.height()) return;
  float* pixel = picture.at(x, y);
  const float amount = static_cast<float>(std::clamp(cover, 0.0, 1.0));
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = (1 - amount) * pixel[c] + amount * color[c];
}

void fill_box(Image& picture, const Box& box, const Rgb& color) {
  for (int y = box.y; y < box.y + box.height; ++y) {
    for (int x = box.x; x < box.x + box.width; ++x) blend(picture, x, y, color, 1);
  }
}

void draw_text(Image& picture, const Text& text) {
  const double size = text.size;
  const double reach_x = (text_width(text.text) / 2 + 0.2) * size, reach_y = 0.7 * size;
  const double half_stroke = std::max(0.5, 0.055 * size);
  for (int j = static_cast<int>(text.y - reach_y); j <= static_cast<int>(text.y + reach_y); ++j) {
    for (int i = static_cast<int>(text.x - reach_x); i <= static_cast<int>(text.x + reach_x); ++i) {
      const double u = (i + 0.5 - text.x) / size, v = (j + 0.5 - text.y) / size;
      const double distance = text_distance(text.text, u, v) * size;
      blend(picture, i, j, kBlack, half_stroke + 0.5 - distance);
    }
  }
}

}  // namespace welkin
