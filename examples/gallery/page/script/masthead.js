// SPDX-License-Identifier: MIT
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
  if (ways.length) links.push(["#ways", "Ways"]);
  if (flights.length) links.push(["#flight", "Under way"]);
  if (data.close_ups.length) links.push(["#close-ups", "Close-ups"]);
  links.push(["#claims", "Claims"], ["#theory", "Theory"], ["#speed", "Speed"], ["#records", "Records"], ["#method", "Method"]);
  for (const [href, text] of links) byId("nav").append(element("a", { href }, text));
}
