/** Elements of the page. Text always goes in as text, so that no name can become markup. */

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | ((event: Event) => void) | undefined>;

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name, value);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

/** A button with a name that a screen reader says. */
export function button(text: string, label: string, click: () => void, extra: Attributes = {}): HTMLButtonElement {
  return h("button", { type: "button", "aria-label": label, title: label, click, ...extra }, text);
}

/** A box to tick. */
export function tick(text: string, isOn: boolean, change: (isOn: boolean) => void, id: string): HTMLLabelElement {
  const input = h("input", { type: "checkbox", id, checked: isOn });
  input.addEventListener("change", () => change(input.checked));
  return h("label", { class: "tick", for: id }, input, text);
}

/** A choice; the values are positions in the list. */
export function choice(
  label: string,
  names: string[],
  chosen: number,
  change: (index: number) => void,
  id: string,
): HTMLLabelElement {
  const select = h("select", { id, "aria-label": label });
  names.forEach((name, i) => select.append(h("option", { value: i, selected: i === chosen }, name)));
  select.addEventListener("change", () => change(Number(select.value)));
  return h("label", { class: "choice", for: id }, h("span", {}, label), select);
}

/** Hands a file to the browser. */
export function save(name: string, content: Blob | string): void {
  const url = typeof content === "string" ? content : URL.createObjectURL(content);
  const link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  if (typeof content !== "string") setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Puts text on the clipboard; true where that went well. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // A page in a frame may not use the clipboard; the old way still works there.
    const area = h("textarea", { class: "aside", "aria-hidden": "true" });
    area.value = text;
    document.body.append(area);
    area.select();
    const isDone = document.execCommand("copy");
    area.remove();
    return isDone;
  }
}

/** A name that every system takes for a file's. */
export function fileName(name: string, ending: string): string {
  const plain = name.replace(/[^A-Za-z0-9._-]+/g, "_").replace(/^[._]+/, "").slice(0, 60);
  return `${plain || "mechanism"}.${ending}`;
}
