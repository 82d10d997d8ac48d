// Times of the page on this machine: reported, never judged.

import init, { Files, Model } from "./tinta.js";
import { program } from "./files.js";
import { finish, test } from "./harness.js";

const median = (values) => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)];
const said = (values, unit) => `${median(values).toFixed(1)} ${unit}, of ${values.map((value) => value.toFixed(1)).join(" ")}`;
const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));

/** Opens the page in a frame and waits for its first picture. */
async function opened() {
  const page = document.createElement("iframe");
  Object.assign(page.style, { width: "1000px", height: "900px", border: "0" });
  const start = performance.now();
  page.src = "index.html";
  document.body.append(page);
  const canvas = () => page.contentDocument?.getElementById("left");
  const isDrawn = () => {
    const left = page.contentWindow?.tinta && canvas();
    const middle = left?.width && left.getContext("2d").getImageData(left.width / 2, left.height / 2, 1, 1).data;
    return middle && middle[3] > 0;
  };
  while (!isDrawn()) await new Promise((resolve) => setTimeout(resolve, 1));
  return { page, ms: performance.now() - start };
}

// The browser is new, and has fetched and compiled nothing of the page but one script.
await test("first picture of a cold load", async () => {
  const { page, ms } = await opened();
  page.remove();
  return said([ms], "ms");
});

await test("first picture of a warm load", async () => {
  const times = [];
  for (let round = 0; round < 5; round += 1) {
    const { page, ms } = await opened();
    times.push(ms);
    page.remove();
  }
  return said(times, "ms");
});

await test("a turn of the bust by the pointer, one style in each pane", async () => {
  const { page } = await opened();
  const view = page.contentWindow;
  const stage = page.contentDocument.getElementById("stage");
  const box = stage.getBoundingClientRect();
  const pointer = (type, x) =>
    stage.dispatchEvent(new view.PointerEvent(type, { pointerId: 1, bubbles: true, buttons: 1, clientX: box.left + x, clientY: box.top + 200 }));
  pointer("pointerdown", 100);
  const times = [];
  for (let step = 0; step < 60; step += 1) {
    const start = performance.now();
    pointer("pointermove", 100 + 3 * step);
    await frame();
    await frame();
    times.push((performance.now() - start) / 2);
  }
  pointer("pointerup", 300);
  page.remove();
  return said([1000 / median(times)], "pictures a second at most, by frames that the browser shows");
});

await test("the bunny's lines as SVG", async () => {
  await init({ module_or_path: await program() });
  const answer = await fetch("/models/stanford-bunny.obj");
  if (!answer.ok) return "SKIPPED: TINTA_MODELS names no folder with stanford-bunny.obj";
  const model = Model.read("stanford-bunny.obj", new Uint8Array(await answer.arrayBuffer()), new Files(), "{}");
  const times = [];
  for (let round = 0; round < 5; round += 1) {
    const start = performance.now();
    model.svg("{\"size\": \"512x512\"}", false);
    times.push(performance.now() - start);
  }
  return said(times, "ms");
});

await finish();
