/** Opens the page: unpacks the document and shows it, or says why that cannot be. */

import "./style.css";
import { App } from "./app";
import { unpacked } from "./data/unpack";
import { handleOf } from "./handle";
import type { ResultDocument } from "./data/types";
import { h } from "./panel/dom";

async function open(): Promise<void> {
  const root = document.getElementById("page");
  const packed = document.getElementById("document")?.textContent ?? "";
  if (!root) return;
  try {
    const app = new App(root, JSON.parse(await unpacked(packed)) as ResultDocument);
    window.flexura = handleOf(app);
    document.documentElement.dataset.ready = "true";
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    root.replaceChildren(h("p", { class: "waiting", role: "alert" }, `The result cannot be shown: ${why}`));
    document.documentElement.dataset.ready = "failed";
  }
}

void open();
