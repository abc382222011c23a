import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";
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

const VIEWER = createRequire(import.meta.url).resolve("swagger-ui-dist/package.json");

/** Puts what shows the description of the API at /docs beside the page, which loads nothing of it. */
function apiViewer(): Plugin {
  const files = {
    "docs/index.html": new URL("src/docs/index.html", import.meta.url),
    "docs/start.js": new URL("src/docs/start.js", import.meta.url),
    "docs/docs.css": new URL("src/docs/docs.css", import.meta.url),
    ...Object.fromEntries(
      ["swagger-ui-bundle.js", "swagger-ui-bundle.js.LICENSE.txt", "swagger-ui.css", "LICENSE", "NOTICE"].map(
        (name) => [`docs/viewer/${name}`, new URL(name, pathToFileURL(VIEWER))],
      ),
    ),
  };
  return {
    name: "api-viewer",
    generateBundle() {
      for (const [fileName, url] of Object.entries(files)) {
        this.emitFile({ type: "asset", fileName, source: readFileSync(url) });
      }
    },
  };
}

export default defineConfig(({ mode }) => ({
  plugins: [svelte(), firstWords(), ...(mode === "lab" ? [] : [apiViewer()])],
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
