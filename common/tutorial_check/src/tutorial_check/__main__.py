"""python3 -m tutorial_check: see commands/program.py."""

from tutorial_check.commands.program import main

if __name__ == "__main__":
    main()
