import { EYE_DISTANCE, FIELD_OF_VIEW, ballMesh, cameraAxes, upright } from "/pages/balls.js";

const MATERIALS = {
  mirror: { metallic: 1, roughness: 0 },
  rough: { metallic: 1, roughness: 0.5 },
  diffuse: { metallic: 0, roughness: 1, metallicF0Factor: 0 },
};

// A left-handed world has our −x as its x: what is mirrored there is seen as we see it here.
const mirrored = (numbers) => numbers.map((x, i) => (i % 3 === 0 ? -x : x));

export async function draw({ size, views, maps, leftHanded, loadLight, show }) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const engine = new BABYLON.Engine(canvas, false), scene = new BABYLON.Scene(engine);
  scene.useRightHandedSystem = !leftHanded;
  scene.clearColor = new BABYLON.Color4(0, 0, 0, 1);
  scene.imageProcessingConfiguration.applyByPostProcess = true;  // so that materials show linear values
  scene.imageProcessingConfiguration.skipFinalColorClamp = true;
  const own = leftHanded ? mirrored : (numbers) => numbers;
  const camera = new BABYLON.FreeCamera("camera", new BABYLON.Vector3(), scene);
  Object.assign(camera, { fov: FIELD_OF_VIEW, minZ: 1, maxZ: 2 * EYE_DISTANCE });
  const target = new BABYLON.RenderTargetTexture("balls", size, scene, { generateMipMaps: false, type: BABYLON.Constants.TEXTURETYPE_FLOAT });
  target.activeCamera = camera;
  for (const map of maps) {
    await loadLight({ scene, folder: `/set/${map}` });
    await new Promise((resolve) => BABYLON.Texture.WhenAllReady([scene.environmentTexture], resolve));
    for (const [number, toward] of views.entries()) {
      const { positions, normals, indices } = ballMesh(size, toward);
      camera.position.set(...own(cameraAxes(toward).eye));
      camera.setTarget(BABYLON.Vector3.Zero());
      for (const [ball, parameters] of Object.entries(MATERIALS)) {
        const mesh = new BABYLON.Mesh(ball, scene), material = new BABYLON.PBRMaterial(ball, scene);
        Object.assign(new BABYLON.VertexData(), { positions: own(positions), normals: own(normals), indices }).applyToMesh(mesh);
        Object.assign(material, parameters, { albedoColor: BABYLON.Color3.White(), backFaceCulling: false });
        mesh.material = material;
        target.renderList = [mesh];
        await material.forceCompilationAsync(mesh);
        await scene.whenReadyAsync();
        target.render();
        const pixels = await target.readPixels();
        mesh.dispose();
        await show(`${map}-${ball}-${number}`, upright(pixels, size));
      }
    }
  }
}
