export async function loadLight({ pc, app, folder }) {
  const cube = new pc.Asset("light", "cubemap", { url: `${folder}/environment.dds` });
  app.assets.add(cube);
  await new Promise((resolve, reject) => {
    cube.once("error", reject);
    cube.ready(resolve);
    app.assets.load(cube);
  });
  app.scene.prefilteredCubemaps = cube.resources.slice(1);
}
