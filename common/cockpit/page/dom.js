/** The functions with which tabs build their elements. */

/** @type {(id: string) => any} of any kind: an input has a value */
export const byId = (id) => document.getElementById(id);

/** An element with properties, attributes (data-*, aria-*, role) and children: elements or texts. */
export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.includes("-") || name === "role") made.setAttribute(name, value);
    else made[name] = value;
  }
  made.append(...children);
  return made;
}

/** For sort(): robot_2 before robot_10. */
export const byName = new Intl.Collator("en", { numeric: true }).compare;

/** A node's name without the numbers that rospy and roscpp give anonymous nodes: /talker_host_…. */
export const brief = (name) => name.replace(/_\d+_\d{10,}$|_\d{16,}$/, "_…");

/** A row of a table. */
export const row = (...cells) => element("tr", {}, ...cells.map((cell) => element("td", {}, cell)));

/** A number as text, without -0.00; a dash if it is not finite. */
export const number = (value, digits = 2) =>
  Number.isFinite(value) ? value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1") : "–";

/** Let a <select> offer these [value, text] pairs, and keep the choice if it is still offered. */
export function offer(select, choices) {
  const wanted = JSON.stringify(choices);
  if (select.dataset.choices === wanted) return; // An open list stays as it is.
  const chosen = select.value;
  select.dataset.choices = wanted;
  select.replaceChildren(...choices.map(([value, text = value]) => new Option(text, value)));
  if (choices.some(([value]) => value === chosen)) select.value = chosen;
}

/** Set a text only if it differs, as screen readers read every change. */
export function say(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

/** Set a name only if it differs. A line breaks after its / and _, and elsewhere only if a part is too long. */
export function sayName(target, name) {
  if (target.textContent === name) return;
  const parts = name.match(/[/_]*[^/_]+[/_]*/g) ?? [name];
  target.replaceChildren(...parts.flatMap((part) => [part, element("wbr")]));
}

/** A function that says whether a text matches a search: it has all words of it, and none that follows a minus. */
export function matcher(search) {
  const words = search.toLowerCase().split(/\s+/).filter((word) => word !== "-");
  return (text) => words.every((word) => word.startsWith("-") !== text.toLowerCase().includes(word.replace(/^-/, "")));
}

/** Append to a list, drop its oldest rows, and keep showing its end if that was visible. */
export function appendBelow(list, parts, most, scroll = list) {
  const atEnd = scroll.scrollHeight - scroll.scrollTop - scroll.clientHeight < 40;
  list.append(...parts);
  while (list.childNodes.length > most) list.firstChild.remove();
  if (atEnd) scroll.scrollTop = scroll.scrollHeight;
}

/** Let the browser save a Blob as a file. */
export function save(blob, name) {
  const url = URL.createObjectURL(blob);
  element("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
