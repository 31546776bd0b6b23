"""The true positions of a simulated machine's axes, which no sensor shows."""

from abc import ABC

from rotemina.drivers.driver import Driver
from rotemina.sim.arrays import FloatArray


class TruePositions(Driver, ABC):
    """A simulated machine that lets itself be looked at, as by the simulated microscope."""

    # One tuple, exchanged as a whole: another thread reads all of it before or after a change.
    _true_positions: tuple[float, ...] = ()

    @property
    def true_positions(self) -> tuple[float, ...]:
        """The newest true positions, m or rad, by axis; any thread may look, also when closed."""
        return self._true_positions

    def _are_at(self, positions: FloatArray) -> None:
        self._true_positions = tuple(positions.tolist())
