// All files that an engine lights a scene with: lighting_set IN FOLDER [ENGINE]
#include <welkin/lighting_set/lighting_set.h>
#include <welkin/lighting_set/manifest.h>
#include <welkin/lighting_set/page.h>
#include <welkin/lighting_set/set_folder.h>
#include <welkin/map_file/map_file.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc < 3) return std::fprintf(stderr, "usage: lighting_set IN FOLDER [ENGINE]\n"), 2;
  const welkin::LoadedMap loaded = welkin::read_map(argv[1]);
  const welkin::Engine& engine = welkin::engine_from_name(argc > 3 ? argv[3] : "general");
  const welkin::LightingSet set = welkin::make_lighting_set(loaded.map, engine);

  const welkin::SetRequest request{.source = argv[1]};
  const std::string manifest = welkin::manifest_text(set, request), page = welkin::page_text(set, request);
  std::vector<welkin::FolderFile> files{{welkin::kManifestName, std::as_bytes(std::span(manifest))},
                                        {welkin::kPageName, std::as_bytes(std::span(page))}};
  for (const welkin::MadeFile& file : set.files) files.push_back({file.made.name, file.bytes});
  welkin::write_set_folder(argv[2], files);

  for (const welkin::MadeFile& file : set.files)
    std::printf("%s: %zu bytes, %s\n", file.made.name.c_str(), file.bytes.size(), file.made.about.c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "lighting_set: %s\n", error.what());
  return 1;
}
