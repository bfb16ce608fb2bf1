// What a texel costs in every parameterization.

#include "harness.h"
#include "pictures.h"
#include "welkin/filter/resample.h"
#include "welkin/map/borders.h"

int main() {
  using namespace welkin;
  using namespace welkin::bench;
  const Threads threads;
  heading("From a 2048×1024 lat-long to every parameterization");
  paragraph(
      "RGB float, in memory; each at the size that has the same number of texels per steradian. CPU "
      "milliseconds per million texels "
      "written, median of 7 runs; *borders* are filled afterwards, and not with the others.");
  const Map source = noise_picture(2048, 1024);
  const Table table({"to", "charts", "bilinear", "auto", "borders"});
  for (const std::string& name : sphere::parameterization_names()) {
    const auto parameterization = sphere::AnyParameterization::make(name);
    const ChartSize size = default_chart_size(source, parameterization);
    Map target(parameterization, size.width, size.height, 3);
    ResampleOptions bilinear, automatic;
    bilinear.filter = Filter::bilinear;
    bilinear.borders = automatic.borders = false;
    if (name == "latlong") {
      // A map of the source's own kind would be copied.
      bilinear.rotation = automatic.rotation = rotation_from_yaw_pitch_roll(30, 20, 10);
    }
    const auto timings =
        time_jobs({[&] { resample(source, target, bilinear); }, [&] { resample(source, target, automatic); },
                   [&] { fill_borders(target); }},
                  7);
    const double texels = 1e-6 * target.charts() * size.width * size.height;
    table.row({(name == "latlong" ? "latlong, rotated" : name),
               std::to_string(target.charts()) + " × " + std::to_string(size.width) + "×" +
                   std::to_string(size.height),
               fixed(1e3 * timings[0].median().cpu / texels, 1),
               fixed(1e3 * timings[1].median().cpu / texels, 1),
               fixed(1e3 * timings[2].median().cpu / texels, 1)});
  }
}
