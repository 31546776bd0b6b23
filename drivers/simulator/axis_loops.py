"""Loops around axes of the simulated machine, at their own fine ticks."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.inverse import Exceedance, Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.feedback import regulated_plant
from rotemina.sim.feedback.controller import Controller
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.messages import message
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.plant.state import Motion, PlantState

_WHOLE = 1e-6  # how near to a whole number a rate must be


class Regulating:
    """The loops that are closed, by the number of their axis.

    Parameters
    ----------
    sample_s : float
        Interval between the machine's samples.
    """

    def __init__(self, sample_s: float) -> None:
        self._sample_s = sample_s
        self._controllers: dict[int, Controller] = {}
        self._inverses: dict[int, Inverse] = {}
        #: Replaced as a whole, so that any thread may look.
        self.regulations: Mapping[int, Regulation] = MappingProxyType({})

    def __bool__(self) -> bool:
        """Whether any axis is under one."""
        return bool(self._controllers)

    @property
    def ticks(self) -> int:
        """How many ticks of the loops there are to a sample."""
        rates = [one.rate_hz for one in self.regulations.values()]
        return round(rates[0] * self._sample_s) if rates else 1

    @property
    def tick_s(self) -> float:
        """Interval between ticks: that of the loops, or the samples' without loops."""
        intervals = [one.interval_s for one in self.regulations.values()]
        return intervals[0] if intervals else self._sample_s

    @property
    def beyond(self) -> dict[int, Exceedance]:
        """In what the inverses of the feed-forwards went beyond what they saw, at present."""
        return {index: one.beyond for index, one in self._inverses.items()}

    def check(self, index: int, regulation: Regulation, *, alone: bool) -> None:
        """Refuse a loop whose rate does not fit; ``alone``: no others live at the ticks.

        Raises
        ------
        FeedbackError
            With both rates.
        """
        ticks = regulation.rate_hz * self._sample_s
        where = message("engine", "axis {axis}: a loop at {rate_hz} Hz").fill(
            axis=regulation.axis, rate_hz=regulation.rate_hz
        )
        if ticks < 1.0 - _WHOLE or abs(ticks - round(ticks)) > _WHOLE * ticks:
            raise FeedbackError(
                message(
                    "engine",
                    "{where}: the simulated machine samples at {sample_s} Hz, and a loop's rate "
                    "must be a whole multiple of that; tune it for such a rate",
                ).fill(where=where, sample_s=1.0 / self._sample_s)
            )
        others = [one for key, one in self.regulations.items() if key != index]
        if others and others[0].rate_hz != regulation.rate_hz:
            raise FeedbackError(
                message(
                    "engine",
                    "{where}: the loop of axis {axis} runs at {rate_hz} Hz, and all loops "
                    "must run at one rate; open that loop, or tune for its rate",
                ).fill(where=where, axis=others[0].axis, rate_hz=others[0].rate_hz)
            )
        if not alone and round(ticks) != 1:
            raise FeedbackError(
                message(
                    "engine",
                    "{where}: the robot's own controllers run at {sample_s} Hz; tune it for that "
                    "rate, or set the simulator's sample_rate_hz to the loop's",
                ).fill(where=where, sample_s=1.0 / self._sample_s)
            )

    def put(
        self,
        index: int,
        regulation: Regulation,
        model: InverseModel | None,
        reference: float,
        output: float,
    ) -> None:
        """Close a loop that rests at a reference with an output that holds it there."""
        inverse = None
        if model is not None:
            inverse = Inverse(model, regulation.interval_s, preview=True)
        controller = regulation.controller(inverse)
        controller.start(reference, output)
        self._controllers[index] = controller
        self._inverses.pop(index, None)
        if inverse is not None:
            self._inverses[index] = inverse
        self.regulations = MappingProxyType({**self.regulations, index: regulation})

    def remove(self, index: int) -> None:
        """Open a loop."""
        self._controllers.pop(index, None)
        self._inverses.pop(index, None)
        left = {key: one for key, one in self.regulations.items() if key != index}
        self.regulations = MappingProxyType(left)

    def hold(self, bounds: FloatArray) -> None:
        """Keep every loop's output within bounds (axes,), m or rad, of its present value.

        So a loop that holds a stopped axis cannot lead it away, whatever its sensor says.
        """
        for index, controller in self._controllers.items():
            controller.hold(float(bounds[index]))

    def lead(self, index: int | None = None) -> None:
        """End :meth:`hold` for an axis that is to move, or for all."""
        for each, controller in self._controllers.items():
            if index is None or each == index:
                controller.lead()

    def limited(self, index: int) -> bool:
        """Whether a limit cuts the output of an axis' loop off at present."""
        return index in self._controllers and self._controllers[index].limited

    def advance(
        self,
        plant: Plant,
        state: PlantState,
        elapsed_s: FloatArray,
        wanted: FloatArray,
        sent: FloatArray,
        chance: Chance,
    ) -> tuple[Motion, PlantState, FloatArray]:
        """Sample the plant at n ticks; return motion, state and actuator commands (n, axes).

        Raises
        ------
        PlantError
            If the response leaves what a number can hold.
        """
        if not self._controllers:
            return *plant.advance(state, elapsed_s, sent, chance=chance), sent
        return regulated_plant.advance(
            plant, state, self.tick_s, sent, np.asarray(wanted), self._controllers, chance
        )
