/** The drawn look: light in flat tones, metal in bands, and an outline of even width. */

import {
  BackSide,
  Color,
  DataTexture,
  LinearFilter,
  MathUtils,
  Mesh,
  MeshBasicMaterial,
  type MeshStandardMaterial,
  MeshToonMaterial,
  RedFormat,
  SkinnedMesh,
} from "three";

/** A light's share on a surface turned from it, and one turned to it; between them an edge at this cosine. */
const TONES = { shade: 0.16, light: 1, edge: 0.2, softness: 0.05, count: 64 } as const;

/** Light of its own that every drawn surface has, as a share of its colour: shade is never black. */
const SHADE = 0.2;

/** How light is gathered: this much is drawn as it is, what is beyond comes ever closer to the whole colour. */
const WHOLE = 1.14;

/** The colour that shade takes: skin's is warm, as light comes through it; cloth's is the sky's. */
const SHADES: readonly (readonly [name: RegExp, tint: readonly [number, number, number]])[] = [
  [/^(skin|lashes)/i, [1, 0.8, 0.76]],
  [/./, [0.9, 0.92, 1]],
];

/** The mirror of the floor leaves this layer out. */
export const OUTLINE_LAYER = 1;

/** Name of the hulls that draw outlines. */
export const OUTLINE = "outline";

/** Width of an outline as a share of the picture's height, and its most on the player, metres. */
const WIDTH = { share: 0.0021, most: 0.0042 } as const;

/** What is too fine for a line about it. */
const NO_OUTLINE = /^(eyes|lashes|felt|pearl|button|piping)/i;

/** The ramp from shade to light by the cosine between surface and light, from −1 to 1. */
export function createTones(): DataTexture {
  const { shade, light, edge, softness, count } = TONES;
  const tones = Uint8Array.from({ length: count }, (_, i) => {
    const cosine = (2 * i) / (count - 1) - 1;
    const share = MathUtils.smoothstep(cosine, edge - softness, edge + softness);
    return Math.round(255 * MathUtils.lerp(shade, light, share));
  });
  const texture = new DataTexture(tones, count, 1, RedFormat);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Many lights on one surface: their sum bends toward the whole colour, and what is left in shade takes its tint. */
function gather(tint: readonly [number, number, number]): string {
  const color = `vec3(${tint.map((part) => part.toFixed(2)).join(", ")})`;
  return /* glsl */ `
vec3 gathered = outgoingLight / max(diffuseColor.rgb, vec3(0.004));
float most = max(gathered.r, max(gathered.g, gathered.b));
float shown = ${WHOLE.toFixed(2)} * (1.0 - exp(-1.9 * most));
// Coloured lamps colour what they light, by half.
vec3 lamp = mix(vec3(1.0), gathered / max(most, 0.001), 0.55);
outgoingLight = diffuseColor.rgb * lamp * shown * mix(${color}, vec3(1.0), smoothstep(0.5, 0.85, shown));
`;
}

/** A ring of light on the crown of the head, broken up by the strands. */
const HAIR_RING = /* glsl */ `
vec3 above = normalize((viewMatrix * vec4(0.0, 1.0, 0.0, 0.0)).xyz);
float strand = dot(diffuseColor.rgb, vec3(0.3, 0.5, 0.2));
float height = dot(normalize(vNormal), above) + 0.8 * (strand - 0.03);
float ring = smoothstep(0.5, 0.53, height) * (1.0 - smoothstep(0.62, 0.68, height));
outgoingLight += ring * shown * mix(diffuseColor.rgb, vec3(0.55, 0.36, 0.26), 0.16);
`;

/** Reflections gathered into four bands of the metal's own colour, deep to nearly white. */
const BANDS = /* glsl */ `
float shine = dot(outgoingLight, vec3(0.3, 0.5, 0.2)) / max(dot(diffuseColor.rgb, vec3(0.3, 0.5, 0.2)), 0.05);
float width = fwidth(shine) * 0.75 + 0.012;
vec3 deep = diffuseColor.rgb * diffuseColor.rgb;
vec3 banded = mix(0.16 * deep, 0.62 * mix(deep, diffuseColor.rgb, 0.35), smoothstep(0.13 - width, 0.13 + width, shine));
banded = mix(banded, mix(deep, diffuseColor.rgb, 0.75), smoothstep(0.5 - width, 0.5 + width, shine));
banded = mix(banded, mix(diffuseColor.rgb, vec3(1.0, 0.97, 0.88), 0.75) * 1.3, smoothstep(2.2 - width, 2.2 + width, shine));
outgoingLight = banded;
`;

function drawMetal(material: MeshStandardMaterial): MeshStandardMaterial {
  const metal = material.clone();
  metal.onBeforeCompile = (program) => {
    program.fragmentShader = program.fragmentShader.replace(
      "#include <opaque_fragment>",
      `${BANDS}\n#include <opaque_fragment>`,
    );
  };
  metal.customProgramCacheKey = () => "drawn metal";
  return metal;
}

/** The drawn counterpart of a surface. */
export function drawSurface(
  material: MeshStandardMaterial,
  tones: DataTexture,
): MeshStandardMaterial | MeshToonMaterial {
  if (material.metalness > 0.5) return drawMetal(material);
  const { color, map, side, transparent, alphaTest, name, vertexColors } = material;
  const drawn = new MeshToonMaterial({ color, map, side, transparent, alphaTest, vertexColors, gradientMap: tones });
  drawn.emissive.copy(color).multiplyScalar(SHADE);
  drawn.emissiveMap = map;
  drawn.name = name;
  const tint = SHADES.find(([pattern]) => pattern.test(name))?.[1] ?? [1, 1, 1];
  const light = gather(tint) + (/^hair/i.test(name) ? HAIR_RING : "");
  drawn.onBeforeCompile = (program) => {
    program.fragmentShader = program.fragmentShader.replace(
      "#include <opaque_fragment>",
      `${light}\n#include <opaque_fragment>`,
    );
  };
  drawn.customProgramCacheKey = () => `drawn ${light}`;
  return drawn;
}

/** Uniforms that all outlines share: the picture's height over its width, and of the lens. */
export const outlineUniforms = () => ({
  /** Width over height of the picture. */
  aspect: { value: 16 / 9 },
  /** Metres across which a picture's height shows at one metre's distance. */
  reach: { value: 0.5 },
});
export type OutlineUniforms = ReturnType<typeof outlineUniforms>;

function createLine(material: MeshStandardMaterial, uniforms: OutlineUniforms): MeshBasicMaterial {
  const color = new Color().copy(material.color).multiplyScalar(0.22);
  if (material.map !== null) color.set(0x3a1f16);
  const line = new MeshBasicMaterial({ color, side: BackSide });
  line.onBeforeCompile = (program) => {
    Object.assign(program.uniforms, uniforms);
    program.vertexShader = program.vertexShader
      .replace("#include <common>", "#include <common>\nuniform float aspect;\nuniform float reach;")
      // The normal is wanted whether the mesh has a skin or not.
      .replace("#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )", "#if 1")
      .replace(
        "#include <project_vertex>",
        `#include <project_vertex>
        // Back faces have their normals turned over.
        vec2 outward = normalize(vec2(1e-6) - normalize(transformedNormal).xy);
        float across = min(${WIDTH.share.toFixed(5)}, ${WIDTH.most.toFixed(5)} / max(-mvPosition.z * reach, 1e-3));
        gl_Position.xy += outward * vec2(1.0 / aspect, 1.0) * (2.0 * across * gl_Position.w);`,
      );
  };
  line.customProgramCacheKey = () => "outline";
  return line;
}

/** The hull of a mesh that draws its outline, or null for what is too fine. It follows the mesh's pose and morphs. */
export function createOutline(mesh: Mesh, material: MeshStandardMaterial, uniforms: OutlineUniforms): Mesh | null {
  if (NO_OUTLINE.test(material.name)) return null;
  const line = createLine(material, uniforms);
  let hull: Mesh;
  if (mesh instanceof SkinnedMesh) {
    const skinned = new SkinnedMesh(mesh.geometry, line);
    skinned.bindMode = mesh.bindMode;
    skinned.bind(mesh.skeleton, mesh.bindMatrix);
    hull = skinned;
  } else {
    hull = new Mesh(mesh.geometry, line);
  }
  if (mesh.morphTargetInfluences !== undefined) hull.morphTargetInfluences = mesh.morphTargetInfluences;
  hull.frustumCulled = mesh.frustumCulled;
  hull.layers.set(OUTLINE_LAYER);
  hull.name = OUTLINE;
  return hull;
}
