#include "render_frames.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "progress.h"
#include "scene_flags.h"
#include "welkin/render/project/project.h"
#include "welkin/render/project/world_along.h"
#include "welkin/sequence/made_note.h"

namespace welkin::cli {

/// An object on its way from one place to another.
struct AnimationFlags::Motion {
  std::size_t instance;
  Vec3d from, to;
  FrameRange range;

  Vec3d place(double frame) const {
    const double t = range.last > range.first ? (frame - range.first) / (range.last - range.first) : 0;
    return from + t * (to - from);
  }
};

void AnimationFlags::add(Command command) {
  command.add_option("--frames", frames,
                     "Frames to make of an animation: A-B; OUT is numbered: turn_%04d.exr");
  command.add_option("--turntable", turntable, "The scene turns once about its vertical in so many frames")
      .within(1, 1'000'000);
  command.add_option(
      "--move", move,
      "NAME=X,Y,Z:X,Y,Z: an object's way from the first frame to the last. It reflects the scene "
      "around it, projected every so many frames and interpolated between");
  command.add_option("--every", every, "Of --move: frames from one projection to the next")
      .within(1, 100'000)
      .show_default();
  command.add_flag("--resume", resume,
                   "Leave frames alone whose files are complete and were made by the same request");
}

bool AnimationFlags::asked(const std::string& out) const {
  if (!frames.empty()) {
    if (!FrameNames::has_place(out)) throw UsageError(out + ": has no place for the frame's number, as %04d");
    return true;
  }
  if (turntable > 0) throw UsageError("--turntable: is for --frames");
  if (!move.empty()) throw UsageError("--move: is for --frames");
  if (resume) throw UsageError("--resume: is for --frames");
  return false;
}

std::optional<AnimationFlags::Motion> AnimationFlags::motion_of(const scene::Scene& scene,
                                                                const FrameRange& range) const {
  if (move.empty()) return std::nullopt;
  const std::size_t equals = move.find('='), colon = move.find(':', equals);
  if (equals == std::string::npos || colon == std::string::npos)
    throw UsageError("--move: '" + move + "' is not NAME=X,Y,Z:X,Y,Z");
  Motion motion{0, parse_point("--move", move.substr(equals + 1, colon - equals - 1)),
                parse_point("--move", move.substr(colon + 1)), range};
  std::vector<std::string> names;
  for (const scene::Instance& instance : scene.instances) names.push_back(instance.name);
  const std::string name = move.substr(0, equals);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw UsageError("--move: " + unknown_name("object", name, names));
  motion.instance = static_cast<std::size_t>(found - names.begin());
  return motion;
}

void AnimationFlags::run(const RenderJob& job, const MakeSceneShading& shade,
                         const IntegratorFlags& integrator, const std::string& words) const {
  const FrameRange range = parse_option("--frames", [&] { return frame_range_from(frames); });
  const FrameNames names(job.out);
  const scene::TracedScene& scene = job.scene;
  const std::optional<Motion> motion = motion_of(scene.scene(), range);
  if (motion && !job.worlds.own.empty()) throw UsageError("--own: cannot be combined with --move");
  if (!integrator.compare.empty() || !integrator.standard_error.empty())
    throw UsageError("--compare, --standard-error: are for one picture, not for --frames");
  if (resume && !io::capabilities_for(job.out).attributes)
    throw Error(ErrorKind::unsupported, job.out,
                "the format has no text metadata, which would say what a frame was made from");
  const std::string digest = sequence::digest_of(words);
  const int count = range.last - range.first + 1;
  const std::vector<scene::Transform> still = scene::turned_places(scene.scene(), 0);
  // What a moving object sees: the scene without it.
  std::optional<scene::TracedScene> around;
  std::optional<scene::WorldAlong> along;
  scene::Worlds worlds = job.worlds;
  if (motion) {
    std::vector<bool> hidden(still.size());
    hidden[motion->instance] = true;
    around = scene.moved(still, hidden);
    along.emplace(
        scene::ShadedScene{*around, *job.shading, &job.worlds.whole},
        [&](double frame) { return motion->place(frame); }, scene::WorldAlongOptions{.every = every});
    worlds.of_instance.assign(still.size(), -1);
    worlds.of_instance[motion->instance] = 0;
  }
  int complete = 0;
  for (int frame = range.first; frame <= range.last; ++frame) {
    const std::string file = names.file(frame).string();
    const std::string note = sequence::made_note(frame, digest);
    const std::filesystem::path files[] = {file};
    if (resume && sequence::is_made(files, note, {})) {
      ++complete;
      continue;
    }
    const double done = frame - range.first;
    const Monitor part = part_of(job.look_up.monitor, done / count, (done + 1) / count);
    std::vector<scene::Transform> places =
        turntable > 0 ? scene::turned_places(scene.scene(), 360 * done / turntable) : still;
    if (motion) {
      places[motion->instance].origin = motion->place(frame);
      worlds.own.clear();
      worlds.own.emplace_back(along->at(frame, without_progress(part)));
    }
    const scene::TracedScene standing = scene.moved(places);
    // Another one only where worlds, or the shadows of lights, are this frame's own.
    std::unique_ptr<scene::Shading> own;
    if (motion || !scene.scene().lights.empty()) own = shade(worlds, standing);
    RenderJob each{.out = file,
                   .scene = standing,
                   .camera = job.camera,
                   .worlds = worlds,
                   .shading = own ? own.get() : job.shading,
                   .look_up = job.look_up,
                   .write = job.write,
                   .note = resume ? note : ""};
    each.look_up.monitor = part;
    integrator.run(each);
  }
  end_progress();
  if (complete > 0)
    print_message(fmt::format("{}: {} of {} frames were complete\n", job.out, complete, count));
}

}  // namespace welkin::cli
