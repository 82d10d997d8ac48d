// The files inside a page that is one file: unpacked, and given addresses by which modules, workers and pictures are loaded.
(async () => {
  if (!globalThis.DecompressionStream) return tintaFails("This browser cannot unpack this page. Use a browser of 2023 or newer.");
  const packed = new Map();
  for (const part of document.querySelectorAll("script[data-file]")) {
    packed.set(part.dataset.file, Uint8Array.from(atob(part.textContent.trim()), (letter) => letter.charCodeAt(0)));
    part.remove();
  }
  const unpacked = async (bytes) =>
    new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer());
  const files = new Map(await Promise.all([...packed].map(async ([name, bytes]) => [name, await unpacked(bytes)])));
  const addresses = new Map();
  const address = (name) => {
    if (!addresses.has(name)) {
      const isScript = name.endsWith(".js");
      // A module names others by their place beside it; here each has an address of its own.
      const text = () => new TextDecoder().decode(files.get(name)).replace(/from "\.\/([^"]+)"/g, (_, other) => `from "${address(other)}"`);
      const types = { js: "text/javascript", svg: "image/svg+xml", txt: "text/plain;charset=utf-8" };
      const type = types[name.replace(/.*\./, "")] ?? "image/png";
      addresses.set(name, URL.createObjectURL(new Blob([isScript ? text() : files.get(name)], { type })));
    }
    return addresses.get(name);
  };
  const lesson = document.getElementById("lesson");
  globalThis.tintaFiles = {
    has: (name) => files.has(name),
    bytes: (name) => files.get(name),
    address: (name) => (files.has(name) ? address(name) : undefined),
    lesson: lesson ? JSON.parse(lesson.textContent) : undefined,
  };
  await import(address("main.js"));
})();
