// SPDX-License-Identifier: MIT
// One close-up: two of its pictures under a slider, where each technique is wrong, and the figures. All pictures are in
// the page from the start, so a choice shows at once.
class CloseUp {
  constructor(shot) {
    this.shot = shot;
    this.left = "hfts";
    this.right = "soft";
    const kinds = [...shot.techniques.map(t => [t.id, t.title]), ["hard", "Truth, hard: 32 rays"], ["soft", `Truth, soft: ${shot.light_rays} rays`]];
    const layer = side => kinds.map(([kind, title]) =>
      element("img", { src: this.source(kind), alt: `${shot.title}: ${title}`, "data-kind": kind, class: side }));
    this.layers = { left: layer("above"), right: layer("below") };
    const slider = element("input", { type: "range", min: 0, max: 100, step: 0.5, value: 50, "aria-label": "Where the left picture ends" });
    const stack = element("div", { class: "stack", style: "--cut:50%" }, ...this.layers.right, ...this.layers.left, slider);
    const cut = value => stack.style.setProperty("--cut", `${value}%`);
    slider.addEventListener("input", () => cut(slider.value));
    stack.addEventListener("pointermove", event => {
      const box = stack.getBoundingClientRect();
      slider.value = 100 * (event.clientX - box.left) / box.width;
      cut(slider.value);
    });
    const choice = (side, label) => element("label", {}, element("span", {}, label),
      element("select", { onchange: event => { this[side] = event.target.value; this.update(); } },
        ...kinds.map(([kind, title]) => element("option", { value: kind, selected: kind === this[side] }, title))));
    this.body = element("article", { class: "close-up" },
      element("h3", {}, shot.title, element("small", {}, `${shot.triangles.toLocaleString("en")} triangles`)),
      element("div", { class: "controls" }, choice("left", "Left"), choice("right", "Right")),
      element("div", { class: "pictures", style: `--aspect:${shot.width}/${shot.height}` },
        element("figure", { class: "compare" }, element("div", { class: "frame" }, stack),
          element("figcaption", {}, "Move the pointer or the arrow keys across")),
        ...shot.techniques.map(t => this.tile(t))),
      this.figures(), this.lists());
    this.update();
  }

  source(kind) {
    const file = ["hard", "soft"].includes(kind) || kind.endsWith("-difference") ? kind : `${kind}-picture`;
    return `images/close-ups/${encodeURIComponent(this.shot.name)}/${file}.png`;
  }

  update() {
    for (const side of ["left", "right"])
      for (const image of this.layers[side]) image.hidden = image.dataset.kind !== this[side];
  }

  tile(t) {
    const source = this.source(`${t.id}-difference`), text = `${this.shot.title}, ${t.title}: against the ${t.truth} truth`;
    return element("figure", {},
      element("button", { type: "button", class: "frame", "aria-label": `Enlarge. ${text}`, onclick: () => zoom(source, text) }, element("img", { src: source, alt: text })),
      element("figcaption", { class: "keyline" }, element("b", {}, t.id.toUpperCase()), `− ${t.truth}`, swatch("#f2412a", "too dark"), swatch("#2f96ff", "too light")));
  }

  table(heads, rows) {
    return element("div", { class: "scroll" }, element("table", {},
      element("thead", {}, element("tr", {}, ...heads.map((head, i) => element("th", { scope: "col", class: i ? "" : "left" }, head)))),
      element("tbody", {}, ...rows.map(([first, ...rest]) => element("tr", {}, element("th", { scope: "row" }, first), ...rest.map(text => element("td", {}, text)))))));
  }

  figures() {
    const small = x => x > 0 && x < 5e-5 ? "<0.0001" : x.toFixed(4);
    const wrong = t => `${t.wrong_off_edge.toLocaleString("en")} (${percent(t.wrong_off_edge / Math.max(this.shot.off_edge_pixels, 1))})`;
    return this.table(["Technique", "Mis-shadowed, off edge", "Wrong samples", "Mean error, hard", "Mean error, soft", "In the penumbra", "ms", "Bytes a pixel"],
      this.shot.techniques.map(t => [t.title, t.truth === "hard" ? wrong(t) : "–",
        t.id === "exact" ? `${t.wrong_samples_ppm.toFixed(1)} ppm` : "–",
        t.truth === "hard" ? small(t.error_hard) : "–", t.error.toFixed(4), t.error_in_penumbra.toFixed(4), number(t.ms), number(t.bytes_per_pixel)]));
  }

  lists() {
    return this.table(["Grid of the exact technique", "Nodes in a list", "Longest", "Nodes a pixel", "List, ms", "Trace, ms", "Masks unlike the first"],
      this.shot.grids.map(g => [g.title, number(g.mean_list), g.longest_list.toLocaleString("en"), number(g.nodes_per_pixel),
        number(g.ms_list), number(g.ms_trace), g.unlike_masks.toLocaleString("en")]));
  }
}

function closeUps() {
  if (!data.close_ups.length) { byId("close-ups").hidden = true; return; }
  for (const shot of data.close_ups) byId("close-up-list").append(new CloseUp(shot).body);
}
