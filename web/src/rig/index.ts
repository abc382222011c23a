export { RigError, type RigDocument } from "./document";
export { loadRig, type LoadedRig } from "./load";
export { RigModel } from "./model";
