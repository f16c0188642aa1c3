import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";
import { sealed } from "./seal.ts";

/** Two pages, each one file: that of a result, and, in the mode "live", the one that solves. */
export default defineConfig(({ mode }) => {
  const isLive = mode === "live";
  const page = isLive ? "live.html" : "index.html";
  return {
    plugins: [
      viteSingleFile({ removeViteModuleLoader: true }),
      isLive ? sealed(page, "live.html", "'wasm-unsafe-eval'") : sealed(page, "page.html"),
    ],
    build: {
      target: "es2022",
      modulePreload: false,
      assetsInlineLimit: Number.MAX_SAFE_INTEGER,
      rollupOptions: { input: page },
      outDir: isLive ? "dist/live" : "dist/page",
    },
  };
});
