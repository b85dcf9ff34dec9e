#!/usr/bin/env python3
"""Run the tutorial's demonstration: see joy_to_twist/demo.py."""

from joy_to_twist.demo import main

if __name__ == "__main__":
    main()
