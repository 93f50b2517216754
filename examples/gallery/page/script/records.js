// SPDX-License-Identifier: MIT
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
