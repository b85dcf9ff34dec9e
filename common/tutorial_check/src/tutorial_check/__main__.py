"""python3 -m tutorial_check: see program.py."""

from tutorial_check.program import main

if __name__ == "__main__":
    main()
