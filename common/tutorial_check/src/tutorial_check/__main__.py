"""python3 -m tutorial_check: see commands/command_line.py."""

from tutorial_check.commands.command_line import main

if __name__ == "__main__":
    main()
