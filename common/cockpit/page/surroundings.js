/** What is around the robots: the map, pressed bumpers. */

const KINDS = [[1, "--wall"], [2, "--void"]]; // of the map's cells; 0 is free

export class Surroundings {
  #map = null; // {x, y, yaw, cell, rows, columns} [m, rad] and its bytes, one for each cell, the lowest row first
  #pictures = new Map(); // colours -> canvas, a pixel for each cell
  #covered = ""; // the corners of the newest map

  /** map: without cells there is none. Returns whether it covers another part of the floor than before. */
  showMap(map) {
    this.#map = map.cells ? { ...map, bytes: Uint8Array.from(atob(map.cells), (c) => c.charCodeAt(0)) } : null;
    this.#pictures.clear();
    const [before, corners] = [this.#covered, this.corners().join()];
    this.#covered = corners || before;
    return this.#covered !== before;
  }

  /** A robot with its place in the map, if known, instead of that of its odometry. */
  placed(robot) {
    return this.#map ? { ...robot, ...robot.truth } : robot;
  }

  /** The corners of the map [m], counterclockwise from its origin, or none. */
  corners() {
    if (!this.#map) return [];
    const { x, y, yaw, cell, rows, columns } = this.#map;
    const [c, s] = [cell * Math.cos(yaw), cell * Math.sin(yaw)];
    const sides = [[0, 0], [columns, 0], [columns, rows], [0, rows]];
    return sides.map(([column, row]) => [x + c * column - s * row, y + s * column + c * row]);
  }

  /** paper: see Floor. */
  draw(paper) {
    if (this.#map) this.#drawMap(paper);
  }

  #drawMap({ pen, toPixels, colour }) {
    const [origin, right, , top] = this.corners().map(toPixels);
    const length = ([x, y]) => Math.hypot(x - origin[0], y - origin[1]);
    pen.save();
    pen.translate(...origin);
    pen.rotate(-this.#map.yaw);
    pen.imageSmoothingEnabled = false;
    pen.drawImage(this.#picture(colour), 0, -length(top), length(right), length(top));
    pen.restore();
  }

  /** The highest row is on top; free cells are transparent, so that the grid is visible. */
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
}

/** Left (0), center (1) and right (2), each over a third of the front half. radius: the pen's unit [pixel]. */
export function drawBumpers({ pen, colour }, radius, pressed) {
  const width = Math.max(4, radius / 5);
  for (const { name, edge } of [{ name: "--floor", edge: 2 }, { name: "--bumper", edge: 0 }]) { // whatever is below
    pen.strokeStyle = colour(name);
    pen.lineWidth = (width + 2 * edge) / radius;
    for (const bumper of pressed) {
      const middle = ((bumper - 1) * Math.PI) / 3;
      const angle = Math.PI / 6 + edge / radius;
      pen.beginPath();
      pen.arc(0, 0, 1 + 1 / radius, middle - angle, middle + angle);
      pen.stroke();
    }
  }
}
