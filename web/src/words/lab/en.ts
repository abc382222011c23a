import { filled, words } from "../words";

/** The lab. */
export const lab = words("lab", {
  title: "Reina's lab",
  tab: "Reina: lab",
  toPlayer: "To the player",
  tables: "Tables of the lab",
  computed: "Everything here is computed by the server",
  rotations: "Rotations",
  kinematics: "Kinematics",
  clips: "Motion clips",
  pictureRotations: "Sphere with the paths of four interpolations",
  pictureKinematics: "Chain, target and limits. Arrow keys, Page Up and Page Down move the target",
  pictureClips: "Motion clip",
  noWebGl:
    "This browser cannot draw the lab: it has no WebGL 2. Switch on hardware acceleration in its settings. The numbers are there all the same.",
  pause: "Pause",
  play: "Play",
  fromTo: filled("From {from} to {to}"),
});
