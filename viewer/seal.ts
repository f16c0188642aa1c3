import { createHash } from "node:crypto";
import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import type { Plugin } from "vite";

/** Writes a page into `crates/report/src`, with a policy that lets it run its own script and style, known by their hashes, and load
 * nothing; `more` is allowed to its scripts besides. */
export function sealed(page: string, kept: string, more = ""): Plugin {
  return {
    name: "sealed",
    enforce: "post",
    generateBundle: {
      order: "post",
      handler(_options, bundle) {
        const html = bundle[page];
        if (html?.type !== "asset") throw new Error(`there is no ${page}`);
        const text = String(html.source);
        const hashes = (element: RegExp): string[] =>
          [...text.matchAll(element)].map((match) => {
            const digest = createHash("sha256").update(match[1] ?? "").digest("base64");
            return `'sha256-${digest}'`;
          });
        const scripts = hashes(/<script type="module"[^>]*>([\s\S]*?)<\/script>/g);
        const styles = hashes(/<style[^>]*>([\s\S]*?)<\/style>/g);
        if (scripts.length !== 1 || styles.length !== 1) {
          throw new Error(`one script and one style are wanted, not ${scripts.length} and ${styles.length}`);
        }
        const policy = [
          "default-src 'none'",
          `script-src ${[...scripts, more].filter(Boolean).join(" ")}`,
          `style-src ${styles.join(" ")}`,
          "img-src data: blob:",
          "worker-src blob:",
          "base-uri 'none'",
          "form-action 'none'",
        ].join("; ");
        if (!text.includes("@policy@")) throw new Error("the page has no place for its policy");
        html.source = text.replace("@policy@", () => policy);
        writeFileSync(fileURLToPath(new URL(`../crates/report/src/${kept}`, import.meta.url)), html.source);
      },
    },
  };
}
