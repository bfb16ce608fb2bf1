export async function loadLight({ scene, folder }) {
  scene.environmentTexture = BABYLON.CubeTexture.CreateFromPrefilteredData(`${folder}/environment.env`, scene);
}
