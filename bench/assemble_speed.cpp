// How long it takes to assemble a world of pictures, beside a conversion of as many texels, and how far the
// world is from the one that the pictures were made of.

#include <string>
#include <utility>
#include <vector>

#include "harness.h"
#include "welkin/assemble/assemble.h"
#include "welkin/assemble/ball_photograph.h"
#include "welkin/assemble/exposure.h"
#include "welkin/filter/resample.h"
#include "welkin/measure/compare.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

Map picture_of(const Map& world, const std::string& shape, int size, const Matrix3& orientation) {
  Map picture(sphere::AnyParameterization::make(shape), size, size, world.channels());
  picture.orientation = orientation;
  resample(world, picture);
  return picture;
}

std::vector<Piece> discs(const Map& world) {
  std::vector<Piece> pieces;
  for (const Look& look :
       {Look{0, 0, 0}, Look{90, 0, 0}, Look{180, 0, 0}, Look{270, 0, 0}, Look{0, 90, 0}, Look{0, -90, 0}})
    pieces.push_back(
        make_panel("", picture_of(world, "fisheye-equisolid,fov=130", 1024, transpose(rotation_of(look))),
                   {.look = look, .feather = 10}));
  return pieces;
}

std::vector<Piece> balls(const Map& world, int count, double apart) {
  std::vector<Piece> pieces;
  for (int k = 0; k < count; ++k) {
    BallPhotographOptions options;
    options.look = {apart * k, 0, 0};
    options.distance = 8;
    options.camera = 8;
    const Matrix3 turn{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};
    pieces.push_back(make_ball_piece("",
                                     picture_of(world, "mirror-ball,distance=8", 1000,
                                                turn * transpose(rotation_of(options.look))),
                                     options)
                         .piece);
  }
  return pieces;
}

void row(const Table& table, const std::string& what, const Map& world, const std::vector<Piece>& pieces,
         const AssembleOptions& options = {}) {
  const MapFrame frame(world);
  const Assembly made = assemble(pieces, frame, options);
  const Timing timing = time_jobs({[&] { assemble(pieces, frame, options); }}, 3)[0];
  const double texels = static_cast<double>(world.width()) * world.height();
  table.row({what, cpu_cell(timing), fixed(timing.median().cpu / texels * 1e9, 0), fixed(100 * made.shown, 2),
             fixed(100 * compare(world, made.map).all.relative_rmse, 2)});
}

}  // namespace

int main() {
  const Threads threads;
  heading("Worlds from pictures");
  const Map room = render(synth::make("room"), sphere::AnyParameterization::make("latlong"), 2048, 1024);
  paragraph(
      "Pictures of the room, a lat-long of 2048×1024, put together to such a lat-long again: time without "
      "files, and "
      "rel. RMSE against the room. Pictures of 1024×1024, photographs of a mirror ball of 1000×1000 from 8 "
      "ball radii.");
  const Table table({"pictures", "CPU s (best)", "CPU ns per texel", "shown, %", "rel. RMSE, %"});
  const Map cube = picture_of(room, "cube", 512, {});
  Map target(room.parameterization, room.width(), room.height(), 3);
  const Timing timing = time_jobs({[&] { resample(cube, target); }}, 3)[0];
  table.row({"a cube of 512, converted", cpu_cell(timing),
             fixed(timing.median().cpu / (2048.0 * 1024) * 1e9, 0), "100.00",
             fixed(100 * compare(room, target).all.relative_rmse, 2)});
  row(table, "6 fish-eyes of 130°", room, discs(room));
  row(table, "1 ball", room, balls(room, 1, 0));
  row(table, "2 balls, 90° apart", room, balls(room, 2, 90));
  row(table, "2 balls, 120° apart", room, balls(room, 2, 120));
  row(table, "3 balls, 120° apart", room, balls(room, 3, 120));
  row(table, "the same, mixed evenly", room, balls(room, 3, 120), {.by_fineness = false});
  const std::vector<Piece> pieces = balls(room, 3, 120);
  const Timing overlaps = time_jobs({[&] { compare_overlaps(pieces); }}, 3)[0];
  table.row({"overlaps of 3 balls, compared", cpu_cell(overlaps), "", "", ""});
}
