"use strict";
// Elements and number formats. Text of a record reaches the page through textContent alone.

/** Makes an element: attributes, then children (elements or text). `class`, `text` and `on*` as expected. */
function el(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

function svg(tag, attributes = {}, ...children) {
  return fill(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

function fill(node, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key === "text") node.textContent = value;
    else if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else if (key === "style") for (const [k, v] of Object.entries(value)) node.style.setProperty(k, v);
    else node.setAttribute(key, value === true ? "" : value);
  }
  for (const child of children.flat(Infinity)) {
    if (child !== null && child !== undefined && child !== "") node.append(child);
  }
  return node;
}

const by_id = (id) => document.getElementById(id);
const is_number = (value) => typeof value === "number" && Number.isFinite(value);
const none = "–";

/** A number with fixed decimals, a proper minus and its unit; a dash where there is none. */
function num(value, decimals = 1, unit = "") {
  if (!is_number(value)) return none;
  const text = value.toFixed(decimals).replace(/^-(0(\.0*)?)$/, "$1").replace("-", "\u2212");
  return unit ? `${text}\u00A0${unit}` : text;
}

/** A share as whole per cent; small ones are not rounded to nothing. */
function percent(value) {
  if (!is_number(value)) return none;
  return value > 0 && value < 0.005 ? "< 1\u00A0%" : `${Math.round(100 * value)}\u00A0%`;
}

function signed(value, decimals = 2) {
  return is_number(value) && value >= 0 ? `+${num(value, decimals)}` : num(value, decimals);
}

/** "3.2° left": what a sign means in words. */
function sided(value, decimals, unit) {
  if (!is_number(value)) return none;
  const text = num(Math.abs(value), decimals);
  const side = Number(text) === 0 ? "" : value > 0 ? " left" : " right";
  return `${text}${unit.startsWith("°") ? "" : "\u00A0"}${unit}${side}`;
}

/** A table from headings and rows of cells; a cell is text, an element or {text, class}. */
function table(caption, headings, rows) {
  const cell = (tag, content, scope) => {
    const known = content === null || content === undefined ? none : content;
    const plain = typeof known === "object" && !(known instanceof Node) ? known : { content: known };
    return el(tag, { class: plain.class, scope }, plain.content);
  };
  const head = el("tr", {}, headings.map((h) => cell("th", h, "col")));
  const body = rows.map((row) => el("tr", { class: row.class },
    row.cells.map((c, i) => (i === 0 ? cell("th", c, "row") : cell("td", c)))));
  return el("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": caption },
    el("table", {}, el("caption", { class: "hidden", text: caption }), el("thead", {}, head), el("tbody", {}, body)));
}

/** A bar for a share in [0, 1], with its value in words beside it. */
function bar(share, text, kind = "") {
  const width = is_number(share) ? Math.min(1, Math.max(0, share)) * 100 : 0;
  return el("span", { class: `bar ${kind}` },
    el("span", { class: "bar-rail", "aria-hidden": "true" }, el("span", { style: { width: `${width}%` } })),
    el("span", { class: "bar-text", text }));
}

const tag = (text, kind = "") => el("span", { class: `tag ${kind}`, text });

/** "v_x" with its index set low. */
function symbol(name) {
  const [letter, index] = String(name).split("_");
  return index && name.length <= 4 ? el("span", {}, letter, el("sub", { text: index })) : el("span", { text: name });
}
