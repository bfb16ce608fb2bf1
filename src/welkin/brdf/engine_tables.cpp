#include "welkin/brdf/engine_tables.h"

#include <algorithm>
#include <utility>

#include "welkin/base/error.h"

namespace welkin::brdf {

namespace {

using enum DfgChannel;

DfgTable table_of(int width, int height, std::vector<DfgChannel> channels) {
  DfgTable table;
  table.width = width;
  table.height = height;
  table.channels = std::move(channels);
  return table;
}

DfgTable with_masking(DfgTable table, GgxMasking masking) {
  table.masking = masking;
  return table;
}

DfgTable turned(DfgTable table) {
  table.cosine_down = true;
  return table;
}

DfgTable by_root_and_ends(DfgTable table) {
  table.cosine = CosineScale::root;
  table.placement = TexelPlacement::ends;
  return table;
}

std::vector<EngineTable> all_tables() {
  std::vector<EngineTable> all;
  const auto add = [&](const char* name, const char* description, const char* source, DfgTable table,
                       const char* type) {
    all.push_back({name, description, source, std::move(table), type});
  };
  add("babylon", "mix(bias, one, f0) with multiple scattering by Turquin; cloth in blue",
      "Babylon.js: pbrBRDFFunctions.fx, getBRDFLookup; brdfTextureTools.ts",
      table_of(256, 256, {bias, one, cloth}), "half");
  add("bevy", "f0 · scale + f90 · bias", "Bevy: bevy_pbr, pbr_lighting.wgsl, F_AB",
      table_of(64, 64, {scale, bias}), "half");
  add("filament", "mix(bias, one, f0) with multiple scattering by Turquin; cloth in blue",
      "Filament: libs/ibl/src/CubemapIBL.cpp, DFG; light_indirect.fs, PrefilteredDFG_LUT",
      table_of(128, 128, {bias, one, cloth}), "half");
  add("karis", "f0 · scale + bias, as published, with Schlick's masking",
      "Karis 2013, Real Shading in Unreal Engine 4, p. 7, IntegrateBRDF",
      with_masking(table_of(128, 128, {scale, bias}), GgxMasking::schlick), "half");
  add("khronos", "f0 · scale + f90 · bias; cloth in blue, which its files keep apart",
      "glTF-IBL-Sampler: lib/shaders/filter.frag, LUT_GGX, LUT_CharlieUniform",
      table_of(1024, 1024, {scale, bias, cloth}), "uint8");
  add("khronos-sheen", "sheen's directional albedo, by which what lies below is darkened",
      "glTF 2.0, KHR_materials_sheen, Albedo-scaling technique", table_of(128, 128, {sheen}), "uint8");
  add("three.js", "f0 · scale + f90 · bias with multiple scattering by Fdez-Agüera; roughness to the right",
      "three.js: DFGLUTData.js; lights_physical_pars_fragment.glsl.js, EnvironmentBRDF",
      turned(table_of(16, 16, {scale, bias})), "half");
  add("unity-hdrp",
      "mix(bias, one, f0); Disney's diffuse term less ½ in blue; √n·v to the right, texels at the ends",
      "Unity HDRP: PreIntegratedFGD.hlsl, GetPreIntegratedFGDGGXAndDisneyDiffuse",
      by_root_and_ends(table_of(64, 64, {bias, one, disney_diffuse})), "half");
  add("unreal", "f0 · scale + min(50 f0, 1) · bias, with masking without roots",
      "Unreal Engine: SystemTextures.cpp, PreintegratedGF; BRDF.ush, EnvBRDF",
      with_masking(table_of(128, 32, {scale, bias}), GgxMasking::approximate), "uint16");
  return all;
}

}  // namespace

const std::vector<EngineTable>& engine_tables() {
  static const std::vector<EngineTable> all = all_tables();
  return all;
}

const EngineTable& engine_table(std::string_view name) {
  const auto found = std::find_if(engine_tables().begin(), engine_tables().end(),
                                  [&](const auto& each) { return each.name == name; });
  if (found != engine_tables().end()) return *found;
  std::vector<std::string> names;
  for (const EngineTable& each : engine_tables()) names.push_back(each.name);
  throw Error(ErrorKind::bad_request, unknown_name("renderer", name, names));
}

}  // namespace welkin::brdf
