// How long a stack of angles of view takes, against one chain: they share the analysis of the map.

#include "harness.h"
#include "lighting.h"
#include "welkin/prefilter/bake.h"
#include "welkin/prefilter/lobe_sum_bake.h"
#include "welkin/prefilter/view_bake.h"

int main() {
  using namespace welkin;
  using namespace welkin::bench;
  const Threads threads;
  const Map source = lighting_picture(1024);
  BakeOptions one;
  one.size = {256, 256};
  one.prefilter.borders = false;
  const BakePlan chain(source, one);
  heading("A stack of 16 angles of view against one chain");
  paragraph(
      "A lat-long of 1024×512, RGB float, GGX, cubes of 6×256 and eight smaller levels, plans kept: sixteen "
      "chains, one for each n·v, made together. *Plan* is made once for any number of maps.");
  const Table table({"axis", "plan, wall s", "stack, CPU ms", "wall ms", "one chain, CPU ms", "wall ms",
                     "× one chain", "target", "met"});
  for (const auto axis : {brdf::LobeAxis::reflected, brdf::LobeAxis::fitted}) {
    ViewBakeOptions options;
    options.axis = axis;
    options.bake = one;
    const auto planned = time_jobs({[&] { const ViewBakePlan made(shape_of(source), options); }}, 1);
    const ViewBakePlan plan(shape_of(source), options);
    const auto timings = time_jobs({[&] { plan.run(source); }, [&] { chain.run(source); }}, 7);
    const double times = ratio(timings[0], timings[1]);
    table.row({axis == brdf::LobeAxis::fitted ? "fitted" : "reflected", fixed(planned[0].median().wall, 2),
               cpu_milliseconds(timings[0]), wall_milliseconds(timings[0]), cpu_milliseconds(timings[1]),
               wall_milliseconds(timings[1]), fixed(times, 1), "≤ 8", met(times <= 8)});
  }
  heading("Tables of lobes to add");
  const Table sums({"lobes", "fit of 16 angles × 9 roughnesses, wall s"});
  for (const int count : {1, 4}) {
    LobeSumOptions options;
    options.count = count;
    options.bake = one;
    const auto timing = time_jobs({[&] { fit_lobe_sums(options); }}, 1);
    sums.row({std::to_string(count), fixed(timing[0].median().wall, 2)});
  }
}
