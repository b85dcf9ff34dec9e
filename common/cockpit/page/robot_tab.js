/** The tab Robot: the floor, the joystick, the driver, and driving from here. */

import { byId, byName, element, number, offer, row, say } from "./dom.js";
import { Floor } from "./floor.js";
import { GamepadPicture } from "./gamepad_picture.js";
import { PoseTools } from "./pose_tools.js";
import { DriverSession, STALE_S } from "./driver_session.js";

const ODOMETRY = [ // name, title, unit, digits
  ["x", "x", " m", 2], ["y", "y", " m", 2], ["yaw", "heading", "°", 1],
  ["v", "speed", " m/s", 2], ["w", "turning", " rad/s", 2], ["covered", "covered", " m", 2],
];
const KOBUKI = [ // name, title, unit, while it is not known
  ["battery", "battery", " V", "–"], ["charger", "charger", "", "–"],
  ["buttons", "pressed buttons", "", "–"], ["wheel_drops", "dropped wheels", "", "–"],
  ["led1", "LED 1", "", "off"], ["led2", "LED 2", "", "off"], ["sound", "last sound", "", "none"],
];

const values = (rows) => rows.map(([name, title, unit]) => `
        <div><dt>${title}</dt><dd><output data-value="${name}">–</output>${unit}</dd></div>`).join("");

export class RobotTab {
  static title = "Robot";
  static panel = `
  <div class="floor">
    <canvas id="floor" tabindex="0" role="img" aria-label="The floor from above, with the robots"></canvas>
    <div class="toolbar" role="group" aria-label="View of the floor">
      <button id="zoom-in" aria-label="Zoom in">+</button>
      <button id="zoom-out" aria-label="Zoom out">−</button>
      <button id="follow" aria-pressed="true">Follow</button>
      <button id="show-all">Show all</button>
      <button id="clear-trail">Clear trail</button>
      <button id="set-pose" aria-pressed="false" hidden>Set pose</button>
      <button id="set-goal" aria-pressed="false" hidden>Set goal</button>
      <p id="tool" role="status"></p>
    </div>
    <div id="glass" role="group" aria-label="Joystick on glass" hidden>
      <div class="shoulders">
        <button id="rb" data-button="RB" aria-label="RB, turbo">RB</button>
        <button id="lb" data-button="LB" aria-label="LB" aria-describedby="how">LB</button>
      </div>
      <div id="stick" role="img" aria-label="Stick: drag it with a thumb, or use the arrow keys"><div id="knob"></div></div>
    </div>
  </div>
  <div id="turtles" role="group" aria-label="Turtles"></div>
  <div class="panel">
    <div class="card" id="drive">
      <h2 class="row"><label for="look">Robot</label> <select id="look"></select> <small id="me"></small></h2>
      <p id="ready" role="status" aria-live="polite"></p>
      <div class="row">
        <button id="take" class="primary" disabled>Drive from this page</button>
        <button id="reset" disabled>Reset robot</button>
      </div>
      <div class="row" id="reach" role="group" aria-label="Keys push the stick" hidden>Keys 1–3</div>
      <div class="row" id="hand-over" hidden>
        <button id="give">Hand over</button>
        <label>to page <input type="number" id="heir" min="1" step="1" required></label>
      </div>
      <p id="how" class="hint" hidden><span id="how-to"></span> <label>F710 at <select id="mode"><option>D</option><option>X</option></select></label></p>
    </div>
    <div class="card of-robot">
      <h2>joy2twist</h2>
      <p id="teleop" role="status" aria-live="polite" data-state="unknown">No report from joy2twist yet.</p>
    </div>
    <div class="card" id="kobuki" hidden>
      <h2>Kobuki</h2>
      <dl class="values">${values(KOBUKI)}</dl>
    </div>
    <div class="card of-robot">
      <h2>Joystick <small id="pad-age"></small></h2>
      <div id="pad"></div>
    </div>
    <div class="card of-robot">
      <h2>Odometry</h2>
      <dl id="odometry" class="values">${values(ODOMETRY)}</dl>
    </div>
    <div class="card" id="class" hidden>
      <h2>All robots</h2>
      <table><thead><tr><th>Robot</th><th>x, y [m]</th><th>Driver</th><th>joy2twist</th></tr></thead>
        <tbody id="robots"></tbody></table>
    </div>
  </div>`;
  static watches = { robots: true, floor: false, look: null, turtles: false };

  #names = []; // of the robots
  #look = null; // the name of the chosen robot, once there is one
  asked = null; // the robot that a person or the address has chosen
  #rows = new Map(); // name -> its row in the table; rows stay, as a click takes time
  #onFloor = ""; // the names of the robots with a place, as JSON

  /** link: the Link. watch(fields): what to ask the server for. page: see main.js. */
  constructor(link, watch, page) {
    this.watch = watch;
    this.page = page;
    this.floor = new Floor(byId("floor"), document.querySelector(".toolbar"), byId("glass"));
    this.floor.tools = new PoseTools(link, this.floor, page);
    this.picture = new GamepadPicture(byId("pad"));
    this.session = new DriverSession(link, page.notice, this);
    link.on("hello", ({ id }) => {
      say(byId("me"), `page ${id}`);
      this.floor.overlays.clear(); // This server sends its own.
      if (this.#look !== null) this.lookAt(this.#look);
    });
    link.on("robots", ({ robots }) => this.#showRobots(robots));
    link.on("speed", (speed) => this.session.showSpeed(speed)); // while another tab is shown
    link.on("map", (map) => {
      if (!this.floor.around.showMap(map)) return; // The view stays as it was chosen.
      this.floor.showAll();
      if (this.#names.length < 2) this.floor.setFollow(true);
    });
    link.on("overlay", (overlay) => this.floor.showOverlay(overlay));
    link.on("turtles", ({ pictures }) => this.#showTurtles(pictures));
    link.on("pad", (pad) => this.#showPad(pad));
    link.on("drives", () => this.#showTeleop()); // after the session has processed it
    byId("zoom-in").onclick = () => this.floor.zoom(1.25);
    byId("zoom-out").onclick = () => this.floor.zoom(0.8);
    byId("show-all").onclick = () => this.floor.showAll();
    byId("clear-trail").onclick = () => this.floor.clearTrails();
    byId("follow").onclick = () => this.floor.setFollow(!this.floor.follow);
    byId("look").onchange = () => this.#ask(byId("look").value);
  }

  get look() {
    return this.#look ?? "";
  }

  connect() {
    this.session.show();
  }

  show(on) {
    this.watch({ floor: on, turtles: on });
  }

  #showNames(names) {
    this.#names = names;
    byId("class").hidden = names.length < 2;
    this.#rows = new Map(names.map((name) => [name, this.#rows.get(name) ?? this.#rowOf(name)]));
    byId("robots").replaceChildren(...this.#rows.values());
    if (this.#look === null && names.length) this.lookAt(names[0]);
    else this.#offerRobots();
  }

  /** A chosen robot stays chosen, as it may return after it has exited. */
  #offerRobots() {
    const choices = this.#names.map((name) => [name, name || "TurtleBot"]);
    const isGone = this.#look !== null && !this.#names.includes(this.#look);
    if (isGone) choices.push([this.#look, `${this.#look || "TurtleBot"} (gone)`]);
    offer(byId("look"), choices);
    if (this.#look !== null) byId("look").value = this.#look;
  }

  #ask(name) {
    this.goTo(name);
    this.page.moved(true);
  }

  /** Show the robot that a person or the address has chosen. A driver sees the driven robot. */
  goTo(name) {
    if (name === null || name === this.#look || this.session.yours || !/^[\w/]{0,200}$/.test(name)) return;
    this.asked = name;
    this.lookAt(name);
  }

  lookAt(name) {
    this.#look = name;
    this.#offerRobots();
    this.floor.look = name;
    this.picture.show();
    say(byId("pad-age"), "no message yet");
    this.#showTeleop();
    this.watch({ look: name });
    this.session.show();
  }

  #showRobots(robots) {
    this.floor.show(robots);
    const names = Object.keys(robots).sort(byName);
    if (JSON.stringify(names) !== JSON.stringify(this.#names)) this.#showNames(names);
    const areAlone = byId("turtles").hasChildNodes() && !names.length; // turtles, without a robot
    for (const part of [byId("floor").parentElement, ...document.querySelectorAll("#robot .of-robot")]) part.hidden = areAlone;
    const placed = names.filter((name) => "x" in robots[name]);
    if (placed.length && JSON.stringify(placed) !== this.#onFloor) {
      this.#onFloor = JSON.stringify(placed);
      if (placed.length > 1 && !this.session.yours) this.floor.showAll();
    }
    const robot = robots[this.look] ?? {};
    this.session.showSpeed(robot);
    const turned = { ...robot, yaw: (robot.yaw * 180) / Math.PI };
    for (const [name, , , digits] of ODOMETRY) {
      say(document.querySelector(`#odometry [data-value=${name}]`), number(turned[name], Number(digits)));
    }
    for (const [name, , , none] of KOBUKI) {
      const output = byId("kobuki").querySelector(`[data-value=${name}]`);
      say(output, robot[name] ?? none);
      output.style.setProperty("--lamp", output.textContent.replace("off", ""));
    }
    byId("kobuki").hidden = !KOBUKI.some(([name]) => robot[name]);
    byId("odometry").classList.toggle("stale", !(robot.age < STALE_S));
    this.#showClass(robots);
  }

  #rowOf(name) {
    const line = row(element("button", { className: "link" }, name || "TurtleBot"), "", "", "");
    line.dataset.robot = name;
    line.onclick = () => this.#ask(name);
    return line;
  }

  #showClass(robots) {
    for (const [name, line] of this.#rows) {
      const { x, y, age } = robots[name] ?? {};
      const { driver, why } = this.session.robots[name] ?? {};
      const texts = [`${number(x)}, ${number(y)}`, driver || "–", why || "–"];
      texts.forEach((text, i) => say(line.cells[i + 1], text));
      line.classList.toggle("stale", !(age < STALE_S));
      line.classList.toggle("chosen", name === this.look);
      line.ariaCurrent = String(name === this.look);
    }
  }

  /** pictures: {node of a turtlesim: PNG in base64, or "" if it is the one that is shown}. */
  #showTurtles(pictures) {
    const shown = new Map([...byId("turtles").children].map((one) => [one.dataset.node, one]));
    const figures = Object.entries(pictures).map(([node, png]) => {
      const figure = shown.get(node) ?? element("figure", { "data-node": node },
        element("img", { alt: `The turtles of ${node}` }), element("figcaption", {}, node));
      if (png) figure.firstChild.src = `data:image/png;base64,${png}`;
      return figure;
    });
    byId("turtles").replaceChildren(...figures);
  }

  #showPad({ robot, axes, buttons, age }) {
    if (robot !== this.look || !this.session.driver.names) return;
    this.picture.show(this.session.driver.names, axes, buttons);
    say(byId("pad-age"), age > STALE_S ? `silent for ${number(age, 0)} s` : "");
    byId("pad").classList.toggle("stale", age > STALE_S);
  }

  #showTeleop() {
    const { state = "unknown", why } = this.session.robots[this.look] ?? {};
    byId("teleop").dataset.state = state;
    say(byId("teleop"), why || "No report from joy2twist yet.");
  }
}
