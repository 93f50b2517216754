// SPDX-License-Identifier: MIT
function claimList() {
  if (!claims.length) byId("claims").hidden = true;
  for (const claim of claims)
    byId("claim-list").append(element("div", { class: "claim" },
      element("p", { class: claim.holds ? "holds" : "fails" }, claim.holds ? "✓ holds" : "✗ does not hold"),
      element("div", {}, element("p", { class: "statement" }, claim.statement), element("p", { class: "source" }, claim.source),
        element("p", {}, claim.measured), element("p", { class: "reason" }, claim.reason))));
}
