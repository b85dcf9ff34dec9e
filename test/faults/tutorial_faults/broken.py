"""Puts a bug into a module on purpose, for as long as a test runs: a hunter must find it."""

import importlib
import sys
from contextlib import contextmanager
from pathlib import Path

LIBRARIES = ("joy_to_twist", "fake_turtlebot_sim", "gamepad", "node_kit", "tutorial_faults")


@contextmanager
def broken(module_name, right, wrong):
    """Have a piece of a module's source replaced, and all that was imported from it.

    Raises ValueError unless the piece stands there exactly once.
    """
    module = importlib.import_module(module_name)
    source = Path(module.__file__).read_text(encoding="utf-8")
    if source.count(right) != 1:
        raise ValueError(f"{module_name}: {source.count(right)} times: {right}")
    before = dict(vars(module))
    exec(compile(source.replace(right, wrong), module.__file__, "exec"), vars(module))
    changed = {
        id(old): vars(module)[name]
        for name, old in before.items()
        if getattr(old, "__module__", None) == module_name  # its classes and functions
    }
    others = [
        vars(other)
        for name, other in list(sys.modules.items())
        if name.split(".")[0] in LIBRARIES and other is not module
    ]
    replaced = [
        (names, name, old)
        for names in others
        for name, old in list(names.items())
        if id(old) in changed
    ]
    for names, name, old in replaced:
        names[name] = changed[id(old)]
    try:
        yield
    finally:
        for names, name, old in replaced:
            names[name] = old
        vars(module).update(before)
