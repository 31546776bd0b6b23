"""Cable that can disturb the bytes in each direction."""

from enum import Enum, auto

import numpy as np


class ByteDamage(Enum):
    """Kind of disturbance of a byte."""

    DROP = auto()
    DOUBLE = auto()
    CORRUPT = auto()


class CableChannel:
    """One direction of a cable, with its disturbances."""

    def __init__(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)
        self._damage_counts: dict[ByteDamage, int] = {}
        self.delay_s = 0.0
        self.silent_until_s = 0.0

    def damage(self, kind: ByteDamage, count: int) -> None:
        """Disturb the next ``count`` bytes in this way."""
        self._damage_counts[kind] = count

    def transmit(self, data: bytes, at_s: float) -> bytes:
        """Return the bytes that arrive if these bytes are sent at the time ``at_s``."""
        if at_s < self.silent_until_s:
            return b""
        if not self._damage_counts:
            return data
        return b"".join(self._transmit_byte(byte) for byte in data)

    def draw_noise(self, count: int) -> bytes:
        """Return a number of random bytes."""
        return self._random.bytes(count)

    def _transmit_byte(self, byte: int) -> bytes:
        if self._take_damage(ByteDamage.DROP):
            return b""
        if self._take_damage(ByteDamage.CORRUPT):
            byte ^= 1 << int(self._random.integers(8))
        return bytes((byte,)) * (2 if self._take_damage(ByteDamage.DOUBLE) else 1)

    def _take_damage(self, kind: ByteDamage) -> bool:
        remaining = self._damage_counts.get(kind, 0)
        if remaining > 1:
            self._damage_counts[kind] = remaining - 1
        elif remaining:
            del self._damage_counts[kind]
        return remaining > 0
