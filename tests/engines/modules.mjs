// How a page finds an engine in node_modules: an import map, or a script that makes a global.

export const MODULES = {
  three: {
    imports: { three: "/node_modules/three/build/three.module.js", "three/addons/": "/node_modules/three/examples/jsm/" },
  },
  filament: { head: '<script src="/node_modules/filament/filament.js"></script>' },
};
