// With Babylon's loaders for glTF (babylonjs.loaders.js).
export async function loadLight({ scene, folder }) {
  await BABYLON.AppendSceneAsync(`${folder}/environment.glb`, scene);
  scene.environmentTexture.gammaSpace = false;  // which its loader leaves out
}
