// What charts and movies share: the page's data, elements, numbers, colours.
const page = JSON.parse(document.getElementById("report-data").textContent);
const problems = (window.reportProblems = []);
window.addEventListener("error", (event) => problems.push(event.message));

// Colours that all eyes tell apart (Okabe and Ito), black left out for dark screens.
const COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8a6d00"];
const DASHES = [null, [8, 4],
  [2, 3],
  [10, 3, 2, 3],
  [5, 2, 1, 2, 1, 2]
];

function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name === "text") made.textContent = value;
    else if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== null && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children);
  return made;
}

function bytes(text) {
  const raw = atob(text),
    array = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) array[i] = raw.charCodeAt(i);
  return array;
}
const floats = (text) => new Float32Array(bytes(text).buffer);
const shorts = (text) => new Int16Array(bytes(text).buffer);
const themed = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const shown = (value, digits = 4) => (Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : "–");
const redraws = []; // what must be drawn again when the colours of the page change
let lastId = 0;

const maps = Object.fromEntries(Object.entries(page.colours || {}).map(([name, text]) => [name, bytes(text)]));

function colourAt(map, share) {
  const i = 3 * Math.max(0, Math.min(255, Math.round(255 * share)));
  return [map[i], map[i + 1], map[i + 2]];
}

function ticks(low, high, count) {
  const raw = (high - low) / Math.max(1, count),
    size = 10 ** Math.floor(Math.log10(raw)),
    ratio = raw / size;
  const step = size * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10),
    found = [];
  for (let value = Math.ceil(low / step - 1e-9) * step; value <= high + 1e-9 * step; value += step) found.push(Math.abs(value) <
    1e-9 * step ? 0 : value);
  return found;
}

function sized(canvas, height) {
  const ratio = window.devicePixelRatio || 1,
    width = canvas.clientWidth || 600;
  canvas.style.height = height + "px";
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return [context, width];
}