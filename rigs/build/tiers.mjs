// Reduces a raw model to its tier's triangles, compresses it with meshopt, validates it, and prints one JSON line.
// usage: node tiers.mjs in.glb out.glb triangles      (0 keeps them all)
//
// Positions stay 32-bit floats: quantised ones would move their scale into the skins' inverse bind matrices and the
// nodes' transforms, and those are to be the rest pose of rig.json and nothing else.
import { readFileSync } from "node:fs";
import { Logger, NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS, EXTMeshoptCompression, KHRMeshQuantization } from "@gltf-transform/extensions";
import { dedup, prune, quantize, reorder, simplifyPrimitive, weld } from "@gltf-transform/functions";
import { MeshoptDecoder, MeshoptEncoder, MeshoptSimplifier } from "meshoptimizer";
import validator from "gltf-validator";

const [input, output, wanted] = process.argv.slice(2);
await Promise.all([MeshoptEncoder.ready, MeshoptDecoder.ready, MeshoptSimplifier.ready]);
const io = new NodeIO()
  .registerExtensions(ALL_EXTENSIONS)
  .registerDependencies({ "meshopt.encoder": MeshoptEncoder, "meshopt.decoder": MeshoptDecoder });

function triangles(document) {
  const drawn = (node) => node.getMesh()?.listPrimitives() ?? [];
  const parts = document.getRoot().listNodes().flatMap(drawn);
  return parts.reduce((sum, part) => sum + part.getIndices().getCount() / 3, 0);
}

// These are built at each tier's own fineness: thin overlapping pieces do not survive being reduced.
const KEPT = new Set(["Hair", "Lapels", "Collar", "Ribbon", "Shirt"]);
function reduce(document, wantedTriangles) {
  const meshes = document.getRoot().listMeshes().filter((mesh) => !KEPT.has(mesh.getName()));
  const parts = meshes.flatMap((mesh) => mesh.listPrimitives());
  const size = (primitives) => primitives.reduce((sum, part) => sum + part.getIndices().getCount() / 3, 0);
  const drawnMoreThanOnce = triangles(document) - size(document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives()));
  const kept = triangles(document) - size(parts) - drawnMoreThanOnce;
  const ratio = (wantedTriangles - kept) / (size(parts) + drawnMoreThanOnce);
  for (const part of parts) simplifyPrimitive(part, { simplifier: MeshoptSimplifier, ratio, error: 0.012 });
}

async function issues(bytes) {
  const { issues: found } = await validator.validateBytes(new Uint8Array(bytes), { maxIssues: 50 });
  const serious = found.messages.filter((message) => message.severity < 2);
  return { errors: found.numErrors, warnings: found.numWarnings, messages: serious };
}

const document = await io.read(input);
document.setLogger(new Logger(Logger.Verbosity.WARN));
await document.transform(dedup(), weld());
const count = Number(wanted);
if (count > 0 && triangles(document) > count) reduce(document, count);
await document.transform(prune({ keepLeaves: true, keepAttributes: false, keepExtras: true }));
const plain = await issues(await io.writeBinary(document));
await document.transform(
  reorder({ encoder: MeshoptEncoder, target: "size" }),
  quantize({ pattern: /^(NORMAL|TANGENT|COLOR_0|WEIGHTS_0|JOINTS_0)$/, quantizeNormal: 8, quantizeColor: 8 }),
);
document.createExtension(KHRMeshQuantization).setRequired(true);
document
  .createExtension(EXTMeshoptCompression)
  .setRequired(true)
  .setEncoderOptions({ method: EXTMeshoptCompression.EncoderMethod.QUANTIZE });
await io.write(output, document);
const packed = await issues(readFileSync(output));
console.log(
  JSON.stringify({
    triangles: triangles(document),
    bytes: readFileSync(output).length,
    errors: plain.errors + packed.errors,
    warnings: plain.warnings + packed.warnings,
    messages: [...plain.messages, ...packed.messages],
  }),
);
