"""Which changes no test can notice, and why: explained.yaml."""

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
