/** Set pose and Set goal on the floor, for drivers, as RViz's 2D Pose Estimate and 2D Nav Goal. */

import { byId, number, say } from "./dom.js";

// The variances of rviz's initial_pose_tool.cpp: of 0.5 m in x and y, and 15 degrees.
const COVARIANCE = Array(36).fill(0).fill(0.25, 0, 1).fill(0.25, 7, 8).fill((Math.PI / 12) ** 2, 35);
const TOOLS = {
  "set-pose": {
    name: "Pose", topic: "initialpose", type: "geometry_msgs/PoseWithCovarianceStamped", field: "pose/pose",
    more: { "pose/covariance": JSON.stringify(COVARIANCE) }, reader: "localization node", colour: "--held",
  },
  "set-goal": {
    name: "Goal", topic: "move_base_simple/goal", type: "geometry_msgs/PoseStamped", field: "pose",
    more: {}, reader: "navigation node", colour: "--good",
  },
};
const MOVES = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const TURNS = { "[": Math.PI / 12, "]": -Math.PI / 12 };
const HELP = "Drag, or use the arrow keys, [, ] and Enter. Esc cancels.";
const MEET_MS = 2000; // A node may subscribe once there is a publisher; then the server sends that it has.
const ARROW = [[0, -3], [26, -3], [26, -10], [44, 0], [26, 10], [26, 3], [0, 3]]; // [pixel]

export class PoseTools {
  #id = ""; // of the tool that is on
  #pose = [0, 0, 0]; // that it chooses: x, y [m], yaw [rad]
  #isHeld = false; // whether a pointer chooses the direction
  #published = new Map(); // id -> the pose, and of which robot
  #server = { frame: "", subscribed: [] }; // says: the frame of the floor, and the topics with a subscriber

  /** page: see main.js. */
  constructor(link, floor, page) {
    this.link = link;
    this.floor = floor;
    this.page = page;
    for (const id in TOOLS) byId(id).onclick = () => this.#choose(id === this.#id ? "" : id);
    link.on("hello", ({ role }) => {
      for (const id in TOOLS) byId(id).hidden = role !== "driver";
    });
    link.on("floor", (message) => {
      if (message.frame !== this.#server.frame) this.#published.clear();
      this.#server = message;
    });
    link.on("refused", ({ what }) => {
      if (what !== "publish") return;
      this.#published.clear();
      this.cancel();
    });
  }

  get isOn() {
    return this.#id !== "";
  }

  #choose(id) {
    this.#id = id;
    this.#isHeld = false;
    for (const tool in TOOLS) byId(tool).setAttribute("aria-pressed", tool === id);
    const { canvas, centre } = this.floor;
    canvas.setAttribute("role", id ? "application" : "img"); // so that a screen reader passes keys on
    if (!id) return say(byId("tool"), "");
    this.#pose = [...centre, 0];
    canvas.focus();
    this.#announce(HELP);
  }

  #announce(text, id = this.#id) {
    const [x, y, yaw] = this.#pose;
    const degrees = number((Math.atan2(Math.sin(yaw), Math.cos(yaw)) * 180) / Math.PI, 0);
    say(byId("tool"), `${TOOLS[id].name}: ${number(x)}, ${number(y)} m, ${degrees}°. ${text}`);
  }

  /** A pointer at a point [m]: pressed, moved, released. */
  press(point) {
    this.#pose = [...point, 0];
    this.#isHeld = true;
  }

  drag([toX, toY]) {
    const [x, y] = this.#pose;
    if (this.#isHeld) this.#pose = [x, y, Math.atan2(toY - y, toX - x)];
  }

  release() {
    if (this.#isHeld) this.#publish();
  }

  cancel() {
    this.#choose("");
  }

  /** step: of an arrow key [m]. Returns whether the key has a meaning now. */
  key(key, step) {
    if (!this.isOn) return false;
    const [x, y, yaw] = this.#pose;
    const [dx, dy] = MOVES[key] ?? [0, 0];
    if (key in MOVES || key in TURNS) {
      this.#pose = [x + step * dx, y + step * dy, yaw + (TURNS[key] ?? 0)];
      this.#announce("");
    } else if (key === "Enter" || key === "Escape") {
      const button = byId(this.#id);
      if (key === "Enter") this.#publish();
      else this.cancel();
      button.focus();
    } else return false;
    return true;
  }

  #publish() {
    const id = this.#id;
    const { topic, type, field, more, reader } = TOOLS[id];
    const [x, y, yaw] = this.#pose;
    const robot = this.page.look();
    const fullName = `${robot && `/${robot}`}/${topic}`;
    const numbers = { "position/x": x, "position/y": y, "orientation/z": Math.sin(yaw / 2), "orientation/w": Math.cos(yaw / 2) };
    const values = { "header/frame_id": this.#server.frame, "header/stamp": "now", ...more };
    for (const [part, value] of Object.entries(numbers)) values[`${field}/${part}`] = String(value);
    this.#choose("");
    if (!this.link.send("publish", { topic: fullName, type, values, period: null })) return;
    this.#published.set(id, [x, y, yaw, robot]);
    this.#announce("Published.", id);
    setTimeout(() => {
      if (this.#server.subscribed.includes(topic) || robot !== this.page.look()) return;
      this.page.notice(`Nothing subscribes to ${fullName}: start a ${reader}.`);
    }, MEET_MS);
  }

  /** paper: see Floor. */
  draw(paper) {
    const isShown = ([id, [, , , robot]]) => id !== this.#id && robot === this.page.look();
    const poses = [...this.#published].filter(isShown);
    if (this.isOn) poses.push([this.#id, this.#pose]);
    for (const [id, pose] of poses) drawPose(paper, pose, TOOLS[id]);
  }
}

function drawPose({ pen, colour, toPixels }, [x, y, yaw], tool) {
  const [px, py] = toPixels([x, y]);
  pen.save();
  Object.assign(pen, { fillStyle: colour(tool.colour), strokeStyle: colour("--text"), lineWidth: 2 });
  pen.translate(px, py);
  pen.fillText(tool.name, 6, yaw > 0 ? 20 : -12);
  pen.rotate(-yaw);
  pen.beginPath();
  for (const [ahead, aside] of ARROW) pen.lineTo(ahead, aside);
  pen.closePath();
  pen.stroke();
  pen.fill();
  pen.restore();
}
