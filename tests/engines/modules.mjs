// How a page finds an engine in node_modules: an import map, or a script that makes a global.

export const MODULES = {
  "babylon, loaders": {
    head: '<script src="/node_modules/babylonjs/babylon.js"></script><script src="/node_modules/babylonjs-loaders/babylonjs.loaders.js"></script>',
  },
  babylon: { head: '<script src="/node_modules/babylonjs/babylon.js"></script>' },
  "model-viewer": { imports: { "@google/model-viewer": "/node_modules/@google/model-viewer/dist/model-viewer.min.js" } },
  playcanvas: { imports: { playcanvas: "/node_modules/playcanvas/build/playcanvas.mjs" } },
  three: {
    imports: { three: "/node_modules/three/build/three.module.js", "three/addons/": "/node_modules/three/examples/jsm/" },
  },
  cesium: {
    head: '<script>CESIUM_BASE_URL = "/node_modules/cesium/Build/Cesium/"</script><script src="/node_modules/cesium/Build/Cesium/Cesium.js"></script>',
  },
  filament: { head: '<script src="/node_modules/filament/filament.js"></script>' },
};
