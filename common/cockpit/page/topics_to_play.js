/** The table of a recording's topics, of which a person chooses those that are played. */

import { brief, byId, element, row, say } from "./dom.js";

export const JOY = "sensor_msgs/Joy";
const MOVING = [JOY, "geometry_msgs/Twist"];
const LEFT_OUT = ["/clock", "/rosout", "/rosout_agg"]; // unless a person chooses them

export class TopicsToPlay {
  #choices = {}; // topic -> whether a person wants it to be played
  #nodes = {}; // topic -> the other nodes that publish it now
  #joysticks = [];
  #moving = []; // the topics that may move a robot
  root = byId("bag-topics");

  /** onChange(): other topics may be chosen. */
  constructor(onChange) {
    this.onChange = onChange;
  }

  show(topics) {
    this.#choices = {};
    this.#joysticks = topics.filter(({ type }) => type === JOY).map(({ name }) => name);
    this.#moving = topics.filter(({ type }) => MOVING.includes(type)).map(({ name }) => name);
    this.root.replaceChildren(...topics.map(({ name, type, count }) => {
      const box = element("input", { type: "checkbox", value: name });
      box.onchange = () => this.#choose(name, box.checked);
      const about = [element("p", { className: "hint" }, type), element("p", { className: "hint others" })];
      return row(element("div", {}, element("label", {}, box, ` ${name}`), ...about), String(count));
    }));
    this.tick(this.#nodes);
  }

  #choose(topic, on) {
    if (this.#joysticks.includes(topic)) for (const other of this.#joysticks) this.#choices[other] = false; // One robot has one.
    this.#choices[topic] = on;
    this.tick(this.#nodes);
  }

  /** Tick what a person has chosen, and else what no other node publishes. */
  tick(nodes) {
    this.#nodes = nodes;
    for (const box of this.root.querySelectorAll("input")) {
      const others = (nodes[box.value] ?? []).map(brief);
      const isOther = this.#joysticks.indexOf(box.value) > 0 || LEFT_OUT.includes(box.value);
      box.checked = this.#choices[box.value] ?? (!others.length && !isOther);
      const publish = others.length > 1 ? "publish" : "publishes";
      say(box.closest("td").querySelector(".others"), others.length ? `${others.join(" and ")} ${publish} this now` : "");
    }
    this.onChange();
  }

  get chosen() {
    return [...this.root.querySelectorAll("input:checked")].map(({ value }) => value);
  }

  get mayMove() {
    return this.chosen.some((topic) => this.#moving.includes(topic));
  }

  /** The chosen topic that moves a joystick, or undefined. */
  get joystick() {
    return this.chosen.find((topic) => this.#joysticks.includes(topic));
  }
}
