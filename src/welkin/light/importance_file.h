#pragma once

#include <filesystem>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/light/importance.h"

/// @file
/// Importance sampling tables as files for other programs' renderers (docs/importance-sampling.md, "Files").
namespace welkin {

/// Writes a sampler's tables as pictures of 32-bit floats, EXR or KTX2 by the name's extension, and a JSON
/// header beside them, named as the first picture with `.json`. A table's picture has a texel for each of the
/// map's, charts one under the other; of `cdf` a second one, `NAME_rows`, one texel wide, has the rows' own
/// distribution. Returns the files' paths, the header last.
///
/// | method | channels, in KTX2 R G B A |
/// |---|---|
/// | cdf | `cdf`: probability, within its row, of the texel and those left of it; `density` |
/// | cdf, rows | `cdf`: probability of the row and those above it |
/// | alias | `threshold`, `alias_x`, `alias_row` as in ImportanceSampler::Alias, `density` |
///
/// `density` is the probability per unit of (u, v) area of the texel's valid part: a renderer that draws
/// evenly over it has a probability per solid angle of density / solid_angle_density(u, v). It is that of the
/// numbers as the file has them. Files appear when all are complete. Throws Error about the file:
/// (unsupported) for another format, and as io::write; Cancelled.
WELKIN_API std::vector<std::filesystem::path> write_importance(const std::filesystem::path& path,
                                                               const ImportanceSampler& sampler,
                                                               const Monitor& monitor = {});

/// The header alone: what the tables are, as JSON. `pictures` are the names of the files with tables.
WELKIN_API std::string importance_header(const ImportanceSampler& sampler,
                                         const std::vector<std::string>& pictures);

}  // namespace welkin
