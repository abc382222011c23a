// Microseconds a frame in Theatre.js's player, read from standard input as bench_keyframes.py writes it. Its values
// are kept hot, as a page keeps them: each object's values are listened to, and a frame is a position and a tick.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(new URL("./theatre/", import.meta.url));
const { createRafDriver, getProject, types } = require("@theatre/core");
const { tracks, starts } = JSON.parse(readFileSync(0, "utf8"));

const hex = (parts) => `#${parts.map((part) => Math.round(255 * part).toString(16).padStart(2, "0")).join("")}ff`;
const color = (parts) => {
  const [r, g, b] = parts;
  return { r, g, b, a: 1, toString: () => hex(parts) };
};
// Theatre.js has numbers and colours; a vector is three of its numbers, an orientation four (no slerp).
const parts = (track) =>
  track.type === "number" || track.type === "color"
    ? [["v", track.values]]
    : track.values[0].map((_, axis) => [`v${axis}`, track.values.map((value) => value[axis])]);

const byObject = {};
for (const [index, track] of tracks.entries()) {
  const trackData = {};
  const trackIdByPropPath = {};
  for (const [name, values] of parts(track)) {
    const id = `t${index}${name}`;
    trackIdByPropPath[JSON.stringify([name])] = id;
    trackData[id] = {
      type: "BasicKeyframedTrack",
      __debugName: id,
      keyframes: values.map((value, number) => ({
        id: `${id}k${number}`,
        position: track.times[number],
        connectedRight: true,
        handles: track.handles[number],
        type: track.steps[number] ? "hold" : "bezier",
        value: track.type === "color" ? { r: value[0], g: value[1], b: value[2], a: 1 } : value,
      })),
    };
  }
  byObject[`o${index}`] = { trackData, trackIdByPropPath };
}
const state = {
  definitionVersion: "0.4.0",
  revisionHistory: ["a"],
  sheetsById: {
    stage: {
      staticOverrides: { byObject: {} },
      sequence: {
        type: "PositionalSequence",
        length: 1e5,
        subUnitsPerUnit: 60,
        tracksByObject: byObject,
      },
    },
  },
};

const project = getProject("bench", { state });
await project.ready;
const sheet = project.sheet("stage");
const driver = createRafDriver({ name: "by hand" });
const seen = [];
for (const [index, track] of tracks.entries()) {
  const props = {};
  for (const [name, values] of parts(track)) {
    props[name] = track.type === "color" ? types.rgba(color([0, 0, 0])) : types.number(values[0]);
  }
  sheet.object(`o${index}`, props).onValuesChange((values) => (seen[index] = values), driver);
}

let now = 0;
const frame = (position) => {
  sheet.sequence.position = position;
  driver.tick((now += 16));
};
const spent = [];
for (const start of [...starts, ...starts]) {
  const begun = performance.now();
  for (let number = 0; number < 60; number++) frame(start + number / 60);
  spent.push(((performance.now() - begun) * 1000) / 60);
}
spent.sort((a, b) => a - b);
// What it says at one time, so that the asker can see that it follows the keys.
frame(starts[starts.length >> 1]);
console.log(JSON.stringify({ us: spent[spent.length >> 1], seen: seen.map((values) => Object.values(values)) }));
process.exit(0);
