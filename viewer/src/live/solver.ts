/** The solver in its worker: requests go in, answers come back in their order. */

import type { ResultDocument } from "../data/types";
import type { Vec } from "../math";
import source from "./worker.js?raw";

export interface Problem {
  is_warning: boolean;
  /** From 1; 0 where it stands in no line. */
  line: number;
  column: number;
  from: number;
  to: number;
  path: string;
  message: string;
  hint: string | null;
  shown: string;
}

export interface Parameter {
  name: string;
  value: number;
  unit: string;
  range: [number, number];
  is_found: boolean;
  is_structural: boolean;
}

export interface Grip {
  name: string;
  kind: "load" | "drive";
  body?: string;
  beam?: string;
  s?: number;
  position: Vec;
  parameters: string[];
}

export interface Answer {
  problems: Problem[];
  opened?: { model: string; parameters: Parameter[]; studies: [string, string][]; has_unknowns: boolean };
  document?: ResultDocument;
  way?: "near" | "rest" | "kept";
  reason?: string;
  /** Is what is dragged where the pointer is? */
  is_there?: boolean;
  values?: [string, number][];
  grips?: Grip[];
  /** How long it took, ms. */
  took: number;
}

export type Request =
  | { do: "open"; text: string; name: string; set?: [string, string][]; inverse: boolean }
  | { do: "solve"; samples?: number }
  | { do: "step"; values?: [string, number][]; set?: [string, string][]; samples?: number }
  | { do: "grips" }
  | { do: "drag"; grip: number; to: Vec; eye: Vec; samples?: number }
  | { do: "release" }
  | { do: "study"; name: string }
  | { do: "trace"; parameter: string; range: [number, number] }
  | { do: "stability" };

interface Reply {
  id: number;
  text?: string;
  broken?: string;
  took?: number;
}

export class Ended extends Error {}

export class Solver {
  private worker!: Worker;
  private waiting = new Map<number, { done: (reply: Reply) => void; fail: (why: Error) => void }>();
  private next = 0;
  private ready!: Promise<unknown>;
  private readonly url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));

  constructor(private readonly module: WebAssembly.Module) {
    this.start();
  }

  private start(): void {
    this.worker = new Worker(this.url);
    this.worker.addEventListener("message", ({ data }: MessageEvent<Reply>) => {
      const waiting = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      waiting?.done(data);
    });
    this.worker.addEventListener("error", (event) => this.fail(new Error(event.message)));
    this.ready = this.post({ module: this.module });
    this.ready.catch(() => undefined);
  }

  private post(message: object): Promise<Reply> {
    const id = ++this.next;
    return new Promise((done, fail) => {
      this.waiting.set(id, { done, fail });
      this.worker.postMessage({ ...message, id });
    });
  }

  private fail(why: Error): void {
    const waiting = [...this.waiting.values()];
    this.waiting.clear();
    for (const { fail } of waiting) fail(why);
  }

  get isBusy(): boolean {
    return this.waiting.size > 0;
  }

  async ask(request: Request): Promise<Answer> {
    await this.ready;
    const reply = await this.post({ request: JSON.stringify(request) });
    if (reply.broken !== undefined || reply.text === undefined) {
      // Its memory is not to be trusted after that.
      this.restart();
      throw new Error(`the solver broke off, which is a bug in flexura: ${reply.broken ?? ""}`);
    }
    return { ...(JSON.parse(reply.text) as Answer), took: reply.took ?? 0 };
  }

  /** Ends whatever it does; nothing is open after that. */
  restart(): void {
    this.worker.terminate();
    this.fail(new Ended("ended"));
    this.start();
  }
}
