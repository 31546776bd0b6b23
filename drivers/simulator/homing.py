"""Homing of the simulated machine: which positions are unknown, and which axes are being homed."""

from collections.abc import Iterable

from rotemina.drivers.simulator.setpoint_generator import SetpointGenerator

# Speed towards the limit switch, as a fraction of the maximum speed.
SEARCH_SPEED_RATIO = 0.5


class HomingState:
    """State of the homing: the numbers of the axes with unknown position, and of those being homed.

    The state is kept when the driver is closed and opened again.
    """

    def __init__(self, unknown: Iterable[int]) -> None:
        self._unknown_axes = set(unknown)
        self._searching_axes: set[int] = set()

    @property
    def unknown_axes(self) -> tuple[int, ...]:
        """Axes whose position is unknown, in order."""
        return tuple(sorted(self._unknown_axes))

    @property
    def under_way(self) -> bool:
        """Whether any axis is moving to its switch."""
        return bool(self._searching_axes)

    def begin(self, axes: Iterable[int], setpoints: SetpointGenerator) -> None:
        """Start moving axes to the low ends of their ranges, where their switches are."""
        self._searching_axes = set(axes)
        # The earlier position is no longer valid. If homing is aborted, it stays unknown.
        self._unknown_axes |= self._searching_axes
        setpoints.begin_search(tuple(self._searching_axes), SEARCH_SPEED_RATIO)

    def note_arrival(self, setpoints: SetpointGenerator) -> None:
        """Mark the positions as known once all axes have arrived."""
        if self._searching_axes and not setpoints.moving:
            self._unknown_axes -= self._searching_axes
            self._searching_axes.clear()

    def abort(self) -> None:
        """Abort the homing. The positions of its axes stay unknown."""
        self._searching_axes.clear()
