/** The stage: loads the rigs, takes frames, draws pictures. */

import { Color, FogExp2, Mesh, Raycaster, Scene, Vector2, Vector3, type WebGLRenderer } from "three";

import type { Hello } from "../generated/protocol";
import { RigModel, loadRig, mergeMeshes } from "../rig";
import { NoteBlocks } from "./blocks/blocks";
import { paneColor } from "./blocks/player-colors";
import { StageCamera } from "./camera";
import {
  CAMERA_PRESETS,
  type CameraPreset,
  type CameraView,
  findPreset,
  type FramedView,
  VALVES,
} from "./camera-presets";
import { castView, playerView, viewAt } from "./cast-views";
import { drummerView, kitView } from "./kit-views";
import { type DrawnFrame, ParameterIndex } from "./frame";
import type { Insets } from "./framing";
import { Inset, type InsetPlace } from "./inset";
import { StageLights } from "./lights";
import { PlayerLook } from "./look";
import { Picture } from "./picture";
import { overview, PictureSpace, type PicturePoint, type Place, type ShowCamera } from "./picture-space";
import { Players, type Stand } from "./players";
import { release } from "./release";
import { createRenderer } from "./renderer";
import { FOOT_JOINTS, KIT_RIG, LEFT_HANDED_KIT_RIG, RoomReflections, createRoom, type Room } from "./room";
import type { ScoreView } from "./score";
import { ShowBinding } from "./show-binding";
import { StillShots } from "./still-shots";
import { dressSurfaces } from "./surfaces";
import { OUTLINE, OUTLINE_LAYER } from "./toon";
import { TIERS, type Tier, type TierSettings } from "./tiers";

export interface StageOptions {
  readonly tier: Tier;
  readonly reducedMotion: boolean;
  /** Nothing but the players, on nothing: their picture has no background. */
  readonly transparent?: boolean;
  /** Draw each part of the models by itself, so that `isolate` can show it alone; it takes more calls. */
  readonly wholeParts?: boolean;
  onCameraTaken?(taken: boolean): void;
}

export class Stage {
  readonly #tier: TierSettings;
  readonly #tierName: Tier;
  readonly #transparent: boolean;
  readonly #wholeParts: boolean;
  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #background = new Color(0x14110e);
  readonly #fog = new FogExp2(0x14110e, 0.05);
  readonly #lights: StageLights;
  readonly #camera: StageCamera;
  readonly #room: Room;
  readonly #reflections: RoomReflections;
  readonly #blocks: NoteBlocks;
  readonly #picture: Picture;
  readonly #inset = new Inset();
  readonly #look = new PlayerLook();
  readonly #show: ShowBinding;
  /** Where less motion is wanted. */
  readonly #still: StillShots | null;
  readonly #space: PictureSpace;
  /** Told after each picture. */
  onPicture: (() => void) | null = null;
  readonly #caster = new Raycaster();
  readonly #shade = new Color();
  #models: RigModel[] = [];
  #players = new Players([]);
  #drawnIndex = -1;
  #pictures = 0;
  readonly #drawnFrom = new Vector3();
  #epoch = -1;
  #revision: string | undefined;
  #songTime = 0;
  /** Something else than the frame changed the picture. */
  #changed = true;
  #onlyModels = false;
  #height = 1;
  #loads = 0;
  #redraw = 0;
  #disposed = false;

  /** @throws StageUnavailableError where the browser gives no WebGL 2. */
  constructor(canvas: HTMLCanvasElement, options: StageOptions) {
    this.#tierName = options.tier;
    this.#wholeParts = options.wholeParts === true;
    this.#tier = TIERS[options.tier];
    const transparent = options.transparent ?? false;
    this.#transparent = transparent;
    this.#still = options.reducedMotion ? new StillShots() : null;
    this.#canvas = canvas;
    this.#renderer = createRenderer(canvas, this.#tier, transparent);
    const scene = this.#scene;
    scene.matrixWorldAutoUpdate = false;
    scene.background = transparent ? null : this.#background;
    scene.fog = this.#fog;
    this.#lights = new StageLights(scene, this.#tier);
    this.#room = createRoom(this.#lights, this.#tier);
    this.#room.object.visible = !transparent;
    scene.add(this.#room.object);
    this.#blocks = new NoteBlocks(options.tier === "low" ? 4 : 10);
    this.#blocks.uniforms.toKey.value = this.#lights.toKey;
    scene.add(this.#blocks.object);
    this.#reflections = new RoomReflections(this.#tier.environmentSize);
    scene.environment = this.#reflections.render(this.#renderer);
    this.#camera = new StageCamera(canvas, {
      reducedMotion: options.reducedMotion,
      onTaken: (taken) => options.onCameraTaken?.(taken),
      onChange: () => this.#drawSoon(),
    });
    this.#camera.camera.layers.enable(OUTLINE_LAYER);
    this.#space = new PictureSpace(this.#camera.camera, () => this.#camera.size);
    this.#picture = new Picture(this.#renderer, this.#tier, transparent);
    this.#show = new ShowBinding({
      renderer: this.#renderer,
      scene,
      fog: this.#fog,
      background: this.#background,
      camera: this.#camera,
      lights: this.#lights,
      room: this.#room,
      blocks: this.#blocks,
      picture: this.#picture,
      look: this.#look,
    });
    canvas.addEventListener("webglcontextrestored", this.#restore);
  }

  /** Index of the frame that was last drawn; -1 before the first. */
  get drawnIndex(): number {
    return this.#drawnIndex;
  }

  /** How many pictures have been drawn. */
  get pictures(): number {
    return this.#pictures;
  }

  /** Names of the rigs whose models stand on the stage. */
  get rigs(): readonly string[] {
    return this.#models.map(({ rig }) => rig);
  }

  /** How many notes lie in each player's lane. */
  get laneNotes(): readonly number[] {
    return this.#blocks.laneNotes;
  }

  /** Colours of the players' blocks in the last picture, as they are read on the page's dark panes: `#rrggbb`. */
  get paneColors(): readonly string[] {
    return this.#blocks.laneColors.map((color) => `#${paneColor(color, this.#shade).getHexString()}`);
  }

  /** Draw calls and triangles of the last picture. */
  get cost(): { readonly calls: number; readonly triangles: number } {
    const { calls, triangles } = this.#renderer.info.render;
    return { calls, triangles };
  }

  /**
   * Fetch what a session's frames move: each skeleton's rig file and the tier's model.
   *
   * @throws RigError if a rig cannot be had or does not fit its model.
   * @throws LayoutError if the frames do not fit the rigs or the page.
   */
  async load(hello: Hello, rigUrl: (name: string) => string): Promise<void> {
    const load = ++this.#loads;
    const rigs = await Promise.all(hello.skeletons.map(({ rig }) => loadRig(rig, rigUrl(rig), this.#tierName)));
    if (load !== this.#loads || this.#disposed) return;
    const parameters = new ParameterIndex(hello.parameters);
    const models = rigs.flatMap((rig, i) => {
      const layout = hello.skeletons[i];
      if (layout === undefined) return [];
      const drawn = this.#wholeParts ? rig : mergeMeshes(rig, this.#tier.shadowMapSize > 0);
      return [new RigModel(drawn, layout, parameters)];
    });
    this.#show.bind(parameters);
    for (const { object } of this.#models) {
      this.#scene.remove(object);
      release(object);
    }
    for (const { object } of models) {
      dressSurfaces(object, this.#tier);
      this.#scene.add(object);
    }
    this.#models = models;
    this.#look.setModels(models.map(({ object }) => object));
    this.#players = new Players(models.map((model, i) => ({ model, player: hello.skeletons[i]?.player ?? 0 })));
    this.#changed = true;
    this.#room.feet.set(models.flatMap((model) => FOOT_JOINTS.flatMap((joint) => model.findJoint(joint) ?? [])));
    const kit = models.find(({ rig }) => rig === KIT_RIG || rig === LEFT_HANDED_KIT_RIG);
    this.#room.kit.set(kit?.findJoint(kit.jointNames[0] ?? "") ?? null, kit?.rig === LEFT_HANDED_KIT_RIG);
    await this.#compile();
  }

  /** Ready the shaders, so that the first picture does not wait for them. */
  async #compile(): Promise<void> {
    if (!this.#renderer.extensions.has("KHR_parallel_shader_compile")) return;
    this.#renderer.setRenderTarget(this.#picture.target);
    const ready = this.#renderer.compileAsync(this.#scene, this.#camera.camera);
    this.#renderer.setRenderTarget(null);
    await ready;
    // And those of a stage with its spots on, for when a show lights them.
    this.#lights.lightSpots(true);
    this.#renderer.setRenderTarget(this.#picture.target);
    void this.#renderer.compileAsync(this.#scene, this.#camera.camera);
    this.#renderer.setRenderTarget(null);
    this.#lights.lightSpots(false);
  }

  /** Lay out the notes that are played. */
  setScore(score: ScoreView): void {
    this.#blocks.setScore(score);
    this.#blocks.scroll(this.#songTime);
    this.#drawSoon();
  }

  /** Take a frame and draw it; the same frame again costs nothing unless something else changed the picture. */
  draw(frame: DrawnFrame): void {
    const { floats } = frame;
    const same = frame.index === this.#drawnIndex && frame.epoch === this.#epoch && frame.songTime === this.#songTime;
    if (same && frame.revision === this.#revision && !this.#changed) return;
    this.#epoch = frame.epoch;
    this.#revision = frame.revision;
    this.#songTime = frame.songTime;
    for (const model of this.#models) model.pose(floats);
    this.#show.apply(floats, frame.songTime);
    const { songTime, epoch, cuts } = frame;
    if (cuts !== undefined) this.#still?.still(this.#camera.show, { songTime, epoch, cuts });
    this.#blocks.scroll(frame.songTime);
    if (this.#render()) this.#drawnIndex = frame.index;
  }

  /** Draw the last frame once more, at once. */
  drawAgain(): void {
    this.#render();
  }

  /** @returns false while the drawing context is lost. */
  #render(): boolean {
    if (this.#renderer.getContext().isContextLost()) return false;
    const scene = this.#scene;
    this.#camera.follow();
    scene.updateMatrixWorld();
    this.#room.feet.follow();
    this.#room.kit.follow();
    const { starts, pieces } = this.#blocks.uniforms;
    this.#players.readLanes(starts.value, pieces.value);
    const stands = this.#players.stands();
    this.#blocks.arrange(
      stands.map(({ x }) => x),
      this.#players.atKits(),
    );
    this.#lights.reach(stands, this.#room.kit.reach);
    const { camera } = this.#camera;
    if (this.#onlyModels || this.#transparent) this.#blocks.object.visible = false;
    if (this.#transparent) for (const { cone } of this.#lights.spots) cone.visible = false;
    this.#look.follow(camera);
    this.#blocks.uniforms.pixelAngle.value = (2 * Math.tan((camera.fov * Math.PI) / 360)) / this.#height;
    const { shadowMap, info } = this.#renderer;
    info.reset();
    shadowMap.autoUpdate = true;
    const { mirror, floor } = this.#room;
    if (mirror !== null && !this.#transparent) {
      // Light in the air is too faint to be seen in the floor.
      const cones = this.#lights.spots.map(({ cone }) => cone).filter(({ visible }) => visible);
      for (const cone of cones) cone.visible = false;
      mirror.render(this.#renderer, scene, camera, floor);
      for (const cone of cones) cone.visible = true;
      shadowMap.autoUpdate = false;
    }
    this.#renderer.setRenderTarget(this.#picture.target);
    this.#renderer.render(scene, camera);
    this.#picture.finish(camera, this.#camera.targetDistance);
    this.#inset.render(this.#renderer, scene, this.#closeUpOf(this.#inset.player));
    this.#drawnFrom.copy(camera.position);
    this.#changed = false;
    this.#pictures += 1;
    this.onPicture?.();
    if (this.#camera.moving) this.#drawSoon();
    return true;
  }

  /** Draw the last frame again with the next picture: the camera moved, or the score came. */
  #drawSoon(): void {
    this.#changed = true;
    if (this.#redraw !== 0 || this.#disposed) return;
    this.#redraw = requestAnimationFrame(() => {
      this.#redraw = 0;
      if (this.#changed && this.#drawnIndex >= 0) this.#render();
    });
  }

  /** three.js makes buffers and textures anew by itself, but not what it had drawn into them. */
  readonly #restore = (): void => {
    this.#scene.environment = this.#reflections.render(this.#renderer);
    this.#drawSoon();
  };

  /** @param pixelRatio of the device; the tier may draw with less. */
  resize(width: number, height: number, pixelRatio: number): void {
    const ratio = Math.min(pixelRatio, this.#tier.largestPixelRatio);
    this.#renderer.setPixelRatio(ratio);
    this.#renderer.setSize(width, height, false);
    this.#height = Math.max(1, height * ratio);
    this.#room.mirror?.resize(width * ratio, height * ratio);
    this.#picture.resize(width * ratio, height * ratio);
    this.#camera.resize(width, height);
    this.#drawSoon();
  }

  /** Keep the show's 16:9 frame clear of what lies over the canvas's edges, CSS pixels from each. */
  setSafeArea(insets: Insets): void {
    this.#camera.setSafeArea(insets);
    this.#drawSoon();
  }

  /**
   * Show a player's valves, or the feet at a kit, in a small picture of their own; null for none.
   *
   * @param player of several, the one whose they are: a place in the cast.
   */
  setInset(place: InsetPlace | null, player = 0): void {
    Object.assign(this.#inset, { place, player });
    this.#drawSoon();
  }

  /** Views that `viewPreset` goes to. */
  get cameraPresets(): readonly CameraPreset[] {
    return CAMERA_PRESETS;
  }

  /**
   * Take the camera to a preset's view, or one of a drummer's kit; returns false where there is none of that name.
   *
   * @param player of several, the one who is looked at: a place in the cast.
   */
  viewPreset(name: string, player = 0): boolean {
    const kit = this.#players.kit(player);
    const ofKit = kit === null ? null : kitView(name, kit, this.#others(player));
    if (ofKit !== null) {
      this.#camera.view(ofKit);
      return true;
    }
    const preset = findPreset(name);
    if (preset === null) return false;
    this.#camera.view(this.#presetOf(preset, player));
    return true;
  }

  /** What the small picture shows of a player. */
  #closeUpOf(player: number): FramedView {
    const kit = this.#players.kit(player);
    return (kit === null ? null : kitView("kit_feet", kit)) ?? this.#presetOf(VALVES, player);
  }

  /** A view as it is of one of several players. */
  #presetOf(preset: FramedView, player: number): FramedView {
    const stand = this.#players.count > 1 ? this.#players.stands()[player] : undefined;
    return stand === undefined ? preset : viewAt(preset, stand);
  }

  /** Where everybody stands but one. */
  #others(player: number): Stand[] {
    return this.#players.stands().filter((_, other) => other !== player);
  }

  /** Take the camera to where the whole cast is seen. */
  viewCast(): void {
    this.#camera.view(castView(this.#players.stands(), this.#camera.camera.aspect));
  }

  /** Take the camera to one player, a place in the cast; where so many do not play it stays. */
  viewPlayer(player: number): void {
    const kit = this.#players.kit(player);
    const stand = this.#players.stands()[player];
    if (kit !== null) this.#camera.view(drummerView(kit, this.#others(player)));
    else if (stand !== undefined) this.#camera.view(playerView(stand));
  }

  /**
   * The player who is seen at a place of the canvas, a place in the cast; null for none.
   *
   * @param x share of the canvas's width from its left, 0 to 1.
   * @param y share of its height from its top.
   */
  playerAt(x: number, y: number): number | null {
    this.#caster.setFromCamera(new Vector2(2 * x - 1, 1 - 2 * y), this.#camera.camera);
    return this.#players.pick(this.#caster.ray);
  }

  /** Take the camera to where some places of the world and the players are seen, from above and from the side. */
  viewPlaces(places: readonly Place[]): void {
    this.#camera.view(overview(places));
  }

  /** Where a place of the world is in the picture that was drawn last, CSS pixels; null behind the camera. */
  pointOf(place: Place): PicturePoint | null {
    return this.#space.pointOf(place);
  }

  /** A place of the world moved along the picture by so many CSS pixels. */
  movedInPicture(place: Place, right: number, down: number): [number, number, number] {
    return this.#space.moved(place, right, down);
  }

  /** The show's own camera: where it stands and looks, and the corners of what it sees, so many metres before it. */
  showCamera(distance: number): ShowCamera {
    const { show } = this.#camera;
    return {
      position: show.position.toArray(),
      target: show.target.toArray(),
      corners: this.#space.cornersOf(show, distance),
    };
  }

  /** The view that is seen, as a show's camera keys hold it: metres and radians, the field of view for 16:9. */
  currentView(): CameraView {
    return this.#camera.current();
  }

  /** Where the camera stood in the picture that was drawn last, in the world, metres. */
  get drawnFrom(): [number, number, number] {
    return this.#drawnFrom.toArray();
  }

  /** Take the camera around what it looks at: to its own right and up for positive angles, radians. */
  orbitBy(azimuth: number, elevation: number): void {
    this.#camera.orbitBy(azimuth, elevation);
  }

  /** Take the camera to so many times its distance from what it looks at, as near and as far as it may go. */
  dollyBy(factor: number): void {
    this.#camera.dollyBy(factor);
  }

  /** Leave the camera where it is, free to be orbited. */
  takeCamera(): void {
    this.#camera.take();
  }

  /** Give the camera back to the show. */
  giveBackCamera(): void {
    this.#camera.giveBack();
  }

  /** Show only the models' meshes whose names fit, without room and notes; null shows everything. For a look at one part. */
  isolate(part: RegExp | null): void {
    this.#room.object.visible = part === null;
    this.#onlyModels = part !== null;
    for (const { object } of this.#models) {
      object.traverse((node) => {
        if (node instanceof Mesh && node.name !== OUTLINE) node.visible = part?.test(node.name) ?? true;
      });
    }
    this.#drawSoon();
  }

  /** The joints' local rotations as they stand in the scene, x y z w, by joint name. */
  boneQuaternions(): Record<string, [number, number, number, number]> {
    const rotations: Record<string, [number, number, number, number]> = {};
    for (const model of this.#models) model.readRotations(rotations);
    return rotations;
  }

  dispose(): void {
    this.#disposed = true;
    cancelAnimationFrame(this.#redraw);
    this.#canvas.removeEventListener("webglcontextrestored", this.#restore);
    this.#camera.dispose();
    this.#lights.dispose();
    this.#blocks.dispose();
    this.#look.release();
    this.#picture.dispose();
    release(this.#scene);
    this.#room.mirror?.dispose();
    this.#reflections.dispose();
    this.#renderer.dispose();
  }
}
