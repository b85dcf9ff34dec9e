"""The damage that a bad cable, hub or converter does to a serial line."""

from __future__ import annotations

from random import Random

STALL_EVERY_S = 10.0  # between the beginnings of two stalls
NOISE_BYTES = 64  # in place of a packet


class Damage:
    """Losses, wrong bytes and stalls; the same seed gives the same ones."""

    def __init__(self, drop: float, corrupt: float, stall_s: float, seed: int = 0) -> None:
        """Lose and corrupt these shares (0 to 1) of the packets; stall for stall_s every 10 s."""
        self._drop, self._corrupt, self._stall_s = drop, corrupt, stall_s
        self._random = Random(seed)
        self._held = b""
        self._is_noise = False

    def switch_noise(self, is_on: bool) -> None:
        """Replace all data with noise, as at a wrong baud rate, or stop doing so."""
        self._is_noise = is_on

    def spoil(self, data: bytes) -> bytes:
        """Return what arrives of a packet: all of it, nothing, or all with one wrong byte."""
        if data and self._is_noise:
            return bytes(self._random.choices(range(256), k=NOISE_BYTES))
        if not data or self._random.random() < self._drop:
            return b""
        if self._random.random() >= self._corrupt:
            return data
        place = self._random.randrange(len(data))
        wrong = data[place] ^ self._random.randrange(1, 256)
        return data[:place] + bytes([wrong]) + data[place + 1 :]

    def delay(self, data: bytes, now_s: float) -> bytes:
        """Return what arrives now: nothing during a stall, and everything held back after it."""
        self._held += data
        if now_s >= STALL_EVERY_S and now_s % STALL_EVERY_S < self._stall_s:
            return b""
        arrived, self._held = self._held, b""
        return arrived
