/** What is packed into the page: base64 of gzip. */

export async function bytes(packed: string): Promise<ArrayBuffer> {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("this browser cannot unpack the result (it lacks DecompressionStream); a newer one can");
  }
  const letters = atob(packed.trim());
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

/** The same as text. */
export async function unpacked(packed: string): Promise<string> {
  return new TextDecoder().decode(await bytes(packed));
}
