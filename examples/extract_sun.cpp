// A map's suns as lights of a program's own, and the map without them, to be baked: extract_sun IN
// LIGHTS.gltf OUT.ktx2
#include <welkin/io/output_file.h>
#include <welkin/light/extract.h>
#include <welkin/light/light_text.h>
#include <welkin/map_file/chain_file.h>
#include <welkin/prefilter/bake.h>

#include <cstdio>
#include <span>
#include <string>

int main(int argc, char** argv) try {
  if (argc != 4) return std::fprintf(stderr, "usage: extract_sun IN LIGHTS.gltf OUT.ktx2\n"), 2;
  const welkin::LoadedMap loaded = welkin::read_map(argv[1]);
  const welkin::Extraction extraction = welkin::extract_lights(loaded.map, {.most = 4});
  for (const welkin::ExtractedLight& light : extraction.found.lights) {
    std::printf("%s toward %.4f %.4f %.4f: luminance of the irradiance %g, %g sr%s\n",
                std::string(name_of(light.shape)).c_str(), light.direction.x, light.direction.y,
                light.direction.z, light.luminance, light.solid_angle,
                light.flat_topped() ? ", flat-topped" : "");
  }
  const std::string text = welkin::light_text(welkin::light_format_from_name("gltf"), extraction.found);
  welkin::io::OutputFile file(argv[2]);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
  welkin::write_chain(argv[3], welkin::bake(extraction.residual));
} catch (const std::exception& error) {
  std::fprintf(stderr, "extract_sun: %s\n", error.what());
  return 1;
}
