#include "welkin/scene/read_scene.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "welkin/scene/scene_file_cases.h"

namespace welkin::scene {
namespace {

TEST(ReadScene, ReadsFilesInItsFolderAndNoOthers) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "welkin_read_scene";
  fs::remove_all(folder);
  fs::create_directories(folder / "deep er");
  const auto write = [](const fs::path& path, const Bytes& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  const Bytes buffer = square_bytes();
  write(folder / "deep er" / "square.bin", buffer);
  write(folder.parent_path() / "welkin_outside.bin", buffer);
  const auto with_buffer = [&](const std::string& uri) {
    std::string text = gltf_text(buffer);
    replace(text, "data:application/octet-stream;base64," + base64(buffer), uri);
    write(folder / "scene.gltf", bytes_of(text));
    return folder / "scene.gltf";
  };
  EXPECT_EQ(triangle_count(read_scene(with_buffer("deep%20er/square.bin"))), 2u);
  const fs::path outside = folder.parent_path() / "welkin_outside.bin";
  for (const std::string& uri :
       {std::string("../welkin_outside.bin"), std::string("deep%20er/../../welkin_outside.bin"),
        std::string("%2e%2e/welkin_outside.bin"), std::string("..%5cwelkin_outside.bin"), outside.string(),
        "file://" + outside.string(), std::string("http://host/a.bin")}) {
    std::string escaped = uri;
    try {
      read_scene(with_buffer(escaped));
      ADD_FAILURE() << uri;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::unsupported) << error.what();
      EXPECT_NE(std::string(error.what()).find("scene.gltf: "), std::string::npos) << error.what();
    }
  }
  try {
    read_scene(with_buffer("gone.bin"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::not_found);
    EXPECT_NE(std::string(error.what()).find("gone.bin"), std::string::npos) << error.what();
  }
  EXPECT_THROW(read_scene(folder / "none.gltf"), Error);
  fs::remove_all(folder);
  fs::remove(outside);
}

}  // namespace
}  // namespace welkin::scene
