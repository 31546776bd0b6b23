"""The positions that a controller reports: which may be used, and of which axes they are known."""

from collections.abc import Iterable, Sequence

from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.gcode.coordinates import StageAxis
from rotemina.drivers.gcode.dialogue import Reception
from rotemina.drivers.gcode.grbl_reports import Status
from rotemina.drivers.gcode.jog_guard import JogGuard
from rotemina.drivers.gcode.machine_states import interpret_state
from rotemina.drivers.reading_check import ReadingCheck


class PositionReports:
    """Keeps the axes as the controller counts them, and what is known of their positions.

    Parameters
    ----------
    axes : tuple of StageAxis
    settings : ControllerSettings
    guard : JogGuard
        It permits targets inside the ranges of these axes.
    """

    def __init__(
        self, axes: tuple[StageAxis, ...], settings: ControllerSettings, guard: JogGuard
    ) -> None:
        #: Axes whose position is known.
        self.known: set[str] = set()
        self._settings, self._guard = settings, guard
        self._tried: set[str] = set()
        self._strange_word: str | None = None  # a state that only the latest report had
        self._use_axes(axes)

    @property
    def axes(self) -> tuple[StageAxis, ...]:
        """The axes, with their present origins."""
        return self._axes

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all axes."""
        return tuple(axis.name for axis in self._axes)

    @property
    def untried(self) -> list[str]:
        """The axes that were not seen to go where they are sent since they were homed."""
        return [name for name in self.names if name not in self._tried]

    @property
    def is_in_doubt(self) -> bool:
        """Whether the latest report could not be used: nothing may begin to move."""
        return self._readings.is_in_doubt

    @property
    def shows_new_position(self) -> bool:
        """Whether reports in a row agree that the axes must be elsewhere."""
        return self._readings.shows_new_position

    def values(self, position: Sequence[float]) -> tuple[float, ...]:
        """Return a report's position in m or rad."""
        return tuple(axis.value(position[axis.number]) for axis in self._axes)

    def is_usable(self, status: Status, reception: Reception) -> bool:
        """Return whether a report is complete, plausible, and of a state that is no slip."""
        if status.position is None or len(status.position) < len(self._axes):
            return False
        known = [index for index, name in enumerate(self.names) if name in self.known]
        values = self.values(status.position)
        if not self._readings.accepts(values, reception.asked_s, reception.received_s, known):
            return False
        # A byte that was lost makes a strange word once; a strange state says it again.
        strange = None if interpret_state(status).recognized else status.state
        usable = strange is None or strange == self._strange_word
        self._strange_word = strange
        return usable

    def expect_anywhere(self) -> None:
        """Accept the next report from wherever it is."""
        self._readings.restart()

    def trust_count(self, position: Sequence[float]) -> None:
        """Take the controller's count for the position, where it lies within the range."""
        for axis, value in zip(self._axes, self.values(position), strict=True):
            if axis.low - axis.tolerance <= value <= axis.high + axis.tolerance:
                self.known.add(axis.name)

    def locate(self, homed: set[str], position: Sequence[float], taken_s: float) -> None:
        """Find out where the count of homed axes begins; their position is known from now on.

        Raises
        ------
        InputError
            If the count fits no machine space, or the range of the robot file.
        """
        axes = tuple(
            axis.located(position[axis.number], self._settings) if axis.name in homed else axis
            for axis in self._axes
        )
        self._use_axes(axes)
        self._readings.restart(self.values(position), taken_s)
        self.known |= homed

    def confirm_direction(self, names: Iterable[str]) -> None:
        """Note that axes were seen to go where they are sent."""
        self._tried.update(names)

    def forget(self, names: Iterable[str]) -> None:
        """Take the position of axes as unknown."""
        forgotten = set(names)
        self.known -= forgotten
        self._tried -= forgotten

    def _use_axes(self, axes: tuple[StageAxis, ...]) -> None:
        self._axes = axes
        self._readings = ReadingCheck([axis.reading_bounds for axis in axes])
        self._guard.permit_ranges({axis.letter: axis.permitted_targets for axis in axes})
