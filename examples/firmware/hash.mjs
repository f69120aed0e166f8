// hash.mjs MODULE SCENE: the hash of a scene's results, computed by a WebAssembly module that imports nothing.
import { readFileSync } from "node:fs";

const [file, scene] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(file), {});
const hash = BigInt.asUintN(64, instance.exports[scene]());
console.log(`hash of 10000 results: ${hash.toString(16).padStart(16, "0")}`);
