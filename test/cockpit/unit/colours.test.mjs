// What the floor and the graph draw stands out from what is beside it: WCAG 2.2, 1.4.11.
// claim: What the floor and the graph draw stands out
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

const css = readFileSync(new URL("../../../common/cockpit/page/style.css", import.meta.url), "utf8");
// A bumper has an edge of the colour of the floor.
const BESIDE = { scan: ["floor", "wall"], bumper: ["floor"], axis: ["floor"], accent: ["floor"] };

function luminance(hex) {
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255)
    .map((c) => (c <= 0.04 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

for (const [scheme, block] of css.match(/:root \{[^}]*\}/g).entries()) {
  test(`colours of scheme ${scheme}`, () => {
    const colours = Object.fromEntries([...block.matchAll(/--([\w-]+): (#\w{6});/g)].map(([, ...one]) => one));
    for (const [name, others] of Object.entries(BESIDE)) {
      for (const other of others) {
        const [low, high] = [colours[name], colours[other]].map(luminance).sort((a, b) => a - b);
        assert.ok((high + 0.05) / (low + 0.05) >= 3, `${name} beside ${other}`);
      }
    }
  });
}
