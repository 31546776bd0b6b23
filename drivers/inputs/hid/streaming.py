"""Detection of devices that report although nothing changes; no descriptor tells."""

from rotemina.drivers.inputs.device import InputReading

STEADY_S = 5.0  # a hand that holds a stick holds it not so still for so long
GAP_S = 0.05  # between two reports of a stream
SILENCE_S = 0.25  # after which one that had been taken for a stream was none, or was cut off


class Streaming:
    """Watches one device.

    Some report only changes; some go on for as long as they are deflected. So the same reading has
    to come again and again, for longer than a hand keeps still. One that is silent after that and
    then continues by itself has to be found out again.
    """

    def __init__(self) -> None:
        self.found = False
        self._newest: InputReading | None = None
        self._since_s = 0.0

    def receive(self, reading: InputReading) -> None:
        """Take in what it said."""
        before, self._newest = self._newest, reading
        time_s = reading.host_time_s
        gap_s = GAP_S if before is None else time_s - before.host_time_s
        same = before is not None and _told(before) == _told(reading)
        if not same or gap_s > GAP_S:
            self._since_s = time_s
        if gap_s > SILENCE_S:
            self.found = False
        self.found = self.found or time_s - self._since_s >= STEADY_S


def _told(reading: InputReading) -> tuple[tuple[float, ...], tuple[bool, ...]]:
    return reading.axes, reading.buttons
