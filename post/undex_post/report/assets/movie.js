// The animated mid-plane on a canvas: fields within the outlines of their bodies, structures, obstacles.
class Movie {
  constructor(host, data) {
    Object.assign(this, { host, data, index: 0, cache: [], timer: 0 });
    this.ranges = Object.fromEntries(data.quantities.map((each) => [each.key, [0, each.top]]));
    this.build();
    const resized = () => {
      if (this.stage.clientWidth !== this.drawnWidth) this.draw();
    };
    this.resizer = new ResizeObserver(() => requestAnimationFrame(resized));
    this.resizer.observe(this.stage);
    redraws.push(() => this.draw());
    this.choose();
  }
  of(part) { return this.data.quantities.filter((each) => each.key.startsWith(part + ".")); }
  build() {
    const label = (text, control) => element("label", {}, element("span", { text }), control);
    const capital = (text) => text[0].toUpperCase() + text.slice(1);
    const choices = (list) => list.map((each) => element("option", { value: each.key, text: capital(each.label) }));
    const first = this.of("fluid").length ? this.of("fluid") : this.of("solids");
    this.field = element("select", { onchange: () => this.choose() }, ...choices(first));
    this.solidField = element("select", { onchange: () => this.draw() }, ...choices(this.of("solids")));
    const plain = element("option", { value: "", text: "Plain" });
    this.structure = element("select", { onchange: () => this.draw() }, ...choices(this.of("structure")), plain);
    const names = Object.keys(maps).map((name) => element("option", { value: name, text: name }));
    this.map = element("select", { onchange: () => this.draw() }, ...names);
    this.low = element("input", { type: "number", step: "any", onchange: () => this.setRange() });
    this.high = element("input", { type: "number", step: "any", onchange: () => this.setRange() });
    this.own = element("input", { type: "checkbox", onchange: () => this.draw() });
    this.cavities = element("input", { type: "checkbox", onchange: () => this.draw() });
    this.unit = element("span", {});
    const controls = element("div", { class: "controls" });
    if (first.length) controls.append(label(this.of("fluid").length ? "Fluid" : "Solids", this.field));
    if (this.of("fluid").length && this.of("solids").length) controls.append(label("Solids", this.solidField));
    if (this.of("structure").length) controls.append(label("Structure", this.structure));
    if (first.length) {
      controls.append(label("Colours", this.map), element("label", {}, this.unit, this.low), label("to", this.high),
        element("label", { class: "row" }, this.own, "each picture its own range"));
      if (this.of("fluid").some((each) => each.key === "fluid.void_fraction"))
        controls.append(element("label", { class: "row" }, this.cavities, "cavitated water white"));
    }
    this.stage = element("div", { class: "stage" });
    this.canvas = element("canvas", { role: "img", "aria-label": "The mid-plane of the scene at the chosen time" });
    this.stage.append(this.canvas);
    this.play = element("button", { type: "button", class: "play", text: "Play", onclick: () => this.toggle() });
    this.slider = element("input", {
      type: "range",
      min: 0,
      max: this.data.frames.length - 1,
      value: 0,
      step: 1,
      "aria-label": "Time",
      oninput: () => this.go(Number(this.slider.value))
    });
    this.clock = element("output", {});
    const step = (text, name, way) => {
      const act = () => {
        this.stop();
        this.go(this.index + way);
      };
      return element("button", { type: "button", text, "aria-label": name, title: name, onclick: act });
    };
    const steps = [step("‹", "One picture back", -1), step("›", "One picture on", 1)];
    const timeline = element("div", { class: "timeline" }, this.play, ...steps, this.slider, this.clock);
    this.bar = element("canvas", { role: "img", "aria-label": "Colours of the fields" });
    this.strainBar = element("canvas", { role: "img", "aria-label": "Colours of the structure" });
    this.readout = element("div", { class: "readout muted", "aria-live": "off" });
    const bars = element("div", { class: "keys" }, this.bar, this.strainBar);
    this.host.append(controls, this.stage, timeline, bars, this.readout);
    this.canvas.addEventListener("pointermove", (event) => this.point(event));
    this.canvas.addEventListener("pointerleave", () => { this.readout.textContent = ""; });
  }
  choose() {
    const usual = { "fluid.pressure": "viridis", "fluid.void_fraction": "blues", "fluid.speed": "magma" };
    if (usual[this.field.value] && maps[usual[this.field.value]]) this.map.value = usual[this.field.value];
    this.fillRange();
    this.draw();
  }
  chosen(key) { return this.data.quantities.find((each) => each.key === key); }
  fillRange() {
    const quantity = this.chosen(this.field.value);
    if (!quantity) return;
    const [low, high] = this.ranges[quantity.key];
    this.unit.textContent = quantity.unit ? `from [${quantity.unit}]` : "from";
    this.low.value = shown(low * quantity.factor, 3);
    this.high.value = shown(high * quantity.factor, 3);
  }
  setRange() {
    const quantity = this.chosen(this.field.value),
      low = Number(this.low.value) / quantity.factor,
      high = Number(this.high.value) / quantity.factor;
    if (Number.isFinite(low) && Number.isFinite(high) && high > low) this.ranges[quantity.key] = [low, high];
    this.own.checked = false;
    this.fillRange();
    this.draw();
  }
  toggle() {
    if (this.timer) return this.stop();
    if (this.index === this.data.frames.length - 1) this.go(0);
    this.play.textContent = "Pause";
    const pause = Math.max(60, Math.min(500, 8000 / this.data.frames.length));
    this.timer = setInterval(() => { if (this.index < this.data.frames.length - 1) this.go(this.index + 1);
      else this.stop(); }, pause);
  }
  stop() { clearInterval(this.timer);
    this.timer = 0;
    this.play.textContent = "Play"; }
  go(index) {
    this.index = Math.max(0, Math.min(this.data.frames.length - 1, index));
    this.slider.value = this.index;
    this.draw();
  }
  async planes(index, part) {
    const frame = this.data.frames[index][part];
    const key = part + index;
    if (!frame || !frame.png) return null;
    if (!this.cache[key]) {
      this.cache[key] = (async () => {
        const image = new Image();
        image.src = "data:image/png;base64," + frame.png;
        await image.decode();
        const canvas = element("canvas", { width: image.width, height: image.height }),
          context = canvas.getContext("2d", { willReadFrequently: true });
        context.drawImage(image, 0, 0);
        const pixels = context.getImageData(0, 0, image.width, image.height).data,
          grey = new Uint8Array(pixels.length / 4);
        for (let i = 0; i < grey.length; ++i) grey[i] = pixels[4 * i];
        return grey;
      })();
    }
    return this.cache[key];
  }
  // Value of a level of 1 to 255, and a table of the colours of all levels.
  static value(scale, level) { return scale[1] + (scale[2] - scale[1]) * ((level - 1) / 254) ** scale[3]; }
  static table(scale, range, map) {
    const table = new Uint8Array(3 * 256);
    for (let level = 1; level < 256; ++level) table.set(colourAt(map, (Movie.value(scale, level) - range[0]) / ((range[1] -
      range[0]) || 1)), 3 * level);
    return table;
  }
  rangeOf(key, scale) {
    return this.own.checked && scale && scale[2] > scale[1] ? [Math.min(0, scale[1]), scale[2]] : this.ranges[key];
  }
  view(width) {
    const [left, bottom, right, top] = this.data.box, [across, up] = this.data.mirror;
    const extent = { left: across ? -right : left, right, bottom: up ? -top : bottom, top };
    const wide = extent.right - extent.left,
      high = extent.top - extent.bottom,
      gap = { left: 44, bottom: 36, right: 10, top: 26 };
    const scale = Math.min((width - gap.left - gap.right) / wide, Math.max(140, 0.75 * (window.innerHeight || 800)) / high);
    const x0 = gap.left + (width - gap.left - gap.right - scale * wide) / 2;
    const x = (u) => x0 + (u - extent.left) * scale;
    const y = (v) => gap.top + (extent.top - v) * scale;
    return { ...extent, scale, x0, y0: gap.top, height: gap.top + scale * high + gap.bottom, x, y };
  }
  images() {
    const [across, up] = this.data.mirror, found = [
      [1, 1]
    ];
    if (across) found.push([-1, 1]);
    if (up) found.push(...found.map(([a]) => [a, -1]));
    return found;
  }
  async draw() {
    const turn = (this.turn = (this.turn || 0) + 1),
      index = this.index,
      frame = this.data.frames[index];
    const [fluid, solids] = await Promise.all([this.planes(index, "fluid"), this.planes(index, "solids")]);
    if (turn !== this.turn) return; // a later call is under way
    const width = (this.drawnWidth = this.stage.clientWidth || 600),
      view = (this.last = this.view(width));
    const [context] = sized(this.canvas, view.height);
    const layers = [];
    if (fluid) layers.push(["fluid", fluid, this.field.value]);
    if (solids) layers.push(["solids", solids, fluid ? this.solidField.value : this.field.value]);
    this.shownLayers = layers;
    for (const [part, grey, key] of layers) this.drawLayer(context, view, part, grey, key);
    const strain = this.structure.value,
      quantity = this.chosen(strain),
      top = quantity ? [0, quantity.largest] : null;
    for (const body of frame.structures || []) this.drawStructure(context, view, body, strain.split(".")[1], top);
    if (frame.obstacles) this.stroke(context, view, shorts(frame.obstacles), themed("--outline"), 1.6);
    this.drawAxes(context, view);
    const quantityShown = this.chosen(this.field.value),
      clock = page.clock;
    this.clock.textContent = `${shown(frame.time * clock.factor, 4)} ${clock.unit}`;
    this.slider.setAttribute("aria-valuetext", this.clock.textContent);
    if (quantityShown) {
      const scales = (frame[quantityShown.key.split(".")[0]] || {}).scales || {};
      this.drawBar(this.bar, quantityShown, this.rangeOf(quantityShown.key, scales[quantityShown.key.split(".")[1]]), maps[
        this.map.value]);
    }
    if (quantity) this.drawBar(this.strainBar, { ...quantity, label: "structure: " + quantity.label }, top, maps.strain);
    else this.strainBar.style.height = "0";
    this.host.dataset.drawn = `${index} ${this.field.value}`;
  }
  drawLayer(context, view, part, grey, key) {
    const frame = this.data.frames[this.index][part],
      grid = this.data.grid,
      name = key.split(".")[1],
      scale = frame.scales[name];
    if (!scale) return;
    const count = grid.columns * grid.rows,
      first = scale[0] * count;
    const colours = Movie.table(scale, this.rangeOf(key, scale), maps[part === "solids" && this.of("fluid").length ?
      "strain" : this.map.value]);
    const picture = new ImageData(grid.columns, grid.rows),
      out = picture.data;
    const hollow = part === "fluid" && this.cavities.checked && frame.scales.void_fraction;
    for (let i = 0; i < count; ++i) {
      const level = grey[first + i];
      if (!level) continue;
      const white = hollow && Movie.value(hollow, grey[hollow[0] * count + i]) > 0.002;
      out[4 * i] = white ? 255 : colours[3 * level];
      out[4 * i + 1] = white ? 255 : colours[3 * level + 1];
      out[4 * i + 2] = white ? 255 : colours[3 * level + 2];
      out[4 * i + 3] = 255;
    }
    const buffer = element("canvas", { width: grid.columns, height: grid.rows });
    buffer.getContext("2d").putImageData(picture, 0, 0);
    const high = grid.low[1] + grid.rows * grid.pixel;
    const outlines = shorts(frame.outlines);
    for (const [across, up] of this.images()) {
      context.save();
      this.mirrored(context, view, across, up);
      context.beginPath();
      this.trace(context, view, outlines);
      context.clip("evenodd");
      context.imageSmoothingEnabled = true;
      context.imageSmoothingQuality = "high";
      const size = [grid.columns, grid.rows].map((count) => count * grid.pixel * view.scale);
      context.drawImage(buffer, view.x(grid.low[0]), view.y(high), ...size);
      context.restore();
    }
    const lines = shorts(frame.interfaces);
    this.stroke(context, view, lines, "rgba(0,0,0,.65)", 2.6);
    this.stroke(context, view, lines, "#ffffff", 1.2);
  }
  mirrored(context, view, across, up) {
    context.translate(across < 0 ? 2 * view.x(0) : 0, up < 0 ? 2 * view.y(0) : 0);
    context.scale(across, up);
  }
  trace(context, view, lines) {
    const low = this.data.grid.low,
      step = this.data.step;
    for (let i = 0; i < lines.length;) {
      const count = lines[i++];
      for (let k = 0; k < count; ++k, i += 2) {
        const x = view.x(low[0] + lines[i] * step),
          y = view.y(low[1] + lines[i + 1] * step);
        if (k) context.lineTo(x, y);
        else context.moveTo(x, y);
      }
    }
  }
  stroke(context, view, lines, colour, width) {
    for (const [across, up] of this.images()) {
      context.save();
      this.mirrored(context, view, across, up);
      context.beginPath();
      this.trace(context, view, lines);
      context.lineWidth = width;
      context.strokeStyle = colour;
      context.lineJoin = "round";
      context.stroke();
      context.restore();
    }
  }
  drawStructure(context, view, body, name, range) {
    const counts = bytes(body.counts),
      places = shorts(body.places),
      scale = name && body.fields[name] ? body.fields[name] : null;
    const levels = scale ? bytes(scale[0]) : null,
      table = scale && range ? Movie.table(["", ...scale.slice(1)], range, maps.strain) : null;
    const low = this.data.grid.low,
      step = this.data.step;
    for (const [across, up] of this.images()) {
      context.save();
      this.mirrored(context, view, across, up);
      let at = 0;
      for (let i = 0; i < counts.length; ++i) {
        context.beginPath();
        for (let k = 0; k < counts[i]; ++k, at += 2) {
          const x = view.x(low[0] + places[at] * step),
            y = view.y(low[1] + places[at + 1] * step);
          if (k) context.lineTo(x, y);
          else context.moveTo(x, y);
        }
        context.closePath();
        context.fillStyle = table ? `rgb(${table[3 * levels[i]]},${table[3 * levels[i] + 1]},${table[3 * levels[i] + 2]})` :
          "#8b93a1";
        context.fill();
        context.lineWidth = 0.6;
        context.strokeStyle = "rgba(20,24,31,.55)";
        context.stroke();
      }
      context.restore();
    }
  }
  drawAxes(context, view) {
    context.font = "12px system-ui, sans-serif";
    context.fillStyle = themed("--muted");
    context.strokeStyle = themed("--muted");
    context.lineWidth = 1;
    const bottom = view.y(view.bottom),
      left = view.x(view.left),
      [right, up] = this.data.axes;
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const u of ticks(1e3 * view.left, 1e3 * view.right, Math.max(2, ((view.right - view.left) * view.scale) / 90))) {
      const x = view.x(1e-3 * u);
      context.beginPath();
      context.moveTo(x, bottom);
      context.lineTo(x, bottom + 4);
      context.stroke();
      context.fillText(shown(u), x, bottom + 6);
    }
    context.textAlign = "right";
    context.fillText(`${right} [mm] →`, view.x(view.right), bottom + 20);
    context.textBaseline = "middle";
    for (const v of ticks(1e3 * view.bottom, 1e3 * view.top, Math.max(2, ((view.top - view.bottom) * view.scale) / 55))) {
      const y = view.y(1e-3 * v);
      context.beginPath();
      context.moveTo(left - 4, y);
      context.lineTo(left, y);
      context.stroke();
      context.fillText(shown(v), left - 7, y);
    }
    context.textAlign = "left";
    context.fillText(`↑ ${up} [mm]`, 8, 13);
  }
  drawBar(canvas, quantity, range, map) {
    const [context, width] = sized(canvas, 50), inner = width - 24;
    for (let i = 0; i < inner; ++i) {
      const [r, g, b] = colourAt(map, i / (inner - 1));
      context.fillStyle = `rgb(${r},${g},${b})`;
      context.fillRect(12 + i, 20, 1.5, 10);
    }
    context.font = "12px system-ui, sans-serif";
    context.fillStyle = themed("--ink");
    context.textBaseline = "alphabetic";
    context.fillText(quantity.label + (quantity.unit ? ` [${quantity.unit}]` : ""), 12, 14);
    context.textAlign = "center";
    context.fillStyle = themed("--muted");
    const [low, high] = range.map((value) => value * quantity.factor);
    if (!(high > low)) return;
    for (const value of ticks(low, high, Math.max(2, inner / 80))) context.fillText(shown(value), 12 + (inner * (value -
      low)) / (high - low), 44);
  }
  point(event) {
    const view = this.last,
      box = this.canvas.getBoundingClientRect(),
      grid = this.data.grid;
    if (!view) return;
    const u = view.left + (event.clientX - box.left - view.x0) / view.scale,
      v = view.top - (event.clientY - box.top - view.y0) / view.scale;
    const column = Math.floor(((this.data.mirror[0] ? Math.abs(u) : u) - grid.low[0]) / grid.pixel);
    const row = Math.floor(((this.data.mirror[1] ? Math.abs(v) : v) - grid.low[1]) / grid.pixel);
    let text = "";
    if (column >= 0 && row >= 0 && column < grid.columns && row < grid.rows) {
      for (const [part, grey, key] of this.shownLayers || []) {
        const scale = this.data.frames[this.index][part].scales[key.split(".")[1]],
          quantity = this.chosen(key);
        const level = scale ? grey[(scale[0] * grid.rows + (grid.rows - 1 - row)) * grid.columns + column] : 0;
        if (level) text += ` ${quantity.label} ${shown(Movie.value(scale, level) * quantity.factor, 3)} ${quantity.unit}`;
      }
    }
    const [right, up] = this.data.axes;
    this.readout.textContent = text ? `${right} ${shown(1e3 * u, 3)} mm, ${up} ${shown(1e3 * v, 3)} mm:${text}` : "";
  }
}