/** What the gallery stands alone: parts by the names of their meshes, lights as a show would set them. */

/** A show parameter's floats, as a frame holds them. */
export type Overrides = Readonly<Record<string, readonly number[]>>;

/** Meshes of the models that make a part; null shows the whole stage. */
export const PARTS: Readonly<Record<string, RegExp | null>> = {
  stage: null,
  "player and instrument": /./,
  player:
    /^(skin|lashes|eyes|hair|shirt|blazer|jacket|skirt|trousers|tights|shoes|lapels|pockets|piping|hem|buttons|collar|ribbon|tie)/i,
  head: /^(skin|lashes|eyes|hair)/i,
  uniform: /^(shirt|blazer|jacket|skirt|trousers|tights|shoes|lapels|pockets|piping|hem|buttons|collar|ribbon|tie)/i,
  "body without clothes": /^(skin|lashes|eyes)/i,
  instrument: /^(body|slide|mouthpiece|valve|mute)/i,
  valves: /^valve/i,
  slides: /^slide/i,
};

const DARK: Overrides = {
  "lights/key/intensity": [0],
  "lights/fill/intensity": [0],
  "lights/rim/intensity": [0],
  "lights/ambient/intensity": [0],
  "lights/environment/intensity": [0.06],
};

/** Each light alone, and two rigs of several. Colours are linear sRGB. */
export const LIGHTS: Readonly<Record<string, Overrides>> = {
  "as the show has it": {},
  key: { ...DARK, "lights/key/intensity": [3.2] },
  fill: { ...DARK, "lights/fill/intensity": [1.2] },
  rim: { ...DARK, "lights/rim/intensity": [4] },
  environment: { ...DARK, "lights/environment/intensity": [1] },
  "back wash": { ...DARK, "lights/back_wash/intensity": [5], "lights/back_wash/color": [0.06, 0.16, 0.5] },
  "one spot": { ...DARK, "lights/environment/intensity": [0.12], "lights/spots/1/intensity": [7], "lights/haze": [1] },
  concert: {
    ...DARK,
    "lights/fill/intensity": [0.25],
    "lights/ambient/intensity": [0.05],
    "lights/environment/intensity": [0.14],
    "lights/spots/1/intensity": [7],
    "lights/spots/2/intensity": [5],
    "lights/spots/3/intensity": [6],
    "lights/back_wash/intensity": [3],
    "lights/haze": [1],
  },
  night: {
    ...DARK,
    // One lamp, warm on the face, before the blue of the windows.
    "lights/spots/1/intensity": [1.6],
    "lights/spots/1/color": [1, 0.62, 0.32],
    "lights/haze": [0.3],
    "lights/fill/intensity": [0.9],
    "lights/fill/color": [0.2, 0.32, 0.7],
    "lights/rim/intensity": [3.6],
    "lights/rim/color": [0.4, 0.55, 1],
    "lights/environment/intensity": [0.28],
  },
  "last sun": {
    "lights/key/intensity": [5],
    "lights/key/color": [1, 0.5, 0.2],
    "lights/key/position": [-3.4, 1.6, 1.1],
    "lights/fill/intensity": [0.9],
    "lights/rim/intensity": [1],
    "lights/environment/intensity": [0.55],
    "stage/fog/density": [0.015],
  },
};

export const STYLES: Readonly<Record<string, Overrides>> = {
  "as the show has it": {},
  physical: { "look/style": [0] },
  toon: { "look/style": [1] },
};

export const FINISHES: Readonly<Record<string, Overrides>> = {
  "as the show has it": {},
  lacquer: { "trumpet/finish": [0] },
  silver: { "trumpet/finish": [1] },
};

export const MUTES: Readonly<Record<string, Overrides>> = {
  "as the score has it": {},
  open: { "trumpet/mute": [0] },
  straight: { "trumpet/mute": [1] },
};

export const LENSES: Readonly<Record<string, Overrides>> = {
  "as the show has it": {},
  "all in focus": { "camera/aperture": [0] },
  "50 mm at f/2": { "camera/aperture": [0.025] },
  "85 mm at f/1.4": { "camera/aperture": [0.06] },
};
