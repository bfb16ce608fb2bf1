#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/camera/camera.h"
#include "welkin/filter/sampler.h"

/// @file
/// Pictures of a world while the camera moves.
namespace welkin {

/// When a camera's shutter is open, in frames.
struct Shutter {
  double open = 0;   ///< from here
  double close = 0;  ///< to here, not before
};

/// How motion is blurred.
struct MotionBlurOptions {
  /// Positions of the camera between open and close that are averaged; none: one and a half for each pixel
  /// that the picture moves at its fastest, fewer beyond 29 pixels, 16 at least and 1024 at most.
  std::optional<int> samples = {};
  Monitor monitor = {};  ///< progress and cancelling
};

/// What a camera sees while its shutter is open: every pixel is the mean of the region that it sweeps,
/// whatever way the camera turns, rolls and zooms. The mean is over positions of the camera evenly spread in
/// time, each with a position in the pixel of its own, by which the region is covered evenly; where pixels
/// are larger than the world's texels they are read from the world's pyramid. `camera` is what it is at a
/// time in frames, of one size and one number of charts throughout. A camera that stands still gives the same
/// but for noise-free antialiasing: use view for that.
///
/// The map has the frame at the middle of the shutter's time. Channels are those of the world; outside of
/// what a lens sees, 0. Throws Error (bad_request): a shutter that closes before it opens, or is not finite;
/// samples below 1 or above 65536; a camera whose size changes. As frame_of and Sampler do; Cancelled.
WELKIN_API Map blurred_view(const Map& world, const std::function<Camera(double frame)>& camera,
                            const Shutter& shutter, const MotionBlurOptions& options = {});

/// A world that blurred pictures are taken of, one after another: its pyramid is made once, when a picture
/// is first coarse enough to read it, and kept. Everything else is immutable: `view` from many threads at
/// once. Copies share the pyramid.
class WELKIN_API BlurredWorld {
 public:
  /// Of the caller's world, which must outlive this and its copies, and not change meanwhile.
  explicit BlurredWorld(const Map& world);
  explicit BlurredWorld(const Map&& world) = delete;

  /// The same as blurred_view of this world, bit for bit.
  Map view(const std::function<Camera(double frame)>& camera, const Shutter& shutter,
           const MotionBlurOptions& options = {}) const;

 private:
  class State;
  std::shared_ptr<const State> state_;
};

/// How far the picture moves at its fastest while the shutter is open, in pixels.
WELKIN_API double swept_pixels(const std::function<Camera(double frame)>& camera, const Shutter& shutter);

}  // namespace welkin
