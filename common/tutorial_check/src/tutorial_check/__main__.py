"""python3 -m tutorial_check: see program.py."""

from tutorial_check.commands.check import main

if __name__ == "__main__":
    main()
