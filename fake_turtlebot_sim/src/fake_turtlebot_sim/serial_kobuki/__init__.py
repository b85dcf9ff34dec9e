"""The rules of a Kobuki on a serial line: firmware, damage, parameters."""
