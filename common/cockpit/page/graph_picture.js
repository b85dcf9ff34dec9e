/** The picture of the tab Graph, and the same as a file. */

import { brief } from "./dom.js";

const SVG = "http://www.w3.org/2000/svg";

function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** The <svg> of what layout() returns. */
export function pictureOf({ width, height, boxes, arrows, groups }) {
  const tip = (id) => svg("marker", { id, viewBox: "0 0 8 8", refX: 7, refY: 4, orient: "auto",
    markerUnits: "userSpaceOnUse", markerWidth: 10, markerHeight: 10 }, svg("path", { d: "M0 0 L8 4 L0 8 Z" }));
  return svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "group" },
    svg("defs", {}, tip("tip"), tip("chosen-tip")),
    ...groups.map(({ name, x, y, w, h }) => svg("g", { class: "group" },
      svg("rect", { x, y, width: w, height: h, rx: 8 }), svg("text", { x: x + 8, y: y + 16 }, name))),
    ...arrows.map(({ from, to, path }) =>
      svg("path", { d: path, class: "arrow", "data-from": from, "data-to": to })),
    ...Object.entries(boxes).map(([item, place]) => boxOf(item, place)));
}

function boxOf(item, { x, y, w, h }) {
  const [kind, name] = item.split(" ");
  const [cx, cy] = [x + w / 2, y + h / 2];
  const shape = kind === "node"
    ? svg("ellipse", { cx, cy, rx: w / 2, ry: h / 2 })
    : svg("rect", { x, y, width: w, height: h, rx: 3 });
  return svg("g", { class: kind, "data-item": item, role: "button", tabindex: -1, "aria-label": item },
    shape, svg("text", { x: cx, y: cy + 5 }, brief(name)), svg("title", {}, name));
}

/** A picture as a file of its own: whole, with its style in the page's light colours. */
export function fileOf(picture) {
  const sheet = [...document.styleSheets].find(({ href }) => href?.endsWith("/style.css"));
  const [light, ...rules] = /** @type {any} */ (sheet.cssRules);
  const style = rules.filter(({ selectorText }) => /^#(graph|tip|chosen-tip) /.test(selectorText))
    .map(({ cssText }) => cssText.replace(/var\((.*?)\)/g, (_, name) => light.style.getPropertyValue(name)));
  const copy = picture.cloneNode(true);
  const { width, height } = picture.viewBox.baseVal;
  for (const [name, value] of Object.entries({ id: "graph", width, height })) copy.setAttribute(name, value);
  copy.prepend(svg("style", {}, ...style), svg("rect", { class: "back", width, height }));
  return new Blob([new XMLSerializer().serializeToString(copy)], { type: "image/svg+xml" });
}
