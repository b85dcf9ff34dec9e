"""A page as it is drawn: colours of pixels, and their contrast; light and dark."""

import base64
import io
from collections import Counter

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


def floor(browser):
    """Return the floor's picture without what is above it: (pixels by [x, y], (width, height))."""
    data = browser.ask("document.getElementById('floor').toDataURL()").partition(",")[2]
    image = Image.open(io.BytesIO(base64.b64decode(data))).convert("RGBA")
    below = Image.new("RGBA", image.size, colour(browser, "--floor"))
    return Image.alpha_composite(below, image).convert("RGB").load(), image.size


def drawn(browser, name):
    """Return where the floor has about a colour [(x, y)], and the two that it has beside it the
    most.
    """
    wanted, (pixels, (width, height)) = colour(browser, name), floor(browser)
    every = {(x, y) for x in range(width) for y in range(height)}
    is_near = lambda one: all(abs(a - b) < NEARLY for a, b in zip(one, wanted))  # noqa: E731
    dots = {at for at in every if is_near(pixels[at])}
    edge = grown(dots) - dots
    beside = Counter(pixels[at] for at in (grown(edge) - edge - dots) & every)
    return sorted(dots), [one for one, _ in beside.most_common(2)]


def grown(places):
    steps = (-1, 0, 1)
    return {(x + dx, y + dy) for x, y in places for dx in steps for dy in steps}


def dress(browser, scheme="light", size=(1280, 800)):
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    browser.send("Emulation.setEmulatedMedia", features=features)
    browser.resize(*size)
