/** The robots' names on the floor, where nothing covers them. */

const HEIGHT = 16, GAP = 4; // of a name, and from its robot [pixel]
const SIDES = [[1, 0], [0, 1], [0, -1], [-1, 0], [1, 1], [1, -1], [-1, 1], [-1, -1]];
// In 14 rings around the robot; a line leads to a name in the second ring or beyond.
const NARROW = 600; // Below this width [pixel] only the chosen robot's name has a line that leads to it.
const PLACES = Array.from({ length: 14 }, (_, ring) => SIDES.map(([dx, dy]) => ({ ring, dx, dy }))).flat();

export const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
const around = (x, y, w, h) => ({ left: x - w, right: x + w, top: y - h, bottom: y + h }); // half sizes

/**
 * robots: [{name, x, y, radius, width}], width: of the name; free: {left, top, right, bottom} of the
 * part of the picture that nothing covers. All in pixels.
 * Returns [{name, x, y, ring}]: the middle of each name. A name that fits nowhere is right of its robot.
 */
export function placeNames(robots, free) {
  const boxes = robots.map(({ x, y, radius }) => around(x, y, radius, radius));
  return robots.map(({ name, x, y, radius, width }) => {
    const boxOf = ({ ring, dx, dy }) => around(
      x + dx * (radius + GAP + width / 2 + ring * HEIGHT), y + dy * (radius + (ring + 0.5) * HEIGHT),
      width / 2 + 1, HEIGHT / 2);
    const isFree = (box) => box.left >= free.left && box.right <= free.right && box.top >= free.top
      && box.bottom <= free.bottom && !boxes.some((other) => overlap(box, other));
    const place = PLACES.find((one) => isFree(boxOf(one))) ?? PLACES[0];
    const box = boxOf(place);
    boxes.push(box);
    return { name, ring: place.ring, x: (box.left + box.right) / 2, y: (box.top + box.bottom) / 2 };
  });
}

/** paper: see Floor. robots: [{name, x, y, radius, isChosen}]. free: see placeNames(). */
export function drawNames({ pen, colour }, robots, free) {
  const { clientWidth: width, clientHeight: height } = pen.canvas;
  const font = ({ isChosen }) => `${isChosen ? "bold " : ""}13px system-ui, sans-serif`;
  const seen = robots.filter(({ x, y }) => x >= 0 && x <= width && y >= 0 && y <= height);
  const measured = seen.map((robot) => {
    pen.font = font(robot);
    return { ...robot, width: pen.measureText(robot.name).width };
  });
  const isNear = ({ ring }, i) => !ring || width >= NARROW || seen[i].isChosen;
  const places = placeNames(measured, free).map((place, i) => ({ ...place, isSeen: isNear(place, i) }));
  pen.save();
  Object.assign(pen, { textAlign: "center", textBaseline: "middle", lineJoin: "round" });
  Object.assign(pen, { strokeStyle: colour("--muted"), lineWidth: 1 });
  pen.beginPath();
  for (const [i, { x, y, ring, isSeen }] of places.entries()) {
    pen.moveTo(seen[i].x, seen[i].y);
    if (ring && isSeen) pen.lineTo(x, y);
  }
  pen.stroke();
  // With an edge, as walls and trails may be below.
  Object.assign(pen, { strokeStyle: colour("--floor"), lineWidth: 4, fillStyle: colour("--text") });
  places.forEach(({ name, x, y, isSeen }, i) => {
    if (!isSeen) return;
    pen.font = font(seen[i]);
    pen.strokeText(name, x, y);
    pen.fillText(name, x, y);
  });
  pen.restore();
}
