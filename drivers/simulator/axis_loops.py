"""Closed loops around axes of the simulated machine, which run at finer ticks than the samples."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate import Inverse, InverseExceedance, InverseModel
from rotemina.sim.errors import FeedbackError
from rotemina.sim.feedback import AxisRegulation, SampledController, regulated_plant
from rotemina.sim.messages import message
from rotemina.sim.plant import Plant, PlantMotion, PlantState, RandomStreams

# The number of ticks per sample counts as whole within this relative tolerance.
_WHOLE_NUMBER_TOLERANCE = 1e-6


class ClosedLoops:
    """Closed loops, by axis number.

    Parameters
    ----------
    sample_s : float
        Interval between the samples of the machine.
    """

    def __init__(self, sample_s: float) -> None:
        self._sample_s = sample_s
        self._controllers: dict[int, SampledController] = {}
        self._inverses: dict[int, Inverse] = {}
        #: Regulations of the closed loops. Replaced as a whole, so that any thread may read them.
        self.regulations: Mapping[int, AxisRegulation] = MappingProxyType({})

    def __bool__(self) -> bool:
        """Return whether any loop is closed."""
        return bool(self._controllers)

    @property
    def ticks_per_sample(self) -> int:
        """Number of ticks of the loops per sample."""
        rates = [regulation.rate_hz for regulation in self.regulations.values()]
        return round(rates[0] * self._sample_s) if rates else 1

    @property
    def tick_s(self) -> float:
        """Interval between the ticks of the loops; between samples if no loop is closed."""
        intervals = [regulation.interval_s for regulation in self.regulations.values()]
        return intervals[0] if intervals else self._sample_s

    @property
    def exceedances(self) -> dict[int, InverseExceedance]:
        """How far the ranges of the feed-forward inverses have been exceeded, by axis number."""
        return {index: inverse.exceedance for index, inverse in self._inverses.items()}

    def check_loop(
        self, index: int, regulation: AxisRegulation, *, has_no_controllers: bool
    ) -> None:
        """Refuse a loop whose rate does not fit.

        Parameters
        ----------
        index : int
        regulation : AxisRegulation
        alone : bool
            Whether the robot file has no controllers.

        Raises
        ------
        FeedbackError
            If the rate does not fit. The message names both rates.
        """
        ticks_per_sample = regulation.rate_hz * self._sample_s
        description = message("engine", "axis {axis}: a loop at {rate_hz} Hz").fill(
            axis=regulation.axis, rate_hz=regulation.rate_hz
        )
        rounding_error = abs(ticks_per_sample - round(ticks_per_sample))
        if (
            ticks_per_sample < 1.0 - _WHOLE_NUMBER_TOLERANCE
            or rounding_error > _WHOLE_NUMBER_TOLERANCE * ticks_per_sample
        ):
            raise FeedbackError(
                "{where}: the simulated machine samples at {sample_s} Hz, and a loop's rate "
                "must be a whole multiple of that; tune it for such a rate",
                where=description,
                sample_s=1.0 / self._sample_s,
            )
        other_loops = [other for key, other in self.regulations.items() if key != index]
        if other_loops and other_loops[0].rate_hz != regulation.rate_hz:
            raise FeedbackError(
                "{where}: the loop of axis {axis} runs at {rate_hz} Hz, and all loops "
                "must run at one rate; open that loop, or tune for its rate",
                where=description,
                axis=other_loops[0].axis,
                rate_hz=other_loops[0].rate_hz,
            )
        if not has_no_controllers and round(ticks_per_sample) != 1:
            raise FeedbackError(
                "{where}: the robot's own controllers run at {sample_s} Hz; tune it for that "
                "rate, or set the simulator's sample_rate_hz to the loop's",
                where=description,
                sample_s=1.0 / self._sample_s,
            )

    def close_loop(
        self,
        index: int,
        regulation: AxisRegulation,
        model: InverseModel | None,
        reference: float,
        output: float,
    ) -> None:
        """Close a loop around an axis that rests at ``reference`` with the given output."""
        inverse = None
        if model is not None:
            inverse = Inverse(model, regulation.interval_s, preview=True)
        controller = regulation.make_controller(inverse)
        controller.start(reference, output)
        self._controllers[index] = controller
        self._inverses.pop(index, None)
        if inverse is not None:
            self._inverses[index] = inverse
        self.regulations = MappingProxyType({**self.regulations, index: regulation})

    def open_loop(self, index: int) -> None:
        """Open the loop of an axis."""
        self._controllers.pop(index, None)
        self._inverses.pop(index, None)
        remaining = {key: other for key, other in self.regulations.items() if key != index}
        self.regulations = MappingProxyType(remaining)

    def hold_outputs(self, bounds: FloatArray) -> None:
        """Keep the output of every loop within bounds (axes,), m or rad, around its current value.

        With this, a loop that holds a stopped axis cannot move it away, even if its sensor fails.
        """
        for index, controller in self._controllers.items():
            controller.hold_output(float(bounds[index]))

    def release_hold(self, index: int | None = None) -> None:
        """End :meth:`hold_outputs` for an axis that will move, or for all axes."""
        for controller_index, controller in self._controllers.items():
            if index is None or controller_index == index:
                controller.release_output()

    def is_limited(self, index: int) -> bool:
        """Return whether the output of an axis' loop is limited now."""
        return index in self._controllers and self._controllers[index].is_limited

    def advance(
        self,
        plant: Plant,
        state: PlantState,
        elapsed_s: FloatArray,
        desired: FloatArray,
        commands: FloatArray,
        random_streams: RandomStreams,
    ) -> tuple[PlantMotion, PlantState, FloatArray]:
        """Simulate n ticks of the plant. Return the motion, the state and the actuator commands.

        Parameters
        ----------
        plant : Plant
        state : PlantState
        elapsed_s : (n,)
            Times of the ticks.
        desired : (n, axes)
            Desired positions, m or rad.
        commands : (n, axes)
            Actuator commands of the axes without a loop, m or rad.
        random_streams : RandomStreams

        Returns
        -------
        motion : PlantMotion
        state : PlantState
        commands : (n, axes)

        Raises
        ------
        PlantError
            If the response diverges.
        """
        if not self._controllers:
            return *plant.advance(
                state, elapsed_s, commands, random_streams=random_streams
            ), commands
        return regulated_plant.advance(
            plant,
            state,
            self.tick_s,
            commands,
            np.asarray(desired),
            self._controllers,
            random_streams,
        )
