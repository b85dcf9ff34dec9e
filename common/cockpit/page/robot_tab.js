/** The tab Robot: the floor, the joystick, the driver, and driving from here. */

import { byId, offer, row, say } from "./dom.js";
import { Driver } from "./driver.js";
import { Floor } from "./floor.js";
import { GamepadPicture } from "./gamepad_picture.js";

const STALE_S = 1; // after which what is shown is not news

const number = (value, digits = 2) =>
  Number.isFinite(value) ? value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1") : "–"; // no -0.00

const PANEL = `
  <div class="floor">
    <canvas id="floor" tabindex="0" role="img" aria-label="The floor from above, with the robots"></canvas>
    <div class="toolbar" role="group" aria-label="View of the floor">
      <button id="zoom-in" aria-label="Zoom in">+</button>
      <button id="zoom-out" aria-label="Zoom out">−</button>
      <button id="follow" aria-pressed="true">Follow</button>
      <button id="show-all">Show all</button>
      <button id="clear-trail">Clear trail</button>
    </div>
    <div id="glass" role="group" aria-label="Joystick on glass" hidden>
      <div class="shoulders">
        <button id="rb" data-button="RB" aria-label="RB, turbo">RB</button>
        <button id="lb" data-button="LB" aria-label="LB" aria-describedby="how">LB</button>
      </div>
      <div id="stick" role="img" aria-label="Stick: drag it with a thumb, or use the arrow keys"><div id="knob"></div></div>
    </div>
  </div>
  <div class="panel">
    <div class="card" id="drive">
      <h2><label for="look">Robot</label> <select id="look"></select> <small id="me"></small></h2>
      <p id="seat" role="status" aria-live="polite"></p>
      <p id="ready" role="status" aria-live="polite"></p>
      <div class="row">
        <button id="take" class="primary" disabled>Drive from this page</button>
        <button id="leave" class="stop" hidden>Stop driving</button>
        <button id="reset" disabled>Reset robot</button>
      </div>
      <div class="row" id="hand-over" hidden>
        <button id="give">Hand over</button>
        <label>to page <input type="number" id="heir" min="1" step="1"></label>
      </div>
      <p id="how" class="hint" hidden><span id="how-to"></span> <label>F710 at <select id="mode"><option>D</option><option>X</option></select></label></p>
    </div>
    <div class="card">
      <h2>joy2twist</h2>
      <p id="teleop" role="status" aria-live="polite" data-state="unknown">No report from joy2twist yet.</p>
    </div>
    <div class="card">
      <h2>Joystick <small id="pad-age"></small></h2>
      <div id="pad"></div>
    </div>
    <div class="card">
      <h2>Odometry</h2>
      <dl id="odometry">
        <div><dt>x</dt><dd><output data-value="x">–</output> m</dd></div>
        <div><dt>y</dt><dd><output data-value="y">–</output> m</dd></div>
        <div><dt>heading</dt><dd><output data-value="yaw">–</output>°</dd></div>
        <div><dt>speed</dt><dd><output data-value="v">–</output> m/s</dd></div>
        <div><dt>turning</dt><dd><output data-value="w">–</output> rad/s</dd></div>
        <div><dt>covered</dt><dd><output data-value="covered">–</output> m</dd></div>
      </dl>
    </div>
    <div class="card" id="class" hidden>
      <h2>All robots</h2>
      <table><thead><tr><th>Robot</th><th>x, y [m]</th><th>Driver</th><th>joy2twist</th></tr></thead>
        <tbody id="robots"></tbody></table>
    </div>
  </div>`;

export class RobotTab {
  static title = "Robot";
  static panel = PANEL;
  static watches = { robots: true, look: null };

  #hello = null;
  #seat = { driver: null, yours: false };
  #drives = { drivers: {}, again: "" }; // the server's words: the driver, and what to do
  #teleop = new Map(); // robot -> what its joy2twist says
  #names = []; // of the robots
  #look = null; // the name of the one that is looked at, once there is one
  #rows = new Map(); // name -> its row in the table of all; rows stay, as a click takes its time
  #onFloor = ""; // the names of those that say where they are, as JSON

  /** link: the Link. watch(fields): what to ask the server for. page: see main.js. */
  constructor(link, watch, { notice }) {
    Object.assign(this, { link, watch, notice });
    const onFloor = ".toolbar button, #glass button, #stick";
    this.floor = new Floor(byId("floor"), () => [...byId("robot").querySelectorAll(onFloor)]);
    this.picture = new GamepadPicture(byId("pad"));
    this.driver = new Driver(link, byId("glass"));
    this.driver.onLost = (why) => notice(`Stopped: ${why}. ${this.#drives.again}`);
    link.on("hello", (hello) => this.#meet(hello));
    link.on("names", ({ names }) => this.#showNames(names));
    link.on("robots", ({ robots }) => this.#showRobots(robots));
    link.on("map", (map) => {
      this.floor.around.showMap(map);
      this.floor.showAll();
      if (this.#names.length < 2) this.#follow(true);
    });
    link.on("around", ({ robots }) => this.floor.around.showRobots(robots));
    link.on("scan", (scan) => this.floor.showScan(scan));
    link.on("pad", (pad) => this.#showPad(pad));
    link.on("teleop", (teleop) => this.#showTeleop(teleop));
    link.on("seat", (seat) => this.#showSeat(seat));
    link.on("drives", (drives) => this.#showDrives(drives));
    link.on("lost", ({ text, again }) => notice(again ? `${text} ${this.#drives.again}` : text));
    this.#listen();
  }

  get look() {
    return this.#look ?? "";
  }

  /** The connection is open or lost. Without it nothing here is news, and nothing drives. */
  connect(isOpen) {
    byId("robot").classList.toggle("stale", !isOpen);
    if (isOpen) this.#showButtons();
    else {
      this.#showSeat({ driver: null, yours: false });
      this.#showDrives({ drivers: {}, who: "Not connected: the driver is unknown.", ready: "", how: "", again: "" });
    }
  }

  #listen() {
    const { link, floor } = this;
    const on = (id, act) => byId(id).addEventListener("click", act);
    on("zoom-in", () => floor.zoom(1.25));
    on("zoom-out", () => floor.zoom(0.8));
    on("show-all", () => floor.showAll());
    on("clear-trail", () => floor.clearTrails());
    floor.onUnfollow = () => this.#follow(false);
    on("follow", () => this.#follow(!floor.follow));
    on("take", () => link.send("drive", { robot: this.look, mode: byId("mode").value }));
    on("leave", () => this.#leave());
    on("reset", () => {
      this.notice("");
      link.send("reset", { robot: this.look });
    });
    on("give", () => link.send("hand_over", { to: Number(byId("heir").value) }));
    byId("look").addEventListener("change", () => this.#lookAt(byId("look").value));
    addEventListener("keydown", (event) => {
      if (event.key === "Escape" && this.driver.isDriving) this.#leave();
    });
  }

  #follow(yes) {
    this.floor.follow = yes;
    byId("follow").setAttribute("aria-pressed", String(yes));
  }

  #leave() {
    this.notice(""); // why it stopped before
    this.driver.stop();
    this.link.send("leave");
  }

  #meet(hello) {
    this.#hello = hello;
    say(byId("me"), `page ${hello.id}`);
    this.#showNames(hello.robots);
    this.#showButtons();
    if (this.#look !== null) this.#lookAt(this.#look);
  }

  #showNames(names) {
    this.#names = names;
    byId("class").hidden = names.length < 2;
    this.#rows = new Map(names.map((name) => [name, this.#rows.get(name) ?? this.#rowOf(name)]));
    byId("robots").replaceChildren(...this.#rows.values());
    if (this.#look === null && names.length) this.#lookAt(names[0]);
    else this.#offerRobots();
  }

  /** A chosen robot stays chosen: one that has gone may come back. */
  #offerRobots() {
    const isGone = this.#look !== null && !this.#names.includes(this.#look);
    const choices = this.#names.map((name) => [name, name || "TurtleBot"]);
    if (isGone) choices.push([this.#look, `${this.#look || "TurtleBot"} (gone)`]);
    offer(byId("look"), choices);
    if (this.#look !== null) byId("look").value = this.#look;
  }

  #lookAt(name) {
    this.#look = name;
    this.#offerRobots();
    this.floor.look = name;
    this.picture.show({ D: [], X: [] }, [], []);
    say(byId("pad-age"), "no message yet");
    this.#showTeleop(this.#teleop.get(name) ?? { robot: name });
    this.watch({ look: name });
  }

  #showRobots(robots) {
    this.floor.show(robots);
    const names = Object.keys(robots);
    const isNew = names.length && JSON.stringify(names) !== this.#onFloor;
    if (isNew && names.length > 1 && !this.#seat.yours) this.floor.showAll();
    if (isNew) this.#onFloor = JSON.stringify(names);
    const robot = robots[this.look] ?? {};
    const degrees = (robot.yaw * 180) / Math.PI;
    const digits = { x: 2, y: 2, yaw: 1, v: 2, w: 2, covered: 2 };
    for (const [name, count] of Object.entries(digits)) {
      const value = name === "yaw" ? degrees : robot[name];
      say(document.querySelector(`#odometry [data-value=${name}]`), number(value, count));
    }
    byId("odometry").classList.toggle("stale", !(robot.age < STALE_S));
    this.#showClass(robots);
  }

  #rowOf(name) {
    const line = row(name, "", "", "");
    line.dataset.robot = name;
    // A driver sees the driven robot.
    line.addEventListener("click", () => this.#seat.yours || name === this.#look || this.#lookAt(name));
    return line;
  }

  #showClass(robots) {
    for (const [name, line] of this.#rows) {
      const { x, y, age } = robots[name] ?? {};
      const why = this.#teleop.get(name)?.why;
      const texts = [name, `${number(x)}, ${number(y)}`, this.#drives.drivers[name] || "–", why ?? "–"];
      texts.forEach((text, i) => say(line.cells[i], text));
      line.classList.toggle("stale", !(age < STALE_S));
      line.classList.toggle("chosen", name === this.look);
    }
  }

  #showPad({ robot, axes, buttons, age }) {
    if (robot !== this.look || !this.#hello) return;
    const names = { D: this.#hello.pad.D.buttons, X: this.#hello.pad.X.buttons };
    this.picture.show(names, axes, buttons);
    say(byId("pad-age"), age > STALE_S ? `silent for ${number(age, 0)} s` : "");
    byId("pad").classList.toggle("stale", age > STALE_S);
  }

  #showTeleop({ robot, state, why }) {
    if (state) this.#teleop.set(robot, { robot, state, why });
    if (robot !== this.look) return;
    byId("teleop").dataset.state = state ?? "unknown";
    say(byId("teleop"), why || state || "No report from joy2twist yet.");
  }

  #showSeat(seat) {
    if (seat.yours && !this.#seat.yours) this.#follow(true); // a driver sees the driven robot
    this.#seat = seat;
    if (seat.yours && seat.robot !== this.#look) this.#lookAt(seat.robot); // it was handed over
    if (seat.yours) this.driver.mode = byId("mode").value;
    if (seat.yours && seat.how !== "bag") this.driver.start();
    else this.driver.stop();
    byId("seat").dataset.armed = Boolean(seat.yours && seat.armed);
    if (seat.yours && seat.armed) this.notice(""); // it may go on
    byId("seat").dataset.state = seat.driver === null ? "free" : seat.yours ? "yours" : "taken";
    byId("hand-over").hidden = !seat.yours || seat.how === "bag";
    this.#showButtons();
  }

  #showDrives(drives) {
    this.#drives = drives;
    say(byId("seat"), drives.who);
    say(byId("ready"), drives.ready);
    say(byId("how-to"), drives.how);
    byId("how").hidden = !drives.how;
  }

  #showButtons() {
    const isViewer = this.#hello?.role === "viewer";
    const mayDrive = this.link.isOpen && !isViewer;
    const { yours, driver } = this.#seat;
    const held = document.activeElement === byId("take") || document.activeElement === byId("leave");
    byId("take").hidden = yours;
    byId("leave").hidden = !yours;
    if (held) byId(yours ? "leave" : "take").focus(); // the keyboard stays where it was
    byId("take").disabled = !mayDrive || (driver !== null && !yours);
    byId("reset").disabled = !mayDrive;
    byId("glass").hidden = !yours || this.#seat.how === "bag";
    byId("look").disabled = yours;
    byId("mode").disabled = yours;
    document.body.classList.toggle("driving", yours);
    document.body.classList.toggle("by-hand", !byId("glass").hidden);
  }
}
