/** Tabs as https://www.w3.org/WAI/ARIA/apg/patterns/tabs/ has them. */

/** onChoose(name) is called with the name of the view that is shown: "robot", "graph" ... */
export function makeTabs(tablist, onChoose) {
  const tabs = [...tablist.querySelectorAll("[role=tab]")];
  const names = tabs.map((tab) => tab.getAttribute("aria-controls"));

  function choose(tab, focus) {
    for (const other of tabs) {
      const chosen = other === tab;
      other.setAttribute("aria-selected", String(chosen));
      other.tabIndex = chosen ? 0 : -1;
      document.getElementById(other.getAttribute("aria-controls")).hidden = !chosen;
    }
    if (focus) tab.focus();
    const name = tab.getAttribute("aria-controls");
    history.replaceState(null, "", `${location.pathname}${location.search}#${name}`);
    onChoose(name);
  }

  for (const tab of tabs) tab.addEventListener("click", () => choose(tab, false));
  tablist.addEventListener("keydown", (event) => {
    const now = tabs.indexOf(document.activeElement);
    const last = tabs.length - 1;
    const next = { ArrowRight: now === last ? 0 : now + 1, ArrowLeft: now <= 0 ? last : now - 1,
      Home: 0, End: last }[event.key];
    if (next === undefined || now < 0) return;
    event.preventDefault();
    choose(tabs[next], true);
  });
  const fromAddress = () => {
    const name = location.hash.slice(1).toLowerCase();
    choose(tabs[Math.max(0, names.indexOf(name))], false);
  };
  addEventListener("hashchange", fromAddress);
  fromAddress();
}
