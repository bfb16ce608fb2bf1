import * as pc from "playcanvas";
import { EYE_DISTANCE, FIELD_OF_VIEW, ballMesh, cameraAxes, upright } from "/pages/balls.js";

const WHITE = new pc.Color(1, 1, 1), BLACK = new pc.Color(0, 0, 0);
const MATERIALS = {
  mirror: { useMetalness: true, metalness: 1, gloss: 1, diffuse: WHITE },
  rough: { useMetalness: true, metalness: 1, gloss: 0.5, diffuse: WHITE },
  diffuse: { useMetalness: false, specular: BLACK, gloss: 0, diffuse: WHITE },
};

export async function draw({ size, views, maps, loadLight, show }) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const app = new pc.Application(canvas, { graphicsDeviceOptions: { antialias: false } });
  app.scene.ambientLight = BLACK;
  app.autoRender = false;
  app.start();

  const device = app.graphicsDevice;
  const colorBuffer = new pc.Texture(device, { width: size, height: size, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false });
  const renderTarget = new pc.RenderTarget({ colorBuffer, depth: true, samples: 1 });
  const camera = new pc.Entity();
  camera.addComponent("camera", { clearColor: BLACK, fov: (FIELD_OF_VIEW * 180) / Math.PI, nearClip: 1, farClip: 2 * EYE_DISTANCE,
    layers: [pc.LAYERID_WORLD], toneMapping: pc.TONEMAP_NONE, gammaCorrection: pc.GAMMA_NONE, renderTarget });
  app.root.addChild(camera);
  for (const map of maps) {
    await loadLight({ pc, app, folder: `/set/${map}` });
    for (const [number, toward] of views.entries()) {
      const { positions, normals, indices } = ballMesh(size, toward);
      camera.setPosition(...cameraAxes(toward).eye);
      camera.lookAt(pc.Vec3.ZERO);
      for (const [ball, parameters] of Object.entries(MATERIALS)) {
        const mesh = new pc.Mesh(device);  // the entity's, and destroyed with it
        mesh.setPositions(positions);
        mesh.setNormals(normals);
        mesh.setIndices(indices);
        mesh.update();
        const material = Object.assign(new pc.StandardMaterial(), parameters), entity = new pc.Entity();
        material.update();
        entity.addComponent("render", { meshInstances: [new pc.MeshInstance(mesh, material)] });
        app.root.addChild(entity);
        app.render();
        const pixels = await colorBuffer.read(0, 0, size, size, { renderTarget, immediate: true });
        entity.destroy();
        await show(`${map}-${ball}-${number}`, upright(pixels, size));
      }
    }
  }
}
