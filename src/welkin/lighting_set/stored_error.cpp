#include "welkin/lighting_set/stored_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"

namespace welkin {
namespace {

StoredError error_of_row(const float* given, const float* stored, std::size_t count) {
  StoredError error;
  error.values = count;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = static_cast<double>(given[i]), b = static_cast<double>(stored[i]);
    error.squared_error += (b - a) * (b - a);
    error.squared += a * a;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (given[i] == stored[i]) continue;
    const double light = std::max(static_cast<double>(given[i]), 0.0);
    const double logarithm =
        std::log1p((std::max(static_cast<double>(stored[i]), 0.0) - light) / (1 + light));
    error.squared_log_error += logarithm * logarithm;
  }
  return error;
}

}  // namespace

double StoredError::relative_rmse() const {
  return squared_error == 0 ? 0 : std::sqrt(squared_error / squared);
}

double StoredError::rmsle() const {
  return values == 0 ? 0 : std::sqrt(squared_log_error / static_cast<double>(values));
}

StoredError& StoredError::operator+=(const StoredError& other) {
  squared_error += other.squared_error;
  squared += other.squared;
  squared_log_error += other.squared_log_error;
  values += other.values;
  return *this;
}

StoredError stored_error(ImageView<const float> given, ImageView<const float> stored) {
  if (given.width != stored.width || given.height != stored.height || given.channels != stored.channels)
    throw Error(ErrorKind::mismatch, "pictures of other sizes have no error of storing");
  const std::size_t row = static_cast<std::size_t>(given.width) * static_cast<std::size_t>(given.channels);
  // Added up in order, so that threads change nothing.
  std::vector<StoredError> rows(static_cast<std::size_t>(given.height));
  parallel_for(given.height, [&](int y) {
    rows[static_cast<std::size_t>(y)] = error_of_row(given.row(y), stored.row(y), row);
  });
  StoredError all;
  for (const StoredError& each : rows) all += each;
  return all;
}

StoredError stored_error(const Map& given, const Map& stored) {
  if (given.charts() != stored.charts())
    throw Error(ErrorKind::mismatch, "maps of other charts have no error of storing");
  StoredError all;
  for (int chart = 0; chart < given.charts(); ++chart)
    all += stored_error(given.level.chart(chart), stored.level.chart(chart));
  return all;
}

std::vector<StoredError> stored_errors(const Chain& given, const Chain& stored) {
  if (given.levels.size() != stored.levels.size())
    throw Error(ErrorKind::mismatch, "chains of other levels have no error of storing");
  std::vector<StoredError> errors;
  for (std::size_t i = 0; i < given.levels.size(); ++i)
    errors.push_back(stored_error(given.levels[i], stored.levels[i]));
  return errors;
}

ReadMapOptions as_written(const Chain& given, const std::string& shape) {
  ReadMapOptions options;
  options.shape = shape;
  options.orientation = given.levels.front().orientation;
  options.join_faces = false;
  return options;
}

}  // namespace welkin
