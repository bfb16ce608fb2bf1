// A world from pictures of its parts: assemble IN OUT. The pictures are six fish-eye views of IN, as
// photographs would be; what they show together is compared with IN.
#include <welkin/assemble/assemble.h>
#include <welkin/assemble/exposure.h>
#include <welkin/filter/resample.h>
#include <welkin/map_file/map_file.h>
#include <welkin/measure/compare.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

int main(int argc, char** argv) try {
  if (argc != 3) return std::fprintf(stderr, "usage: assemble IN OUT\n"), 2;
  const welkin::Map world = welkin::read_map(argv[1]).map;

  const auto lens = welkin::sphere::AnyParameterization::make("fisheye-equisolid,fov=130");
  std::vector<welkin::Piece> pieces;
  for (const welkin::Look& look :
       {welkin::Look{0, 0, 0}, welkin::Look{90, 0, 0}, welkin::Look{180, 0, 0}, welkin::Look{270, 0, 0},
        welkin::Look{0, 90, 0}, welkin::Look{0, -90, 0}}) {
    welkin::Map photograph(lens, 400, 400, world.channels());
    photograph.orientation = transpose(rotation_of(look));
    welkin::resample(world, photograph);
    pieces.push_back(welkin::make_panel("yaw " + std::to_string(static_cast<int>(look.yaw)),
                                        std::move(photograph), {.look = look, .feather = 10}));
  }
  for (const welkin::Overlap& each : welkin::compare_overlaps(pieces))
    std::printf("%s and %s differ by %.2f %%\n", pieces[each.first].name.c_str(),
                pieces[each.second].name.c_str(), 100 * each.error);

  const welkin::Assembly made = welkin::assemble(pieces, welkin::MapFrame(world));
  std::printf("%.1f %% of the sphere, rel. RMSE %.3f\n", 100 * made.shown,
              welkin::compare(world, made.map).all.relative_rmse);
  welkin::write_map(argv[2], made.map);
} catch (const std::exception& error) {
  std::fprintf(stderr, "assemble: %s\n", error.what());
  return 1;
}
