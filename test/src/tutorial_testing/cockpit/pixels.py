"""A page as it is drawn: colours of pixels, and their contrast; light and dark."""

import io

from PIL import Image

SCHEMES = ("light", "dark")
LEAST_CONTRAST = 3.0  # WCAG 2.2, 1.4.11


def luminance(colour):
    parts = [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in colour]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


def contrast(one, other):
    """As WCAG 2 has it, from 1 to 21."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def colour(browser, name):
    style = f"getComputedStyle(document.getElementById('floor')).getPropertyValue('{name}')"
    return tuple(bytes.fromhex(browser.ask(style).strip()[1:]))


def seen(browser):
    """Return the page's pixels, by [x, y], as (red, green, blue), and its (width, height)."""
    image = Image.open(io.BytesIO(browser.driver.get_screenshot_as_png())).convert("RGB")
    return image.load(), image.size


def dress(browser, scheme="light", size=(1280, 800)):
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    browser.send("Emulation.setEmulatedMedia", features=features)
    browser.resize(*size)
