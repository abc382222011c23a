import { BoxGeometry, Group, Mesh, MeshStandardMaterial } from "three";
import { describe, expect, it } from "vitest";

import { PlayerLook } from "./look";
import { OUTLINE } from "./toon";

function model(): { object: Group; cloth: Mesh; bell: Mesh; eyes: Mesh } {
  const mesh = (name: string, metalness: number): Mesh => {
    const material = new MeshStandardMaterial({ name, metalness, color: metalness > 0.5 ? 0xd9a441 : 0x202848 });
    return new Mesh(new BoxGeometry(), material);
  };
  const [cloth, bell, eyes] = [mesh("blazer", 0), mesh("brass", 1), mesh("eyes", 0)];
  return { object: new Group().add(cloth, bell, eyes), cloth, bell, eyes };
}

const colorOf = (mesh: Mesh): number => (mesh.material as MeshStandardMaterial).color.getHex();

describe("PlayerLook", () => {
  it("draws with outlines and goes back to the very same surfaces", () => {
    const look = new PlayerLook();
    const { object, cloth, eyes } = model();
    const before = cloth.material;
    look.setModels([object]);
    look.setStyle(1);
    expect(cloth.material).not.toBe(before);
    expect(cloth.children.map(({ name, visible }) => [name, visible])).toEqual([[OUTLINE, true]]);
    expect(eyes.children).toHaveLength(0);
    look.setStyle(0);
    expect(cloth.material).toBe(before);
    expect(cloth.children[0]?.visible).toBe(false);
    look.setStyle(1);
    expect(cloth.children).toHaveLength(1);
  });

  it("plates the brass in either style, and nothing else", () => {
    const look = new PlayerLook();
    const { object, cloth, bell } = model();
    look.setModels([object]);
    const [lacquer, navy] = [colorOf(bell), colorOf(cloth)];
    look.setFinish(1);
    const silver = colorOf(bell);
    expect(silver).not.toBe(lacquer);
    look.setStyle(1);
    expect(colorOf(bell)).toBe(silver);
    look.setFinish(0);
    expect(colorOf(bell)).toBe(lacquer);
    look.setStyle(0);
    expect(colorOf(bell)).toBe(lacquer);
    expect(colorOf(cloth)).toBe(navy);
  });

  it("dresses models that come later as the show has it", () => {
    const look = new PlayerLook();
    look.setStyle(1);
    look.setFinish(1);
    const { object, cloth, bell } = model();
    const before = cloth.material;
    look.setModels([object]);
    expect(cloth.material).not.toBe(before);
    expect(colorOf(bell)).not.toBe(0xd9a441);
    look.release();
    expect(cloth.material).toBe(before);
    expect(cloth.children).toHaveLength(0);
  });
});
