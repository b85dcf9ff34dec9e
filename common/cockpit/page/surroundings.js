/** What is around the robots: the map, what the laser of one sees, bumpers that are pressed. */

const KINDS = [[1, "--wall"], [2, "--void"]]; // of the map's cells; 0 is free

export class Surroundings {
  #map = null; // {x, y, cell, rows, columns} [m] and its cells, a byte for each, the lowest row first
  #pictures = new Map(); // colours -> canvas, a pixel for each cell
  #robots = {}; // name -> {x, y, yaw} in the map, and the numbers of the bumpers that are pressed
  #scan = { name: null, points: [] }; // [m], of that robot

  /** onChange(): called when something is to be drawn anew. */
  constructor(onChange) {
    this.onChange = onChange;
  }

  showMap(map) {
    this.#map = { ...map, bytes: Uint8Array.from(atob(map.cells), (c) => c.charCodeAt(0)) };
    this.#pictures.clear();
    this.onChange();
  }

  showRobots(robots) {
    this.#robots = robots;
    this.onChange();
  }

  /** robot: where it is now; nothing if nobody knows. */
  showScan({ robot: name, points }, robot) {
    const { x: rx, y: ry, yaw } = robot ?? { x: NaN };
    const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
    this.#scan = { name, points: points.map(([x, y]) => [rx + c * x - s * y, ry + s * x + c * y]) };
    this.onChange();
  }

  /** A robot with its place in the map, if there is one, in place of that of its odometry. */
  placed(name, robot) {
    return this.#map ? { ...robot, ...this.#robots[name] } : robot;
  }

  /** Two corners of the map [m], or none. */
  corners() {
    if (!this.#map) return [];
    const { x, y, cell, rows, columns } = this.#map;
    return [[x, y], [x + columns * cell, y + rows * cell]];
  }

  drawMap(pen, toPixels, scale, colour) {
    if (!this.#map) return;
    const [[west], [, north]] = this.corners();
    const [left, top] = toPixels([west, north]);
    const { cell, rows, columns } = this.#map;
    pen.imageSmoothingEnabled = false;
    pen.drawImage(this.#picture(colour), left, top, columns * cell * scale, rows * cell * scale);
  }

  /** The highest row on top; what is free lets the grid be seen. */
  #picture(colour) {
    const styles = KINDS.map(([, name]) => colour(name)).join();
    if (!this.#pictures.has(styles)) {
      const { rows, columns, bytes } = this.#map;
      const picture = Object.assign(document.createElement("canvas"), { width: columns, height: rows });
      const pen = picture.getContext("2d");
      for (const [kind, name] of KINDS) {
        pen.fillStyle = colour(name);
        bytes.forEach((cell, i) => {
          if (cell === kind) pen.fillRect(i % columns, rows - 1 - Math.floor(i / columns), 1, 1);
        });
      }
      this.#pictures.set(styles, picture);
    }
    return this.#pictures.get(styles);
  }

  /** name: of the robot that is looked at. */
  drawScan(pen, toPixels, name, colour) {
    if (this.#scan.name !== name) return;
    pen.fillStyle = colour("--scan");
    for (const point of this.#scan.points) {
      const [px, py] = toPixels(point);
      pen.fillRect(px - 1.5, py - 1.5, 3, 3);
    }
  }
}

/** Left (0), center (1) and right (2), each over a third of the front half. */
export function drawBumpers(pen, [px, py], yaw, radius, pressed, colour) {
  pen.strokeStyle = colour("--bumper");
  pen.lineWidth = Math.max(3, radius / 5);
  for (const bumper of pressed) {
    const middle = -yaw - ((1 - bumper) * Math.PI) / 3;
    pen.beginPath();
    pen.arc(px, py, radius + 1, middle - Math.PI / 6, middle + Math.PI / 6);
    pen.stroke();
  }
}
