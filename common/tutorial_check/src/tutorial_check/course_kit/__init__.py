"""What checks of own courses work with, beside what the handout needs."""
