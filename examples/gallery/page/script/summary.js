// SPDX-License-Identifier: MIT
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
