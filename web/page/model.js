// Models: built-in ones, and those of files that were chosen or dropped.

import { Files, Model } from "./tinta.js";

/** Endings of files that a model may name and that are no models. */
const BESIDE = /\.(mtl|bin|png|jpe?g|bmp|tga|pcx|ppm)$/i;

/** The model among files, with those beside it; undefined where all are of the other kind. */
export async function ofFiles(files) {
  const bytesOf = async (file) => ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
  const all = await Promise.all([...files].map(bytesOf));
  const model = all.find(({ name }) => !BESIDE.test(name));
  return model && { ...model, beside: all.filter((file) => file !== model) };
}

/** Reads a requested model. */
export function read({ name, bytes, beside }) {
  if (!bytes) return Model.builtin(name);
  const files = new Files();
  try {
    for (const file of beside) files.add(file.name, file.bytes);
    return Model.read(name, bytes, files);
  } finally {
    files.free();
  }
}
