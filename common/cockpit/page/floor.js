/** The floor from above: grid, map, trails, robots. x is to the right, y up, as on paper. */

import { drawBumpers, Surroundings } from "./surroundings.js";

const BODY_RADIUS_M = 0.177; // TurtleBot 2
const TRAIL_STEP_M = 0.02; // between two points of a trail
const TRAIL_POINTS = 3000;
const SCALE = { least: 4, start: 110, most: 1500 }; // [pixel/m]
const GRID_PX = 45; // least distance of two lines of the grid

export class Floor {
  #centre = [0, 0]; // [m] in the middle of the canvas
  #scale = SCALE.start;
  #trails = new Map(); // name -> [[x, y], ...]
  #robots = {};
  #pointers = new Map();
  #due = false;
  #free = { left: 0, top: 0, right: 0, bottom: 0 }; // the part of the canvas on which nothing lies [pixel]

  /** above(): the elements that lie on the canvas: robots are shown beside them, and nothing is written under them. */
  constructor(canvas, above) {
    this.canvas = canvas;
    this.above = above;
    this.follow = true;
    this.look = ""; // the robot that is followed
    this.onUnfollow = () => {};
    this.around = new Surroundings(() => this.#drawSoon());
    new ResizeObserver(() => this.#drawSoon()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#drawSoon());
    this.#listen();
  }

  /** robots: {name: {x, y, yaw, v, w}} [m, rad]; one without a place is nowhere to be seen. */
  show(robots) {
    const placed = Object.entries(robots)
      .map(([name, robot]) => [name, this.around.placed(name, robot)])
      .filter(([, { x, y, yaw }]) => [x, y, yaw].every(Number.isFinite));
    this.#robots = Object.fromEntries(placed);
    for (const [name, { x, y }] of placed) {
      const trail = this.#trails.get(name) ?? [];
      const [lastX, lastY] = trail.at(-1) ?? [Infinity, 0];
      const step = Math.hypot(x - lastX, y - lastY);
      if (step > 1) trail.length = 0; // it was put somewhere else
      if (step > TRAIL_STEP_M) trail.push([x, y]);
      if (trail.length > TRAIL_POINTS) trail.shift();
      this.#trails.set(name, trail);
    }
    for (const name of this.#trails.keys()) if (!(name in robots)) this.#trails.delete(name);
    this.#drawSoon();
  }

  /** Its points stay where they are while the robot drives on. */
  showScan(scan) {
    this.around.showScan(scan, this.#robots[scan.robot]);
  }

  clearTrails() {
    this.#trails.clear();
    this.#drawSoon();
  }

  zoom(factor, [px, py] = this.#middle()) {
    const before = this.#toFloor(px, py);
    this.#scale = Math.min(SCALE.most, Math.max(SCALE.least, this.#scale * factor));
    const after = this.#toFloor(px, py);
    if (!this.follow) this.#centre = this.#centre.map((c, i) => c + before[i] - after[i]);
    this.#drawSoon();
  }

  pan(dx, dy) {
    this.follow = false;
    this.onUnfollow();
    this.#centre = [this.#centre[0] - dx / this.#scale, this.#centre[1] + dy / this.#scale];
    this.#drawSoon();
  }

  /** Move and zoom until every robot and trail is seen. */
  showAll() {
    const points = [...this.#trails.values()].flat();
    points.push(...Object.values(this.#robots).map(({ x, y }) => [x, y]));
    points.push(...this.around.corners());
    if (points.length === 0) return;
    const range = (i) => points.reduce(
      ([low, high], p) => [Math.min(low, p[i]), Math.max(high, p[i])], [Infinity, -Infinity]);
    const [[west, east], [south, north]] = [range(0), range(1)];
    const { left, top, right, bottom } = this.#findFree();
    const scale = Math.min((right - left) / (east - west + 1), (bottom - top) / (north - south + 1));
    this.#scale = Math.min(SCALE.start * 2, Math.max(SCALE.least, scale));
    this.follow = false;
    this.onUnfollow();
    this.#centre = [(west + east) / 2, (south + north) / 2];
    this.#drawSoon();
  }

  /** Of each element that lies on the canvas, the strip beside it is left that is larger than the other ones. */
  #findFree() {
    const corner = this.canvas.getBoundingClientRect();
    const free = { left: 0, top: 0, right: corner.width, bottom: corner.height };
    for (const one of this.above()) {
      const box = one.getBoundingClientRect();
      const [left, right, top, bottom] = [
        box.left - corner.left, box.right - corner.left, box.top - corner.top, box.bottom - corner.top];
      if (!box.width || right <= free.left || left >= free.right || bottom <= free.top || top >= free.bottom) continue;
      const cuts = [{ left: right }, { right: left }, { top: bottom }, { bottom: top }];
      const area = (cut) => {
        const rest = { ...free, ...cut };
        return Math.max(0, rest.right - rest.left) * Math.max(0, rest.bottom - rest.top);
      };
      Object.assign(free, cuts.reduce((best, cut) => (area(cut) > area(best) ? cut : best)));
    }
    return (this.#free = free);
  }

  #middle() {
    const { left, top, right, bottom } = this.#free;
    return [(left + right) / 2, (top + bottom) / 2];
  }

  #toFloor(px, py) {
    const [mx, my] = this.#middle();
    const [cx, cy] = this.#centre;
    return [cx + (px - mx) / this.#scale, cy - (py - my) / this.#scale];
  }

  #toPixels([x, y]) {
    const [mx, my] = this.#middle();
    const [cx, cy] = this.#centre;
    return [mx + (x - cx) * this.#scale, my - (y - cy) * this.#scale];
  }

  #listen() {
    const canvas = this.canvas;
    const at = (event) => [event.offsetX, event.offsetY];
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY / 400), at(event));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.#pointers.set(event.pointerId, at(event));
    });
    canvas.addEventListener("pointermove", (event) => {
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
    });
    for (const kind of ["pointerup", "pointercancel", "lostpointercapture"]) {
      canvas.addEventListener(kind, (event) => this.#pointers.delete(event.pointerId));
    }
    const STEP = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
    canvas.addEventListener("keydown", (event) => {
      if (event.key in STEP) this.pan(...STEP[event.key]);
      else if (event.key === "+") this.zoom(1.25);
      else if (event.key === "-") this.zoom(0.8);
      else return;
      event.preventDefault();
    });
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
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    this.#findFree();
    const followed = this.#robots[this.look];
    if (this.follow && followed) this.#centre = [followed.x, followed.y];
    const colours = getComputedStyle(canvas);
    const colour = (name) => colours.getPropertyValue(name).trim();
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.fillStyle = colour("--floor");
    pen.fillRect(0, 0, width, height);
    this.#drawGrid(pen, width, height, colour);
    const toPixels = (point) => this.#toPixels(point);
    this.around.drawMap(pen, toPixels, this.#scale, colour);
    this.around.drawScan(pen, toPixels, this.look, colour);
    for (const [name, trail] of this.#trails) this.#drawTrail(pen, trail, name, colour);
    for (const [name, robot] of Object.entries(this.#robots)) this.#drawRobot(pen, name, robot, colour);
  }

  #drawGrid(pen, width, height, colour) {
    // Lines every metre; where they would be too close, every 2, 5, 10 ...
    const step = [1, 2, 5, 10, 20, 50].find((m) => m * this.#scale >= GRID_PX) ?? 100;
    const [west, north] = this.#toFloor(0, 0);
    const [east, south] = this.#toFloor(width, height);
    pen.font = "12px system-ui, sans-serif";
    pen.lineWidth = 1;
    const corner = this.canvas.getBoundingClientRect();
    const boxes = this.above().map((one) => one.getBoundingClientRect());
    const write = (text, x, y) => {
      const [left, low] = [corner.left + x, corner.top + y];
      const right = left + pen.measureText(text).width;
      const isHidden = boxes.some((box) =>
        box.left < right && left < box.right && box.top < low && low - 12 < box.bottom);
      pen.fillStyle = colour("--muted");
      if (!isHidden) pen.fillText(text, x, y);
    };
    // Counted in whole numbers: far away, x + step is x again, and the loop would not end.
    const multiples = (from, to) => {
      const first = Math.ceil(from / step);
      return Array.from({ length: Math.floor(to / step) - first + 1 }, (_, i) => (first + i) * step);
    };
    for (const x of multiples(west, east)) {
      this.#line(pen, [x, north], [x, south], colour(x === 0 ? "--axis" : "--grid"));
      write(`${x} m`, this.#toPixels([x, 0])[0] + 3, height - 6);
    }
    for (const y of multiples(south, north)) {
      this.#line(pen, [west, y], [east, y], colour(y === 0 ? "--axis" : "--grid"));
      write(`${y} m`, 4, this.#toPixels([0, y])[1] - 4);
    }
  }

  #line(pen, from, to, style) {
    pen.strokeStyle = style;
    pen.beginPath();
    pen.moveTo(...this.#toPixels(from));
    pen.lineTo(...this.#toPixels(to));
    pen.stroke();
  }

  #drawTrail(pen, trail, name, colour) {
    pen.strokeStyle = colour(name === this.look ? "--accent" : "--muted");
    pen.lineWidth = name === this.look ? 2 : 1;
    pen.lineJoin = "round";
    pen.beginPath();
    for (const point of trail) pen.lineTo(...this.#toPixels(point));
    const robot = this.#robots[name];
    if (robot) pen.lineTo(...this.#toPixels([robot.x, robot.y]));
    pen.stroke();
  }

  #drawRobot(pen, name, { x, y, yaw, age, bumpers }, colour) {
    const [px, py] = this.#toPixels([x, y]);
    const radius = Math.max(5, BODY_RADIUS_M * this.#scale);
    pen.globalAlpha = age > 1 ? 0.4 : 1; // it says nothing any more
    pen.fillStyle = colour(name === this.look ? "--accent" : "--muted");
    pen.beginPath();
    pen.arc(px, py, radius, 0, 2 * Math.PI);
    pen.fill();
    pen.strokeStyle = colour("--floor");
    pen.fillStyle = colour("--floor");
    const ahead = (angle, share) => [
      px + radius * share * Math.cos(yaw + angle), py - radius * share * Math.sin(yaw + angle)];
    pen.beginPath();
    pen.moveTo(...ahead(0, 0.85));
    pen.lineTo(...ahead(2.4, 0.6));
    pen.lineTo(...ahead(Math.PI, 0.2));
    pen.lineTo(...ahead(-2.4, 0.6));
    pen.closePath();
    pen.fill();
    pen.globalAlpha = 1;
    drawBumpers(pen, [px, py], yaw, radius, bumpers ?? [], colour);
    if (!name) return;
    pen.fillStyle = colour("--text");
    pen.font = `${name === this.look ? "bold " : ""}13px system-ui, sans-serif`;
    pen.fillText(name, px + radius + 4, py + 4);
  }
}
