// SPDX-License-Identifier: MIT
function method() {
  for (const place of document.querySelectorAll("[data-setting]")) place.textContent = settings[place.dataset.setting];
  const taps = 2 * settings.filter_radius + 1;
  byId("machine").textContent =
    `Pictures of ${settings.width} × ${settings.height}, ${taps} × ${taps} taps, seed ${settings.seed}` + (settings.quick ? ", quick run" : "") +
    `. Drivers: ${machine.backends.map(b => `${b.name} (${b.driver})`).join("; ")}; ${machine.threads} hardware threads.`;
}
