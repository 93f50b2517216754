// SPDX-License-Identifier: MIT
// The page's own test, for index.html#check: every picture of every choice must load, and no script error may occur.
async function check() {
  const wanted = new Set();
  for (const r of records.filter(r => r.backend === firstBackend)) {
    const at = folder(r.scene, r.view);
    wanted.add(at + "truth.png");
    for (const kind of ["picture", "difference", "overlay", "footprint", ...(r.maps ? ["maps"] : [])]) wanted.add(`${at}${r.technique}-${kind}.png`);
  }
  for (const picture of besidePictures()) wanted.add(picture.source);
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
waysTable();
parityTable();
beside();
flightTable();
closeUps();
claimList();
recordTable();
method();
if (location.hash === "#check") window.addEventListener("load", check);
