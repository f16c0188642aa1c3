import { createHash } from "node:crypto";
import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

/** Where `crates/report` keeps the page. */
const PAGE = fileURLToPath(new URL("../crates/report/src/page.html", import.meta.url));

/** Writes the page with a policy that lets it run its own script and style, known by their hashes, and load nothing. */
function sealed(): Plugin {
  return {
    name: "sealed",
    enforce: "post",
    generateBundle: {
      order: "post",
      handler(_options, bundle) {
      const html = bundle["index.html"];
      if (html?.type !== "asset") throw new Error("there is no index.html");
      const text = String(html.source);
      const hashes = (element: RegExp): string[] =>
        [...text.matchAll(element)].map((match) => {
          const digest = createHash("sha256").update(match[1] ?? "").digest("base64");
          return `'sha256-${digest}'`;
        });
      const scripts = hashes(/<script type="module"[^>]*>([\s\S]*?)<\/script>/g);
      const styles = hashes(/<style[^>]*>([\s\S]*?)<\/style>/g);
      if (scripts.length !== 1 || styles.length !== 1) throw new Error(`one script and one style are wanted, not ${scripts.length} and ${styles.length}`);
      const policy = [
        "default-src 'none'",
        `script-src ${scripts.join(" ")}`,
        `style-src ${styles.join(" ")}`,
        "img-src data: blob:",
        "worker-src blob:",
        "base-uri 'none'",
        "form-action 'none'",
      ].join("; ");
      if (!text.includes("@policy@")) throw new Error("the page has no place for its policy");
      html.source = text.replace("@policy@", () => policy);
      writeFileSync(PAGE, html.source);
      },
    },
  };
}

export default defineConfig({
  plugins: [viteSingleFile({ removeViteModuleLoader: true }), sealed()],
  build: { target: "es2022", modulePreload: false, assetsInlineLimit: Number.MAX_SAFE_INTEGER },
});
