"""python3 -m tutorial_check: see program.py."""

from tutorial_check.command_line import main

if __name__ == "__main__":
    main()
