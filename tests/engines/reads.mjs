// How each engine's shader reads a chain and shades a white ball, as its source says; the light itself comes from Welkin.
//
//   level(r, last)   the level at which roughness r is looked up, of those to `last`
//   least            the least roughness of a surface
//   toNormal(r)      how far the reflected direction is moved to the normal
//   metal(E, L, D, r)   what a white metal shows: E is the albedo of single scattering, L the reflected light, D the diffuse
//   albedo           which of Welkin's tables holds E
//   latlong(level)   the size of lat-longs into which the engine resamples the levels
//   ofSky            these are made of the sky itself
//   diffuseLevel     diffuse light is the last level
//   diffuseDegree    diffuse light is spherical harmonics of this degree; with neither, it is all there is

const slope = (r) => Math.min(1, r * r + 0.0005);  // Babylon's convertRoughnessToAverageSlope

const FILAMENT = { level: (r, last) => last * r * (2 - r), least: 0.089, toNormal: (r) => r ** 4 };

const PLAYCANVAS = {
  level: (r) => 5 * r,
  least: 0,
  toNormal: () => 0,
  latlong: (level) => `${(512 >> level) - 2}x${(256 >> level) - 2}`,
};

export const READS = {
  // src/renderers/shaders/ShaderChunk/: envmap_physical_pars_fragment (getIBLRadiance, getIBLIrradiance), lights_physical_fragment,
  // lights_physical_pars_fragment (computeMultiscattering with a white f0: multiple = 1 − single)
  "three.js": {
    level: (r, last) => last * r * (2 - r),
    least: 0.045,
    toNormal: (r) => r ** 4,
    metal: (E, L, D) => E * L + (1 - E) * D,
    albedo: "three.js",
    diffuseLevel: true,
  },

  // shaders/src/: surface_light_indirect.fs (perceptualRoughnessToLod, getSpecularDominantDirection, diffuseIrradiance); a white metal's
  // compensation 1/E takes E back. In a browser the least roughness is that of mobile devices (surface_material.fs).
  filament: { ...FILAMENT, diffuseLevel: true },
  "filament, harmonics": { ...FILAMENT, diffuseDegree: 2 },

  // pbrIBLFunctions (getLodFromAlphaG, with CubeTexture's lodGenerationScale), pbrBlockReflection (MIX_IBL_RADIANCE_WITH_IRRADIANCE); a
  // white metal's compensation takes E back. Diffuse light is a polynomial of degree 2 that the loader makes of level 0.
  babylon: {
    level: (r, last) => Math.min(Math.max(0.8 * Math.log2(256 * slope(r)), 0), last),
    least: 0,
    toNormal: () => 0,
    metal: (E, L, D, r) => L + slope(r) * (D - L),
    diffuseDegree: 2,
  },

  // The same of a light of a glTF file: EXT_lights_image_based.js, lodGenerationScale = (levels − 1) / log2(width). Its diffuse light is the
  // file's.
  "babylon, glTF": {
    level: (r, last) => Math.min(Math.max((last / 8) * Math.log2(256 * slope(r)), 0), last),
    least: 0,
    toNormal: () => 0,
    metal: (E, L, D, r) => L + slope(r) * (D - L),
    diffuseDegree: 2,
  },

  // src/scene/shader-lib/glsl/chunks/lit/frag/: reflectionEnv (calcReflection), ambient, fresnelSchlick; src/scene/graphics/env-lighting.js
  // resamples the cube into an atlas, and makes the diffuse light of level 0.
  playcanvas: PLAYCANVAS,
  "playcanvas, atlas": { ...PLAYCANVAS, ofSky: true },

  // ImageBasedLightingStageFS (textureIBL, of which a white metal's multiple scattering is 1 − single), BrdfLutGeneratorFS
  cesium: {
    level: (r, last) => last * r,
    least: 0,
    toNormal: () => 0,
    metal: (E, L, D) => E * L + (1 - E) * D,
    albedo: "khronos",
    diffuseDegree: 2,
  },
};
