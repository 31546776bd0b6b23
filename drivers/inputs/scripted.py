"""An input device that plays a script, for tests, demonstrations and training."""

import time
from bisect import bisect_right
from collections.abc import Sequence

from rotemina.drivers.contract import Clock, InputLostError, LimitError, StateError
from rotemina.drivers.inputs.device import InputIdentity, InputReading, InputSource, RumbleDevice
from rotemina.drivers.inputs.script import InputScript, ScriptMoment


class ScriptedSource(InputSource):
    """Source of one device that plays a script. The script starts when the source is created.

    Parameters
    ----------
    script : InputScript
    label : str
        Distinguishes several scripted devices.
    clock : callable
        Returns the host's time, s.
    """

    name = "Scripted device"

    def __init__(
        self, script: InputScript, label: str = "scripted", *, clock: Clock = time.monotonic
    ) -> None:
        super().__init__(clock=clock)
        self.identity = InputIdentity(f"scripted:{label}", label, "scripted")
        self.script = script
        self.start()

    def start(self) -> None:
        """Restart the script now."""
        self.start_s = self.clock()

    def devices(self) -> Sequence[InputIdentity]:
        """Return the device while it is plugged in."""
        begun_count = self._count_begun_moments()
        is_plugged = not begun_count or self.script.moments[begun_count - 1].plugged
        return (self.identity,) if is_plugged else ()

    def open(self, identity: InputIdentity) -> "ScriptedDevice":
        """Open the device; see :class:`InputSource`."""
        if identity not in self.devices():
            raise InputLostError(
                "{name} ({key}) is not plugged in", name=identity.name, key=identity.key
            )
        return ScriptedDevice(self, max(0, self._count_begun_moments() - 1))

    def find_moments_since(self, number: int) -> tuple[ScriptMoment, ...]:
        """Return the moments that have begun, starting at the index ``number``."""
        return self.script.moments[number : self._count_begun_moments()]

    def _count_begun_moments(self) -> int:
        elapsed_s = self.clock() - self.start_s
        return bisect_right(self.script.moments, elapsed_s, key=lambda moment: moment.time_s)


class ScriptedDevice(RumbleDevice):
    """An open scripted device, which records all calls of :meth:`rumble`.

    Parameters
    ----------
    source : ScriptedSource
    first : int
        Index of the moment that is current when the device is opened.
    """

    def __init__(self, source: ScriptedSource, first: int) -> None:
        self.identity = source.identity
        self.axes = source.script.axes
        self.buttons = source.script.buttons
        #: (host time, strength) of each call of :meth:`rumble`.
        self.rumble_calls: list[tuple[float, float]] = []
        self._source = source
        self._open_s = source.clock()
        self._next_index = first
        self._is_open = True
        self._is_lost = False

    def read(self) -> tuple[InputReading, ...]:
        """Return the readings since the last call; see :class:`InputDevice`."""
        if not self._is_open:
            raise StateError("{name} was closed; open it again", name=self.identity.name)
        moments = self._source.find_moments_since(self._next_index)
        self._next_index += len(moments)
        self._is_lost = self._is_lost or not all(moment.plugged for moment in moments)
        if self._is_lost:
            raise InputLostError("{name} was unplugged by its script", name=self.identity.name)
        start_s = self._source.start_s
        return tuple(
            InputReading(max(self._open_s, start_s + moment.time_s), moment.axes, moment.buttons)
            for moment in moments
        )

    def close(self) -> None:
        """Release the device; see :class:`InputDevice`."""
        self._is_open = False

    def rumble(self, strength: float) -> None:
        """Record the time and the strength; see :class:`RumbleDevice`."""
        if not 0.0 <= strength <= 1.0:
            raise LimitError(
                "{name}: strength {strength}: must be 0 to 1",
                name=self.identity.name,
                strength=strength,
            )
        self.rumble_calls.append((self._source.clock(), strength))
