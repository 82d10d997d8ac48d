// Tests of the program and the page in a browser: each reports its name and whether it held.

import init, { Files, Model, Pane, listing, look, shaders, tables as tablesOf } from "./tinta.js";
import { assert, biased, byteDifference, darkness, differing, drawn, finish, pixels, test } from "./harness.js";
import { program } from "./files.js";
import { testPage } from "./page.js";

const SIZE = "512x512";

/** The largest share of pixels that may differ by more than 2 of 255 from the command line's picture. */
const MOST = 0.001;

/**
 * Edges of triangles fall on other pixels in another driver. Where a filter reads each pixel of a map five times, five pixels answer;
 * where lines lie on faces, each of their pixels is hidden or seen by the last bit of a depth.
 */
const TIMES = { "three-pass": 5, "two-pass": 5, mrt: 5, ink: 5, inking: 5 };

/** How far a drawing's F1 against the exact lines may be from the command line's. */
const F1 = 0.003;

/** Styles whose every grain turns over by the last bit of a texture's filter: these differences must cancel in each square of pixels. */
const GRAINY = ["charcoal", "sand"];

globalThis.program = await init({ module_or_path: await program() });
const tables = JSON.parse(tablesOf());
const ofPasses = tables.styles.filter((style) => !style.draws_lines);
const pane = new Pane(document.createElement("canvas"));
await test("WebGL has the bits that the styles need", () => {
  const { renderer, depth_bits, alpha_bits } = JSON.parse(pane.context());
  assert(depth_bits >= 24 && alpha_bits === 8, `${depth_bits} ${alpha_bits}`);
  return renderer;
});

await test("every shader is listed in pieces", () => {
  const paths = JSON.parse(shaders());
  for (const path of paths) assert(JSON.parse(listing(path)).some(([old, now]) => old !== now), path);
  return `${paths.length} shaders`;
});

for (const { name } of tables.models) {
  const model = Model.builtin(name, "{}");
  pane.show(model);
  for (const style of ofPasses.filter((style) => style.name !== "sand" || name === "soldier")) {
    await test(`${style.name} of ${name} is the command line's picture`, async () => {
      const options = { style: style.name, size: SIZE };
      pane.draw(JSON.stringify(options), "final", false);
      const words = ["--style", style.name, "--size", SIZE, "--backend", "egl"];
      const expected = await pixels(await drawn(`builtin:${name}`, ...words, "drawn.png"));
      const grainy = GRAINY.includes(style.name);
      const share = grainy ? biased(pane.pixels(), expected, 512) : differing(pane.pixels(), expected, 2);
      const most = grainy ? 0 : MOST * (TIMES[style.name] ?? 1);
      const percent = `${(share * 100).toFixed(3)} % of the ${grainy ? "squares' tones" : "pixels"} differ`;
      assert(share <= most, `${percent}; at most ${most * 100} % may`);
      return percent;
    });
    if (["three-pass", "mrt", "inking", "dietrich", "ink"].includes(style.name)) {
      await test(`the lines of ${style.name} of ${name} are as good as the command line's`, async () => {
        const options = JSON.stringify({ style: style.name, size: SIZE });
        const words = ["--style", style.name, "--size", SIZE, "--backend", "egl", "--show", "borders"];
        const borders = await pixels(await drawn(`builtin:${name}`, ...words, "drawn.png"));
        const f1 = [pane.ink(options), darkness(borders)].map((ink) => model.error(options, ink));
        assert(Math.abs(f1[0] - f1[1]) <= F1, `F1 ${f1}`);
        return `F1 ${f1.map((f1) => f1.toFixed(4)).join(" and ")}`;
      });
    }
  }
  await test(`the exact lines of ${name} are the command line's SVG, byte by byte`, async () => {
    for (const [hasRecipe, words] of [
      [false, ["--no-recipe"]],
      [true, []],
    ]) {
      const expected = new TextDecoder().decode(await drawn(`builtin:${name}`, "--style", "lines", "--size", SIZE, ...words, "drawn.svg"));
      const found = model.svg(JSON.stringify({ size: SIZE }), hasRecipe);
      assert(found === expected, byteDifference(found, expected));
    }
  });
  model.free();
}

for (const name of ["bust", "gear", "soldier"]) {
  const print = JSON.parse(look("print"), (_, value) => value ?? undefined);
  // Its switches are flags.
  const settings = Object.fromEntries(Object.entries(print.settings).map(([name, value]) => [name, value === "on" ? true : value]));
  for (const [what, style, words, options] of [
    ["the depth texture of three-pass", "three-pass", ["--map-encoding", "depth-texture"], { "map-encoding": "depth-texture" }],
    // A shadow moves the command's camera; the page keeps its own.
    ["the look print", print.style, ["--look", "print", "--ground", "none"], { ...settings, ...print.scene, ...print.read, ground: "none" }],
  ]) {
    await test(`${what} of ${name} is the command line's picture, again and again`, async () => {
      const isLook = words[0] === "--look";
      const model = Model.builtin(name, JSON.stringify(isLook ? print.read : {}));
      pane.show(model);
      pane.look(isLook ? print.view : "30,15", isLook);
      const shares = [];
      for (const round of [1, 2]) {
        pane.draw(JSON.stringify({ style, size: SIZE, ...options }), "final", false);
        const how = isLook ? words : ["--style", style, "--view", "30,15", ...words];
        const expected = await pixels(await drawn(`builtin:${name}`, ...how, "--size", SIZE, "--backend", "egl", "drawn.png"));
        shares.push(differing(pane.pixels(), expected, 2));
      }
      model.free();
      pane.reset();
      assert(shares.every((share) => share <= MOST * TIMES[style]) && shares[0] === shares[1], `${shares}`);
      return `${(shares[0] * 100).toFixed(3)} %`;
    });
  }
}

await test("every choice of every setting of every style links and draws, or says why not", () => {
  const model = Model.builtin("soldier", "{}");
  pane.show(model);
  const refused = [];
  let count = 0;
  for (const style of ofPasses) {
    const drawWith = (settings, show) => {
      count += 1;
      try {
        pane.draw(JSON.stringify({ style: style.name, size: "48x48", ...settings }), show, false);
      } catch (problem) {
        const said = problem.message;
        assert(!/^shader|compile|link|GL_INVALID/i.test(said), `${style.name} ${JSON.stringify(settings)}: ${said}`);
        refused.push(said);
      }
    };
    style.shows.forEach((show) => drawWith({}, show));
    for (const { name, kind } of style.settings) {
      const texts = kind.is === "flag" ? [true] : kind.is === "switch" ? ["on", "off"] : (kind.names ?? []);
      for (const text of texts) drawWith({ [name]: text }, "final");
    }
  }
  model.free();
  return `${count} pictures, ${refused.length} refused: ${[...new Set(refused)].join(" | ")}`;
});

await test("what is no model is refused in a sentence", () => {
  const bytes = (text) => new TextEncoder().encode(text);
  const hostile = [
    ["cow.obj", bytes("")],
    ["cow.obj", bytes("f 1 2 3\n")],
    ["cow.ply", bytes("ply\nformat ascii 1.0\nelement vertex 99999999999\nend_header\n")],
    ["cow.stl", new Uint8Array(84).fill(255)],
    ["cow.glb", bytes("glTF\u0002\u0000\u0000\u0000garbage")],
    ["cow.3ds", new Uint8Array([0x4d, 0x4d, 255, 255, 255, 255])],
    ["cow.md2", bytes("IDP2 and nothing else that a model has")],
  ];
  for (const [name, data] of hostile) {
    let said;
    try {
      Model.read(name, data, new Files(), "{}").free();
    } catch (problem) {
      said = problem.message;
    }
    assert(said?.includes(name), `${name}: ${said}`);
  }
});

await test("memory and WebGL's objects stay as they are over many changes of the model", () => {
  const change = (number) => {
    const model = Model.builtin(tables.models[number % tables.models.length].name, "{}");
    pane.show(model);
    pane.draw(JSON.stringify({ style: "three-pass", size: "64x64" }), "final", false);
    model.free();
  };
  // Whole rounds of all models: both counts are taken with the same one.
  const rounds = (count) => {
    for (let number = 0; number < count * tables.models.length; number += 1) change(number);
  };
  rounds(6);
  const memory = () => globalThis.program.memory.buffer.byteLength;
  const before = [memory(), pane.live_objects()];
  rounds(60);
  const after = [memory(), pane.live_objects()];
  assert(after[0] === before[0] && after[1] <= before[1], `${before} before, ${after} after`);
  return `${(after[0] / 1048576).toFixed(1)} MiB`;
});
pane.free();

await testPage(tables);
await finish();
