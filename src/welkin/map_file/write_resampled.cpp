#include "welkin/map_file/write_resampled.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/texel_maker.h"
#include "welkin/map/adjust.h"
#include "welkin/map_file/cell_walk.h"
#include "welkin/map_file/chain_attributes.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin {

using namespace map_file;

namespace {

/// Makes the rows of cells when they are written.
class CellMaker {
 public:
  CellMaker(const Map& source, const MapFrame& frame, const WriteResampledOptions& options)
      : frame_(frame),
        monitor_(options.resample.monitor),
        made_rows_(options.made),
        maker_(make_texels(source, frame, options.resample)) {
    if (options.factor == 1) return;
    for (const std::string& name : source.channel_names)
      factors_.push_back(name == "A" ? 1.0f : options.factor);
  }

  void draw(const LayoutCell& cell, int y, ImageView<float> rows) {
    try {
      if (monitor_.cancelled && monitor_.cancelled()) throw Cancelled();
      const TexelWalk walk = walk_of(cell, frame_.size).from(0, y);
      maker_->make({cell.chart, walk}, rows);
      if (made_rows_) hand_out(cell.chart, walk, rows);
      if (!factors_.empty()) scale_rows(rows);
      if (monitor_.progress) monitor_.progress(progress(rows));
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      throw;
    }
  }

  int rows() const { return maker_->rows(); }

  /// What ended a draw: writers may have told it in their own words.
  const std::exception_ptr& failure() const { return failure_; }

 private:
  /// Rows of the cell as the chart has them, which are whole unless it lies on its side.
  void hand_out(int chart, const TexelWalk& walk, ImageView<const float> rows) const {
    if (walk.as_it_is()) return made_rows_(chart, walk.start_y, rows);
    std::vector<float> straight(static_cast<std::size_t>(rows.width) *
                                static_cast<std::size_t>(rows.channels));
    const ImageView<float> row{straight.data(), rows.width, 1, rows.channels, 0};
    for (int y = 0; y < rows.height; ++y) {
      const TexelWalk along = walk.from(0, y);
      copy_unwalked(rows.part(0, y, rows.width, 1),
                    {along.right_x > 0 ? 0 : rows.width - 1, 0, along.right_x}, row);
      made_rows_(chart, along.start_y, row);
    }
  }

  void scale_rows(ImageView<float> rows) const {
    for (int y = 0; y < rows.height; ++y) {
      float* value = rows.row(y);
      for (int x = 0; x < rows.width; ++x) {
        for (const float each : factors_) *value++ *= each;
      }
    }
  }

  /// How much is done with these rows. Some may be drawn twice.
  double progress(ImageView<float> rows) {
    const auto texels = [](int width, int height) {
      return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    };
    const std::uint64_t done = made_ += texels(rows.width, rows.height);
    const std::uint64_t all = texels(frame_.size.width, frame_.size.height) *
                              static_cast<std::uint64_t>(frame_.parameterization.charts());
    return std::min(1.0, static_cast<double>(done) / static_cast<double>(all));
  }

  const MapFrame frame_;
  const Monitor monitor_;
  const std::function<void(int, int, ImageView<const float>)> made_rows_;
  const std::unique_ptr<TexelMaker> maker_;
  std::vector<float> factors_;  ///< of each channel; none for 1
  std::atomic<std::uint64_t> made_{0};
  std::mutex mutex_;
  std::exception_ptr failure_;
};

io::WriteReport write_by_map(const std::filesystem::path& path, const Map& source, const MapFrame& frame,
                             const Layout& layout, const WriteMapOptions& write,
                             const WriteResampledOptions& options) {
  Map target(frame.parameterization, frame.size.width, frame.size.height, source.channels());
  target.channel_names = source.channel_names;
  target.orientation = frame.orientation;
  ResampleOptions resampling = options.resample;
  resampling.borders = write.border > 0;
  resample(source, target, resampling);
  if (options.made) {
    parallel_for(target.charts() * target.height(), [&](int i) {
      const int chart = i / target.height(), y = i % target.height();
      options.made(chart, y, target.level.chart(chart).part(0, y, target.width(), 1));
    });
  }
  if (options.factor != 1) scale(target, options.factor);
  return write_map(path, target, layout, write);
}

}  // namespace

io::WriteReport write_resampled(const std::filesystem::path& path, const Map& source, const MapShape& shape,
                                ChartSize size, const WriteResampledOptions& options) {
  const MapFrame frame(shape.parameterization, size, options.orientation);
  WriteMapOptions write = options.write;
  for (const auto& [key, text] : attributes_of(options.notes)) write.image.attributes[key] = text;
  Layout placed = layout_for(shape.layout, frame.parameterization, frame.orientation);
  if (!write.faces.empty()) placed = with_faces(placed, frame.parameterization, write.faces);
  check_turns(placed, size);
  // Filter::automatic makes texels as their chart lies; turning them band by band takes longer than a map. Of
  // cells that lie on their side no row is whole before all are made.
  const bool by_map =
      write.border > 0 || std::any_of(placed.cells.begin(), placed.cells.end(), [&](const LayoutCell& cell) {
        const TexelWalk walk = walk_of(cell, size);
        return !walk.as_it_is() &&
               (options.resample.filter == Filter::automatic || (options.made && walk.on_its_side()));
      });
  if (by_map) return write_by_map(path, source, frame, shape.layout, write, options);
  CellMaker maker(source, frame, options);
  const WrittenLevel level(
      frame, source.channel_names,
      [&maker](const LayoutCell& cell, int y, ImageView<float> rows) { maker.draw(cell, y, rows); },
      maker.rows());
  try {
    return write_levels(Destination(path), {&level, 1}, shape.layout, write);
  } catch (...) {
    if (maker.failure()) std::rethrow_exception(maker.failure());
    throw;
  }
}

}  // namespace welkin
