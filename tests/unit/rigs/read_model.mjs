// Writes a rig's model as plain numbers: every mesh's positions, normals, triangles and place (column by column), and
// of a skin the joints, weights and inverse bind matrices. Models are compressed by meshopt and quantized, which Python cannot read.
//
// usage: node read_model.mjs MODEL.glb OUT.json

import { readFileSync, writeFileSync } from "node:fs";
import { MeshoptDecoder } from "../../../web/node_modules/three/examples/jsm/libs/meshopt_decoder.module.js";

const COMPONENTS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
const ARRAYS = { 5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const SCALE = { 5120: 127, 5121: 255, 5122: 32767, 5123: 65535 };

const [file, out] = process.argv.slice(2);
const bytes = readFileSync(file);
const jsonLength = bytes.readUInt32LE(12);
const gltf = JSON.parse(bytes.subarray(20, 20 + jsonLength).toString());
const binary = bytes.subarray(20 + jsonLength + 8);
await MeshoptDecoder.ready;

function view(index) {
  const { byteOffset = 0, byteLength, byteStride, extensions } = gltf.bufferViews[index];
  const packed = extensions?.EXT_meshopt_compression ?? extensions?.KHR_meshopt_compression;
  if (packed === undefined) return { data: binary.subarray(byteOffset, byteOffset + byteLength), stride: byteStride };
  const { byteOffset: from = 0, byteLength: length, byteStride: stride, count, mode, filter } = packed;
  const data = new Uint8Array(count * stride);
  MeshoptDecoder.decodeGltfBuffer(data, count, stride, binary.subarray(from, from + length), mode, filter);
  return { data, stride };
}

function read(index) {
  const { bufferView, byteOffset = 0, componentType, count, type, normalized } = gltf.accessors[index];
  const Kind = ARRAYS[componentType];
  const width = COMPONENTS[type];
  const { data, stride } = view(bufferView);
  const step = stride ?? width * Kind.BYTES_PER_ELEMENT;
  const values = [];
  for (let i = 0; i < count; i++) {
    const at = data.byteOffset + byteOffset + i * step;
    const row = new Kind(data.buffer.slice(at, at + width * Kind.BYTES_PER_ELEMENT));
    for (const value of row) values.push(normalized ? Math.max(value / SCALE[componentType], -1) : value);
  }
  return { width, values };
}

function multiply(a, b) {
  return Array.from({ length: 16 }, (_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + (i % 4)] * b[4 * (i >> 2) + k], 0));
}

function local({ matrix, translation: t = [0, 0, 0], rotation: [x, y, z, w] = [0, 0, 0, 1], scale: s = [1, 1, 1] }) {
  if (matrix !== undefined) return matrix;
  return [
    ...[1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)].map((part) => part * s[0]), 0,
    ...[2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)].map((part) => part * s[1]), 0,
    ...[2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)].map((part) => part * s[2]), 0,
    ...t, 1,
  ];
}

function place(index) {
  const parent = gltf.nodes.findIndex(({ children = [] }) => children.includes(index));
  const own = local(gltf.nodes[index]);
  return parent < 0 ? own : multiply(place(parent), own);
}

const meshes = gltf.nodes.flatMap((node, index) =>
  node.mesh === undefined
    ? []
    : gltf.meshes[node.mesh].primitives.map((primitive) => ({
        name: node.name,
        place: place(index),
        material: gltf.materials[primitive.material].name,
        triangles: read(primitive.indices),
        ...Object.fromEntries(
          ["POSITION", "NORMAL", "COLOR_0", "JOINTS_0", "WEIGHTS_0"]
            .filter((key) => key in primitive.attributes)
            .map((key) => [key.toLowerCase(), read(primitive.attributes[key])]),
        ),
      })),
);
const skin = gltf.skins?.[0];
const skinned =
  skin === undefined ? {} : { joints: skin.joints.map((node) => gltf.nodes[node].name), inverseBind: read(skin.inverseBindMatrices) };
writeFileSync(out, JSON.stringify({ meshes, ...skinned }));
