import { EYE_DISTANCE, FIELD_OF_VIEW, ballMesh, cameraAxes, upright } from "/pages/balls.js";
import { MATERIALS, ONLY_DIFFUSE, glb } from "/pages/glb.js";

// Cesium's frame is a texture of half floats, which is mapped to colours afterwards: it is read when the ball has just been drawn.
function watchDraws(gl, size) {
  const seen = { count: 0, pixels: null }, draw = gl.drawElements;
  gl.drawElements = function (mode, count, type, offset) {
    draw.call(gl, mode, count, type, offset);
    if (count !== seen.count) return;
    seen.pixels ??= new Float32Array(size * size * 4);
    gl.readPixels(0, 0, size, size, gl.RGBA, gl.FLOAT, seen.pixels);
  };
  return seen;
}

// glTF's x, y, z are north, up and east here.
const local = ([x, y, z]) => new Cesium.Cartesian3(z, x, y);

export async function draw({ size, views, maps, loadLight, show }) {
  const place = document.createElement("div");
  place.style.cssText = `width: ${size}px; height: ${size}px`;
  document.body.append(place);
  const widget = new Cesium.CesiumWidget(place, { globe: false, skyBox: false, skyAtmosphere: false, baseLayer: false, msaaSamples: 1,
    useDefaultRenderLoop: false, requestRenderMode: false });
  widget.canvas.style.cssText = "width: 100%; height: 100%";
  widget.canvas.parentElement.style.cssText = "width: 100%; height: 100%";
  widget.resize();
  const { scene } = widget, seen = watchDraws(widget.canvas.getContext("webgl2"), size);
  scene.highDynamicRange = true;
  scene.light = new Cesium.DirectionalLight({ direction: new Cesium.Cartesian3(1, 0, 0), intensity: 0 });
  const modelMatrix = Cesium.Transforms.eastNorthUpToFixedFrame(Cesium.Cartesian3.fromDegrees(0, 0, 1e6));
  scene.camera.frustum = new Cesium.PerspectiveFrustum({ fov: FIELD_OF_VIEW, aspectRatio: 1, near: 1, far: 2 * EYE_DISTANCE });

  for (const map of maps) {
    const imageBasedLighting = await loadLight({ folder: `/set/${map}` });
    for (const [number, toward] of views.entries()) {
      const mesh = ballMesh(size, toward), { back, up, eye } = cameraAxes(toward);
      const turned = (vector) => Cesium.Matrix4.multiplyByPointAsVector(modelMatrix, local(vector), new Cesium.Cartesian3());
      scene.camera.setView({
        destination: Cesium.Matrix4.multiplyByPoint(modelMatrix, local(eye), new Cesium.Cartesian3()),
        orientation: { direction: turned(back.map((x) => -x)), up: turned(up) },
      });
      for (const [ball, material] of Object.entries({ ...MATERIALS, diffuse: ONLY_DIFFUSE })) {
        const gltf = glb(mesh, material);
        const model = await Cesium.Model.fromGltfAsync({ gltf, modelMatrix, imageBasedLighting });
        scene.primitives.add(model);
        Object.assign(seen, { count: mesh.indices.length, pixels: null });
        let ready = 0;  // frames with the light
        for (let frame = 0; frame < 1000 && ready < 3; ++frame) {
          scene.initializeFrame();
          scene.render();
          if (model.ready && imageBasedLighting.specularEnvironmentCubeMap?.ready) ++ready;
          await new Promise(requestAnimationFrame);
        }
        if (ready < 3 || !seen.pixels) throw new Error(`no light or no ball after 1000 frames: ready ${model.ready}, drawn ${!!seen.pixels}`);
        scene.primitives.remove(model);
        await show(`${map}-${ball}-${number}`, upright(seen.pixels, size));
      }
    }
  }
}
