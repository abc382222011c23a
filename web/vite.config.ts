import { readFileSync } from "node:fs";
import { svelte } from "@sveltejs/vite-plugin-svelte";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

// `REINA_URL=http://127.0.0.1:8000 npm run dev` develops the page against a running server.
const server = process.env["REINA_URL"] ?? "http://127.0.0.1:8000";

/** Puts into a page's head what finds its language, and into index.html its first words in the languages beside English. */
function firstWords(): Plugin {
  const read = (path: string): string => readFileSync(new URL(`src/words/${path}`, import.meta.url), "utf8");
  return {
    name: "first-words",
    transformIndexHtml: {
      order: "pre",
      handler: (html) => {
        const words = ["de", "ja"].map((code) => `"${code}": ${read(`first/${code}.json`).trim()}`);
        return html
          .replace(
            /<script src="\/src\/words\/first-language.js"><\/script>/,
            () => `<script>${read("first-language.js")}</script>`,
          )
          .replace("FIRST_WORDS", () => `{ ${words.join(", ")} }`);
      },
    },
  };
}

export default defineConfig(({ mode }) => ({
  plugins: [svelte(), firstWords()],
  build: {
    target: "es2023",
    chunkSizeWarningLimit: 1200,
    // What the page is delivered with asks for its licences to be delivered too.
    license: { fileName: mode === "lab" ? "licences-lab.md" : "licences.md" },
    // The lab, at /lab, is built by itself (`--mode lab`): the player's page loads nothing of it, nor shares with it.
    ...(mode === "lab" ? { emptyOutDir: false, copyPublicDir: false, rolldownOptions: { input: "lab.html" } } : {}),
  },
  server: {
    proxy: { "/api": { target: server, ws: true, changeOrigin: true } },
  },
  test: { include: ["src/**/*.test.ts"], environment: "node" },
}));
