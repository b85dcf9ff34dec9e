"""python3 -m tutorial_faults: see live/program.py."""

import sys

from tutorial_faults.live.program import main

if __name__ == "__main__":
    sys.exit(main())
