export async function loadLight({ pc, app, folder }) {
  const sampling = { mipmaps: false, minfilter: "linear", magfilter: "linear", addressu: "clamp", addressv: "clamp" };
  const atlas = new pc.Asset("light", "texture", { url: `${folder}/environment.dds` }, sampling);
  app.assets.add(atlas);
  await new Promise((resolve, reject) => {
    atlas.once("error", reject);
    atlas.ready(resolve);
    app.assets.load(atlas);
  });
  app.scene.envAtlas = atlas.resource;
}
