/** The drawn look: light in flat tones, metal in bands, and an outline of even width. */

import {
  BackSide,
  Color,
  DataTexture,
  Mesh,
  MeshBasicMaterial,
  type MeshStandardMaterial,
  MeshToonMaterial,
  NearestFilter,
  RedFormat,
  SkinnedMesh,
} from "three";

/** Tones from shade to light, as shares of the light; the shade stays bright. */
const TONES = [0.2, 0.2, 0.24, 0.86, 0.98, 1];

/** Light of its own that every drawn surface has, as a share of its colour. */
const SHADE = 0.24;

/** The most light that it shows, as a share of its colour: no lamp washes it out. */
const BRIGHTEST = 1.2;

/** The mirror of the floor leaves this layer out. */
export const OUTLINE_LAYER = 1;

/** Name of the hulls that draw outlines. */
export const OUTLINE = "outline";

/** Width of an outline as a share of the picture's height, and its most on the player, metres. */
const WIDTH = { share: 0.0021, most: 0.0042 } as const;

/** What is too fine for a line about it. */
const NO_OUTLINE = /^(eyes|lashes|felt|pearl|button)/i;

export function createTones(): DataTexture {
  const texture = new DataTexture(Uint8Array.from(TONES, (tone) => Math.round(255 * tone)), TONES.length, 1, RedFormat);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

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
    program.fragmentShader = program.fragmentShader.replace("#include <opaque_fragment>", `${BANDS}\n#include <opaque_fragment>`);
  };
  metal.customProgramCacheKey = () => "drawn metal";
  return metal;
}

/** The drawn counterpart of a surface. */
export function drawSurface(material: MeshStandardMaterial, tones: DataTexture): MeshStandardMaterial | MeshToonMaterial {
  if (material.metalness > 0.5) return drawMetal(material);
  const { color, map, side, transparent, alphaTest, name, vertexColors } = material;
  const drawn = new MeshToonMaterial({ color, map, side, transparent, alphaTest, vertexColors, gradientMap: tones });
  // Shade is never black.
  drawn.emissive.copy(color).multiplyScalar(SHADE);
  drawn.emissiveMap = map;
  drawn.name = name;
  drawn.onBeforeCompile = (program) => {
    program.fragmentShader = program.fragmentShader.replace(
      "#include <opaque_fragment>",
      `outgoingLight = min(outgoingLight, diffuseColor.rgb * ${BRIGHTEST.toFixed(2)} + 0.01);\n#include <opaque_fragment>`,
    );
  };
  drawn.customProgramCacheKey = () => "drawn cloth";
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
