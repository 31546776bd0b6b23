"""Check of reported positions: which reports are plausible, and which positions are known."""

from collections.abc import Iterable, Sequence

from rotemina.drivers.contract import ReadingCheck
from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.gcode.coordinates import StageAxis
from rotemina.drivers.gcode.dialogue import ReceivedMessage
from rotemina.drivers.gcode.grbl_reports import StatusReport
from rotemina.drivers.gcode.jog_guard import JogGuard
from rotemina.drivers.gcode.machine_states import interpret_state


class PositionReports:
    """Positions of the axes: checks reports, determines origins, and knows which are valid.

    Parameters
    ----------
    axes : tuple of StageAxis
    settings : ControllerSettings
    guard : JogGuard
        Updated with the permitted targets of the axes.
    """

    def __init__(
        self, axes: tuple[StageAxis, ...], settings: ControllerSettings, guard: JogGuard
    ) -> None:
        #: Axes whose position is known.
        self.known_axes: set[str] = set()
        self._settings, self._guard = settings, guard
        self._confirmed_axes: set[str] = set()
        # Unknown state word of the latest report, if it had one.
        self._unknown_state: str | None = None
        self._use_axes(axes)

    @property
    def axes(self) -> tuple[StageAxis, ...]:
        """The axes with their current origins."""
        return self._axes

    @property
    def axis_names(self) -> tuple[str, ...]:
        """The names of all axes."""
        return tuple(axis.name for axis in self._axes)

    @property
    def untried_axes(self) -> list[str]:
        """The axes for which no reading since homing has confirmed the direction of motion."""
        return [name for name in self.axis_names if name not in self._confirmed_axes]

    @property
    def is_in_doubt(self) -> bool:
        """Whether the latest report was not usable, so that no motion may begin."""
        return self._readings.is_in_doubt

    @property
    def shows_new_position(self) -> bool:
        """Whether several refused reports agree on another position of the axes."""
        return self._readings.shows_new_position

    def convert_position(self, position: Sequence[float]) -> tuple[float, ...]:
        """Convert the position of a report to m or rad."""
        return tuple(axis.from_controller(position[axis.number]) for axis in self._axes)

    def is_usable(self, status: StatusReport, reception: ReceivedMessage) -> bool:
        """Return whether a report is complete, plausible, and has a valid state word."""
        if status.position is None or len(status.position) < len(self._axes):
            return False
        known_indices = [
            index for index, name in enumerate(self.axis_names) if name in self.known_axes
        ]
        values = self.convert_position(status.position)
        if not self._readings.accept_report(
            values, reception.requested_s, reception.received_s, known_indices
        ):
            return False
        # A lost byte causes an unknown word only once. An unknown word that is repeated is a real
        # state of the controller.
        unknown_state = None if interpret_state(status).is_recognized else status.state
        is_usable = unknown_state is None or unknown_state == self._unknown_state
        self._unknown_state = unknown_state
        return is_usable

    def accept_any_position(self) -> None:
        """Accept any position in the next report."""
        self._readings.restart()

    def accept_step_count(self, position: Sequence[float]) -> None:
        """Accept the controller's step count as the position of each axis that is in its range."""
        for axis, value in zip(self._axes, self.convert_position(position), strict=True):
            if axis.low - axis.tolerance <= value <= axis.high + axis.tolerance:
                self.known_axes.add(axis.name)

    def locate_axes(self, homed: set[str], position: Sequence[float], taken_s: float) -> None:
        """Determine the origins of homed axes from their position. Their positions are then known.

        Raises
        ------
        InputError
            If a position is outside the controller's travel or the range of the robot file.
        """
        axes = tuple(
            axis.with_homed_origin(position[axis.number], self._settings)
            if axis.name in homed
            else axis
            for axis in self._axes
        )
        self._use_axes(axes)
        self._readings.restart(self.convert_position(position), taken_s)
        self.known_axes |= homed

    def confirm_direction(self, names: Iterable[str]) -> None:
        """Note that readings have confirmed the direction of these axes."""
        self._confirmed_axes.update(names)

    def forget_positions(self, names: Iterable[str]) -> None:
        """Mark the positions of axes as unknown."""
        forgotten = set(names)
        self.known_axes -= forgotten
        self._confirmed_axes -= forgotten

    def _use_axes(self, axes: tuple[StageAxis, ...]) -> None:
        self._axes = axes
        self._readings = ReadingCheck([axis.reading_bounds for axis in axes])
        self._guard.permit_ranges({axis.letter: axis.permitted_targets for axis in axes})
