// What narrow lobes cost, roughness 1/16 and less, beside roughness 1/8, and how exact they are.

#include <cmath>

#include "harness.h"
#include "lighting.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

std::vector<PrefilterLevel> one_level(int face, double roughness) {
  return {{{face, face}, lobe::AnyLobe::make("ggx").with_roughness(roughness)}};
}

void face_rows(const Map& source, const PrefilterReference& reference, int face, const Table& table) {
  const auto cube = sphere::AnyParameterization::make("cube");
  const double texel = 0.5 * kPi / face;
  const std::vector<int> inverses{8, 16, 32, 64};
  std::vector<PrefilterPlan> plans;
  std::vector<std::function<void()>> jobs;
  for (const int inverse : inverses) {
    plans.emplace_back(shape_of(source), cube, one_level(face, 1.0 / inverse));
    jobs.push_back(
        [&source, &cube, face, inverse] { prefilter_map(source, cube, one_level(face, 1.0 / inverse)); });
  }
  for (const PrefilterPlan& plan : plans) jobs.push_back([&source, &plan] { plan.run(source); });
  const auto timings = time_jobs(jobs, 5);
  const std::size_t count = inverses.size();
  for (std::size_t i = 0; i < count; ++i) {
    const PrefilterMethod& method = plans[i].methods()[0];
    const std::vector<Map> levels = plans[i].run(source);
    const LevelErrors errors = errors_of(reference, levels[0], method.lobe);
    std::string blur, plain;
    if (method.widened > 0) {
      blur = fixed(method.widened / texel, 2);
      plain = errors_cell(errors_of(reference, levels[0], one_level(face, 1.0 / inverses[i])[0].lobe));
    }
    const double cost = ratio(timings[i], timings[0]);
    table.row({"6×" + std::to_string(face), "1/" + std::to_string(inverses[i]),
               method.name + " " + std::to_string(method.degree), cpu_milliseconds(timings[i]),
               wall_milliseconds(timings[i]), fixed(cost, 2), cpu_milliseconds(timings[count + i]),
               errors_cell(errors), blur, plain, i == 0 ? "" : "≤ 3 ×, RMSE ≤ 0.1 %",
               i == 0 ? "" : met(cost <= 3 && errors.relative_rmse <= 1e-3)});
  }
}

}  // namespace

int main() {
  const Threads threads;
  heading("Pre-filtering: narrow lobes");
  paragraph(
      "1024×512 to one level of GGX. *Cost* is the CPU time over that of roughness ⅛ on the same faces, "
      "plans "
      "included. Errors are as above, relative RMSE % / maximum %. A lobe narrower than texels is blurred by "
      "a "
      "Gaussian, *blur* its σ in texels of 90° / face; its *errors* are against brute force with the lobe so "
      "blurred, and *not blurred* against the lobe that was asked for.");
  const Table table({"faces", "roughness", "method", "CPU ms", "wall ms", "cost", "kept plan, CPU ms",
                     "errors", "blur", "not blurred", "target", "met"});
  const Map source = lighting_picture(1024);
  const PrefilterReference reference(source);
  for (const int face : {256, 512}) face_rows(source, reference, face, table);
}
