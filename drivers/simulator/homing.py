"""Homing of the simulated machine: homed axes, and axes in search of their switch."""

from collections.abc import Iterable

from rotemina.drivers.simulator.setpoint_generator import SetpointGenerator

# So fast an axis goes towards its switch, of its greatest speed.
SEARCH_SPEED = 0.5


class Homing:
    """Axes, by their number, whose position is unknown; it outlives a closed connection."""

    def __init__(self, unknown: Iterable[int]) -> None:
        self._unknown = set(unknown)
        self._sought: set[int] = set()

    @property
    def unknown(self) -> tuple[int, ...]:
        """The axes whose position is unknown, in order."""
        return tuple(sorted(self._unknown))

    @property
    def under_way(self) -> bool:
        """Whether any axis is on its way to its switch."""
        return bool(self._sought)

    def begin(self, axes: Iterable[int], setpoints: SetpointGenerator) -> None:
        """Send axes to the low ends of their ranges, where their switches are."""
        self._sought = set(axes)
        # Where it was said to be counts no longer: a search that is ended leaves it unknown.
        self._unknown |= self._sought
        setpoints.search(tuple(self._sought), SEARCH_SPEED)

    def notice(self, setpoints: SetpointGenerator) -> None:
        """Note that the axes are known once all of them have arrived."""
        if self._sought and not setpoints.moving:
            self._unknown -= self._sought
            self._sought.clear()

    def give_up(self) -> None:
        """End the search; the position of its axes stays unknown."""
        self._sought.clear()
