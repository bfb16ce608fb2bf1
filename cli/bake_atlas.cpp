#include "bake_atlas.h"

#include <fmt/core.h>

#include "bake_source.h"
#include "progress.h"
#include "welkin/map/adjust.h"
#include "welkin/prefilter/playcanvas_atlas.h"
#include "welkin/prefilter/source_faults.h"

namespace welkin::cli {

void bake_atlas(AtlasRequest request, const BakeLevels& made, const ReadFlags& read,
                const SanitizeFlags& repair) {
  const BakeLevels unset;
  if (made.lobe_spec != unset.lobe_spec || made.to != unset.to || !made.size.empty() || made.count ||
      !made.roughness.empty() || made.level0 != unset.level0 || made.method != unset.method)
    throw UsageError(
        "--atlas: has levels of its own; --lobe, --to, --size, --levels, --roughness, --level0 and "
        "--method don't go with it");
  io::WriteOptions& image = request.write.image;
  if (!image.encoding) image.encoding = io::LightEncoding::from_name("rgbp");
  const std::vector<std::string> names = default_channel_names(3);
  try {
    io::check_write(request.out, 512, 512, names, image);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  Map source = read_bake_source(request.in, read, repair,
                                repair.parse(std::min(image.encoding->largest() / request.brighter,
                                                      static_cast<double>(kMaxRadiance))));
  turn_world(source, request.turn);
  fit_channels_to(source, request.out, request.write);
  if (source.channel_names != names)
    throw Error(ErrorKind::unsupported, request.in, "an atlas is of R, G and B");
  scale(source, static_cast<float>(request.brighter));
  const Image atlas = playcanvas_atlas(source, request.prefilter, progress_monitor("bake"));
  end_progress();
  const io::WritePart part{"", atlas.view(), names};
  report_losses(request.out, io::write(request.out, std::span(&part, 1), image));
}

}  // namespace welkin::cli
