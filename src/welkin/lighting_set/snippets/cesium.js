// For models of glTF files: Cesium.Model.fromGltfAsync({ url, imageBasedLighting: await loadLight({ folder }) })
export async function loadLight({ folder }) {
  const { coefficients } = await (await fetch(`${folder}/harmonics.json`)).json();
  return new Cesium.ImageBasedLighting({
    sphericalHarmonicCoefficients: coefficients.map((rgb) => Cesium.Cartesian3.fromArray(rgb)),
    specularEnvironmentMaps: `${folder}/environment.ktx2`,
  });
}
