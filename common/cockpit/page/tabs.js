/**
 * Tabs as in https://www.w3.org/WAI/ARIA/apg/patterns/tabs/, and the address of what they show:
 * ?robot=robot_7#topics/odom, #plot?f=/odom/pose/pose/position/x&last=30. A reload keeps it, and Back works.
 * In a wide window the first tab can be beside another one, which then is the selected tab: ?beside=robot#topics.
 */

const WIDE = matchMedia("(min-width: 1200px)");
const nameOf = (tab) => tab.getAttribute("aria-controls");

export class Tabs {
  #tabs;
  #shown; // the selected one
  #other; // the newest one that is not the first
  #isBeside = false; // whether the first one is beside others, where there is room
  #handled = ""; // the address that is shown; null while it is being shown

  /**
   * beside: the button for the first tab beside another one. page.onChoose(names) is called with the names of the views
   * that are shown: "robot", "graph" ...; before it page.go(name, path, query) with what an address names.
   * page.placeOf(name) returns what follows the name there; page.robot() the value of ?robot=.
   */
  constructor(tablist, beside, page) {
    this.beside = beside;
    this.page = page;
    const tabs = this.#tabs = [...tablist.querySelectorAll("[role=tab]")];
    [this.#shown, this.#other] = tabs;
    for (const tab of tabs) tab.onclick = () => this.#choose(tab, true);
    tablist.addEventListener("keydown", (event) => {
      const now = tabs.indexOf(document.activeElement);
      const places = { ArrowRight: (now + 1) % tabs.length, ArrowLeft: now - 1, Home: 0, End: -1 };
      if (!(event.key in places)) return;
      const next = tabs.at(places[event.key]);
      event.preventDefault();
      this.#choose(next, true);
      next.focus();
    });
    beside.onclick = () => {
      this.#isBeside = beside.getAttribute("aria-pressed") === "false";
      this.#choose(this.#isBeside ? this.#other : this.#shown, true);
    };
    WIDE.addEventListener("change", () => this.#choose(this.#shown, false));
    addEventListener("popstate", () => this.#chooseByAddress()); // also for an address that is typed
    this.#chooseByAddress();
  }

  /** Write the address after a change. back: whether Back returns to the view before. */
  moved(back = false) {
    if (this.#handled === null) return;
    const query = new URLSearchParams(location.search);
    if (this.page.robot() !== null) query.set("robot", this.page.robot());
    if (this.#isBeside) query.set("beside", nameOf(this.#tabs[0]));
    else query.delete("beside");
    const name = nameOf(this.#shown);
    const address = `${String(query) && `?${query}`}#${name}${this.page.placeOf(name)}`;
    if (location.search + location.hash === address) return;
    history[back ? "pushState" : "replaceState"](null, "", location.pathname + address);
    this.#handled = location.href;
  }

  #choose(chosen, back) {
    const [first] = this.#tabs;
    this.#shown = chosen;
    if (chosen !== first) this.#other = chosen;
    const isPair = this.#isBeside && WIDE.matches && chosen !== first;
    const visible = isPair ? [first, chosen] : [chosen];
    document.body.classList.toggle("pair", isPair);
    this.beside.setAttribute("aria-pressed", isPair);
    for (const tab of this.#tabs) {
      tab.setAttribute("aria-selected", tab === chosen);
      tab.tabIndex = tab === chosen ? 0 : -1;
      document.getElementById(nameOf(tab)).hidden = !visible.includes(tab);
    }
    document.title = `${chosen.textContent.replace(/ \(.*/, "")} – Cockpit`; // without how many topics it publishes
    this.page.onChoose(visible.map(nameOf));
    this.moved(back);
  }

  #chooseByAddress() {
    if (location.href === this.#handled) return;
    const [, name, path, query] = /^#?([^/?]*)([^?]*)\??(.*)$/.exec(location.hash);
    const tab = this.#tabs.find((one) => nameOf(one) === name.toLowerCase()) ?? this.#tabs[0];
    this.#isBeside = new URLSearchParams(location.search).has("beside");
    this.#handled = null;
    this.page.go(nameOf(tab), path, new URLSearchParams(query));
    this.#handled = location.href;
    this.#choose(tab, false);
  }
}
