import { svelte } from "@sveltejs/vite-plugin-svelte";
import { defineConfig } from "vitest/config";

// `REINA_URL=http://127.0.0.1:8000 npm run dev` develops the page against a running server.
const server = process.env["REINA_URL"] ?? "http://127.0.0.1:8000";

export default defineConfig(({ mode }) => ({
  plugins: [svelte()],
  build: {
    target: "es2023",
    chunkSizeWarningLimit: 1200,
    // The lab, at /lab, is built by itself (`--mode lab`): the player's page loads nothing of it, nor shares with it.
    ...(mode === "lab" ? { emptyOutDir: false, copyPublicDir: false, rolldownOptions: { input: "lab.html" } } : {}),
  },
  server: {
    proxy: { "/api": { target: server, ws: true, changeOrigin: true } },
  },
  test: { include: ["src/**/*.test.ts"], environment: "node" },
}));
