"""The blind generator's machine under way, tick by tick, as the virtual boards want it."""

from dataclasses import dataclass

import numpy as np

from rotemina.app.blind.stepped_machine import STEPPED, Going
from rotemina.drivers.virtual_board.lookahead import PlantRun, Response
from rotemina.sim.blind.machine import machine_of

__all__ = ("STEPPED", "BlindRun", "Going")


@dataclass(frozen=True)
class State:
    """What a whole machine remembers, as the boards keep it."""

    memories: tuple
    time_s: np.ndarray


class BlindPlant:
    """All axes of a robot, those of one stage with a case, as the boards' run of a plant wants."""

    def __init__(self, robot, case, tick_s):
        order = list(robot.axes)
        self._stages = []
        for names in robot.stages.values():
            columns = [order.index(name) for name in names]
            travels = {name: np.array(robot.axes[name].range) for name in names}
            mine = tuple(names) == tuple(case.names)
            machine = case.machine if mine else machine_of(robot, names, travels)
            self._stages.append((columns, Going(machine, tick_s)))

    def at_rest(self, time_s, position):
        """Return the state at rest at ``position`` (axes,)."""
        position = np.asarray(position)
        memories = tuple(going.at_rest(position[columns]) for columns, going in self._stages)
        return State(memories, np.array([time_s]))

    def advance(self, state, since_s, commands, *, chance):
        """Return positions and readings (ticks, axes), and the state after them."""
        motion, memories = np.empty_like(commands), []
        noise = chance.draw(*commands.shape, 0)
        reading = np.empty_like(commands)
        for (columns, going), memory in zip(self._stages, state.memories, strict=True):
            motion[:, columns], after = going.advance(memory, commands[:, columns])
            memories.append(after)
            rms = np.array([axis.noise for axis in going.axes])
            step = np.array([axis.resolution for axis in going.axes])
            noisy = motion[:, columns] + rms * noise[:, columns]
            reading[:, columns] = np.round(noisy / step) * step
        return Response(motion, reading), State(tuple(memories), since_s)


class BlindRun(PlantRun):
    """In the place of the boards' ``PlantRun``."""

    def __init__(self, robot, case, tick_s, seed, position):
        super().__init__(BlindPlant(robot, case, tick_s), tick_s, seed, position)
