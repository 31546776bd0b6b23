"""Inverses between the set-points of the simulated machine and its actuators, tick by tick."""

from rotemina.drivers.simulator.setpoints import SetpointLimits
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.inverse import Beyond, Inverse, resting_at
from rotemina.sim.compensate.model import InverseModel


class Compensating:
    """The inverses in use, by the number of their axis; each is asked once a tick.

    Parameters
    ----------
    limits : SetpointLimits
        Of the machine.
    tick_s : float
    """

    def __init__(self, limits: SetpointLimits, tick_s: float) -> None:
        self._limits = limits
        self._tick_s = tick_s
        self._inverses: dict[int, Inverse] = {}
        #: In what each axis that has an inverse has gone beyond it; replaced as a whole.
        self.beyond: dict[int, Beyond] = {}

    def change(self, index: int, model: InverseModel | None, sent: float) -> float:
        """Use another inverse, or none, of an axis that was sent to ``sent``; return its command.

        Raises
        ------
        CompensationError
            If the inverse asks for ``sent`` nowhere.
        """
        others = {key: one for key, one in self._inverses.items() if key != index}
        wanted = sent
        if model is not None:
            others[index], wanted = resting_at(model, self._tick_s, sent)
        self._inverses = others
        self.beyond = {key: self.beyond.get(key, Beyond(0)) for key in others if key != index}
        if model is not None:
            self.beyond = {**self.beyond, index: Beyond(0)}
        return wanted

    def bounds(self, index: int) -> tuple[float, float]:
        """Return between which commands an axis may be: no farther than its inverse saw."""
        low, high = float(self._limits.low[index]), float(self._limits.high[index])
        if index in self._inverses:
            seen = self._inverses[index].model.desired_range
            return max(low, seen[0]), min(high, seen[1])
        return low, high

    def sent(self, command: FloatArray) -> FloatArray:
        """Return what the actuators (n, axes) are told at the next n ticks."""
        if not self._inverses or not len(command):
            return command
        sent = command.copy()
        for index, inverse in self._inverses.items():
            sent[:, index] = inverse.run(command[:, index])
            said = self.beyond[index] | inverse.beyond
            if said != self.beyond[index]:
                self.beyond = {**self.beyond, index: said}
        return sent
