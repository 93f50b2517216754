// SPDX-License-Identifier: MIT
const faults = [];
window.addEventListener("error", event => faults.push(event.message || "an image did not load"), true);

const data = JSON.parse(document.getElementById("data").textContent);
const { records, ways, parity, fits, flights, judged, broken, claims, machine, settings, techniques, scenes, palette } = data;
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
