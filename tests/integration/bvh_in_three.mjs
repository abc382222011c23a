// A BVH file as three.js plays it: reads the file on standard input, writes the world positions of all bones
// in all frames as JSON, {times, bones: {name: [[x, y, z], ...]}}.
import { readFileSync } from "node:fs";
import { AnimationMixer, LoopOnce, Vector3 } from "../../web/node_modules/three/build/three.module.js";
import { BVHLoader } from "../../web/node_modules/three/examples/jsm/loaders/BVHLoader.js";

const { clip, skeleton } = new BVHLoader().parse(readFileSync(0, "utf8"));
const root = skeleton.bones[0];
const mixer = new AnimationMixer(root);
const action = mixer.clipAction(clip);
action.setLoop(LoopOnce, 1);
action.clampWhenFinished = true;
action.play();
const times = [...clip.tracks[0].times];
const named = skeleton.bones.filter((bone) => bone.name !== "ENDSITE");
const bones = Object.fromEntries(named.map((bone) => [bone.name, []]));
const place = new Vector3();
for (const time of times) {
  mixer.setTime(time);
  root.updateMatrixWorld(true);
  for (const bone of named) bones[bone.name].push(place.setFromMatrixPosition(bone.matrixWorld).toArray());
}
process.stdout.write(JSON.stringify({ times, bones }));
