"""Imported first, this loads of roslaunch only what reads launch files.

`import roslaunch` runs its __init__.py, which loads all of it, rosclean and numpy, too: 0.35 s in
place of 0.1 s, before each launch. For programs that use launch_tree and no more of roslaunch.
"""

import sys
from importlib.machinery import PathFinder
from importlib.util import module_from_spec
from pathlib import Path

if "roslaunch" not in sys.modules:
    _spec = PathFinder.find_spec("roslaunch")
    # A roslaunch that is built from its sources has them elsewhere, and its __init__.py knows.
    if _spec and _spec.origin and Path(_spec.origin).with_name("xmlloader.py").exists():
        sys.modules["roslaunch"] = module_from_spec(_spec)  # which is not run
