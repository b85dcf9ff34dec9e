/** The floor from above: grid, map, trails, robots. x is to the right, y up, as on paper. */

import { drawNames } from "./names.js";
import { Overlays } from "./overlays.js";
import { drawBumpers, Surroundings } from "./surroundings.js";

const BODY_RADIUS_M = 0.177; // TurtleBot 2
const TRAIL_STEP_M = 0.02; // between two points of a trail
const TRAIL_POINTS = 3000;
const SCALE = { least: 4, start: 110, most: 1500 }; // [pixel/m]
const GRID_PX = 45; // least distance between two lines of the grid
const BODY = "M1 0 A1 1 0 0 1 -1 0 A1 1 0 0 1 1 0"; // of a robot, with the radius 1
const ARROW = "M.85 0 L-.44 .41 L-.2 0 L-.44 -.41"; // on it, ahead
const [body, arrow] = [BODY, ARROW].map((path) => new Path2D(path));
const PAN = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
const STEP_PX = 20; // by which a key moves a pose
const ZOOM = { "+": 1.25, "-": 0.8 };

export class Floor {
  #centre = [0, 0]; // [m] in the middle of the free part of the canvas
  #scale = SCALE.start;
  #trails = new Map(); // name -> [[x, y], ...]
  #robots = {};
  #pointers = new Map();
  #due = false;
  around = new Surroundings(); // Changes are drawn with the robots' next places.
  overlays = new Overlays();
  /** @type {any} */
  tools = null; // the PoseTools, once there are some
  #free = { left: 0, top: 0, right: 0, bottom: 0 }; // the part of the canvas that nothing covers [pixel]

  /** toolbar, glass: they cover the canvas at the top, and maybe at the bottom. Names are between them. */
  constructor(canvas, toolbar, glass) {
    this.canvas = canvas;
    this.toolbar = toolbar;
    this.glass = glass;
    this.follow = true;
    this.look = ""; // the robot that is followed
    new ResizeObserver(() => this.#drawSoon()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#drawSoon());
    this.#listen();
  }

  /** robots: {name: {x, y, yaw, age}} [m, rad]; one without a place is not drawn. */
  show(robots) {
    const placed = Object.entries(robots)
      .map(([name, robot]) => [name, this.around.placed(robot)])
      .filter(([, { x, y, yaw }]) => [x, y, yaw].every(Number.isFinite));
    this.#robots = Object.fromEntries(placed);
    for (const [name, { x, y }] of placed) {
      const trail = this.#trails.get(name) ?? [];
      const [lastX, lastY] = trail.at(-1) ?? [Infinity, 0];
      const step = Math.hypot(x - lastX, y - lastY);
      if (step > 1) trail.length = 0; // It was moved elsewhere.
      if (step > TRAIL_STEP_M) trail.push([x, y]);
      if (trail.length > TRAIL_POINTS) trail.shift();
      this.#trails.set(name, trail);
    }
    for (const name of this.#trails.keys()) if (!(name in robots)) this.#trails.delete(name);
    this.#drawSoon();
  }

  /** overlay: its points stay in place while the robot drives on. */
  showOverlay(overlay) {
    this.overlays.show(overlay, this.#robots);
    this.#drawSoon();
  }

  clearTrails() {
    this.#trails.clear();
    this.#drawSoon();
  }

  /** Keep the chosen robot in the middle, or leave the view where it is. */
  setFollow(on) {
    this.follow = on;
    this.toolbar.querySelector("#follow").setAttribute("aria-pressed", on);
  }

  zoom(factor, at = this.#middle()) {
    const before = this.#toFloor(at);
    this.#scale = Math.min(SCALE.most, Math.max(SCALE.least, this.#scale * factor));
    const after = this.#toFloor(at);
    if (!this.follow) this.#centre = this.#centre.map((c, i) => c + before[i] - after[i]);
    this.#drawSoon();
  }

  pan(dx, dy) {
    this.setFollow(false);
    this.#centre = [this.#centre[0] - dx / this.#scale, this.#centre[1] + dy / this.#scale];
    this.#drawSoon();
  }

  /** Move and zoom until every robot and trail is visible. */
  showAll() {
    const robots = Object.values(this.#robots).map(({ x, y }) => [x, y]);
    const points = [...[...this.#trails.values()].flat(), ...robots, ...this.around.corners(), ...this.overlays.points];
    if (points.length === 0) return;
    // A loop: there are more points than a function takes as arguments.
    const range = (i) => points.reduce(
      ([low, high], p) => [Math.min(low, p[i]), Math.max(high, p[i])], [Infinity, -Infinity]);
    const [[west, east], [south, north]] = [range(0), range(1)];
    this.#findFree();
    const { left, top, right, bottom } = this.#free;
    const scale = Math.min((right - left) / (east - west + 1), (bottom - top) / (north - south + 1));
    this.#scale = Math.min(SCALE.start * 2, Math.max(SCALE.least, scale));
    this.#centre = [(west + east) / 2, (south + north) / 2];
    this.setFollow(false);
    this.#drawSoon();
  }

  #findFree() {
    const { clientWidth: right, clientHeight: height } = this.canvas;
    const corner = this.canvas.getBoundingClientRect();
    const top = this.toolbar.getBoundingClientRect().bottom - corner.top;
    const edge = this.glass.hidden ? height : this.glass.getBoundingClientRect().top - corner.top;
    this.#free = { left: 0, top, right, bottom: Math.min(height, edge) };
  }

  /** [x, y] [m] in the middle. */
  get centre() {
    return this.#centre;
  }

  /** @returns {any} [x, y] [pixel] */
  #middle() {
    const { left, top, right, bottom } = this.#free;
    return [(left + right) / 2, (top + bottom) / 2];
  }

  #toFloor([px, py]) {
    const [mx, my] = this.#middle();
    return [this.#centre[0] + (px - mx) / this.#scale, this.#centre[1] - (py - my) / this.#scale];
  }

  #toPixels([x, y]) {
    const [mx, my] = this.#middle();
    return [mx + (x - this.#centre[0]) * this.#scale, my - (y - this.#centre[1]) * this.#scale];
  }

  #listen() {
    const { canvas } = this;
    /** @returns {any} */
    const at = (event) => [event.offsetX, event.offsetY];
    canvas.onwheel = (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY / 400), at(event));
    };
    canvas.onpointerdown = (event) => {
      canvas.setPointerCapture(event.pointerId);
      if (this.tools.isOn && event.button === 0) this.tools.press(this.#toFloor(at(event)));
      else this.#pointers.set(event.pointerId, at(event));
    };
    canvas.onpointermove = (event) => {
      if (this.tools.isOn) {
        this.tools.drag(this.#toFloor(at(event)));
        this.#drawSoon();
      }
      const before = this.#pointers.get(event.pointerId);
      if (!before) return;
      const now = at(event);
      const other = [...this.#pointers].find(([id]) => id !== event.pointerId)?.[1];
      if (other) {
        const distance = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
        this.zoom(distance(now) / distance(before), other);
      } else if (now[0] !== before[0] || now[1] !== before[1]) {
        this.pan(now[0] - before[0], now[1] - before[1]);
      }
      this.#pointers.set(event.pointerId, now);
    };
    canvas.onpointerup = () => this.tools.release();
    canvas.onpointercancel = () => this.tools.cancel();
    canvas.onlostpointercapture = (event) => this.#pointers.delete(event.pointerId); // also for a lifted pointer
    canvas.onkeydown = (event) => {
      if (this.tools.key(event.key, STEP_PX / this.#scale)) this.#drawSoon();
      else if (event.key in PAN) this.pan(...PAN[event.key]);
      else if (event.key in ZOOM) this.zoom(ZOOM[event.key]);
      else return;
      event.preventDefault();
    };
  }

  #drawSoon() {
    if (this.#due) return;
    this.#due = true;
    requestAnimationFrame(() => {
      this.#due = false;
      this.#draw();
    });
  }

  #draw() {
    const { canvas } = this;
    const { clientWidth: width, clientHeight: height } = canvas;
    if (!width || !height) return; // another tab is shown
    const ratio = devicePixelRatio || 1;
    const size = { width: Math.round(width * ratio), height: Math.round(height * ratio) };
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    this.#findFree();
    const followed = this.#robots[this.look];
    if (this.follow && followed) this.#centre = [followed.x, followed.y];
    const pen = canvas.getContext("2d");
    const colours = getComputedStyle(canvas);
    const colour = (name) => colours.getPropertyValue(name).trim();
    const paper = { pen, colour, toPixels: (point) => this.#toPixels(point), scale: this.#scale };
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.fillStyle = colour("--floor");
    pen.fillRect(0, 0, width, height);
    this.#drawGrid(paper, width, height);
    this.around.draw(paper);
    this.overlays.draw(paper);
    for (const [name, trail] of this.#trails) this.#drawTrail(paper, name, trail);
    const robots = Object.entries(this.#robots).map(([name, robot]) => this.#drawRobot(paper, name, robot));
    robots.sort((a, b) => Number(b.isChosen) - Number(a.isChosen)); // Its name gets the best place.
    drawNames(paper, robots, this.#free);
    this.tools.draw(paper);
  }

  #drawGrid(paper, width, height) {
    const { pen, colour } = paper;
    // Lines every metre; where they would be too close, every 2, 5, 10 ...
    const step = [1, 2, 5, 10, 20, 50].find((m) => m * this.#scale >= GRID_PX) ?? 100;
    const [west, north] = this.#toFloor([0, 0]);
    const [east, south] = this.#toFloor([width, height]);
    // The loop counts whole numbers: far away, x + step equals x, and a loop over x would not end.
    const multiples = (from, to) => {
      const first = Math.ceil(from / step);
      return Array.from({ length: Math.floor(to / step) - first + 1 }, (_, i) => (first + i) * step);
    };
    const { top: ceiling, bottom: ground } = this.#free;
    pen.font = "12px system-ui, sans-serif";
    pen.lineWidth = 1;
    const draw = (metres, ends, left, bottom) => {
      stroke(paper, ends, metres === 0 ? "--axis" : "--grid");
      pen.fillStyle = colour("--muted");
      if (bottom > ceiling + 12 && bottom < ground) pen.fillText(`${metres} m`, left, bottom);
    };
    for (const x of multiples(west, east)) {
      draw(x, [[x, north], [x, south]], this.#toPixels([x, 0])[0] + 3, ground - 6);
    }
    for (const y of multiples(south, north)) {
      draw(y, [[west, y], [east, y]], 4, this.#toPixels([0, y])[1] - 4);
    }
  }

  #drawTrail(paper, name, trail) {
    const isChosen = name === this.look;
    const robot = this.#robots[name];
    paper.pen.lineWidth = isChosen ? 2 : 1;
    paper.pen.lineJoin = "round";
    const points = robot ? [...trail, [robot.x, robot.y]] : trail;
    stroke(paper, points, isChosen ? "--accent" : "--muted");
  }

  /** Draw a robot without its name; return where and how large it is [pixel]. */
  #drawRobot(paper, name, { x, y, yaw, age, bumpers }) {
    const { pen, colour } = paper;
    const isChosen = name === this.look;
    const [px, py] = this.#toPixels([x, y]);
    const radius = Math.max(5, BODY_RADIUS_M * this.#scale);
    pen.save();
    pen.translate(px, py);
    pen.rotate(-yaw);
    pen.scale(radius, radius);
    pen.globalAlpha = age >= 1 ? 0.4 : 1; // outdated
    pen.fillStyle = colour(isChosen ? "--accent" : "--muted");
    pen.fill(body);
    pen.fillStyle = colour("--floor");
    pen.fill(arrow);
    pen.globalAlpha = 1;
    drawBumpers(paper, radius, bumpers ?? []);
    pen.restore();
    return { name, x: px, y: py, radius, isChosen };
  }
}

/** Draw a line along points [m]. */
function stroke({ pen, colour, toPixels }, points, name) {
  pen.strokeStyle = colour(name);
  pen.beginPath();
  for (const point of points) pen.lineTo(...toPixels(point));
  pen.stroke();
}
