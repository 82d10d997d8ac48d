// The page's files: those of its server, or those inside the page where all is one file.

/** The files inside, by their names: an address each, and their bytes; undefined on a server. */
const inside = globalThis.tintaFiles;

/** What whoever made the page put into it: a model and a link; undefined on a server. */
export const lesson = inside?.lesson;

/** Whether the page has this file. A server may have any. */
export const has = (name) => !inside || inside.has(name);

/** The address of a file, for a worker or a picture. */
export const address = (name) => inside?.address(name) ?? name;

/** A file's text. */
export async function text(name) {
  if (inside) return new TextDecoder().decode(inside.bytes(name));
  return (await answered(name)).text();
}

async function answered(name) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`the server answers ${answer.status} for ${name}; copy the whole folder`);
  return answer;
}

/** The compiled program. It is compressed, because few servers of files compress what they send. */
export async function program() {
  if (inside) return WebAssembly.compile(inside.bytes("tinta_bg.wasm"));
  if (!globalThis.DecompressionStream) return WebAssembly.compile(await (await answered("tinta_bg.wasm")).arrayBuffer());
  const answer = await answered("tinta_bg.wasm.gz");
  const isPlain = answer.headers.get("Content-Encoding");
  const plain = isPlain ? answer.body : answer.body.pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compileStreaming(new Response(plain, { headers: { "Content-Type": "application/wasm" } }));
}
