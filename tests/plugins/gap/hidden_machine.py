"""A machine with something hidden: while it plays, its readings are those of the blind generator.

Where it goes when nothing plays, the nominal model answers: nobody examines that.
"""

from dataclasses import replace

import numpy as np

from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.blind.case import measured
from rotemina.sim.blind.machine import Commands
from rotemina.sim.records.record import Tap


class HiddenMachine(Simulator):
    """The simulator's commands and clock, and a case of the blind generator for a plant.

    The generator runs a machine over whole motions, so it answers at the beginning of one; its
    rows are those of the trajectory, which follow each other evenly.
    """

    def __init__(self, robot, case):
        super().__init__(robot, {"settle_s": 0.02})
        self._case = case
        self._columns = [self.axes.index(axis.name) for axis in case.machine.axes]
        self._readings = np.empty((0, len(self._columns)))
        self._played = len(case.training)

    def _play(self, trajectory, permit):
        interval_s = float(np.diff(trajectory.time_s).mean())
        values = np.stack(
            [trajectory.signal(axis.name, Tap.CMD) for axis in self._case.machine.axes], axis=1
        )
        self._played += 1
        _, self._readings = measured(self._case, Commands(interval_s, values), self._played)
        super()._play(trajectory, permit)

    def _read(self):
        samples = super()._read()
        at = np.flatnonzero(samples.playback_row >= 0)
        if not len(at):
            return samples
        seen = np.array(samples.measured)
        seen[np.ix_(at, self._columns)] = self._readings[samples.playback_row[at]]
        return replace(samples, measured=seen)
