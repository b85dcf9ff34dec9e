"""Which changes no test can notice, and why: explained.yaml, held against what was found."""

from pathlib import Path

import yaml

EXPLAINED = Path(__file__).with_name("explained.yaml")


def key_of(module, survivor):
    """How a survivor of results.json is named in explained.yaml."""
    return f"{module}: {survivor['was']} -> {survivor['becomes']}"


def reasons():
    """From each explained change to its reason."""
    document = yaml.safe_load(EXPLAINED.read_text(encoding="utf-8")) or []
    found = {}
    for entry in document:
        for change in entry["changes"]:
            if change in found:
                raise ValueError(f"explained twice: {change}")
            found[change] = entry["reason"]
    return found


def unexplained(results):
    """The survivors without a reason."""
    known = reasons()
    return [
        key_of(module, survivor)
        for module, found in results.items()
        for survivor in found["survivors"]
        if key_of(module, survivor) not in known
    ]


def stale(results):
    """The reasons for changes that are noticed now, or not made any more."""
    survived = {
        key_of(module, one) for module, found in results.items() for one in found["survivors"]
    }
    return [change for change in reasons() if change not in survived]
