#include "welkin/measure/picture_errors.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/image/color_ramp.h"
#include "welkin/image/drawing.h"

namespace welkin {
namespace {

void check(const PicturePair& pair) {
  const auto fits = [&](const ImageView<const float>& other) {
    return other.width == pair.truth.width && other.height == pair.truth.height &&
           other.channels == pair.truth.channels;
  };
  if (!fits(pair.approximation) || (pair.truth_error && !fits(*pair.truth_error)))
    throw Error(ErrorKind::mismatch, "the pictures differ in size or channels");
  require(pair.truth.channels == 1 || pair.truth.channels == 3 || pair.truth.channels == 4,
          "pictures that are compared have one, three or four channels");
}

int colours_of(const PicturePair& pair) {
  return std::min(pair.truth.channels, 3);
}

bool is_covered(const PicturePair& pair, int x, int y) {
  return pair.truth.channels < 4 || pair.truth.at(x, y)[3] > 0 || pair.approximation.at(x, y)[3] > 0;
}

bool is_finite(const PicturePair& pair, int x, int y) {
  for (int c = 0; c < colours_of(pair); ++c)
    if (!std::isfinite(pair.truth.at(x, y)[c]) || !std::isfinite(pair.approximation.at(x, y)[c]))
      return false;
  return true;
}

/// Means over a pixel's channels.
struct Squares {
  double truth = 0;
  double error = 0;
};
Squares squares_at(const PicturePair& pair, int x, int y) {
  Squares sum;
  const int colours = colours_of(pair);
  for (int c = 0; c < colours; ++c) {
    const double t = pair.truth.at(x, y)[c], apart = pair.approximation.at(x, y)[c] - t;
    sum.truth += t * t / colours;
    sum.error += apart * apart / colours;
  }
  return sum;
}

double quotient(double part, double whole) {
  return part == 0 ? 0 : part / whole;
}

}  // namespace

PictureErrors picture_errors(const PicturePair& pair) {
  check(pair);
  PictureErrors errors;
  const int colours = colours_of(pair);
  double truth = 0, error = 0, noise = 0, mean_truth = 0, mean_error = 0;
  for (int y = 0; y < pair.truth.height; ++y) {
    for (int x = 0; x < pair.truth.width; ++x) {
      if (!is_covered(pair, x, y)) continue;
      if (!is_finite(pair, x, y)) {
        ++errors.skipped;
        continue;
      }
      ++errors.pixels;
      const Squares squares = squares_at(pair, x, y);
      truth += squares.truth;
      error += squares.error;
      for (int c = 0; c < colours; ++c) {
        const double t = pair.truth.at(x, y)[c], apart = pair.approximation.at(x, y)[c] - t;
        mean_truth += t;
        mean_error += apart;
        if (pair.truth_error) noise += std::pow(pair.truth_error->at(x, y)[c], 2) / colours;
        if (std::abs(apart) <= errors.maximum) continue;
        errors.maximum = std::abs(apart);
        errors.maximum_x = x;
        errors.maximum_y = y;
      }
    }
  }
  errors.relative_rmse = quotient(std::sqrt(error), std::sqrt(truth));
  errors.truth_noise = quotient(std::sqrt(noise), std::sqrt(truth));
  errors.mean_error = quotient(mean_error, mean_truth);
  return errors;
}

Image side_by_side(const PicturePair& pair) {
  const PictureErrors errors = picture_errors(pair);
  const int width = pair.truth.width, height = pair.truth.height, gap = std::max(2, width / 80);
  Image picture(3 * width + 2 * gap, height, 3);
  fill_box(picture, {0, 0, picture.width(), height}, kWhite);
  double all = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (is_covered(pair, x, y) && is_finite(pair, x, y)) all += squares_at(pair, x, y).truth;
  const double floor = 0.1 * std::sqrt(all / static_cast<double>(std::max<std::uint64_t>(1, errors.pixels)));
  const int colours = colours_of(pair);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const int from = colours == 1 ? 0 : c;
        picture.at(x, y)[c] = pair.approximation.at(x, y)[from];
        picture.at(width + gap + x, y)[c] = pair.truth.at(x, y)[from];
      }
      Rgb colour = neutral_color();
      if (is_covered(pair, x, y) && is_finite(pair, x, y)) {
        const Squares squares = squares_at(pair, x, y);
        const double error = quotient(std::sqrt(squares.error), std::max(std::sqrt(squares.truth), floor));
        colour = color_ramp(1 - std::log(std::max(error, 1e-30)) / std::log(kPictureErrorMinimum));
      }
      std::copy(colour.begin(), colour.end(), picture.at(2 * (width + gap) + x, y));
    }
  }
  return picture;
}

}  // namespace welkin
