import * as THREE from "three";
import { KTX2Loader } from "three/addons/loaders/KTX2Loader.js";

export async function loadLight({ renderer, scene, folder }) {
  const file = await new KTX2Loader().detectSupport(renderer).loadAsync(`${folder}/environment.ktx2`);
  // Of a cube that isn't compressed the loader makes a flat texture, whose levels hold six faces each.
  const faces = [0, 1, 2, 3, 4, 5].map((face) => ({
    width: file.image.width,
    height: file.image.height,
    mipmaps: file.mipmaps.map(({ data, width, height }) => ({
      data: data.subarray((face * data.length) / 6, ((face + 1) * data.length) / 6), width, height,
    })),
  }));
  const light = new THREE.CompressedCubeTexture(faces, file.format, file.type);
  light.minFilter = THREE.LinearMipmapLinearFilter;
  light.magFilter = THREE.LinearFilter;
  light.isPMREMTexture = true;
  light.needsUpdate = true;
  scene.environment = light;
}
