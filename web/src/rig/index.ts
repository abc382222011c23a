export { RigError, type RigDocument } from "./document";
export { loadRig, type LoadedRig } from "./load";
export { mergeMeshes, SHADOW_ELSEWHERE } from "./merge-meshes";
export { RigModel, type RigPoint } from "./model";
