"""A kernel with joysticks, in QEMU where this machine's has none."""
