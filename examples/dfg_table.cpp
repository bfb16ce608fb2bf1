// The split-sum table of a renderer, what it says of a material, and how much light single scattering loses.
#include <welkin/brdf/compensation.h>
#include <welkin/brdf/engine_tables.h>
#include <welkin/brdf/fresnel.h>
#include <welkin/io/image_file.h>

#include <cstdio>

int main(int argc, char** argv) try {
  const char* path = argc > 1 ? argv[1] : "dfg.ktx2";
  const welkin::brdf::EngineTable& bevy = welkin::brdf::engine_table("bevy");
  const welkin::Image table = welkin::brdf::make_dfg_table(bevy.table);

  welkin::io::WriteOptions options;
  options.type = welkin::io::pixel_type_from_name(bevy.type);
  options.colour = welkin::io::Colour::linear;
  const welkin::io::WritePart part{"", table.view(), {"R", "G"}};
  welkin::io::write(path, {&part, 1}, options);
  std::printf("%s: %d×%d, %s\n", path, table.width(), table.height(), bevy.description.c_str());

  // The same integrals at one place: rough gold, seen at 60°.
  const welkin::brdf::Boundary gold{0.14, 3.697};  // red light; Johnson & Christy 1972
  const double f0 = welkin::brdf::fresnel(1, gold);
  const welkin::brdf::SplitSum sum = welkin::brdf::ggx_split_sum(0.5, 0.8);
  std::printf("gold reflects %.3f once, %.3f with all further scattering\n", sum.reflectance(f0),
              welkin::brdf::fdez_aguera_reflectance(sum, f0));
} catch (const std::exception& error) {
  std::fprintf(stderr, "dfg_table: %s\n", error.what());
  return 1;
}
