// Converts STEP to GLB with occt-import-js: node -e SCRIPT IN.step OUT.glb TOLERANCE_MM ANGLE_RADIANS
// Exit status 91: occt-import-js is not installed.
const fs = require("fs");
const path = require("path");
const [source, target, tolerance, angle] = process.argv.slice(1);

// npm installs into the folder of a project, or with -g next to Node.
function load() {
  const node = path.dirname(process.execPath);
  const places = [
    process.cwd(),
    path.join(node, "..", "lib"),
    path.join(node, "..", "share"),
    node,
    path.join(process.env.APPDATA || node, "npm"),
  ];
  try {
    return require(require.resolve("occt-import-js", { paths: places }));
  } catch (error) {
    console.log(error.message);
    process.exit(91);
  }
}

const chunks = [];
let length = 0;
const gltf = {
  asset: { version: "2.0", generator: "ligne with occt-import-js" },
  scene: 0,
  scenes: [{ nodes: [0] }],
  // Millimetres and z up become metres and y up.
  nodes: [{ matrix: [0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1], children: [] }],
  meshes: [],
  materials: [],
  accessors: [],
  bufferViews: [],
};

function accessor(array, type, componentType, target) {
  const bytes = Buffer.from(array.buffer, array.byteOffset, array.byteLength);
  gltf.bufferViews.push({ buffer: 0, byteOffset: length, byteLength: bytes.length, target });
  chunks.push(bytes);
  length += bytes.length;
  const made = { bufferView: gltf.bufferViews.length - 1, componentType, type, count: array.length / (type === "VEC3" ? 3 : 1) };
  if (type === "VEC3") {
    made.min = [0, 1, 2].map((axis) => array.reduce((low, v, i) => (i % 3 === axis ? Math.min(low, v) : low), Infinity));
    made.max = [0, 1, 2].map((axis) => array.reduce((high, v, i) => (i % 3 === axis ? Math.max(high, v) : high), -Infinity));
  }
  gltf.accessors.push(made);
  return gltf.accessors.length - 1;
}

const materials = new Map();
function material(color) {
  const key = String(color);
  if (!materials.has(key)) {
    // Both count colours linearly.
    const factor = [...color, 1];
    materials.set(key, gltf.materials.push({ pbrMetallicRoughness: { baseColorFactor: factor, metallicFactor: 0 }, doubleSided: true }) - 1);
  }
  return materials.get(key);
}

// A mesh with one primitive for each colour of its faces.
function mesh(made) {
  const attributes = { POSITION: accessor(new Float32Array(made.attributes.position.array), "VEC3", 5126, 34962) };
  if (made.attributes.normal) {
    attributes.NORMAL = accessor(new Float32Array(made.attributes.normal.array), "VEC3", 5126, 34962);
  }
  const corners = made.index.array;
  const groups = new Map();
  const faces = made.brep_faces && made.brep_faces.length ? made.brep_faces : [{ first: 0, last: corners.length / 3 - 1 }];
  for (const face of faces) {
    const color = face.color || made.color || null;
    const key = String(color);
    if (!groups.has(key)) groups.set(key, { color, corners: [] });
    const group = groups.get(key).corners;
    for (let i = 3 * face.first; i < 3 * (face.last + 1); i += 1) group.push(corners[i]);
  }
  const primitives = [];
  for (const group of groups.values()) {
    if (group.corners.length === 0) continue;
    const primitive = { attributes, indices: accessor(new Uint32Array(group.corners), "SCALAR", 5125, 34963) };
    if (group.color) primitive.material = material(group.color);
    primitives.push(primitive);
  }
  return primitives.length ? gltf.meshes.push({ name: made.name, primitives }) - 1 : null;
}

function add(node, parent, meshes) {
  const index = gltf.nodes.push({ name: node.name || undefined, children: [] }) - 1;
  gltf.nodes[parent].children.push(index);
  const own = node.meshes.map((number) => meshes[number]).filter((number) => number !== null);
  if (own.length === 1) {
    gltf.nodes[index].mesh = own[0];
    gltf.nodes[index].name = node.name || gltf.meshes[own[0]].name;
  } else {
    for (const number of own) {
      const name = gltf.meshes[number].name || node.name;
      gltf.nodes[index].children.push(gltf.nodes.push({ name, mesh: number }) - 1);
    }
  }
  for (const child of node.children) add(child, index, meshes);
}

load()().then((occt) => {
  const made = occt.ReadStepFile(new Uint8Array(fs.readFileSync(source)), {
    linearUnit: "millimeter",
    linearDeflectionType: "absolute_value",
    linearDeflection: Number(tolerance),
    angularDeflection: Number(angle),
  });
  if (!made.success) {
    console.log("occt-import-js cannot read this file");
    process.exit(1);
  }
  add(made.root, 0, made.meshes.map(mesh));
  for (const node of gltf.nodes) if (node.children && node.children.length === 0) delete node.children;
  for (const list of ["meshes", "materials", "accessors", "bufferViews"]) if (gltf[list].length === 0) delete gltf[list];
  gltf.buffers = length ? [{ byteLength: length }] : undefined;
  let json = Buffer.from(JSON.stringify(gltf));
  json = Buffer.concat([json, Buffer.alloc((4 - (json.length % 4)) % 4, " ")]);
  const header = Buffer.alloc(20);
  const end = Buffer.alloc(8);
  header.write("glTF", 0, "latin1");
  header.writeUInt32LE(2, 4);
  header.writeUInt32LE(12 + 8 + json.length + 8 + length, 8);
  header.writeUInt32LE(json.length, 12);
  header.write("JSON", 16, "latin1");
  end.writeUInt32LE(length, 0);
  end.write("BIN\0", 4, "latin1");
  fs.writeFileSync(target, Buffer.concat([header, json, end, ...chunks]));
  process.exit(0);
}).catch((error) => {
  console.log(String(error));
  process.exit(1);
});
