/** Exits with 0 where this Node is one that package.json names, else with another status. */
import { readFileSync } from "node:fs";

const { engines } = JSON.parse(readFileSync(new URL("../package.json", import.meta.url), "utf8"));
const [major, minor] = process.versions.node.split(".").map(Number);
const fits = engines.node.split(" || ").some((range) => {
  const [, sign, leastMajor, leastMinor] = /^(\^|>=)(\d+)\.(\d+)$/.exec(range);
  if (major !== Number(leastMajor)) return sign === ">=" && major > Number(leastMajor);
  return minor >= Number(leastMinor);
});
process.exitCode = fits ? 0 : 1;
