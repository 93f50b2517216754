// SPDX-License-Identifier: MIT
const swatch = (colour, text) =>
  element("span", {}, element("span", { class: "swatch", style: `background:${colour}`, "aria-hidden": "true" }), text);
const legends = {
  difference: () => [swatch("#f2412a", "false shadow"), swatch("#2f96ff", "false light"), swatch("#8c6a64", "edge")],
  overlay: record => Array.from({ length: record.maps }, (_, i) => swatch(palette.maps[i], String(i + 1))),
  footprint: () => [element("span", { class: "scale" }, "¼", element("i", { style: `background:linear-gradient(90deg,${palette.footprint.join(",")})` }), "16 px a texel")],
  maps: () => [swatch("rgb(236,205,164)", "read by the picture"), swatch("rgb(86,106,134)", "drawn for nobody")],
  truth: () => ["ray-traced"],
};
const titles = { picture: "Picture", truth: "Truth", difference: "Difference", overlay: "Map in use", footprint: "Footprint", maps: "Maps" };

// One scene: a choice of view and technique, and the pictures of that choice.
class Show {
  constructor(scene) {
    this.scene = scene;
    this.view = scene.views[0];
    this.technique = techniques.some(t => t.id === "cascades-4-stable") ? "cascades-4-stable" : techniques[0].id;
    this.versus = "truth";
    this.body = element("div");
    this.select = element("select", { onchange: () => this.choose(this.select.value) });
    this.versusSelect = element("select", { onchange: () => { this.versus = this.versusSelect.value; this.update(); } },
      ...["truth", "difference", "overlay", "footprint"].map(kind => element("option", { value: kind }, titles[kind])));
    const step = by => {
      const ids = this.served().map(t => t.id);
      this.choose(ids[(ids.indexOf(this.technique) + by + ids.length) % ids.length]);
    };
    this.section = element("section", { id: `scene-${scene.name}` },
      element("h2", {}, word(scene.name), element("small", {}, `${scene.triangles.toLocaleString("en")} triangles`)),
      element("div", { class: "controls" },
        element("fieldset", {}, element("legend", {}, "View"), element("div", { class: "tabs" }, ...scene.views.map((view, i) =>
          element("label", {}, element("input", { type: "radio", name: `view-${scene.name}`, checked: i === 0,
            onchange: () => { this.view = view; this.update(); } }), word(view.name))))),
        element("div", {}, element("label", {}, element("span", {}, "Technique")),
          element("div", { class: "chooser" },
            element("button", { type: "button", class: "step", "aria-label": "Previous technique", onclick: () => step(-1) }, "‹"), this.select,
            element("button", { type: "button", class: "step", "aria-label": "Next technique", onclick: () => step(1) }, "›"))),
        element("label", {}, element("span", {}, "Compare with"), this.versusSelect)),
      this.body);
    this.select.setAttribute("aria-label", `Technique shown for ${scene.name}`);
    byId("scenes").append(this.section);
    this.update();
  }

  served() { return techniques.filter(t => matching({ scene: this.scene.name, view: this.view.name, technique: t.id }).length); }
  choose(id) { this.technique = id; this.update(); }
  source(kind) { return folder(this.scene.name, this.view.name) + (kind === "truth" ? "truth" : `${this.technique}-${kind}`) + ".png"; }
  alt(kind) { return `${titles[kind]}: ${word(this.scene.name)}, ${this.view.name}` + (kind === "truth" ? "" : `, ${technique(this.technique).title}`); }
  image(kind, attributes = {}) { return element("img", { src: this.source(kind), alt: this.alt(kind), ...attributes }); }

  compare() {
    const slider = element("input", { type: "range", min: 0, max: 100, step: 0.5, value: 50, "aria-label": `Picture left of here, ${this.versus} right of here` });
    const stack = element("div", { class: "stack", style: "--cut:50%" }, this.image(this.versus), this.image("picture", { class: "above" }),
      element("span", { class: "tag a" }, "picture"), element("span", { class: "tag b" }, titles[this.versus].toLowerCase()), slider);
    const cut = value => stack.style.setProperty("--cut", `${value}%`);
    slider.addEventListener("input", () => cut(slider.value));
    stack.addEventListener("pointermove", event => {
      const box = stack.getBoundingClientRect();
      slider.value = 100 * (event.clientX - box.left) / box.width;
      cut(slider.value);
    });
    return element("figure", { class: "compare" }, element("div", { class: "frame" }, stack),
      element("figcaption", {}, element("b", {}, "Picture"), " and ", titles[this.versus].toLowerCase(), ": move the pointer or the arrow keys across"));
  }

  tile(kind, record, attributes = {}) {
    return element("figure", attributes,
      element("button", { type: "button", class: "frame", "aria-label": `Enlarge. ${this.alt(kind)}`, onclick: () => zoom(this.source(kind), this.alt(kind)) }, this.image(kind)),
      element("figcaption", { class: "keyline" }, element("b", {}, titles[kind]), ...legends[kind](record)));
  }

  update() {
    const served = this.served();
    if (!served.some(t => t.id === this.technique)) this.technique = served[0].id;
    this.select.replaceChildren(...served.map(t => element("option", { value: t.id, selected: t.id === this.technique }, t.title)));
    const record = matching({ scene: this.scene.name, view: this.view.name, technique: this.technique, backend: firstBackend })[0];
    const figures = [
      ["Wrong off edge", percent(record.mis_shadowed_fraction_off_edge)], ["Wrong, all", percent(record.mis_shadowed_fraction)],
      ["Judged", record.lit_facing_pixels.toLocaleString("en") + " px"], ["In no map", record.unmapped_pixels.toLocaleString("en") + " px"],
      ["Footprint p95 / max", `${number(record.footprint_p95)} / ${number(record.footprint_max)} px`],
      ["Map used", percent(record.map_used_fraction)], ["Maps", `${record.maps} × ${record.map_size}²`],
      ["Depth + receive", `${number(record.ms_depth)} + ${number(record.ms_receive)} ms`],
      ["Light", `${this.view.light}, ${this.view.light_elevation_degrees.toFixed(0)}°`]];
    const wide = [];
    if (record.splits.length) wide.push(["Splits, metres", record.splits.map(number).join(" · ")]);
    if (record.note) wide.push(["The library says", record.note]);
    const list = element("dl", { class: "figures" }, ...[...figures.map(f => [f, false]), ...wide.map(f => [f, true])].map(
      ([[term, value], isWide]) => element("div", isWide ? { class: "wide" } : {}, element("dt", {}, term), element("dd", {}, value))));
    const tiles = ["truth", "difference", "overlay", "footprint"].map(kind => this.tile(kind, record));
    const maps = record.maps ? [this.tile("maps", record, { class: "maps", style: `--count:${record.maps}` })] : [];
    this.body.replaceChildren(element("div", { class: "pictures", style: `--aspect:${settings.width}/${settings.height}` },
      this.compare(), ...tiles, list, ...maps));
  }
}

const shows = new Map();

function zoom(source, text) {
  byId("zoom-image").src = source;
  byId("zoom-image").alt = text;
  byId("zoom-text").textContent = text;
  byId("zoom").showModal();
}
