import * as THREE from "three";
import { RGBELoader } from "three/addons/loaders/RGBELoader.js";

export async function loadLight({ scene, folder }) {
  const panorama = await new RGBELoader().loadAsync(`${folder}/panorama.hdr`);
  panorama.mapping = THREE.EquirectangularReflectionMapping;
  scene.environment = scene.background = panorama;
}
