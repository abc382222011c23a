// Microseconds a frame in three.js's AnimationMixer, read from standard input as bench_keyframes.py writes it.
import { readFileSync } from "node:fs";
import * as THREE from "../../web/node_modules/three/build/three.module.js";

const { tracks, starts } = JSON.parse(readFileSync(0, "utf8"));

const kinds = {
  number: [THREE.NumberKeyframeTrack, () => 0],
  vector: [THREE.VectorKeyframeTrack, () => new THREE.Vector3()],
  color: [THREE.ColorKeyframeTrack, () => new THREE.Color()],
  orientation: [THREE.QuaternionKeyframeTrack, () => new THREE.Quaternion()],
};
const root = new THREE.Object3D();
const nodes = [];
const clip = new THREE.AnimationClip(
  "show",
  -1,
  tracks.map(({ type, times, values }, index) => {
    const node = new THREE.Object3D();
    node.name = `n${index}`;
    root.add(node);
    nodes.push(node);
    const [Track, make] = kinds[type];
    const property = type === "orientation" ? "quaternion" : type === "vector" ? "position" : "shown";
    if (property === "shown") node.shown = make();
    return new Track(`n${index}.${property}`, times, values.flat());
  }),
);
const mixer = new THREE.AnimationMixer(root);
mixer.clipAction(clip).play();
const spent = [];
for (const start of [...starts, ...starts]) {
  const begun = performance.now();
  for (let frame = 0; frame < 60; frame++) mixer.setTime(start + frame / 60);
  spent.push(((performance.now() - begun) * 1000) / 60);
}
spent.sort((a, b) => a - b);
mixer.setTime(starts[starts.length >> 1]);
const seen = nodes.map((node, index) => (tracks[index].type === "number" ? [node.shown] : []));
console.log(JSON.stringify({ us: spent[spent.length >> 1], seen }));
