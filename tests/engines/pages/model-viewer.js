import "@google/model-viewer";
import { EYE_DISTANCE, FIELD_OF_VIEW, ballMesh, cameraAxes } from "/pages/balls.js";
import { MATERIALS, ONLY_DIFFUSE, glb } from "/pages/glb.js";

const BRIGHTEST = { axes: 1, room: 50 };  // which becomes white, as pictures have 8 bits

const linear = (byte) => (byte <= 0.04045 * 255 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);

async function pixelsOf(viewer, size, scale) {
  const picture = await createImageBitmap(await viewer.toBlob({ mimeType: "image/png" }));
  if (picture.width !== size || picture.height !== size) throw new Error(`the picture is ${picture.width}×${picture.height}, not ${size}²`);
  const context = new OffscreenCanvas(size, size).getContext("2d");
  context.drawImage(picture, 0, 0);
  const rgba = context.getImageData(0, 0, size, size).data, rgb = new Float32Array(size * size * 3);
  for (let i = 0; i < size * size; ++i) for (let k = 0; k < 3; ++k) rgb[3 * i + k] = scale * linear(rgba[4 * i + k]);
  return rgb;
}

function makeViewer(size, toward) {
  const { back } = cameraAxes(toward), viewer = document.createElement("model-viewer");
  viewer.style.cssText = `width: ${size}px; height: ${size}px; display: block`;
  const attributes = {
    "camera-orbit": `${Math.atan2(back[0], back[2])}rad ${Math.acos(back[1])}rad ${EYE_DISTANCE}m`, "camera-target": "0m 0m 0m",
    "min-camera-orbit": "auto auto 1m", "max-camera-orbit": `auto auto ${2 * EYE_DISTANCE}m`,
    "field-of-view": `${FIELD_OF_VIEW}rad`, "min-field-of-view": "1deg",
    "tone-mapping": "linear", "shadow-intensity": 0, "interaction-prompt": "none", loading: "eager",
  };
  for (const [name, value] of Object.entries(attributes)) viewer.setAttribute(name, value);
  document.body.append(viewer);
  return viewer;
}

export async function draw({ size, views, maps, loadLight, show }) {
  for (const map of maps) {
    for (const [number, toward] of views.entries()) {
      const mesh = ballMesh(size, toward), viewer = makeViewer(size, toward);
      viewer.setAttribute("exposure", 1 / BRIGHTEST[map]);
      for (const [ball, material] of Object.entries({ ...MATERIALS, diffuse: ONLY_DIFFUSE })) {
        const loaded = new Promise((resolve, reject) => {
          viewer.addEventListener("load", resolve, { once: true });
          viewer.addEventListener("error", (event) => reject(new Error(JSON.stringify(event.detail))), { once: true });
        });
        const file = glb(mesh, material);
        viewer.setAttribute("src", URL.createObjectURL(new Blob([file])));
        await loadLight({ viewer, folder: `/set/${map}` });
        await loaded;
        for (let frame = 0; frame < 3; ++frame) await new Promise(requestAnimationFrame);
        await show(`${map}-${ball}-${number}`, await pixelsOf(viewer, size, BRIGHTEST[map]));
      }
      viewer.remove();
    }
  }
}
