// Shared by the tests: reports to the server, the command line's pictures, comparison of pictures.

/** An address of the server that has these tests: the page may be a file. */
const address = (path) => new URL(path, import.meta.url);
const report = (body) => fetch(address("/report"), { method: "POST", body: JSON.stringify(body) });

/** Runs a test and reports whether it passed, with its result. */
export async function test(name, work) {
  try {
    const note = await work();
    await report({ name, ok: true, note: note ? `: ${note}` : "" });
  } catch (problem) {
    await report({ name, ok: false, note: `: ${problem.message ?? problem}` });
  }
}

/** All is done. */
export const finish = () => report({ done: true });

export function assert(holds, problem) {
  if (!holds) throw new Error(problem);
}

/** Waits until something holds, up to a minute. */
export async function until(holds, what) {
  const end = performance.now() + 60_000;
  while (!holds()) {
    assert(performance.now() < end, `${what} did not come about`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

/** The bytes of the command line's picture with these options, the file's name last. */
export async function drawn(...words) {
  const answer = await fetch(address(`/drawn?${encodeURIComponent(JSON.stringify(words))}`));
  if (!answer.ok) throw new Error(await answer.text());
  return new Uint8Array(await answer.arrayBuffer());
}

/** A PNG's pixels, unconverted. */
export async function pixels(png) {
  const picture = await createImageBitmap(new Blob([png]), { premultiplyAlpha: "none", colorSpaceConversion: "none" });
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  const context = canvas.getContext("2d");
  context.drawImage(picture, 0, 0);
  return context.getImageData(0, 0, picture.width, picture.height).data;
}

/** The share of pixels with a channel that differs by more than this. */
export function differing(a, b, by) {
  assert(a.length === b.length, `${a.length} and ${b.length} bytes`);
  let count = 0;
  for (let at = 0; at < a.length; at += 4) {
    if ([0, 1, 2].some((channel) => Math.abs(a[at + channel] - b[at + channel]) > by)) count += 1;
  }
  return count / (a.length / 4);
}

/** The ink of a picture of lines on white: how far each pixel is from white in its darkest channel. */
export function darkness(pixels) {
  return Uint8Array.from({ length: pixels.length / 4 }, (_, at) => 255 - Math.min(pixels[at * 4], pixels[at * 4 + 1], pixels[at * 4 + 2]));
}

/**
 * The share of a picture's squares of 32 pixels whose tone differs by more than grains that turn over at random make it: by more
 * than 4.5 standard deviations of the sum of their differences. Chance alone gives one square in 100,000.
 */
export function biased(a, b, width) {
  const side = 32;
  const columns = width / side;
  const [sums, squares] = [0, 1].map(() => new Float64Array(a.length / 4 / side / side));
  for (let at = 0; at < a.length; at += 4) {
    const pixel = at >> 2;
    const square = Math.floor(Math.floor(pixel / width) / side) * columns + Math.floor((pixel % width) / side);
    sums[square] += a[at] - b[at];
    squares[square] += (a[at] - b[at]) ** 2;
  }
  return sums.filter((sum, square) => Math.abs(sum) > 4.5 * Math.sqrt(squares[square])).length / sums.length;
}

/** Where two texts begin to differ. */
export function byteDifference(found, expected) {
  const at = [...found].findIndex((letter, place) => letter !== expected[place]);
  const near = (text) => JSON.stringify(text.slice(Math.max(0, at - 20), at + 60));
  return `${found.length} and ${expected.length} letters; ${near(found)} for ${near(expected)}`;
}
