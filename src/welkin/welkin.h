#pragma once

/// @file
/// All of the library (docs/library.md). Programs that mind their compile time include what they use instead.

#include "welkin/base/error.h"
#include "welkin/base/export.h"
#include "welkin/base/large_memory.h"
#include "welkin/base/monitor.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parameter.h"
#include "welkin/base/version.h"
#include "welkin/brdf/compensation.h"
#include "welkin/brdf/dfg.h"
#include "welkin/brdf/dfg_table.h"
#include "welkin/brdf/engine_tables.h"
#include "welkin/brdf/fresnel.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/brdf/table_axis.h"
#include "welkin/brdf/table_text.h"
#include "welkin/filter/filter.h"
#include "welkin/filter/resample.h"
#include "welkin/filter/resample_reference.h"
#include "welkin/filter/sampler.h"
#include "welkin/image/image.h"
#include "welkin/image/pixels.h"
#include "welkin/io/byte_sink.h"
#include "welkin/io/capabilities.h"
#include "welkin/io/image_file.h"
#include "welkin/io/output_file.h"
#include "welkin/io/process.h"
#include "welkin/light/importance.h"
#include "welkin/light/importance_file.h"
#include "welkin/lobe/custom.h"
#include "welkin/lobe/energy.h"
#include "welkin/lobe/lobe.h"
#include "welkin/lobe/roughness_curve.h"
#include "welkin/lobe/zonal.h"
#include "welkin/map/adjust.h"
#include "welkin/map/borders.h"
#include "welkin/map/chain.h"
#include "welkin/map/map.h"
#include "welkin/map/pyramid.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/map_file/layout.h"
#include "welkin/map_file/map_file.h"
#include "welkin/map_file/safety_border.h"
#include "welkin/map_file/write_resampled.h"
#include "welkin/math/angles.h"
#include "welkin/math/rotation.h"
#include "welkin/math/scalar.h"
#include "welkin/math/vec.h"
#include "welkin/measure/compare.h"
#include "welkin/measure/density.h"
#include "welkin/measure/energy.h"
#include "welkin/measure/statistics.h"
#include "welkin/plot/draw_density.h"
#include "welkin/plot/draw_distortion.h"
#include "welkin/plot/draw_fresnel.h"
#include "welkin/plot/draw_lobes.h"
#include "welkin/plot/mip_sheet.h"
#include "welkin/prefilter/bake.h"
#include "welkin/prefilter/paraboloid_convolution.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/prefilter/roughness_levels.h"
#include "welkin/prefilter/source_faults.h"
#include "welkin/prefilter/verify.h"
#include "welkin/sequence/bake_frames.h"
#include "welkin/sequence/frame_names.h"
#include "welkin/sequence/interpolate.h"
#include "welkin/sphere/convention.h"
#include "welkin/sphere/custom.h"
#include "welkin/sphere/kernels.h"
#include "welkin/sphere/parameterization.h"
#include "welkin/sphere/registry.h"
#include "welkin/sphere/traits.h"
#include "welkin/synth/render_synth.h"
#include "welkin/synth/synth.h"

/// Environment maps: read, convert, filter, measure, write.
namespace welkin {}
/// BRDFs as functions of angles, and their integrals.
namespace welkin::brdf {}
/// Pictures ↔ files.
namespace welkin::io {}
/// Rotationally symmetric lobes, by which maps are pre-filtered.
namespace welkin::lobe {}
/// Parameterizations: where a direction lies in a picture.
namespace welkin::sphere {}
/// Built-in maps, as functions of direction.
namespace welkin::synth {}
