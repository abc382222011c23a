import globals from "globals";
import svelte from "eslint-plugin-svelte";
import ts from "typescript-eslint";
import { defineConfig, globalIgnores } from "eslint/config";
import svelteConfig from "./svelte.config.js";

const noThree = {
  group: ["three", "three/*"],
  message: "Only src/scene, src/rig and src/lab/scene draw with three.js; use Stage from src/scene.",
};
const noSocket = {
  name: "WebSocket",
  message: "Only src/connection touches the WebSocket.",
};

export default defineConfig(
  globalIgnores(["dist", "src/generated"]),
  ts.configs.strictTypeChecked,
  ts.configs.stylisticTypeChecked,
  svelte.configs.recommended,
  {
    languageOptions: {
      globals: { ...globals.browser },
      parserOptions: { projectService: true, extraFileExtensions: [".svelte"] },
    },
    rules: {
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
      "@typescript-eslint/no-confusing-void-expression": ["error", { ignoreArrowShorthand: true }],
      eqeqeq: "error",
      "no-restricted-imports": ["error", { patterns: [noThree] }],
      "no-restricted-globals": ["error", noSocket],
    },
  },
  {
    files: ["**/*.svelte", "**/*.svelte.ts"],
    languageOptions: { parserOptions: { parser: ts.parser, svelteConfig } },
    rules: {
      // Svelte's `let { … } = $props()` and bound values are reassigned by the compiler.
      "prefer-const": "off",
    },
  },
  {
    // The editor's sets and maps are values: never changed, replaced as wholes in $state.raw.
    files: ["src/editor/**"],
    rules: { "svelte/prefer-svelte-reactivity": "off" },
  },
  { files: ["src/connection/**"], rules: { "no-restricted-globals": "off" } },
  {
    files: ["src/scene/**", "src/rig/**", "src/lab/scene/**"],
    rules: { "no-restricted-imports": "off" },
  },
  {
    files: ["scripts/**"],
    extends: [ts.configs.disableTypeChecked],
    languageOptions: { globals: { ...globals.node }, parserOptions: { projectService: false } },
  },
);
