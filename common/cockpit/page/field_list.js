/** A list of fields with a search, of which a person chooses some. */

import { byId, element } from "./dom.js";

export const MOST = 20; // chosen at a time, as in the server
export const FIRST = 20; // entries of an array that are offered without a search
const LISTED = 200; // of the matching fields

/** The fields that an address names and that the server accepts. */
export const fieldsOf = (query) => query.getAll("f").filter((field) => /^[!-~]{1,200}$/.test(field)).slice(0, MOST);

export class FieldList {
  static panel = (id) => `<h2><label for="${id}-search">Fields</label></h2>
    <input type="search" id="${id}-search" class="search" placeholder="Search, e.g. odom linear" autocomplete="off">
    <ul id="${id}-fields" class="fields"></ul>`;

  /**
   * id: as in panel(id). chosen(): the chosen fields. offered(isSearch): all others, for a search with all entries of
   * arrays. choose(field, on): a person has chosen. nothing: what is said of a search without a result.
   */
  constructor(id, { chosen, offered, choose, nothing }) {
    this.chosen = chosen;
    this.offered = offered;
    this.choose = choose;
    this.nothing = nothing;
    this.search = byId(`${id}-search`);
    this.root = byId(`${id}-fields`);
    this.search.oninput = () => this.list();
  }

  list() {
    const search = this.search.value.trim();
    const words = search.toLowerCase().split(/\s+/).filter(Boolean);
    const [chosen, offered] = [this.chosen(), this.offered(words.length > 0)];
    const matching = offered.filter((field) => words.every((word) => field.toLowerCase().includes(word)));
    const fields = [...new Set([...chosen, ...matching])]; // the chosen ones first
    const listed = fields.slice(0, LISTED);
    this.root.replaceChildren(...listed.map((field) => {
      const box = element("input", { type: "checkbox", checked: chosen.includes(field), value: field });
      box.onchange = () => this.choose(field, box.checked);
      return element("li", {}, element("label", {}, box, ` ${field}`));
    }));
    const rest = fields.length - listed.length;
    const hint = rest ? `… and ${rest} more: search by name.`
      : matching.length || !offered.length ? "" : `${this.nothing} ${search}.`;
    if (hint) this.root.append(element("li", { className: "hint" }, hint));
    this.limit();
  }

  /** Let no more than MOST be chosen. */
  limit() {
    const isFull = this.chosen().length >= MOST;
    for (const box of this.root.querySelectorAll("input")) box.disabled = !box.checked && isFull;
  }
}
