// Controls made from the tables of settings: one loop, whatever settings there are.

/** An element with properties and children. */
export function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

/**
 * Controls for settings, under their headings; `change(name, text)` receives a text, or null for the default, and returns an
 * error, if any.
 */
export function panel(table, settings, change) {
  const groups = new Map();
  for (const setting of table.filter((setting) => setting.kind.is !== "file")) {
    const heading = setting.heading.split(/[(:]/)[0].trim();
    if (!groups.has(heading)) groups.set(heading, element("details", {}, element("summary", { textContent: heading })));
    groups.get(heading).append(control(setting, settings, change));
  }
  return [...groups.values()];
}

function control(setting, settings, change) {
  const id = `setting-${crypto.getRandomValues(new Uint32Array(1))[0]}`;
  const problem = element("span", { className: "problem", role: "alert" });
  const field = fieldOf(setting, settings[setting.name] ?? setting.default ?? "");
  field.id = id;
  field.name = setting.name;
  const reset = element("button", {
    type: "button",
    textContent: "↺",
    title: `${setting.label}: back to the default, ${setting.default || "none"}`,
    ariaLabel: `${setting.label}: back to the default`,
    hidden: !(setting.name in settings),
  });
  const apply = (text) => {
    problem.textContent = change(setting.name, text) ?? "";
    reset.hidden = text === null;
  };
  field.addEventListener("change", () => {
    const text = field.type === "checkbox" ? (field.checked ? "on" : "off") : field.value;
    apply(text === setting.default ? null : text);
  });
  reset.addEventListener("click", () => {
    if (field.type === "checkbox") field.checked = setting.default === "on";
    else field.value = setting.default ?? "";
    apply(null);
    field.focus();
  });
  const label = element("label", { htmlFor: id, textContent: setting.label, title: setting.help });
  return element("div", { className: "setting" }, label, field, reset, problem);
}

/** The field for a kind of setting. */
function fieldOf({ kind, help, name, open }, value) {
  const title = help;
  switch (kind.is) {
    case "switch":
    case "flag":
      return element("input", { type: "checkbox", checked: value === "on", title });
    case "choice":
    case "recipe": {
      const field = element("select", { title });
      for (const text of new Set([...kind.names, value])) field.append(element("option", { value: text, textContent: text }));
      field.value = value;
      return field;
    }
    case "numbers":
      if (kind.count === 1 && value !== "" && value !== open && !Number.isNaN(Number(value))) {
        const field = element("input", { type: "number", step: kind.decimals ? 10 ** -kind.decimals : 1, title });
        [field.min, field.max] = kind.range;
        field.value = value;
        return field;
      }
      return element("input", { type: "text", value, title });
    default: {
      const field = element("input", { type: "text", value, title });
      field.placeholder = kind.offered?.join(", ") ?? name;
      return field;
    }
  }
}
