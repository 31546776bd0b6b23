"""The true positions of a simulated machine's axes, which no sensor shows."""

from abc import ABC
from collections.abc import Mapping

from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import Robot


class TruePositions(Driver, ABC):
    """A simulated machine that lets itself be looked at, as by the simulated microscope."""

    def __init__(
        self, robot: Robot, settings: Mapping[str, object] | None = None, *, clock: Clock
    ) -> None:
        super().__init__(robot, settings, clock=clock)
        # One tuple, exchanged as a whole: another thread reads all of it before or after a change.
        self._true_positions: tuple[float, ...] = ()

    @property
    def true_positions(self) -> tuple[float, ...]:
        """The newest true positions, m or rad, by axis; any thread may look, also when closed."""
        return self._true_positions

    def _are_at(self, positions: FloatArray) -> None:
        self._true_positions = tuple(positions.tolist())
