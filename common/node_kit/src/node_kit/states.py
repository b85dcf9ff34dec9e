"""What joy2twist says of itself on /diagnostics, where others read it (pure)."""

DRIVING = "driving"
