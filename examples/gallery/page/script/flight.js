// SPDX-License-Identifier: MIT
// Flips of ten thousand decisions, policy by policy.
function flightTable() {
  if (!flights.length) { byId("flight").hidden = true; return; }
  const names = [...new Set(flights.map(f => f.policy))];
  const flown = scenes.filter(s => flights.some(f => f.scene === s.name));
  const at = (scene, policy) => flights.find(f => f.scene === scene && f.policy === policy);
  const share = x => x === 0 ? "0" : 1e4 * x < 0.01 ? "<0.01" : number(1e4 * x);
  const cells = (f, strong) => [f.shimmer, f.shimmer_within].map(x => element("td", {}, strong ? element("b", {}, share(x)) : share(x)));
  byId("flight-table").append(
    element("thead", {},
      element("tr", {}, element("th", { class: "left", scope: "col", rowspan: 2 }, "Policy"), element("th", { scope: "col", rowspan: 2 }, "Maps"),
        ...flown.map(s => element("th", { scope: "colgroup", colspan: 2 }, word(s.name)))),
      element("tr", {}, ...flown.flatMap(() => ["all", "same map"].map(text => element("th", { scope: "col" }, text))))),
    element("tbody", {}, ...names.map(name => {
      const mine = flights.filter(f => f.policy === name);
      const [any] = mine;
      return element("tr", {}, element("th", { scope: "row" }, any.title, element("small", {}, any.stable ? "promises at most 1" : "promises nothing")),
        element("td", {}, [...new Set(mine.map(f => `${f.maps} × ${f.map_size}²`))].join(", ")), ...flown.flatMap(s => cells(at(s.name, name), any.stable)));
    })));
  const decisions = totalOf(flights.filter(f => f.policy === names[0]), "decisions");
  byId("flight-found").textContent = `${flights[0].frames} frames and ${whole(decisions)} decisions for each policy.`;
}
