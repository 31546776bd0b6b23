"""A device that plays a script: for tests, demonstrations and training."""

import time
from bisect import bisect_right
from collections.abc import Sequence

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.inputs.device import (
    InputIdentity,
    InputLostError,
    InputReading,
    InputSource,
    Rumbler,
)
from rotemina.drivers.inputs.script import Moment, Script
from rotemina.sim.messages import message


class Scripted(InputSource):
    """One device, which does what its script says; the script begins when the source is made.

    Parameters
    ----------
    script : Script
    label : str
        Tells several scripted devices apart.
    clock : callable
        The host's time, s.
    """

    name = "Scripted device"

    def __init__(
        self, script: Script, label: str = "scripted", *, clock: Clock = time.monotonic
    ) -> None:
        super().__init__(clock=clock)
        self.identity = InputIdentity(f"scripted:{label}", label, "scripted")
        self.script = script
        self.start()

    def start(self) -> None:
        """Begin the script again, now."""
        self.begun_s = self.clock()

    def devices(self) -> Sequence[InputIdentity]:
        """Return the device while it is plugged in."""
        past = self._past()
        return (self.identity,) if not past or self.script.moments[past - 1].plugged else ()

    def open(self, identity: InputIdentity) -> "ScriptedDevice":
        """Open the device; see :class:`InputSource`."""
        if identity not in self.devices():
            raise InputLostError(
                message("engine", "{name} ({key}) is not plugged in").fill(
                    name=identity.name, key=identity.key
                )
            )
        return ScriptedDevice(self, max(0, self._past() - 1))

    def since(self, number: int) -> tuple[Moment, ...]:
        """Return the moments from a number on that have begun."""
        return self.script.moments[number : self._past()]

    def _past(self) -> int:
        """Return how many moments have begun."""
        past_s = self.clock() - self.begun_s
        return bisect_right(self.script.moments, past_s, key=lambda moment: moment.time_s)


class ScriptedDevice(Rumbler):
    """An open scripted device; it remembers how it was made to shake.

    Parameters
    ----------
    source : Scripted
    first : int
        The moment that it begins with: the one that holds as it is opened.
    """

    def __init__(self, source: Scripted, first: int) -> None:
        self.identity = source.identity
        self.axes = source.script.axes
        self.buttons = source.script.buttons
        #: (host time, strength) of each call of :meth:`rumble`.
        self.rumbled: list[tuple[float, float]] = []
        self._source = source
        self._opened_s = source.clock()
        self._next = first
        self._is_open = True
        self._lost = False

    def read(self) -> tuple[InputReading, ...]:
        """Return what happened since the last call; see :class:`InputDevice`."""
        if not self._is_open:
            raise StateError(
                message("engine", "{name} was closed; open it again").fill(name=self.identity.name)
            )
        moments = self._source.since(self._next)
        self._next += len(moments)
        self._lost = self._lost or not all(moment.plugged for moment in moments)
        if self._lost:
            raise InputLostError(
                message("engine", "{name} was unplugged by its script").fill(
                    name=self.identity.name
                )
            )
        begun_s = self._source.begun_s
        return tuple(
            InputReading(max(self._opened_s, begun_s + moment.time_s), moment.axes, moment.buttons)
            for moment in moments
        )

    def close(self) -> None:
        """Release it; see :class:`InputDevice`."""
        self._is_open = False

    def rumble(self, strength: float) -> None:
        """Remember the strength; see :class:`Rumbler`."""
        if not 0.0 <= strength <= 1.0:
            raise LimitError(
                message("engine", "{name}: strength {strength}: must be 0 to 1").fill(
                    name=self.identity.name, strength=strength
                )
            )
        self.rumbled.append((self._source.clock(), strength))
