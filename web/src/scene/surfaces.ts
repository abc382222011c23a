/** How skin, cloth and metal of a model take the stage's light: by the names of their materials. */

import {
  BackSide,
  Color,
  DoubleSide,
  Mesh,
  MeshPhysicalMaterial,
  MeshStandardMaterial,
  type Object3D,
  ShaderChunk,
} from "three";

import { SHADOW_ELSEWHERE } from "../rig";
import type { TierSettings } from "./tiers";

/** Light that enters skin comes out a little farther, red: the edge of a shadow is soft and warm. */
const SKIN_LIGHT = ShaderChunk.lights_physical_pars_fragment.replace(
  "vec3 irradiance = dotNL * directLight.color;",
  `float skinNL = dot( geometryNormal, directLight.direction );
   vec3 skinWrap = vec3( 0.34, 0.17, 0.11 );
   vec3 irradiance = clamp( ( skinNL + skinWrap ) / ( 1.0 + skinWrap ), 0.0, 1.0 ) * directLight.color;`,
);

/** One spark whitens its whole pixel: skin and hair are never brighter than this, in the scene's own light. */
const WITHOUT_SPARKS = `outgoingLight = min(outgoingLight, vec3(1.6));
#include <opaque_fragment>`;

/** Hair's normals lean toward the head's roundness; where they lean away from who looks, they would mirror the room. */
const FACING_NORMALS = `#include <normal_fragment_maps>
vec3 toEye = normalize(vViewPosition);
normal = normalize(normal + toEye * max(0.25 - dot(normal, toEye), 0.0));`;

type Dress = (material: MeshStandardMaterial) => MeshStandardMaterial;

/** Fine knit: where it is seen straight on, the leg shows through; toward its outline it closes. */
const KNIT = `#include <normal_fragment_maps>
float across = max(dot(normal, normalize(vViewPosition)), 0.0);
diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.12, 0.072, 0.06), 0.42 * pow(across, 2.2));`;

/** A dress that puts pieces of its own for pieces of three.js's fragment shader; `name` tells its programs apart. */
function reshade(name: string, pieces: Readonly<Record<string, string>>): Dress {
  return (material) => {
    material.onBeforeCompile = (program) => {
      for (const [piece, own] of Object.entries(pieces)) {
        program.fragmentShader = program.fragmentShader.replace(`#include <${piece}>`, own);
      }
    };
    material.customProgramCacheKey = () => name;
    return material;
  };
}

/** Cloth as light as this, linear, has the whole of its nap; black cloth would turn grey by it. */
const NAPPED = 0.06;

/** Wool's nap: folds turn toward a paler edge. */
function napCloth(material: MeshStandardMaterial): MeshStandardMaterial {
  const cloth = new MeshPhysicalMaterial();
  MeshStandardMaterial.prototype.copy.call(cloth, material);
  cloth.sheen = 0.2;
  cloth.sheenRoughness = 0.45;
  const { r, g, b } = material.color;
  const pale = 0.35 * Math.min(1, Math.max(r, g, b) / NAPPED);
  cloth.sheenColor.copy(material.color).lerp(new Color(0x8fa0c8), pale);
  return cloth;
}

/** Beginnings of material names; the first that fits is taken. */
const DRESSES: readonly (readonly [name: RegExp, dress: Dress])[] = [
  [/^skin/i, reshade("skin", { lights_physical_pars_fragment: SKIN_LIGHT, opaque_fragment: WITHOUT_SPARKS })],
  [/^hair/i, reshade("hair", { normal_fragment_maps: FACING_NORMALS, opaque_fragment: WITHOUT_SPARKS })],
  [/^tights/i, reshade("tights", { normal_fragment_maps: KNIT })],
  [/^(blazer|jacket|lapel|skirt|trousers)/i, napCloth],
];

/** Ready a model's meshes for the stage's light and shadow. */
export function dressSurfaces(model: Object3D, tier: TierSettings): void {
  const dressed = new Map<MeshStandardMaterial, MeshStandardMaterial>();
  model.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    node.receiveShadow = tier.shadowMapSize > 0;
    node.castShadow = node.receiveShadow && node.userData[SHADOW_ELSEWHERE] !== true;
    const { material } = node as Mesh;
    // Thin cloth would shade itself: its far side casts the shadow.
    if ((material as MeshStandardMaterial).side === DoubleSide)
      (material as MeshStandardMaterial).shadowSide = BackSide;
    if (!tier.softSurfaces || !(material instanceof MeshStandardMaterial)) return;
    const dress = DRESSES.find(([name]) => name.test(material.name))?.[1];
    if (dress === undefined) return;
    const known = dressed.get(material) ?? dress(material);
    dressed.set(material, known);
    node.material = known;
  });
}
