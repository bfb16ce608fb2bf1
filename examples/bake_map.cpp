// From a panorama to the file that a renderer loads: bake_map IN OUT.ktx2
#include <welkin/map_file/chain_file.h>
#include <welkin/prefilter/bake.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 3) return std::fprintf(stderr, "usage: bake_map IN OUT.ktx2\n"), 2;
  const welkin::LoadedMap loaded = welkin::read_map(argv[1]);
  const welkin::Chain chain = welkin::bake(loaded.map);
  welkin::write_chain(argv[2], chain);
} catch (const std::exception& error) {
  std::fprintf(stderr, "bake_map: %s\n", error.what());
  return 1;
}
