#include "welkin/scene/read_scene.h"

#include "welkin/base/error.h"

namespace welkin::scene {

Scene read_scene(const std::filesystem::path& path) {
  throw Error(ErrorKind::unsupported, path.string(), "files of scenes are not read yet");
}

}  // namespace welkin::scene
