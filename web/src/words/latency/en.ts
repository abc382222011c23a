import { filled, words } from "../words";

/** When sound comes to the ear: headphones and televisions that hold it, or the picture, back. */
export const latency = words("latency", {
  title: "Sound delay of the headphones",
  titleNow: filled("Sound delay of the headphones: {delay}"),
  help: "Wireless headphones hold the sound back longer than the browser knows. If you hear a note after you see it, move this to the right; if before, to the left.",
  less: "5 ms less",
  more: "5 ms more",
  none: "as the browser says",
  earlier: "sound is sent earlier",
  later: "sound is sent later",
  test: "Click and flash",
  stop: "Stop",
  testing: "Move it until click and flash come together.",
  reset: "Reset",
  kept: "This browser remembers it.",
  keptFor: filled("Remembered for {device}"),
});
