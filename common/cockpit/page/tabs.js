/** Tabs as https://www.w3.org/WAI/ARIA/apg/patterns/tabs/ has them. */

/** onChoose(name) is called with the name of the view that is shown: "robot", "graph" ... */
export function makeTabs(tablist, onChoose) {
  const tabs = [...tablist.querySelectorAll("[role=tab]")];
  const nameOf = (tab) => tab.getAttribute("aria-controls");

  function choose(chosen) {
    for (const tab of tabs) {
      tab.setAttribute("aria-selected", tab === chosen);
      tab.tabIndex = tab === chosen ? 0 : -1;
      document.getElementById(nameOf(tab)).hidden = tab !== chosen;
    }
    document.title = `${chosen.textContent} – Cockpit`;
    history.replaceState(null, "", `${location.pathname}${location.search}#${nameOf(chosen)}`);
    onChoose(nameOf(chosen));
  }

  for (const tab of tabs) tab.onclick = () => choose(tab);
  tablist.addEventListener("keydown", (event) => {
    const [now, last] = [tabs.indexOf(document.activeElement), tabs.length - 1];
    const next = { ArrowRight: now === last ? 0 : now + 1, ArrowLeft: now <= 0 ? last : now - 1,
      Home: 0, End: last }[event.key];
    if (next === undefined || now < 0) return;
    event.preventDefault();
    choose(tabs[next]);
    tabs[next].focus();
  });
  const chooseByAddress = () => {
    const name = location.hash.slice(1).toLowerCase();
    choose(tabs.find((tab) => nameOf(tab) === name) ?? tabs[0]);
  };
  addEventListener("hashchange", chooseByAddress);
  chooseByAddress();
}
