/** The driver's session: the driver, the speed and Stop above all tabs, and driving in the tab Robot. */

import { byId, element, number, say } from "./dom.js";
import { Driver } from "./driver.js";
import { REACH } from "./keys.js";

const NOTHING = {
  session: { driver: null, yours: false, robot: "", topic: "" },
  drives: { robots: {}, who: "", ready: "", how: "", refusal: "", no_reset: "" },
};
export const STALE_S = 1; // An older speed is not shown, and other values of this age are grey.
const CUT = "This page no longer drives: its connection was lost. Press Drive from this page, or Publish, to continue.";

export class DriverSession {
  #role = null; // "driver" or "viewer", once the server has sent it
  #said = NOTHING; // by the server, over this connection
  #advice = ""; // a notice of what to do, valid while this page has the session

  /** tab: the RobotTab, which has the robot, the floor, and the elements below the tabs. */
  constructor(link, notice, tab) {
    this.link = link;
    this.notice = notice;
    this.tab = tab;
    this.driver = new Driver(link, byId("glass"), () => this.#showReach());
    byId("reach").append(...Object.entries(REACH).map(([code, [name]]) => element("button", {
      "data-code": code, "aria-keyshortcuts": code.at(-1), onclick: () => this.#showReach(code) }, name)));
    link.on("hello", ({ role }) => this.#begin(role));
    link.on("session", (session) => this.#take(session));
    link.on("drives", (drives) => this.#hear({ drives }));
    link.on("lost", ({ text, keeps }) => {
      if (keeps) this.#advice = text;
      notice(text);
    });
    byId("take").onclick = () => link.send("drive", { robot: tab.look, mode: byId("mode").value });
    byId("stop").onclick = () => this.#stop();
    byId("reset").onclick = () => link.send("reset", { robot: tab.look });
    byId("give").onclick = () => {
      const heir = byId("heir");
      if (heir.reportValidity()) link.send("hand_over", { to: heir.valueAsNumber });
    };
    addEventListener("keydown", (event) => event.key === "Escape" && !byId("stop").disabled && this.#stop());
  }

  /** Whether this page drives, by hand, with a recording, or by a form. */
  get yours() {
    return this.#now.session.yours;
  }

  /** Robot -> {driver: the name of what drives it, or ""; state, why: of joy2twist's report}. */
  get robots() {
    return this.#now.drives.robots;
  }

  /** v, w, age: of the chosen robot [m/s, rad/s, s]; without them: unknown. */
  showSpeed({ v = NaN, w = NaN, age = NaN }) {
    const isKnown = this.link.isOpen && age < STALE_S;
    say(byId("speed"), isKnown ? `${number(v)} m/s, ${number(w)} rad/s` : "– m/s");
  }

  /** Show what the server sent last. Without a connection that is outdated, and this page does not drive. */
  show() {
    const { isOpen, heardAt } = this.link;
    const { session, drives } = this.#now;
    const isByHand = session.yours && !session.plays && !session.topic;
    if (isByHand) this.driver.start();
    else this.driver.stop();
    if (!session.yours && byId("notice").textContent === this.#advice) this.notice("");
    if (!isOpen) this.showSpeed({});
    const time = new Date(heardAt).toTimeString().slice(0, 8);
    const old = heardAt ? `Not connected: everything shown is from ${time}. The driver is unknown.` : "";
    say(byId("session"), isOpen ? drives.who : old);
    byId("session").dataset.armed = Boolean(session.yours && session.armed);
    byId("session").dataset.state = session.driver === null ? "free" : session.yours ? "yours" : "taken";
    say(byId("ready"), drives.ready);
    say(byId("how-to"), drives.how);
    byId("how").hidden = !drives.how;
    this.#showReach();
    this.#showButtons(session, drives, isByHand);
  }

  #showButtons({ yours, driver, robot, topic }, { refusal, no_reset: noReset }, isByHand) {
    const mayDrive = this.link.isOpen && this.#role === "driver";
    const [take, stop, reset] = [byId("take"), byId("stop"), byId("reset")];
    const focused = [take, stop, reset].find((one) => one === document.activeElement);
    take.hidden = yours;
    take.disabled = !mayDrive || Boolean(refusal);
    stop.disabled = !mayDrive || driver === null || !(yours || topic || robot === this.tab.look);
    reset.disabled = !mayDrive || Boolean(noReset);
    reset.title = noReset;
    if (focused && (focused.hidden || focused.disabled)) { // Move the focus to an element that can be pressed.
      const selected = document.querySelector("[role=tab][aria-selected=true]");
      ([stop, take].find((one) => !one.disabled && one.offsetParent) ?? selected)?.focus();
    }
    for (const part of ["hand-over", "glass", "reach", "reach-now"]) byId(part).hidden = !isByHand;
    byId("look").disabled = byId("mode").disabled = yours;
    document.body.classList.toggle("driving", yours);
    document.body.classList.toggle("by-hand", isByHand);
  }

  /** How far keys push the stick, which a button or a key has chosen. */
  #showReach(code = this.driver.keys.reach) {
    this.driver.keys.reach = code;
    for (const button of byId("reach").children) button.setAttribute("aria-pressed", button.dataset.code === code);
    say(byId("reach-now"), `keys: ${REACH[code][0]}`);
  }

  get #now() {
    return this.link.isOpen ? this.#said : NOTHING;
  }

  #hear(words) {
    this.#said = { ...this.#said, ...words };
    this.show();
  }

  #begin(role) {
    if (this.yours) this.notice(CUT);
    this.#role = role;
    this.#hear(NOTHING);
  }

  #take(session) {
    const drives = session.yours && !session.topic; // A form may move something that is no robot.
    if (drives && !this.yours) this.tab.floor.setFollow(true); // A driver sees the driven robot.
    if (drives && session.robot !== this.tab.look) this.tab.lookAt(session.robot); // It was handed over.
    if (session.yours) this.driver.mode = byId("mode").value;
    if (session.yours && session.armed) this.notice(""); // It may drive on.
    this.#hear({ session });
  }

  /** Stop the robot: release this page's hands at once and leave the session, or stop another driver. */
  #stop() {
    this.notice(""); // why it stopped before
    this.driver.stop();
    this.link.send("stop");
  }
}
