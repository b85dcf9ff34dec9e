"""What the floor of the cockpit shows, by the pixels of its canvas."""

DRAWN = """(() => {
  const canvas = document.getElementById("floor"), box = canvas.getBoundingClientRect();
  const name = %r, style = getComputedStyle(canvas);
  const hex = (name.startsWith("#") ? name : style.getPropertyValue(name).trim()).slice(1);
  const wanted = [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));
  const pen = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
  pen.drawImage(canvas, 0, 0);
  const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
  let [count, x, y] = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    if (wanted.some((value, k) => Math.abs(data[i + k] - value) >= 12)) continue;
    count += 1;
    x += (i / 4) %% canvas.width;
    y += Math.floor(i / 4 / canvas.width);
  }
  return [count, box.left + x / count, box.top + y / count];
})()"""


def drawn(browser, colour):
    """Return [how many pixels of the floor have about this colour, x, y of their middle [pixel]].

    colour: #rrggbb, or the name of a variable of the style sheet.
    """
    return browser.ask(DRAWN % colour)


def settled(browser, colour):
    """Return where a colour is drawn, once it no longer changes."""
    now = drawn(browser, colour)
    return now if now[0] and now == drawn(browser, colour) else None
