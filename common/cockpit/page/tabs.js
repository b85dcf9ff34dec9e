/**
 * Tabs as in https://www.w3.org/WAI/ARIA/apg/patterns/tabs/, and the address of what they show:
 * ?robot=robot_7#topics/odom, #plot?f=/odom/pose/pose/position/x&last=30. A reload keeps it, and Back works.
 */

const nameOf = (tab) => tab.getAttribute("aria-controls");

/**
 * onChoose(name) is called with the name of the view that is shown: "robot", "graph" ...; before it go(name, path,
 * query) with what an address names. placeOf(name) returns what follows the name there; robot() the value of ?robot=.
 * Returns moved(back), which writes the address after a change; back: whether Back returns to the view before.
 */
export function makeTabs(tablist, { onChoose, go, placeOf, robot }) {
  const tabs = [...tablist.querySelectorAll("[role=tab]")];
  let shown = tabs[0];
  let handled = ""; // the address that is shown; null while it is being shown

  function moved(back = false) {
    if (handled === null) return;
    const query = new URLSearchParams(location.search);
    if (robot() !== null) query.set("robot", robot());
    const address = `${String(query) && `?${query}`}#${nameOf(shown)}${placeOf(nameOf(shown))}`;
    if (location.search + location.hash === address) return;
    history[back ? "pushState" : "replaceState"](null, "", address);
    handled = location.href;
  }

  function choose(chosen, back) {
    shown = chosen;
    for (const tab of tabs) {
      tab.setAttribute("aria-selected", tab === chosen);
      tab.tabIndex = tab === chosen ? 0 : -1;
      document.getElementById(nameOf(tab)).hidden = tab !== chosen;
    }
    document.title = `${chosen.textContent} – Cockpit`;
    onChoose(nameOf(chosen));
    moved(back);
  }

  for (const tab of tabs) tab.onclick = () => choose(tab, true);
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
    handled = null;
    go(nameOf(tab), path, new URLSearchParams(query));
    handled = location.href;
    choose(tab, false);
  };
  addEventListener("popstate", chooseByAddress); // also for an address that is typed
  chooseByAddress();
  return moved;
}
