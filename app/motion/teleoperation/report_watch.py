"""Whether what an input device said last still holds: silence is never consent.

A hand that holds a stick still looks, to the program, like a radio link that has failed: in both
cases nothing new comes in. What tells them apart is how the device behaved before. One that went on
reporting although nothing changed would report now as well; its silence is a failure. One that only
ever reported changes may be held still, but must confirm that from time to time.

No rule here needs to know the kind of device, and none trusts what a source says about itself: a
reading counts from the moment at which it is received.
"""

from math import inf, isfinite

from rotemina.app.motion.teleoperation.profile import SilencePolicy
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice
from rotemina.drivers.inputs.device import InputReading
from rotemina.sim.messages import message

#: The longest silence of a device that keeps reporting while nothing changes, s.
MAX_SILENCE_S = 0.25
#: The longest silence of one that reports only changes, while something moves by it, s.
MAX_STILLNESS_S = 1.0
#: The longest time between two looks at the devices; after it nobody knows what was missed, s.
MAX_PAUSE_S = 0.5
# A device that reports only changes repeats itself at most now and then, for example where a part
# of its report changed that is not read.
_MIN_REPEATS = 3


class ReportWatch:
    """Finds out whether one device keeps reporting while nothing changes.

    There are two signs of it, each good until the next pause: it repeats readings exactly, or it
    goes on reporting while it is at rest, where only noise is left to report.

    Parameters
    ----------
    heard_s : float, optional
        When the latest reading was received, if there was one before.
    """

    def __init__(self, heard_s: float | None = None) -> None:
        self._heard_s = heard_s
        self._content: object = None
        self._repeats = 0
        self._rest_since_s: float | None = None
        self._reports_at_rest = False

    def begin(self, now_s: float) -> None:
        """Give a device that has said nothing yet as long as it would have after a reading."""
        if self._heard_s is None:
            self._heard_s = now_s

    def receive(self, reading: InputReading, now_s: float, *, at_rest: bool) -> None:
        """Process a reading; ``at_rest`` if nobody seems to touch the device."""
        silence_s = self.silence_s(now_s)
        content = reading.axes, reading.buttons
        if not 0.0 <= silence_s <= MAX_SILENCE_S:
            self._repeats, self._rest_since_s, self._reports_at_rest = 0, None, False
        elif content == self._content:
            self._repeats += 1
        self._heard_s, self._content = now_s, content
        if not at_rest:
            self._rest_since_s = None
        elif self._rest_since_s is None:
            self._rest_since_s = now_s
        elif now_s - self._rest_since_s >= MAX_STILLNESS_S:
            self._reports_at_rest = True

    def silence_s(self, now_s: float) -> float:
        """Return for how long nothing has come in."""
        return inf if self._heard_s is None else now_s - self._heard_s

    @property
    def repeats_itself(self) -> bool:
        """Whether it has repeated readings exactly since its latest pause."""
        return self._repeats >= _MIN_REPEATS

    def max_silence_s(self, policy: SilencePolicy) -> float:
        """Return the longest silence in which what it said last may go on moving something."""
        if self.repeats_itself:
            return MAX_SILENCE_S
        if policy is SilencePolicy.CONTINUE:
            return inf
        return MAX_SILENCE_S if self._reports_at_rest else MAX_STILLNESS_S


def check_reading(
    device: PluggedDevice, reading: object, after_s: float, now_s: float
) -> InputReading:
    """Return what a source returned as a sound reading; one with a fault if it is none.

    Its time is moved between ``after_s`` and ``now_s``, the looks before and at which it came in.
    """
    if not isinstance(reading, InputReading):
        return _unusable(device, now_s, _no_reading(device, reading))
    try:
        time_s = min(max(float(reading.host_time_s), after_s), now_s)
        axes = tuple(map(float, reading.axes))
        buttons = tuple(map(bool, reading.buttons))
    except (TypeError, ValueError):
        return _unusable(device, now_s, _no_reading(device, reading))
    if not isfinite(time_s):
        time_s = now_s
    if reading.fault is not None:
        return _unusable(device, time_s, reading.fault)
    if (len(axes), len(buttons)) != (len(device.axes), len(device.buttons)):
        fault = message(
            "engine",
            "a reading has {axes} axes and {buttons} buttons, but the device has "
            "{known} and {others}: replug it",
        ).fill(
            axes=len(axes),
            buttons=len(buttons),
            known=len(device.axes),
            others=len(device.buttons),
        )
        return _unusable(device, time_s, fault)
    return InputReading(time_s, axes, buttons)


def _unusable(device: PluggedDevice, time_s: float, fault: str) -> InputReading:
    return InputReading.unusable(time_s, device, fault)


def _no_reading(device: PluggedDevice, answer: object) -> str:
    return message(
        "engine",
        "its plugin ({source}) returned {answer}, which is no reading, and the device counts as "
        "released. Update or remove the plugin",
    ).fill(source=device.identity.source, answer=repr(answer)[:80])
