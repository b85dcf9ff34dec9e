/**
 * Tabs as in https://www.w3.org/WAI/ARIA/apg/patterns/tabs/, and the address of what they show:
 * ?robot=robot_7#topics/odom, #plot?f=/odom/pose/pose/position/x&last=30. A reload keeps it, and Back works.
 * In a wide window the first tab can be beside another one, which then is the selected tab: ?beside=robot#topics.
 */

const WIDE = matchMedia("(min-width: 1200px)");
const nameOf = (tab) => tab.getAttribute("aria-controls");

/**
 * beside: the button for the first tab beside another one. onChoose(names) is called with the names of the views that are
 * shown: "robot", "graph" ...; before it go(name, path, query) with what an address names. placeOf(name) returns what
 * follows the name there; robot() the value of ?robot=.
 * Returns moved(back), which writes the address after a change; back: whether Back returns to the view before.
 */
export function makeTabs(tablist, beside, { onChoose, go, placeOf, robot }) {
  const tabs = [...tablist.querySelectorAll("[role=tab]")];
  const [first] = tabs;
  let shown = first;
  let other = tabs[1]; // the newest one that is not the first
  let isWanted = false; // the first tab beside another one, where there is room
  let handled = ""; // the address that is shown; null while it is being shown

  function moved(back = false) {
    if (handled === null) return;
    const query = new URLSearchParams(location.search);
    if (robot() !== null) query.set("robot", robot());
    if (isWanted) query.set("beside", nameOf(first));
    else query.delete("beside");
    const address = `${String(query) && `?${query}`}#${nameOf(shown)}${placeOf(nameOf(shown))}`;
    if (location.search + location.hash === address) return;
    history[back ? "pushState" : "replaceState"](null, "", location.pathname + address);
    handled = location.href;
  }

  function choose(chosen, back) {
    shown = chosen;
    if (chosen !== first) other = chosen;
    const isPair = isWanted && WIDE.matches && chosen !== first;
    const visible = isPair ? [first, chosen] : [chosen];
    document.body.classList.toggle("pair", isPair);
    beside.setAttribute("aria-pressed", isPair);
    for (const tab of tabs) {
      tab.setAttribute("aria-selected", tab === chosen);
      tab.tabIndex = tab === chosen ? 0 : -1;
      document.getElementById(nameOf(tab)).hidden = !visible.includes(tab);
    }
    document.title = `${chosen.textContent} – Cockpit`;
    onChoose(visible.map(nameOf));
    moved(back);
  }

  for (const tab of tabs) tab.onclick = () => choose(tab, true);
  beside.onclick = () => {
    isWanted = beside.getAttribute("aria-pressed") === "false";
    choose(isWanted ? other : shown, true);
  };
  WIDE.addEventListener("change", () => choose(shown, false));
  tablist.addEventListener("keydown", (event) => {
    const now = tabs.indexOf(document.activeElement);
    const places = { ArrowRight: (now + 1) % tabs.length, ArrowLeft: now - 1, Home: 0, End: -1 };
    if (!(event.key in places)) return;
    const next = tabs.at(places[event.key]);
    event.preventDefault();
    choose(next, true);
    next.focus();
  });
  const chooseByAddress = () => {
    if (location.href === handled) return;
    const [, name, path, query] = /^#?([^/?]*)([^?]*)\??(.*)$/.exec(location.hash);
    const tab = tabs.find((one) => nameOf(one) === name.toLowerCase()) ?? tabs[0];
    isWanted = new URLSearchParams(location.search).has("beside");
    handled = null;
    go(nameOf(tab), path, new URLSearchParams(query));
    handled = location.href;
    choose(tab, false);
  };
  addEventListener("popstate", chooseByAddress); // also for an address that is typed
  chooseByAddress();
  return moved;
}
