/** A drawing of the F710, with its sticks and buttons as /joy has them. */

import { handsOf, heldBy } from "./f710.js";

const PICTURE = `
<svg viewBox="0 0 320 204" role="img">
  <g class="shoulder">
    <g data-name="LT"><rect x="62" y="4" width="52" height="20" rx="8"/><text x="88" y="18">LT</text></g>
    <g data-name="RT"><rect x="206" y="4" width="52" height="20" rx="8"/><text x="232" y="18">RT</text></g>
    <g data-name="LB" class="deadman"><rect x="50" y="28" width="72" height="20" rx="8"/><text x="86" y="42">LB</text></g>
    <g data-name="RB"><rect x="198" y="28" width="72" height="20" rx="8"/><text x="234" y="42">RB</text></g>
  </g>
  <path class="body" d="M72 52 H248 C290 52 300 92 308 140 C314 178 300 200 280 198 C262 196 250 172
    232 164 H88 C70 172 58 196 40 198 C20 200 6 178 12 140 C20 92 30 52 72 52 Z"/>
  <g class="dpad" transform="translate(76 92)">
    <path d="M-8 -24 H8 V-8 H24 V8 H8 V24 H-8 V8 H-24 V-8 H-8 Z"/>
    <path data-name="up" d="M0 -21 L6 -12 H-6 Z"/><path data-name="down" d="M0 21 L6 12 H-6 Z"/>
    <path data-name="left" d="M-21 0 L-12 -6 V6 Z"/><path data-name="right" d="M21 0 L12 -6 V6 Z"/>
  </g>
  <g class="face">
    <g data-name="Y"><circle cx="244" cy="72" r="11"/><text x="244" y="76">Y</text></g>
    <g data-name="B"><circle cx="266" cy="92" r="11"/><text x="266" y="96">B</text></g>
    <g data-name="A"><circle cx="244" cy="112" r="11"/><text x="244" y="116">A</text></g>
    <g data-name="X"><circle cx="222" cy="92" r="11"/><text x="222" y="96">X</text></g>
  </g>
  <g class="small">
    <g data-name="BACK"><rect x="116" y="70" width="38" height="15" rx="7"/><text x="135" y="81">BACK</text></g>
    <g data-name="LOGITECH"><circle cx="160" cy="100" r="9"/><text x="160" y="103">●</text></g>
    <g data-name="START"><rect x="166" y="70" width="38" height="15" rx="7"/><text x="185" y="81">START</text></g>
  </g>
  <g class="stick" data-name="LEFT" transform="translate(118 134)"><circle r="25"/><circle data-stick="left" r="15"/></g>
  <g class="stick" data-name="RIGHT" transform="translate(202 134)"><circle r="25"/><circle data-stick="right" r="15"/></g>
</svg>`;
const TRAVEL = 12; // of a stick's knob, in units of the picture

export class GamepadPicture {
  constructor(root) {
    root.innerHTML = PICTURE;
    this.svg = root.querySelector("svg");
    this.show();
  }

  /** names: {D, X: names of the buttons of that mode}. axes, buttons: as on /joy, of either mode. */
  show(names = { D: [], X: [] }, axes = [0, 0], buttons = []) {
    const mode = axes.length === 8 ? "X" : "D";
    const hands = handsOf(mode, names[mode], axes, buttons);
    const held = heldBy(hands);
    const [dx, dy] = hands.dpad;
    const ways = { left: dx > 0, right: dx < 0, up: dy > 0, down: dy < 0 };
    for (const part of this.svg.querySelectorAll("[data-name]")) {
      part.classList.toggle("held", ways[part.dataset.name] ?? held.has(part.dataset.name));
    }
    for (const side of ["left", "right"]) {
      const [x, y] = hands[side].map((v) => -v * TRAVEL);
      const knob = this.svg.querySelector(`[data-stick=${side}]`);
      knob.setAttribute("transform", `translate(${x} ${y})`);
      knob.classList.toggle("moved", Math.hypot(x, y) > 0.01);
    }
    const words = [...held, ...hands.left.map((v) => v.toFixed(2))].join(" ");
    this.svg.setAttribute("aria-label", `F710 at ${mode}; held and left stick: ${words}`);
  }
}
