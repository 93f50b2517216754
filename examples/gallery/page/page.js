"use strict";
(() => {
  const faults = [];
  window.addEventListener("error", event => faults.push(event.message || "an image did not load"), true);

  const data = JSON.parse(document.getElementById("data").textContent);
  const { records, claims, machine, settings, techniques, scenes, palette } = data;
  const firstBackend = machine.backends[0].name;
  const byId = id => document.getElementById(id);

  // element("p", {class: "x", onclick: f}, child, "text")
  function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
      if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
      else if (value === true) made.setAttribute(key, "");
      else if (value !== false && value !== undefined) made.setAttribute(key, value);
    }
    made.append(...children);
    return made;
  }

  const percent = x => {
    const p = 100 * x;
    return (p === 0 ? "0" : p < 0.01 ? "<0.01" : p < 10 ? p.toFixed(2) : p.toFixed(1)) + "\u2009%";
  };
  const number = x => x === 0 ? "0" : x >= 100 ? x.toFixed(0) : x >= 10 ? x.toFixed(1) : x.toFixed(2);
  const mean = values => values.reduce((sum, x) => sum + x, 0) / Math.max(values.length, 1);
  const word = name => name.charAt(0).toUpperCase() + name.slice(1).replace(/[-_]+/g, " ");
  const technique = id => techniques.find(t => t.id === id);
  const folder = (scene, view) => ["images", scene, view].map(encodeURIComponent).join("/") + "/";
  const matching = wanted => records.filter(r => Object.entries(wanted).every(([key, value]) => r[key] === value));

  function masthead() {
    const judged = records.reduce((sum, r) => sum + r.lit_facing_pixels, 0);
    const views = scenes.reduce((sum, s) => sum + s.views.length, 0);
    byId("lede").textContent =
      `${techniques.length} techniques drew ${views} views of ${scenes.length} ${scenes.length === 1 ? "scene" : "scenes"}. ` +
      "Every pixel that faces the light was then asked again, by tracing a ray. This page shows where the maps were wrong.";
    const ranked = techniques
      .map(t => [t, matching({ technique: t.id, backend: firstBackend }).map(r => r.mis_shadowed_fraction_off_edge)])
      .filter(([, fractions]) => fractions.length)
      .map(([t, fractions]) => [t, mean(fractions)])
      .sort((a, b) => a[1] - b[1]);
    const others = records.filter(r => r.backend !== firstBackend);
    const held = claims.filter(c => c.holds).length;
    const keys = [];
    if (ranked.length) keys.push(["Fewest wrong pixels", percent(ranked[0][1]), ranked[0][0].title]);
    keys.push(["Pixels judged", judged >= 1e6 ? (judged / 1e6).toFixed(1) + " million" : judged.toLocaleString("en"), `${records.length} pictures`]);
    if (others.length) {
      const unlike = mean(others.map(r => r.unlike_first_backend_fraction));
      keys.push(["Drivers", String(machine.backends.length),
                 unlike === 0 ? "identical pictures, bit for bit" : percent(unlike) + " of pixels differ"]);
    }
    if (claims.length) keys.push(["Claims that hold", `${held} of ${claims.length}`, "measured, below"]);
    for (const [term, value, hint] of keys)
      byId("keys").append(element("div", {}, element("dt", {}, term), element("dd", {}, value, element("small", {}, hint))));
  }

  function navigation() {
    const links = scenes.map(s => [`#scene-${s.name}`, word(s.name)]);
    links.push(["#claims", "Claims"], ["#theory", "Theory"], ["#records", "Records"], ["#method", "Method"]);
    for (const [href, text] of links) byId("nav").append(element("a", { href }, text));
  }

  function summary() {
    const columns = [
      ["Footprint, p95", "footprint_p95", number], ["Map used", "map_used_fraction", percent],
      ["Depth, ms", "ms_depth", number], ["Receive, ms", "ms_receive", number]];
    const rows = techniques.map(t => {
      const mine = matching({ technique: t.id, backend: firstBackend });
      const fractions = scenes.map(s => mine.filter(r => r.scene === s.name).map(r => r.mis_shadowed_fraction_off_edge));
      return { t, mine, scenes: fractions.map(f => f.length ? mean(f) : null), all: mean(mine.map(r => r.mis_shadowed_fraction_off_edge)) };
    }).filter(row => row.mine.length);
    const highest = Math.max(1e-6, ...rows.flatMap(row => row.scenes));
    const best = scenes.map((_, i) => Math.min(...rows.map(row => row.scenes[i] ?? Infinity)));
    const cell = (row, value, i) => value === null ? element("td", {}, "–") :
      element("td", { class: "cell" + (value === best[i] ? " best" : ""), style: `--heat:${(0.5 * Math.sqrt(value / highest)).toFixed(3)}` },
        element("a", { href: `#scene-${scenes[i].name}`, onclick: () => shows.get(scenes[i].name).choose(row.t.id) }, percent(value)));
    byId("summary-table").append(
      element("caption", { hidden: true }, "Mis-shadowed pixels off edges by technique and scene"),
      element("thead", {}, element("tr", {}, element("th", { class: "left", scope: "col" }, "Technique"),
        ...scenes.map(s => element("th", { scope: "col" }, word(s.name))), element("th", { scope: "col" }, "Mean"),
        ...columns.map(([title]) => element("th", { scope: "col" }, title)))),
      element("tbody", {}, ...rows.map(row => element("tr", {},
        element("th", { scope: "row" }, row.t.title, element("small", {}, `${row.t.maps} × ${row.t.map_size}², ${row.t.source}`)),
        ...row.scenes.map((value, i) => cell(row, value, i)), element("td", {}, element("b", {}, percent(row.all))),
        ...columns.map(([, key, show]) => element("td", {}, show(mean(row.mine.map(r => r[key])))))))));
  }

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

//@SECTIONS@
  function claimList() {
    if (!claims.length) byId("claims").hidden = true;
    for (const claim of claims)
      byId("claim-list").append(element("div", { class: "claim" },
        element("p", { class: claim.holds ? "holds" : "fails" }, claim.holds ? "✓ holds" : "✗ does not hold"),
        element("div", {}, element("p", { class: "statement" }, claim.statement), element("p", { class: "source" }, claim.source),
          element("p", {}, claim.measured), element("p", { class: "reason" }, claim.reason))));
  }

  function recordTable() {
    const columns = [
      ["Scene", "scene"], ["View", "view"], ["Technique", "technique"], ["Driver", "backend"],
      ["Off edge", "mis_shadowed_fraction_off_edge", percent], ["All", "mis_shadowed_fraction", percent],
      ["Judged px", "lit_facing_pixels", x => x.toLocaleString("en")], ["Beyond px", "beyond_pixels", x => x.toLocaleString("en")],
      ["Unmapped px", "unmapped_pixels", x => x.toLocaleString("en")],
      ["Footprint mean", "footprint_mean", number], ["p95", "footprint_p95", number], ["max", "footprint_max", number],
      ["Map used", "map_used_fraction", percent], ["Maps", "maps", String], ["Size", "map_size", String],
      ["Depth, ms", "ms_depth", number], ["Receive, ms", "ms_receive", number],
      ["Unlike first driver", "unlike_first_backend_fraction", percent], ["Note", "note"]];
    const body = element("tbody");
    const fill = rows => body.replaceChildren(...rows.map(r => element("tr", {}, ...columns.map(([, key, show]) =>
      element("td", { class: key === "note" ? "note" : show ? "" : "left" }, show ? show(r[key]) : r[key])))));
    const heads = columns.map(([title, key, show]) => {
      const head = element("th", { scope: "col", class: show ? "" : "left" }, element("button", { type: "button", onclick: () => {
        const descending = head.getAttribute("aria-sort") === "ascending";
        heads.forEach(h => h.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", descending ? "descending" : "ascending");
        const order = (a, b) => a[key] < b[key] ? -1 : a[key] > b[key] ? 1 : 0;
        fill([...records].sort((a, b) => descending ? order(b, a) : order(a, b)));
      } }, title));
      return head;
    });
    fill(records);
    byId("record-table").append(element("thead", {}, element("tr", {}, ...heads)), body);
  }

  function method() {
    for (const place of document.querySelectorAll("[data-setting]")) place.textContent = settings[place.dataset.setting];
    const taps = 2 * settings.filter_radius + 1;
    byId("machine").textContent =
      `Pictures of ${settings.width} × ${settings.height}, ${taps} × ${taps} taps, seed ${settings.seed}` + (settings.quick ? ", quick run" : "") +
      `. Drivers: ${machine.backends.map(b => `${b.name} (${b.driver})`).join("; ")}; ${machine.threads} hardware threads.`;
  }

  // The page's own test, for index.html#check: every picture of every choice must load, and no script error may occur.
  async function check() {
    const wanted = new Set();
    for (const r of records.filter(r => r.backend === firstBackend)) {
      const at = folder(r.scene, r.view);
      wanted.add(at + "truth.png");
      for (const kind of ["picture", "difference", "overlay", "footprint", ...(r.maps ? ["maps"] : [])]) wanted.add(`${at}${r.technique}-${kind}.png`);
    }
    await Promise.all([...wanted].map(source => new Promise(done => {
      const image = new Image();
      image.onload = () => { if (!image.naturalWidth) faults.push(source); done(); };
      image.onerror = () => { faults.push(source); done(); };
      image.src = source;
    })));
    const shown = [...document.images].filter(image => image.getAttribute("src"));
    for (const image of shown) if (!(image.complete && image.naturalWidth > 0)) faults.push(image.src);
    document.documentElement.dataset.verdict = faults.length ? `bad: ${faults.join(" | ")}` : `ok: ${wanted.size} pictures, ${shown.length} shown`;
  }

  masthead();
  navigation();
  for (const scene of scenes) shows.set(scene.name, new Show(scene));
  summary();
  closeUps();
  claimList();
  recordTable();
  method();
  if (location.hash === "#check") window.addEventListener("load", check);
})();
