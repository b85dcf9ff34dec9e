"""A page as it is drawn: colours of pixels, and their contrast; light and dark."""

import base64
import io
from collections import Counter

import numpy as np
from PIL import Image

SCHEMES = ("light", "dark")
LEAST_CONTRAST = 3.0  # WCAG 2.2, 1.4.11
NEARLY = 12  # of a colour, whose edges are blended


def luminance(colour):
    parts = [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in colour]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


def contrast(one, other):
    """As WCAG 2 has it, from 1 to 21."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def colour(browser, name):
    """Return that of a variable of the style sheet."""
    style = f"getComputedStyle(document.getElementById('floor')).getPropertyValue('{name}')"
    return tuple(bytes.fromhex(browser.ask(style).strip()[1:]))


def shot(browser):
    """Return the page's pixels, by [x, y], as (red, green, blue)."""
    return Image.open(io.BytesIO(browser.driver.get_screenshot_as_png())).convert("RGB").load()


def drawn(browser, name):
    """Return where the floor has about a colour [(y, x)], and the two that it has beside it the
    most. What is above the floor is not seen.
    """
    data = browser.ask("document.getElementById('floor').toDataURL()").partition(",")[2]
    image = Image.open(io.BytesIO(base64.b64decode(data))).convert("RGBA")
    below = Image.new("RGBA", image.size, colour(browser, "--floor"))
    pixels = np.asarray(Image.alpha_composite(below, image).convert("RGB"), dtype=int)
    dots = (abs(pixels - colour(browser, name)) < NEARLY).all(axis=2)
    edge = grown(dots)
    colours = Counter(map(tuple, pixels[grown(edge) & ~edge].tolist()))
    return np.argwhere(dots).tolist(), [one for one, _ in colours.most_common(2)]


def grown(mask):
    """Return a mask with what is beside it."""
    wide = np.pad(mask, 1)
    rows = wide[:-2] | wide[1:-1] | wide[2:]
    return rows[:, :-2] | rows[:, 1:-1] | rows[:, 2:]


def dress(browser, scheme="light", size=(1280, 800)):
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    browser.send("Emulation.setEmulatedMedia", features=features)
    browser.resize(*size)
