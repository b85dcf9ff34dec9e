/** What nodes show on the floor: scans, paths and markers, in shapes that tabs/shapes.py describes. */

const LEAST = { line: 2, pairs: 2, dots: 3, text: 11, area: 0 }, MOST = 500; // size [pixel]
const EDGE = 1; // around a shape [pixel], so that it is seen on any background

export class Overlays {
  #layers = new Map(); // topic -> shapes

  /** robots: with their places now, for a scan whose place is known on its robot only. */
  show({ topic, shapes }, robots) {
    this.#layers.set(topic, shapes.map((shape) => {
      if (!("robot" in shape)) return shape;
      const { x, y, yaw } = robots[shape.robot] ?? { x: NaN };
      const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
      return { ...shape, points: shape.points.map(([px, py]) => [x + c * px - s * py, y + s * px + c * py]) };
    }));
    if (!shapes.length) this.#layers.delete(topic);
  }

  /** Forget everything, as a new server sends what there is. */
  clear() {
    this.#layers.clear();
  }

  /** All points [m]. */
  get points() {
    return [...this.#layers.values()].flat().flatMap(({ points }) => points);
  }

  /** paper: see Floor. */
  draw(paper) {
    paper.pen.save();
    paper.pen.lineJoin = "round";
    for (const shape of [...this.#layers.values()].flat()) drawShape(paper, shape);
    paper.pen.restore();
  }
}

function drawShape({ pen, colour, toPixels, scale }, { as, points, text, size, colour: given }) {
  const pixels = points.map(toPixels);
  const isOurs = given.startsWith("--"); // made for this floor
  const [fill, edge] = isOurs ? [colour(given), colour("--floor")] : [given, colour("--axis")];
  const width = Math.min(MOST, Math.max(LEAST[as], size * scale));
  const styles = [[edge, width + 2 * EDGE], [fill, width]];
  if (as === "dots") {
    for (const [style, side] of styles) {
      pen.fillStyle = style;
      for (const [x, y] of pixels) pen.fillRect(Math.round(x - side / 2), Math.round(y - side / 2), side, side);
    }
  } else if (as === "text") {
    Object.assign(pen, { strokeStyle: edge, fillStyle: fill, lineWidth: 2 * EDGE, textAlign: "center" });
    pen.font = `${width}px system-ui, sans-serif`;
    pen.strokeText(text, ...pixels[0]);
    pen.fillText(text, ...pixels[0]);
  } else {
    pen.beginPath();
    const isFirst = (i) => i === 0 || (as === "pairs" && i % 2 === 0);
    pixels.forEach(([x, y], i) => (isFirst(i) ? pen.moveTo(x, y) : pen.lineTo(x, y)));
    if (as === "area") pen.closePath();
    for (const [strokeStyle, lineWidth] of as === "area" ? styles.slice(0, 1) : styles) {
      Object.assign(pen, { strokeStyle, lineWidth });
      pen.stroke();
    }
    pen.fillStyle = fill;
    if (as === "area") pen.fill();
  }
}
