"""What every launch file of the suite needs; README.md says how launch files use it."""
