import * as THREE from "three";
import { EYE_DISTANCE, FIELD_OF_VIEW, ballMesh, cameraAxes, upright } from "/pages/balls.js";

const MATERIALS = {
  mirror: { color: 0xffffff, metalness: 1, roughness: 0 },
  rough: { color: 0xffffff, metalness: 1, roughness: 0.5 },
  diffuse: { color: 0xffffff, metalness: 0, roughness: 1, specularIntensity: 0 },
};

export async function draw({ size, views, maps, loadLight, show }) {
  const renderer = new THREE.WebGLRenderer();
  renderer.toneMapping = THREE.NoToneMapping;
  const scene = new THREE.Scene();
  const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType });
  const camera = new THREE.PerspectiveCamera((FIELD_OF_VIEW * 180) / Math.PI, 1, 1, 2 * EYE_DISTANCE);
  const pixels = new Float32Array(size * size * 4);
  for (const map of maps) {
    await loadLight({ renderer, scene, folder: `/set/${map}`, transcoder: "/node_modules/three/examples/jsm/libs/basis/" });
    for (const [number, view] of views.entries()) {
      const { positions, normals, indices } = ballMesh(size, view);
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
      geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
      geometry.setIndex(new THREE.BufferAttribute(indices, 1));
      camera.position.set(...cameraAxes(view).eye);
      camera.lookAt(0, 0, 0);
      for (const [ball, parameters] of Object.entries(MATERIALS)) {
        const mesh = new THREE.Mesh(geometry, new THREE.MeshPhysicalMaterial(parameters));
        scene.add(mesh);
        renderer.setRenderTarget(target);
        renderer.clear();
        renderer.render(scene, camera);
        renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
        scene.remove(mesh);
        await show(`${map}-${ball}-${number}`, upright(pixels, size));
      }
    }
  }
}
