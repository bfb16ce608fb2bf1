export async function loadLight({ engine, scene, folder }) {
  const bytes = async (name) => new Uint8Array(await (await fetch(`${folder}/${name}`)).arrayBuffer());
  const light = engine.createIblFromKtx1(await bytes("environment_ibl.ktx"));
  light.setIntensity(1);  // the files' radiance in cd/m²
  scene.setIndirectLight(light);
  scene.setSkybox(engine.createSkyFromKtx1(await bytes("environment_skybox.ktx")));
}
