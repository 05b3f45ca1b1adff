// A chart of curves, drawn by Dygraphs: zoom, pan, values under the pointer, boxes that hide curves.
const timeCharts = [];
let moving = false; // the charts of time follow one another

function colourOf(series) {
  return series.colour < 0 ? themed("--muted") : COLOURS[series.colour % COLOURS.length];
}

function dashOf(series) {
  return series.colour < 0 ? DASHES[1 + (series.mark % 4)] : DASHES[(series.dash || 0) % DASHES.length];
}

function drawMark(context, shape, x, y, colour, size) {
  context.beginPath();
  context.strokeStyle = colour;
  context.lineWidth = 1.6;
  context.setLineDash([]);
  if (shape === 0) context.arc(x, y, size, 0, 2 * Math.PI);
  else if (shape === 1) context.rect(x - size, y - size, 2 * size, 2 * size);
  else if (shape === 2) { context.moveTo(x, y - size);
    context.lineTo(x + size, y + size);
    context.lineTo(x - size, y + size);
    context.closePath(); } else if (shape === 3) { context.moveTo(x - size, y - size);
    context.lineTo(x + size, y + size);
    context.moveTo(x + size, y - size);
    context.lineTo(x - size, y + size); } else if (shape === 4) { context.moveTo(x, y - size);
    context.lineTo(x + size, y);
    context.lineTo(x, y + size);
    context.lineTo(x - size, y);
    context.closePath(); } else { context.moveTo(x - size, y);
    context.lineTo(x + size, y);
    context.moveTo(x, y - size);
    context.lineTo(x, y + size); }
  context.stroke();
}

class Chart {
  constructor(host, data) {
    this.data = data;
    this.numbers = data.numbers.map(floats);
    this.visible = data.series.map(() => true);
    this.outputs = [];
    this.plot = element("div", { class: "plot",
    role: "img", "aria-label": `Chart: ${data.title}. ${data.y} over ${data.x}.` });
    const tool = (text, label, act) => element("button", { type: "button", "aria-label": `${label}: ${data.title}`,
      title: label, text, onclick: act });
    const tools = element("div", { class: "tools" },
      tool("+", "Zoom in", () => this.zoom(0.5)),
      tool("−", "Zoom out", () => this.zoom(2)),
      tool("←", "Move left", () => this.pan(-0.25)),
      tool("→", "Move right", () => this.pan(0.25)),
      tool("Whole", "Show the whole chart", () => this.reset()));
    host.append(
      element("div", { class: "heading" }, element("h3", { text: data.title }), tools),
      element("div", { class: "axis", text: data.y }),
      this.plot,
      element("div", { class: "axis x", text: data.x }),
      this.legend());
    this.draw();
    redraws.push(() => this.recolour());
    if (data.time) timeCharts.push(this);
  }
  legend() {
    const legend = element("div", { class: "legend" });
    this.swatches = [];
    this.data.series.forEach((series, i) => {
      const show = () => {
        this.visible[i] = box.checked;
        this.graph.setVisibility(i, box.checked);
      };
      const box = element("input", { type: "checkbox", checked: true, onchange: show });
      const swatch = element("canvas", { width: 56, height: 24, style: "width:28px;height:12px", "aria-hidden": "true" });
      const output = element("output", {});
      this.outputs.push(output);
      this.swatches.push(swatch);
      legend.append(element("label", {}, box, swatch, element("span", { text: series.label }), output));
    });
    return legend;
  }
  drawSwatches() {
    this.data.series.forEach((series, i) => {
      const context = this.swatches[i].getContext("2d");
      context.setTransform(2, 0, 0, 2, 0, 0);
      context.clearRect(0, 0, 28, 12);
      if (series.kind === "points") return drawMark(context, (series.mark || 0) % 6, 14, 6, colourOf(series), 4);
      context.strokeStyle = colourOf(series);
      context.lineWidth = 2.2;
      context.setLineDash(dashOf(series) || []);
      context.beginPath();
      context.moveTo(0, 6);
      context.lineTo(28, 6);
      context.stroke();
    });
  }
  rows() {
    const every = this.data.series.flatMap((series) => Array.from(this.numbers[series.x])).filter(Number.isFinite);
    const places = [...new Set(every)].sort((a, b) => a - b);
    const at = new Map(places.map((x, i) => [x, i]));
    const table = places.map((x) => [x, ...this.data.series.map(() => null)]);
    this.data.series.forEach((series, k) => {
      const x = this.numbers[series.x],
        y = this.numbers[series.y];
      for (let i = 0; i < x.length; ++i)
        if (Number.isFinite(x[i])) table[at.get(x[i])][k + 1] = Number.isFinite(y[i]) ? y[i] : NaN;
    });
    return table;
  }
  // What depends on the colours of the page.
  looks() {
    const each = {};
    this.data.series.forEach((series, i) => {
      each["s" + i] = { color: colourOf(series), strokePattern: dashOf(series), strokeWidth: series.colour < 0 ? 1.4 :
          1.8 };
      if (series.kind === "points") {
        const mark = (graph, name, context, x, y, colour) => drawMark(context, (series.mark || 0) % 6, x, y, colour,
          "mark" in series ? 4 : 1.2);
        Object.assign(each["s" + i], { strokeWidth: 0, drawPoints: true, pointSize: 4, drawPointCallback: mark,
          drawHighlightPointCallback: mark });
      }
    });
    return { series: each, gridLineColor: themed("--grid"), axisLineColor: themed("--line") };
  }
  draw() {
    // One finger scrolls the page, two zoom the chart.
    const usual = Dygraph.defaultInteractionModel;
    const touchstart = (event, graph, context) => {
      if (event.touches.length > 1) usual.touchstart(event, graph, context);
    };
    const touch = { ...usual, touchstart };
    this.graph = new Dygraph(this.plot, this.rows(), {
      ...this.looks(),
      labels: ["x", ...this.data.series.map((_, i) => "s" + i)],
      visibility: this.visible,
      connectSeparatedPoints: true,
      legend: "never",
      interactionModel: touch,
      highlightCircleSize: 3,
      rightGap: 12,
      xRangePad: 4,
      yRangePad: 8,
      labelsKMB: false,
      animatedZooms: false,
      axes: { x: { axisLabelFormatter: (x) => shown(x, 6), pixelsPerLabel: 70 }, y: { axisLabelFormatter: (y) => shown(y,
            5), axisLabelWidth: 58, pixelsPerLabel: 34 } },
      highlightCallback: (event, x) => this.read(x),
      unhighlightCallback: () => this.read(NaN),
      zoomCallback: () => this.follow(),
      drawCallback: (graph, first) => { if (!first) this.follow(); }
    });
    this.drawSwatches();
  }
  recolour() {
    this.graph.updateOptions(this.looks(), true);
    this.graph.resize();
    this.drawSwatches();
  }
  // Chromium prints a canvas that was drawn in "beforeprint" empty, unless it has been read since.
  settle() { for (const canvas of this.plot.querySelectorAll("canvas")) canvas.getContext("2d").getImageData(0, 0, 1, 1); }
  read(x) {
    this.data.series.forEach((series, i) => {
      const value = Number.isFinite(x) ? interpolated(this.numbers[series.x], this.numbers[series.y], x) : NaN;
      this.outputs[i].textContent = series.kind !== "points" && Number.isFinite(value) ? shown(value) : "";
    });
  }
  zoom(factor) {
    const [low, high] = this.graph.xAxisRange(), middle = (low + high) / 2, half = ((high - low) / 2) * factor;
    const [first, last] = this.graph.xAxisExtremes();
    if (2 * half >= last - first) return this.reset();
    this.show([middle - half, middle + half]);
  }
  pan(share) {
    const [low, high] = this.graph.xAxisRange(), way = share * (high - low);
    this.show([low + way, high + way]);
  }
  show(range) { this.zoomed = true;
    this.graph.updateOptions({ dateWindow: range }); }
  reset() { this.zoomed = false;
    this.graph.resetZoom(); }
  follow() {
    const box = document.getElementById("together");
    this.zoomed = this.graph.isZoomed();
    if (moving || !this.data.time || !box || !box.checked) return;
    moving = true;
    const range = this.graph.xAxisRange(),
      whole = !this.graph.isZoomed("x");
    for (const other of timeCharts)
      if (other !== this && other.data.x === this.data.x) whole ? other.graph.resetZoom() : other.show(range);
    moving = false;
  }
}

function interpolated(x, y, at) {
  const n = x.length;
  if (!n || at < x[0] || at > x[n - 1]) return NaN;
  let low = 0,
    high = n - 1;
  while (high - low > 1) { const middle = (low + high) >> 1; if (x[middle] <= at) low = middle;
    else high = middle; }
  if (x[high] === x[low]) return y[low];
  return y[low] + ((at - x[low]) / (x[high] - x[low])) * (y[high] - y[low]);
}