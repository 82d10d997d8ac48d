// The page itself, in a frame: driven by events as a hand makes them, and looked into.

import { assert, differing, drawn, pixels, test, until } from "./harness.js";

/** Opens the page in a frame of this size; what goes wrong in it is collected. */
async function opened(width, height, link = "") {
  const frame = document.createElement("iframe");
  Object.assign(frame.style, { width: `${width}px`, height: `${height}px`, border: "0" });
  const problems = [];
  frame.src = link.startsWith("/") ? link : `index.html${link}`;
  document.body.append(frame);
  frame.contentWindow.addEventListener("error", (event) => problems.push(event.message));
  await new Promise((resolve) => frame.addEventListener("load", resolve));
  const page = frame.contentWindow;
  page.console.error = (...words) => problems.push(words.join(" "));
  page.addEventListener("error", (event) => problems.push(event.message));
  page.addEventListener("unhandledrejection", (event) => problems.push(String(event.reason)));
  await until(() => page.tinta, "the page");
  const at = (id) => page.document.getElementById(id);
  const frames = () => new Promise((resolve) => page.requestAnimationFrame(() => page.requestAnimationFrame(resolve)));
  const settled = async () => {
    await frames();
    await until(() => !page.tinta.isMoving(), "rest");
    await frames();
  };
  await settled();
  await settled();
  return { frame, page, at, settled, problems, close: () => frame.remove() };
}

const picture = (canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;

/** Tests the page. */
export async function testPage(tables) {
  const opening = await opened(1000, 900);
  const { page, at, settled, problems, close } = opening;
  const stage = at("stage");
  const change = (field, value) => {
    field.value = value;
    field.dispatchEvent(new page.Event("change"));
    return settled();
  };
  const pointer = (type, x, y, more = {}) => {
    const box = stage.getBoundingClientRect();
    const place = { clientX: box.left + x * box.width, clientY: box.top + y * box.height };
    stage.dispatchEvent(new page.PointerEvent(type, { pointerId: 1, bubbles: true, buttons: 1, ...place, ...more }));
    return settled();
  };
  const key = (key, more = {}) => {
    stage.dispatchEvent(new page.KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...more }));
    return settled();
  };

  /** A place of the left side where the model is drawn: the middle of those whose colour is not the corner's. */
  const covered = (canvas = at("left")) => {
    const { width, height } = canvas;
    const colors = new Uint32Array(picture(canvas).buffer);
    const drawn = [...colors.keys()].filter((place) => place % width < width * 0.45 && colors[place] !== colors[0]);
    const place = drawn[drawn.length >> 1];
    return [((place % width) + 0.5) / width, (Math.floor(place / width) + 0.5) / height];
  };

  await test("a pixel is explained where the picture is pressed, until the picture changes", async () => {
    await pointer("pointerdown", ...covered(), { altKey: true });
    const said = () => at("why").querySelector("pre").textContent;
    assert(!at("why").hidden && /leaves [0-9]/.test(said()) && /the driver/.test(said()), said());
    // What is recomputed is what the browser drew.
    const apart = [...said().matchAll(/([0-9.]+) steps of 255 away/g)].map(([, steps]) => Number(steps));
    assert(apart.every((steps) => steps <= 1.5), `apart by ${apart} of 255`);
    at("ask").click();
    assert(stage.classList.contains("asks"), "the button waits for a pixel");
    await pointer("pointerdown", 0.002, 0.002);
    assert(/background/.test(said()) && !stage.classList.contains("asks"), said());
    await key("ArrowRight");
    assert(at("why").hidden && at("asked").hidden, "what was said of another picture goes");
    await key("r");
    assert(at("why").ariaLive === "polite", "a screen reader reads it");
  });

  await test("a pixel of a supersampled picture is explained as drawn once", async () => {
    await change(at("left-side").querySelector('[name="supersample"]'), "2");
    await pointer("pointerdown", ...covered(), { altKey: true });
    const said = at("why").querySelector("pre").textContent;
    assert(said.startsWith("As drawn once, without “Supersample”:") && /leaves [0-9]/.test(said), said);
    await change(at("left-side").querySelector('[name="supersample"]'), "1");
  });

  await test("a style is timed after its first picture, and its label holds one error", async () => {
    const cost = (name) => at(`${name}-side`).querySelector(".cost").textContent;
    await until(() => /^inking: [0-9.]+ ms a picture; line error [0-9.]+ /.test(cost("right")), "time and error");
    await change(at("left-Style"), "lines");
    await until(() => cost("left") === "lines: exact", "the lines");
    await change(at("left-Style"), "phong");
    assert(cost("left") === "phong: timed when the view rests", cost("left"));
    await until(() => /^phong: [0-9.]+ ms a picture$/.test(cost("left")), "the time of the second picture");
    await until(() => /^inking: [0-9.]+ ms a picture; line error [^;]+$/.test(cost("right")), `one error: ${cost("right")}`);
    await change(at("left-Style"), "three-pass");
    return cost("right");
  });

  await test("the page shows both styles at once", () => {
    for (const name of ["left", "right"]) {
      const colors = new Set(new Uint32Array(picture(at(name)).buffer));
      assert(colors.size > 20, `${name}: ${colors.size} colours`);
    }
    assert(differing(picture(at("left")), picture(at("right")), 8) > 0.05, "they are two styles");
  });

  await test("dragging turns, keys turn back, and the divider divides", async () => {
    const before = picture(at("left"));
    await pointer("pointerdown", 0.25, 0.5);
    await pointer("pointermove", 0.45, 0.5);
    await pointer("pointerup", 0.45, 0.5);
    assert(differing(before, picture(at("left")), 8) > 0.05, "it turned");
    await key("r");
    assert(differing(before, picture(at("left")), 0) === 0, "R is the first view again");
    await pointer("pointerdown", 0.5, 0.5);
    await pointer("pointermove", 0.7, 0.5);
    await pointer("pointerup", 0.7, 0.5);
    assert(Math.abs(page.tinta.state().divider - 70) < 1, `divider at ${page.tinta.state().divider}`);
    assert(differing(before, picture(at("left")), 0) === 0, "dividing does not turn");
    await key("[");
    assert(Math.abs(Number(at("divider").value) - 65) < 1.5, at("divider").value);
  });

  await test("every style by its key and every setting by its field", async () => {
    let count = 0;
    for (const [number, style] of tables.styles.entries()) {
      await pointer("pointerdown", 0.2, 0.9);
      await pointer("pointerup", 0.2, 0.9);
      // Those after the ninth have no key.
      if (number < 9) await key(String(number + 1));
      else await change(at("left-Style"), style.name);
      assert(at("left-Style").value === style.name, `${at("left-Style").value} for ${style.name}`);
      const fields = [...at("left-side").querySelectorAll(".setting")];
      const named = style.settings.filter(({ kind }) => kind.is !== "file");
      assert(!at("status").textContent.includes("bug"), at("status").textContent);
      assert(fields.length === named.length, `${style.name}: ${fields.length} fields for ${named.length} settings`);
      count += fields.length;
      for (const field of at("left-side").querySelectorAll(".setting :is(input, select)")) {
        assert(field.labels.length === 1, `${field.name} has a label`);
      }
    }
    return `${count} fields`;
  });

  await test("the sheet of keys is that of the table, and what only the window has is left to the browser", async () => {
    const listed = [...page.document.querySelectorAll("#keys dt")].map((term) => term.textContent);
    assert(listed.join() === tables.keys.map(({ keys }) => keys).join(), listed.join());
    assert(listed.includes("Ctrl S") && !listed.includes("Ctrl T"), listed.join());
    const pressed = new page.KeyboardEvent("keydown", { key: "t", ctrlKey: true, bubbles: true, cancelable: true });
    assert(stage.dispatchEvent(pressed), "Ctrl T is the browser's");
    const elsewhere = new page.KeyboardEvent("keydown", { key: "l", ctrlKey: true, bubbles: true, cancelable: true });
    assert(page.document.body.dispatchEvent(elsewhere), "and so is Ctrl L where the picture has no focus");
    await key("h");
    assert(at("keys").open, "H opens it");
    at("keys").close();
  });

  await test("a setting changes the picture, its default comes back, nonsense is refused beside it", async () => {
    await change(at("left-Style"), "inking");
    const before = picture(at("left"));
    const width = at("left-side").querySelector('[name="line-width"]');
    await change(width, "7");
    assert(differing(before, picture(at("left")), 8) > 0.005, "lines are wider");
    await until(() => page.location.hash.includes("left%3Aline-width=7"), "the setting in the address");
    width.parentElement.querySelector("button").click();
    await settled();
    assert(differing(before, picture(at("left")), 0) === 0, "the default is back");
    const offset = at("left-side").querySelector('[name="polygon-offset"]');
    await change(offset, "much");
    assert(offset.parentElement.querySelector(".problem").textContent.length > 10, "a sentence says why");
  });

  await test("a style that is chosen by the keyboard keeps the focus, and what was open", async () => {
    await change(at("left-Style"), "three-pass");
    const groups = () => [...at("left-side").querySelectorAll("details")];
    groups().forEach((details) => (details.open = true));
    at("left-Style").focus();
    await change(at("left-Style"), "mrt");
    assert(page.document.activeElement === at("left-Style"), "the new field has the focus");
    assert(groups().filter((details) => details.open).length >= 3, "settings and groups that both styles have are open");
    at("left-published").focus();
    at("left-published").click();
    await settled();
    assert(page.document.activeElement === at("left-published"), "the button has it");
    groups().forEach((details) => (details.open = false));
  });

  await test("a side that cannot be drawn is empty and says why, and comes back", async () => {
    await change(at("model"), "bust");
    await change(at("left-Style"), "three-pass");
    const before = picture(at("left"));
    await change(at("left-Style"), "sand");
    assert(picture(at("left")).every((byte) => byte === 0), "nothing of the style before is left");
    assert(/texture/.test(at("problem").textContent) && !at("problem").hidden, at("problem").textContent);
    assert(!at("problem").textContent.includes("--"), `in the page's words: ${at("problem").textContent}`);
    await change(at("left-Style"), "three-pass");
    assert(differing(before, picture(at("left")), 0) === 0, "it is drawn again");
    assert(at("problem").hidden, at("problem").textContent);
  });

  await test("a constant that is changed in a listing is drawn with, and taken back", async () => {
    await change(at("left-Style"), "three-pass");
    const before = picture(at("left"));
    at("listings").open = true;
    await change(at("shader"), "evangelista/border.frag");
    at("edit").click();
    const [numbers, text] = [at("numbers"), at("text")];
    assert(numbers.textContent.split("\n").at(-1) === String(text.value.split("\n").length), "every line has its number");
    text.scrollTop = 60;
    await until(() => numbers.scrollTop === text.scrollTop && text.scrollTop > 0, "numbers that scroll with the text");
    assert(Math.abs(numbers.scrollHeight - text.scrollHeight) < 20, `${numbers.scrollHeight} and ${text.scrollHeight} px`);
    at("text").value = at("text").value.replace("DETECTION_FACTOR 0.2f", "DETECTION_FACTOR 2.0f");
    at("apply").click();
    await settled();
    assert(differing(before, picture(at("left")), 8) > 0.005, "borders are darker");
    assert(at("original").textContent.includes("DETECTION_FACTOR 2.0f"), "the listing is the changed one");
    const marked = [...at("transcribed").querySelectorAll("mark")].map((mark) => mark.textContent);
    assert(marked.includes("2.0"), `what had to change in it is marked: ${marked}`);
    const edited = picture(at("left"));
    const again = await opened(1000, 900, page.tinta.link());
    assert(differing(edited, picture(again.at("left")), 0) === 0, "the link carries the change");
    again.close();
    const lines = at("text").value.split("\n");
    const number = lines.findIndex((line) => line.includes("gl_FragColor=")) + 1;
    at("text").value = lines.with(number - 1, "foo;").join("\n");
    at("apply").click();
    await settled();
    assert(at("shader-problem").textContent.startsWith(`Line ${number}, “foo;”`), at("shader-problem").textContent);
    assert(differing(edited, picture(at("left")), 0) === 0, "the last shader that works draws on");
    at("published").click();
    await settled();
    assert(differing(before, picture(at("left")), 0) === 0, "as published again");
  });

  await test("a look sets the style of its side and the scene of both", async () => {
    await change(at("model"), "bust");
    await change(at("left-Look"), "sketch");
    assert(at("left-Style").value === "charcoal", at("left-Style").value);
    assert(at("left-Look").value === "sketch", `in use: ${at("left-Look").value}`);
    assert(at("problem").hidden, at("problem").textContent);
    const looked = picture(at("left"));
    await change(at("left-Look"), "published");
    assert(at("left-Style").value === "three-pass", at("left-Style").value);
    await change(at("left-Style"), "charcoal");
    assert(differing(looked, picture(at("left")), 8) > 0.005, "charcoal as published is another");
    // The bust has no texture for sand.
    await change(at("model"), "soldier");
    for (const { name } of tables.looks) {
      await change(at("left-Look"), name);
      assert(at("problem").hidden, `${name}: ${at("problem").textContent}`);
      const isOfLines = at("left-Style").value === "lines";
      if (isOfLines) await until(() => at("left-lines").querySelector("svg") && !at("left-lines").hidden, `the lines of ${name}`);
      else assert(new Set(new Uint32Array(picture(at("left")).buffer)).size > 3, name);
    }
    await change(at("left-Look"), "print");
    assert(page.tinta.state().read.normals === "lasting", "a look sets how models are read");
    await change(at("left-side").querySelector('[name="tones"]'), "2");
    assert(at("left-Look").value === "", `another number of tones is no look: ${at("left-Look").value}`);
    await change(at("left-Look"), "published");
    assert(!page.tinta.state().read.normals, "another look takes it back");
  });

  await test("a link shows the same again", async () => {
    await change(at("model"), "gear");
    await change(at("right-Style"), "charcoal");
    await key("ArrowLeft");
    await key("+");
    await until(() => page.location.hash.includes(encodeURIComponent(page.tinta.pane().orbit())), "the view in the address");
    const again = await opened(1000, 900, page.location.hash);
    for (const name of ["left", "right"]) {
      assert(differing(picture(at(name)), picture(again.at(name)), 0) === 0, `${name} is the same`);
    }
    assert(again.at("model").value === "gear");
    assert(!again.at("status").textContent.includes("unknown"), again.at("status").textContent);
    again.close();
  });

  await test("a link says what it has that the page does not know", async () => {
    const wrong = await opened(900, 700, "#model=zzz&left=foo&left:bla=3&right.show=bar&scene:x=1&lecture=nobody&right=phong");
    const said = wrong.at("status").textContent;
    assert(/has model=zzz, left=foo, left:bla=3, scene:x=1, right.show=bar, lecture=nobody, unknown/.test(said), said);
    assert(wrong.at("right-Style").value === "phong", "the rest is followed");
    wrong.close();
  });

  const drop = async (files) => {
    const data = new page.DataTransfer();
    for (const [name, text] of Object.entries(files)) data.items.add(new page.File([text], name));
    stage.dispatchEvent(new page.DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
    at("status").textContent = "";
    await until(() => at("status").textContent, "a word about the file");
    await settled();
  };

  await test("a dropped file is drawn, a hostile one is refused and the picture stays", async () => {
    await drop({ "two.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n" });
    assert(at("status").textContent.startsWith("two.obj: 2 triangles."), at("status").textContent);
    const before = picture(at("left"));
    await drop({ "bad.obj": "f 7 8 9\n" });
    assert(at("status").textContent.includes("bad.obj"), at("status").textContent);
    assert(differing(before, picture(at("left")), 0) === 0, "the picture stays");
    await drop({ "wood.png": "" });
    assert(at("status").textContent.startsWith("None of these files is a model"), at("status").textContent);
  });

  await test("materials and pictures dropped with a model are read", async () => {
    await change(at("left-Style"), "phong");
    const files = {
      "square.obj": "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl a\nf 1/1 2/2 3/3\nf 1/1 3/3 4/2\n",
      "Square.MTL": "newmtl a\nKd 1 1 1\nmap_Kd art\\red.ppm\n",
    };
    await drop(files);
    assert(at("status").textContent.includes("red.ppm is not beside it"), at("status").textContent);
    await drop({ ...files, "red.ppm": "P3 1 1 255 255 0 0\n" });
    assert(!at("status").textContent.includes("red.ppm"), at("status").textContent);
    const surface = page.document.querySelector('[name="surface"]');
    await change(surface, "textured");
    const red = () => picture(at("left")).filter((value, place, all) => place % 4 === 0 && value > 60 && all[place + 1] < value / 4).length;
    assert(red() > 1000, `${red()} red pixels`);
    await change(surface, "plain");
    assert(red() === 0, `${red()} red pixels on a plain surface`);
  });

  await test("the saved lines are the command line's SVG", async () => {
    await change(at("model"), "gear");
    await key("r");
    let saved;
    page.URL.createObjectURL = (blob) => {
      saved = blob;
      return "#";
    };
    page.HTMLAnchorElement.prototype.click = () => {};
    at("svg").click();
    await until(() => saved, "the file");
    const text = await saved.text();
    const size = text.match(/width="(\d+)" height="(\d+)"/).slice(1).join("x");
    const expected = new TextDecoder().decode(await drawn("builtin:gear", "--style", "lines", "--size", size, "drawn.svg"));
    assert(text === expected, `${text.length} and ${expected.length} letters`);
    saved = undefined;
    at("left-save").click();
    await until(() => saved, "the picture");
    const png = new Uint8Array(await saved.arrayBuffer());
    assert(new TextDecoder("latin1").decode(png).includes("tinta-recipe"), "it carries its recipe");
    assert((await pixels(png)).length === at("left").width * at("left").height * 4, "it is as large as on the screen");
  });

  await test("the error against the exact lines is said when nothing moves", async () => {
    await change(at("left-Style"), "ink");
    const cost = () => at("left-side").querySelector(".cost").textContent;
    await until(() => cost().includes("line error 0."), "the error");
    return cost();
  });

  await test("a context that is lost is said so, and restored", async () => {
    const before = picture(at("left"));
    const context = page.tinta.canvas.getContext("webgl").getExtension("WEBGL_lose_context");
    context.loseContext();
    await until(() => at("problem").textContent.includes("lost"), "the sentence");
    await until(() => !at("exact").hidden && at("exact").querySelector("svg"), "the exact lines");
    const isOffered = () => at("ask").getClientRects().length > 0 || at("left-side").getClientRects().length > 0;
    assert(!isOffered(), "what needs it is hidden");
    context.restoreContext();
    await until(() => at("status").textContent.includes("back"), "the context");
    await settled();
    assert(at("problem").hidden && at("exact").hidden && differing(before, picture(at("left")), 0) === 0, "the same picture again");
    assert(isOffered(), "what needs it is back");
  });

  await test("the page fits 320 pixels and follows a new size", async () => {
    opening.frame.style.width = "320px";
    const isSmall = () => at("left").width <= 320 * page.devicePixelRatio;
    await until(isSmall, "a smaller picture").catch((problem) => {
      const said = [at("status").textContent, page.document.visibilityState, at("left-side").querySelector(".cost").textContent];
      throw new Error(`${problem.message}; ${at("left").width} px in ${stage.clientWidth}; ${said.join("; ")}; ${problems.join("; ")}`);
    });
    const { scrollWidth, clientWidth } = page.document.documentElement;
    assert(scrollWidth <= clientWidth, `${scrollWidth} px in ${clientWidth}`);
  });

  await test("nothing was asked of another host, and nothing went wrong unsaid", () => {
    const others = page.performance.getEntriesByType("resource").filter(({ name }) => new URL(name).host !== location.host);
    assert(others.length === 0, others.map(({ name }) => name).join(" "));
    assert(problems.length === 0, problems.join(" | "));
  });
  close();

  for (const name of ["evangelista", "dachsbacher", "valente"]) {
    await test(`the lecture on ${name} shows its figure live, its buffers and its shaders, of any model`, async () => {
      const lecture = await opened(390, 844, `#lecture=${name}&model=gear&divider=100`);
      const { page, at, settled } = lecture;
      const article = at("text-of-lecture");
      await until(() => article.querySelectorAll("h2").length > 3, "its sections");
      assert([...article.querySelectorAll("details")].every((answer) => !answer.open && answer.textContent.length > 40), "answers are folded");
      assert(article.querySelectorAll("details").length === 3, "three exercises");
      assert(at("original").textContent.startsWith("#version 120"), "a shader");
      const buffers = () => [...article.querySelectorAll("canvas.buffer")];
      if (name !== "dachsbacher") {
        await until(() => buffers().length > 1 && buffers().every((canvas) => new Set(new Uint32Array(picture(canvas).buffer)).size > 2), "live buffers");
        const before = picture(at("left"));
        buffers()[0].click();
        await settled();
        assert(differing(before, picture(at("left")), 8) > 0.02, "a buffer that is clicked is shown");
      }
      assert(!at("controls").open && !at("left-Style").checkVisibility(), "styles and settings are folded");
      const heading = at("controls").querySelector("summary").getBoundingClientRect();
      assert(heading.height >= 44 && heading.bottom <= article.getBoundingClientRect().top, "above the text");
      const images = [...page.document.images].filter((image) => image.complete && !image.naturalWidth);
      assert(images.length === 0, images.map((image) => image.src).join(" "));
      const { scrollWidth, clientWidth } = page.document.documentElement;
      assert(scrollWidth <= clientWidth, `${scrollWidth} px in ${clientWidth}`);
      lecture.close();
    });
  }

  for (const [width, height] of [[390, 844], [1366, 768]]) {
    await test(`at ${width}x${height} the picture stays in view beside or above every control`, async () => {
      const sized = await opened(width, height);
      const { page, at, settled } = sized;
      for (const details of page.document.querySelectorAll("#panel details")) details.open = true;
      await settled();
      const inView = () => {
        const box = at("stage").getBoundingClientRect();
        return Math.min(box.bottom, height) - Math.max(box.top, 0);
      };
      for (const field of page.document.querySelectorAll("#panel :is(select, input, button, summary)")) {
        field.scrollIntoView({ block: "end" });
        assert(inView() > height / 4, `${inView()} px of the picture are in view at ${field.id || field.name}`);
        const { height: tall, width: wide } = field.getBoundingClientRect();
        if (width < 700 && !field.hidden && !field.classList.contains("code") && tall) assert(tall >= 44 && wide >= 24, `${field.id || field.name}: ${wide}x${tall}`);
      }
      sized.close();
    });
  }

  const made = (...words) => opened(900, 700, `/made?${encodeURIComponent(JSON.stringify([...words, "made.html"]))}`);
  await test("a page that is one file shows its model, its lecture and its lines, and asks for no other file", async () => {
    const lesson = await made("models/pawn.obj", "--lecture", "valente");
    assert(lesson.at("status").textContent.startsWith("pawn.obj: "), lesson.at("status").textContent);
    assert(lesson.at("left-Style").value === "charcoal" && lesson.at("lecture").value === "valente", lesson.at("left-Style").value);
    assert(lesson.at("lecture").options.length === 2, "it has its lecture alone");
    await until(() => lesson.at("text-of-lecture").querySelector("h2"), "the text");
    const look = await made("models/pawn.obj", "--tones", "2");
    assert(look.at("left-Look").value === "", `print has three tones: ${look.at("left-Look").value}`);
    const print = await made("builtin:bust");
    assert(print.at("left-Look").value === "print", `the look in use: ${print.at("left-Look").value}`);
    assert(!/unknown/.test(print.at("status").textContent), print.at("status").textContent);
    print.at("ask").click();
    const stage = print.at("stage").getBoundingClientRect();
    const [right, down] = covered(print.at("left"));
    const place = { clientX: stage.left + right * stage.width, clientY: stage.top + down * stage.height };
    print.at("stage").dispatchEvent(new print.page.PointerEvent("pointerdown", { pointerId: 1, bubbles: true, ...place }));
    const why = print.at("why").querySelector("pre").textContent;
    assert(/leaves [0-9]/.test(why), why);
    print.close();
    assert(look.at("left-Style").value === "ink" && look.page.tinta.state().sides.left.settings.tones === "2", "the look print, with two tones");
    assert(look.at("lecture").parentElement.hidden, "and no lecture");
    await until(() => look.at("left-side").querySelector(".cost").textContent.includes("line error"), "its worker");
    for (const { page, problems, close } of [lesson, look]) {
      const asked = page.performance.getEntriesByType("resource").filter(({ name }) => !name.startsWith("blob:"));
      assert(asked.length === 0 && problems.length === 0, asked.map(({ name }) => name).concat(problems).join(" "));
      close();
    }
  });

  await test("a side that the divider covers is not drawn, and a model opens in frame", async () => {
    const one = await opened(900, 700, "#model=bust&divider=100&left=phong&right=ink");
    await until(() => /ms a picture/.test(one.at("left-side").querySelector(".cost").textContent), "the left side is drawn");
    assert(one.at("right-side").querySelector(".cost").textContent === "", "the right side is not");
    one.page.tinta.pane().zoom(3);
    one.at("model").value = "gear";
    one.at("model").dispatchEvent(new one.page.Event("change"));
    await one.settled();
    assert(one.page.tinta.pane().orbit().split(",")[2] === "1", one.page.tinta.pane().orbit());
    one.close();
  });
}
