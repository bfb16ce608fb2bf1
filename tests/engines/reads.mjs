// How each engine's shader reads a chain and shades a white ball, as its source says; the light itself comes from Welkin.
//
//   level(r, last)   the level at which roughness r is looked up, of those to `last`
//   least            the least roughness of a surface
//   toNormal(r)      how far the reflected direction is moved to the normal
//   metal(E, L, D)   what a white metal shows: E is the albedo of single scattering, L the reflected light, D the diffuse
//   diffuseLevel     whether diffuse light is the last level

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
  filament: {
    level: (r, last) => last * r * (2 - r),
    least: 0.089,
    toNormal: (r) => r ** 4,
    diffuseLevel: true,
  },
};
