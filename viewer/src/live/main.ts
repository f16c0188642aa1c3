/** Opens the live page: the result and the solver are unpacked, the result is shown, and the solver takes over. */

import "../style.css";
import "./live.css";
import { App } from "../app";
import { bytes, unpacked } from "../data/unpack";
import type { ResultDocument } from "../data/types";
import { handleOf } from "../handle";
import { h } from "../panel/dom";
import { Live } from "./live";
import type { LiveModel } from "./live";
import { Solver } from "./solver";

declare global {
  interface Window {
    live?: Live;
  }
}

function modelsOf(document: ResultDocument): LiveModel[] {
  const list = document.study === "live" ? (document.models as ResultDocument[]) : [document];
  return list.map((own) => ({ name: own.model, document: own, text: textIn(own) }));
}

/** The model file of a document; all studies of a run have the same. */
function textIn(document: ResultDocument): string | undefined {
  const inner = Object.values((document.studies as Record<string, ResultDocument> | undefined) ?? {});
  return [document, ...inner].map((own) => own.scene?.text).find((text) => text !== undefined);
}

const textOf = (id: string): string => document.getElementById(id)?.textContent ?? "";

async function open(): Promise<void> {
  const root = document.getElementById("page");
  if (!root) return;
  try {
    const models = modelsOf(JSON.parse(await unpacked(textOf("document"))) as ResultDocument);
    const app = new App(root, models[0]!.document);
    window.flexura = handleOf(app);
    document.documentElement.dataset.ready = "true";
    const live = new Live(app, new Solver(await WebAssembly.compile(await bytes(textOf("solver")))), models);
    window.live = live;
    await live.begin();
    document.documentElement.dataset.live = "true";
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    root.prepend(h("p", { class: "waiting bad", role: "alert" }, `The live page cannot start: ${why}`));
    document.documentElement.dataset.ready ??= "failed";
    document.documentElement.dataset.live = "failed";
  }
}

void open();
