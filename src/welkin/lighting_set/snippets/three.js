import * as THREE from "three";
import { KTX2Loader } from "three/addons/loaders/KTX2Loader.js";

// The transcoder is in three's examples/jsm/libs/basis/: copy that folder beside your page, or say where it is.
export async function loadLight({ renderer, scene, folder, transcoder = "basis/" }) {
  const loader = new KTX2Loader().setTranscoderPath(transcoder).detectSupport(renderer);
  const light = await loader.loadAsync(`${folder}/environment.ktx2`);
  light.isPMREMTexture = true;
  scene.environment = light;
}
