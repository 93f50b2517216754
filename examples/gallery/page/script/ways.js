// SPDX-License-Identifier: MIT
const totalOf = (rows, key) => rows.reduce((sum, row) => sum + row[key], 0);
const whole = x => x.toLocaleString("en");
const mebibytes = w => (w.maps_in_memory * w.map_size ** 2 * 4 / 2 ** 20).toFixed(0);

const unlikeKeys = w => w.with_picture ? ["unlike_pixels", "pixels", "px"] : ["unlike_texels", "texels", "texels"];

function unlikeCell(rows) {
  const [unlike, all, unit] = unlikeKeys(rows[0]);
  const count = totalOf(rows, unlike);
  const title = `of ${whole(totalOf(rows, all))} ${unit}` + (count && !rows[0].with_picture ? `, by at most ${Math.max(...rows.map(r => r.largest_difference))}` : "");
  return element("span", { title }, count ? `${whole(count)} ${unit}` : "0");
}

// What every way hands over and takes, scene by scene, and on the mean against the first way of its kind.
function waysTable() {
  if (!ways.length) byId("ways").hidden = true;
  const drivers = machine.backends.map(b => b.name);
  const order = [...ways].sort((a, b) => a.with_picture - b.with_picture);
  const names = [...new Set(order.map(w => w.way))];
  const first = w => names.find(name => order.some(o => o.way === name && o.with_picture === w.with_picture));
  const at = (scene, way, backend) => ways.find(w => w.scene === scene && w.way === way && w.backend === backend);
  const counts = [
    ["Passes", w => w.passes], ["Draw calls", w => w.draw_calls], ["Vertices", w => w.vertices], ["Triangles", w => w.triangles],
    ["Vertex runs", w => w.driver?.vertex_runs], ["Clipped", w => w.driver?.clipper_triangles]];
  const milliseconds = w => w.milliseconds;

  // The geometric mean over the scenes, against the first way of its kind.
  const ratio = (way, backend, figure) => {
    const logs = scenes.flatMap(s => {
      const mine = at(s.name, way, backend);
      const other = mine && at(s.name, first(mine), backend);
      return mine && figure(mine) > 0 && figure(other) > 0 ? [Math.log(figure(mine) / figure(other))] : [];
    });
    return logs.length ? Math.exp(mean(logs)).toFixed(2) + "×" : "–";
  };
  const cells = texts => texts.map(text => element("td", {}, text));
  const group = text => element("tr", { class: "group" },
    element("th", { class: "left", scope: "rowgroup", colspan: counts.length + drivers.length + 3 }, text));
  const pictured = way => order.find(o => o.way === way).with_picture;
  const row = (way, texts) => element("tr", { class: pictured(way) ? "pictured" : undefined }, element("th", { scope: "row" }, word(way)), ...cells(texts));
  const driverOf = way => drivers.find(d => ways.some(w => w.way === way && w.backend === d));

  const means = names.map(way => row(way, ["",
    ...counts.map(([, figure]) => ratio(way, driverOf(way), figure)), ...drivers.map(d => ratio(way, d, milliseconds)),
    unlikeCell(ways.filter(w => w.way === way))]));
  const bodies = scenes.filter(s => ways.some(w => w.scene === s.name)).map(s => {
    const best = w => Math.min(...ways.filter(o => o.scene === w.scene && o.backend === w.backend && o.with_picture === w.with_picture).map(milliseconds));
    return element("tbody", {}, group(`${word(s.name)}: ${ways.find(w => w.scene === s.name).view}`),
      ...names.map(way => {
        const mine = drivers.map(d => at(s.name, way, d));
        const any = mine.find(w => w);
        return row(way, [mebibytes(any), ...counts.map(([, figure]) => figure(any) === undefined ? "–" : whole(figure(any))),
          ...mine.map(w => !w ? "–" : w.milliseconds === best(w) ? element("b", {}, number(w.milliseconds)) : number(w.milliseconds)),
          unlikeCell(mine.filter(w => w))]);
      }));
  });
  byId("ways-table").append(
    element("thead", {}, element("tr", {}, element("th", { class: "left", scope: "col" }, "Way"), ...["Maps, MiB", ...counts.map(([title]) => title),
      ...drivers.map(d => `${d}, ms`), "Unlike"].map(title => element("th", { scope: "col" }, title)))),
    element("tbody", {}, group("All scenes: the mean, relative to the first way of its kind"), ...means), ...bodies);
  byId("ways-found").textContent = waysFound();
}

// In sentences: are they the same, what do they save, where does multiview fall back.
function waysFound() {
  const maps = ways.filter(w => !w.with_picture);
  const unlike = totalOf(maps, "unlike_texels");
  const found = [unlike ? `Of ${whole(totalOf(maps, "texels"))} texels ${whole(unlike)} are unlike, by at most ${Math.max(...maps.map(w => w.largest_difference))}.` : `All ways gave the same maps: ${whole(totalOf(maps, "texels"))} texels compared, none unlike.`];
  const same = ways.filter(w => w.way === "multiview" && w.maps > 1).map(w =>
    [w, ways.find(o => o.scene === w.scene && o.backend === w.backend && !o.with_picture)]);
  const back = same.filter(([w, pass]) => w.vertices >= pass.vertices);
  if (!same.length) found.push("No driver here has multiview.");
  else if (back.length) found.push("Multiview falls back on this machine: its driver draws one view at once, so it comes to a pass a map and one more that clears.");
  const saved = ways.filter(w => w.with_picture && w.maps_in_memory < w.maps);
  if (saved.length) {
    const most = Math.max(...saved.map(w => w.maps));
    const pixels = totalOf(saved, "unlike_pixels");
    found.push(`Split by split needs memory for one map instead of ${most}; of its ${whole(totalOf(saved, "pixels"))} pixels ` +
      `${pixels ? whole(pixels) : "none"} ${pixels === 1 ? "is" : "are"} unlike.`);
  }
  return found.join(" ");
}

function fitsFound() {
  const [maps, unlike, pictures] = ["maps", "unlike_maps", "pictures"].map(key => totalOf(fits, key));
  if (!maps) return "";
  return `${whole(maps)} maps in ${whole(pictures)} pictures were fitted on the device to the depth that the eye saw, and used there: ` +
    (unlike ? `${whole(unlike)} are not the C++’s` : "all have the bits of the C++’s matrices") +
    `; of ${whole(totalOf(fits, "texels"))} texels drawn with them ${whole(totalOf(fits, "unlike_texels"))} and of ` +
    `${whole(totalOf(fits, "pixels"))} pixels ${whole(totalOf(fits, "unlike_pixels"))} are unlike.`;
}

// What promises.hpp found.
function verdict() {
  if (!judged) return "These drivers do not share a rasteriser, so their differences are told but not judged.";
  return broken.length ? `Broken here, against what is promised: ${broken.join("; ")}.` :
    "Nothing that is promised is broken here: the same texels covered, depths within 2 ulp, pixels alike off edges, the same maps and " +
    "picture in every way, no triangle drawn into a map that its object does not cast into, and the device’s fits those of the C++.";
}

function parityTable() {
  byId("fits-found").textContent = fitsFound();
  byId("judged").textContent = verdict();
  byId("judged").classList.toggle("warning", judged && broken.length > 0);
  byId("parity-table").hidden = !parity.length;
  if (!parity.length) return;
  const columns = [
    ["Scene", p => word(p.scene)], ["Driver", p => p.backend], ["Maps", p => whole(p.maps)], ["Texels covered", p => whole(p.covered_texels)],
    ["in one only", p => whole(p.covered_in_one)], ["at another depth", p => whole(p.unlike_texels)], ["ulp, at most", p => whole(p.largest_ulp)],
    ["Pictures", p => whole(p.pictures)], ["Pixels", p => whole(p.pixels)], ["unlike", p => whole(p.unlike_pixels)], ["unlike off edges", p => whole(p.unlike_off_edges)]];
  byId("parity-table").append(
    element("thead", {}, element("tr", {}, ...columns.map(([title], i) => element("th", { scope: "col", class: i < 2 ? "left" : "" }, title)))),
    element("tbody", {}, ...parity.map(p => element("tr", {}, ...columns.map(([, show], i) => element("td", { class: i < 2 ? "left" : "" }, show(p)))))));
}

// The first view of each scene as every driver drew it.
function besidePictures() {
  return scenes.flatMap(s => data.shown_on_every_driver.flatMap(id => machine.backends
    .filter(b => matching({ scene: s.name, view: s.views[0].name, technique: id, backend: b.name }).length)
    .map((b, i) => ({ scene: s, id, driver: b.name, text: `${word(s.name)}, ${technique(id).title}, ${b.name}`,
      source: `${folder(s.name, s.views[0].name)}${id}-picture${i ? "-" + b.name : ""}.png` }))));
}

function beside() {
  if (machine.backends.length < 2) return;
  const all = besidePictures();
  for (const s of scenes)
    for (const id of data.shown_on_every_driver) {
      const mine = all.filter(p => p.scene === s && p.id === id);
      if (mine.length) byId("beside").append(element("h4", {}, `${word(s.name)}: ${technique(id).title}`),
        element("div", { class: "beside", style: `--count:${mine.length}` }, ...mine.map(p => element("figure", {},
          element("button", { type: "button", class: "frame", "aria-label": `Enlarge. ${p.text}`, onclick: () => zoom(p.source, p.text) },
            element("img", { src: p.source, alt: p.text })),
          element("figcaption", {}, p.driver)))));
    }
}
