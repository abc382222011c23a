import { ReinaApi } from "../connection";
import type {
  ForwardRequest,
  InterpolationComparison,
  InterpolationRequest,
  InverseAnswer,
  InverseRequest,
  LabChain,
  LabChainList,
  LabClip,
  LabClipList,
  LabPose,
  ParsedClip,
  ReachCells,
  ReachRequest,
} from "../generated/lab";

const LAB = "/api/v1/lab";

/** What a joint's position channels mean: its place, or how far it is from its OFFSET. */
export type PositionMeaning = "replace" | "add";

/** The laboratory's calls, typed. Each throws ProblemError when the server refuses or does not answer. */
export class LabApi {
  readonly #api: ReinaApi;

  constructor(api = new ReinaApi()) {
    this.#api = api;
  }

  interpolations(request: InterpolationRequest): Promise<InterpolationComparison> {
    return this.#json("interpolations", { json: request });
  }

  async chains(): Promise<LabChain[]> {
    return (await this.#json<LabChainList>("chains")).chains;
  }

  forward(request: ForwardRequest): Promise<LabPose> {
    return this.#json("forward", { json: request });
  }

  inverse(request: InverseRequest): Promise<InverseAnswer> {
    return this.#json("inverse", { json: request });
  }

  reach(request: ReachRequest): Promise<ReachCells> {
    return this.#json("reach", { json: request });
  }

  async clips(): Promise<LabClip[]> {
    return (await this.#json<LabClipList>("clips")).clips;
  }

  readClip(file: Blob, positions: PositionMeaning): Promise<ParsedClip> {
    return this.#json(`bvh?positions=${positions}`, { body: file });
  }

  /** The same motion as Reina writes it. */
  async rewrittenClip(file: Blob, positions: PositionMeaning): Promise<Blob> {
    return (await this.#api.request("POST", `${LAB}/bvh/rewritten?positions=${positions}`, { body: file })).blob();
  }

  async file(href: string): Promise<Blob> {
    return (await this.#api.request("GET", href)).blob();
  }

  async #json<T>(path: string, sent?: { json?: unknown; body?: XMLHttpRequestBodyInit }): Promise<T> {
    const method = sent === undefined ? "GET" : "POST";
    return (await (await this.#api.request(method, `${LAB}/${path}`, sent)).json()) as T;
  }
}
