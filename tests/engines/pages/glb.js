// A ball as a binary glTF of one triangle mesh, for engines whose own meshes are made of files.

const FLOAT = 5126, UNSIGNED_SHORT = 5123, ARRAY = 34962, ELEMENTS = 34963;

const padded = (bytes, filler) => {
  const all = new Uint8Array(Math.ceil(bytes.length / 4) * 4).fill(filler);
  all.set(bytes);
  return all;
};

// mesh: of ballMesh(); material: a glTF material.
export function glb({ positions, normals, indices }, material) {
  const parts = [positions, normals, indices].map((array) => padded(new Uint8Array(array.buffer), 0));
  const offsets = [0, parts[0].length, parts[0].length + parts[1].length];
  const bounds = [0, 1, 2].map((k) => positions.reduce(([low, high], x, i) => (i % 3 === k ? [Math.min(low, x), Math.max(high, x)] : [low, high]),
    [Infinity, -Infinity]));
  const json = {
    asset: { version: "2.0" },
    extensionsUsed: material.extensions && Object.keys(material.extensions),
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1 }, indices: 2, material: 0 }] }],
    materials: [material],
    accessors: [
      { bufferView: 0, componentType: FLOAT, count: positions.length / 3, type: "VEC3", min: bounds.map((b) => b[0]), max: bounds.map((b) => b[1]) },
      { bufferView: 1, componentType: FLOAT, count: normals.length / 3, type: "VEC3" },
      { bufferView: 2, componentType: UNSIGNED_SHORT, count: indices.length, type: "SCALAR" },
    ],
    bufferViews: parts.map((part, i) => ({ buffer: 0, byteOffset: offsets[i], byteLength: part.length, target: i === 2 ? ELEMENTS : ARRAY })),
    buffers: [{ byteLength: parts.reduce((sum, part) => sum + part.length, 0) }],
  };
  const text = padded(new TextEncoder().encode(JSON.stringify(json)), 0x20);
  const binary = parts.reduce((all, part) => new Uint8Array([...all, ...part]), []);
  const file = new Uint8Array(12 + 8 + text.length + 8 + binary.length), view = new DataView(file.buffer);
  [0x46546c67, 2, file.length, text.length, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  file.set(text, 20);
  view.setUint32(20 + text.length, binary.length, true);
  view.setUint32(24 + text.length, 0x004e4942, true);
  file.set(binary, 28 + text.length);
  return file;
}

export const MATERIALS = {
  mirror: { pbrMetallicRoughness: { metallicFactor: 1, roughnessFactor: 0 } },
  rough: { pbrMetallicRoughness: { metallicFactor: 1, roughnessFactor: 0.5 } },
  diffuse: { pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 1 } },
};

// Diffuse without reflection, where KHR_materials_specular is known.
export const ONLY_DIFFUSE = { pbrMetallicRoughness: { metallicFactor: 0 }, extensions: { KHR_materials_specular: { specularFactor: 0 } } };
