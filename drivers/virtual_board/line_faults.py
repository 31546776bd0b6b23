"""A cable with disturbances of the bytes in either direction."""

from enum import Enum, auto

import numpy as np


class Damage(Enum):
    """What is done to the next bytes."""

    DROP = auto()
    DOUBLE = auto()
    CORRUPT = auto()


class Channel:
    """One direction of a cable."""

    def __init__(self, seed: int) -> None:
        self._chance = np.random.default_rng(seed)
        self._counts: dict[Damage, int] = {}
        self.delay_s = 0.0
        self.silent_until_s = 0.0

    def damage(self, kind: Damage, count: int) -> None:
        """Do this to the next bytes."""
        self._counts[kind] = count

    def passed(self, data: bytes, at_s: float) -> bytes:
        """Return what comes out of bytes that go in at a time, s."""
        if at_s < self.silent_until_s:
            return b""
        if not self._counts:
            return data
        return b"".join(self._one(byte) for byte in data)

    def noise(self, count: int) -> bytes:
        """Return spurious bytes."""
        return self._chance.bytes(count)

    def _one(self, byte: int) -> bytes:
        if self._takes(Damage.DROP):
            return b""
        if self._takes(Damage.CORRUPT):
            byte ^= 1 << int(self._chance.integers(8))
        return bytes((byte,)) * (2 if self._takes(Damage.DOUBLE) else 1)

    def _takes(self, kind: Damage) -> bool:
        left = self._counts.get(kind, 0)
        if left > 1:
            self._counts[kind] = left - 1
        elif left:
            del self._counts[kind]
        return left > 0
