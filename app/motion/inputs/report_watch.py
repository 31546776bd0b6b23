"""Decides for how long the latest reading of an input device stays valid when it is silent.

To the program, a stick that is held still looks like a radio link that has failed: in both cases no
new reading arrives. The earlier behaviour of the device tells the two apart. If it used to report
without changes, its silence is a failure. If it has reported only changes, the stick may be held
still, but the operator must confirm that from time to time.

No rule depends on the kind of device, or on the times that a source gives. A reading is valid from
the moment at which it is received.
"""

from math import inf, isfinite

from rotemina.app.motion.inputs.profile import SilencePolicy
from rotemina.app.motion.inputs.profile_check import PluggedDevice
from rotemina.drivers.inputs import InputReading
from rotemina.sim.messages import message

#: Longest permitted silence of a device that reports continuously.
MAX_SILENCE_S = 0.25
#: Longest permitted silence of a device that reports only changes, while it moves an axis.
MAX_STILLNESS_S = 1.0
#: Longest permitted time between two steps that read the devices. After a longer pause, changes may
#: have been missed.
MAX_PAUSE_S = 0.5
# A device that reports only changes may also repeat a reading, for example if an unused part of its
# report has changed. So several repeats are needed as evidence.
_MIN_REPEATS = 3


class ReportWatch:
    """Finds out whether a device reports continuously, even while nothing changes.

    There are two signs, each valid until the next pause: the device repeats readings exactly, or it
    continues to report at rest, where it can only report noise.

    Parameters
    ----------
    last_reading_s : float, optional
        Host time of the latest reading, if the device was read before.
    """

    def __init__(self, last_reading_s: float | None = None) -> None:
        self._last_reading_s = last_reading_s
        self._last_content: object = None
        self._repeat_count = 0
        self._rest_began_s: float | None = None
        self._is_reporting_at_rest = False

    def begin(self, now_s: float) -> None:
        """Start to measure the silence of a device that has not reported yet."""
        if self._last_reading_s is None:
            self._last_reading_s = now_s

    def receive(self, reading: InputReading, now_s: float, *, at_rest: bool) -> None:
        """Process a reading. ``at_rest`` says whether the device seems to be untouched."""
        silence_s = self.compute_silence_s(now_s)
        content = reading.axes, reading.buttons
        if not 0.0 <= silence_s <= MAX_SILENCE_S:
            self._repeat_count, self._rest_began_s, self._is_reporting_at_rest = 0, None, False
        elif content == self._last_content:
            self._repeat_count += 1
        self._last_reading_s, self._last_content = now_s, content
        if not at_rest:
            self._rest_began_s = None
        elif self._rest_began_s is None:
            self._rest_began_s = now_s
        elif now_s - self._rest_began_s >= MAX_STILLNESS_S:
            self._is_reporting_at_rest = True

    def compute_silence_s(self, now_s: float) -> float:
        """Return the time since the latest reading, s."""
        return inf if self._last_reading_s is None else now_s - self._last_reading_s

    @property
    def is_repeating(self) -> bool:
        """Whether the device has repeated readings exactly since its latest pause."""
        return self._repeat_count >= _MIN_REPEATS

    def find_max_silence_s(self, policy: SilencePolicy) -> float:
        """Return the longest silence during which the latest reading stays valid, s."""
        if self.is_repeating:
            return MAX_SILENCE_S
        if policy is SilencePolicy.CONTINUE:
            return inf
        return MAX_SILENCE_S if self._is_reporting_at_rest else MAX_STILLNESS_S


def sanitise_reading(
    device: PluggedDevice, reading: object, after_s: float, now_s: float
) -> InputReading:
    """Return a reading with valid values, or a faulty reading if the source returned anything else.

    Its time is clipped to ``after_s`` and ``now_s``, the times of the previous and current step.
    """
    if not isinstance(reading, InputReading):
        return _make_faulty_reading(device, now_s, _describe_invalid_reading(device, reading))
    try:
        time_s = min(max(float(reading.host_time_s), after_s), now_s)
        axes = tuple(map(float, reading.axes))
        buttons = tuple(map(bool, reading.buttons))
    except (TypeError, ValueError):
        return _make_faulty_reading(device, now_s, _describe_invalid_reading(device, reading))
    if not isfinite(time_s):
        time_s = now_s
    if reading.fault is not None:
        return _make_faulty_reading(device, time_s, reading.fault)
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
        return _make_faulty_reading(device, time_s, fault)
    return InputReading(time_s, axes, buttons)


def _make_faulty_reading(device: PluggedDevice, time_s: float, fault: str) -> InputReading:
    return InputReading.make_unusable(time_s, device, fault)


def _describe_invalid_reading(device: PluggedDevice, returned: object) -> str:
    return message(
        "engine",
        "its plugin ({source}) returned {answer}, which is no reading, and the device counts as "
        "released. Update or remove the plugin",
    ).fill(source=device.identity.source, answer=repr(returned)[:80])
