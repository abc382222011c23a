// three.js's CCDIKSolver on a finger: reads hinges, limits and targets as JSON, says errors and time as JSON.
// A hinge that shares its place with the one before it is the same bone turned about a second axis.
import { readFileSync } from "node:fs";
import { Bone, BufferGeometry, MeshBasicMaterial, Skeleton, SkinnedMesh, Vector3 } from "../../web/node_modules/three/build/three.module.js";
import { CCDIKSolver } from "../../web/node_modules/three/examples/jsm/animation/CCDIKSolver.js";

const { hinges, pad, rounds, targets, tolerance } = JSON.parse(readFileSync(0, "utf8"));
const bones = [];
const links = [];
const root = new Bone();
bones.push(root);
let tip = root;
for (const hinge of hinges) {
  const [x, y, z, w] = hinge.rest;
  const axis = hinge.axis.indexOf(1);
  const shared = hinge.link.every((value) => value === 0);
  if (!shared) {
    // A bone of its own holds the rest turn, so that the limits are of the turn from rest.
    const held = new Bone();
    held.position.fromArray(hinge.link);
    held.quaternion.set(x, y, z, w);
    const turned = new Bone();
    tip.add(held);
    held.add(turned);
    bones.push(held, turned);
    tip = turned;
    links.unshift({ index: bones.length - 1, rotationMin: new Vector3(), rotationMax: new Vector3() });
  }
  links[0].rotationMin.setComponent(axis, hinge.low);
  links[0].rotationMax.setComponent(axis, hinge.high);
}
const effector = new Bone();
effector.position.fromArray(pad);
tip.add(effector);
const target = new Bone();
root.add(target);
bones.push(effector, target);
const mesh = new SkinnedMesh(new BufferGeometry(), new MeshBasicMaterial());
mesh.add(root);
mesh.bind(new Skeleton(bones));
const solver = new CCDIKSolver(mesh, [
  { effector: bones.length - 2, target: bones.length - 1, links, iteration: 1 },
]);
const found = new Vector3();
const wanted = new Vector3();

function solve(place) {
  for (const link of links) bones[link.index].quaternion.identity();
  wanted.fromArray(place);
  target.position.copy(wanted);
  mesh.updateMatrixWorld(true);
  let error = Infinity;
  for (let round = 0; round < rounds; round += 1) {
    error = found.setFromMatrixPosition(effector.matrixWorld).distanceTo(wanted);
    if (error <= tolerance) return error;
    solver.update();
  }
  return found.setFromMatrixPosition(effector.matrixWorld).distanceTo(wanted);
}

for (const place of targets) solve(place); // warm: the compiler has seen it
const begin = process.cpuUsage();
const error_m = targets.map(solve);
const spent = process.cpuUsage(begin);
const took_us = (spent.user + spent.system) / targets.length;
process.stdout.write(JSON.stringify({ error_m, took_us }));
