/**
 * What the browser calls the sound device that it plays on; empty where it does not say, as most do not before the
 * person has let the page use a microphone.
 */
export async function outputDevice(devices: Pick<MediaDevices, "enumerateDevices"> | undefined): Promise<string> {
  try {
    const outputs = ((await devices?.enumerateDevices()) ?? []).filter(({ kind }) => kind === "audiooutput");
    return (outputs.find(({ deviceId }) => deviceId === "default") ?? outputs[0])?.label ?? "";
  } catch {
    return "";
  }
}
