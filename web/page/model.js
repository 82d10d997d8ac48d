// Models: built-in ones, and those of files that were chosen or dropped.

import { Files, Model } from "./tinta.js";

/** Endings of files that a model may name and that are no models. */
export const BESIDE = ["mtl", "bin", "png", "jpg", "jpeg", "bmp", "tga", "pcx", "ppm"];

/** The model among files, with those beside it; undefined where all are of the other kind. */
export async function ofFiles(files) {
  const bytesOf = async (file) => ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
  const all = await Promise.all([...files].map(bytesOf));
  const model = all.find(({ name }) => !BESIDE.includes(name.replace(/.*\./, "").toLowerCase()));
  return model && { ...model, beside: all.filter((file) => file !== model) };
}

/** The model that stands in the page: the first of its files, with the others beside it. */
export function ofLesson({ files }, bytes) {
  const [model, ...beside] = files.map((name) => ({ name, bytes: bytes(`model/${name}`) }));
  return { ...model, beside };
}

/** Reads a requested model with these options. */
export function read({ name, bytes, beside }, options) {
  if (!bytes) return Model.builtin(name, options);
  const files = new Files();
  try {
    for (const file of beside) files.add(file.name, file.bytes);
    return Model.read(name, bytes, files, options);
  } finally {
    files.free();
  }
}

/** The name of a file about a model, without its folder and ending. */
export const stem = (name) => name.replace(/^.*[/\\:]/, "").replace(/\.[^.]*$/, "");
