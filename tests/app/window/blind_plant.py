"""The machine of the blind generator, simulated tick by tick for the virtual boards."""

from dataclasses import dataclass

import numpy as np

from rotemina.app.blind.stepped_machine import STEPPED_EFFECTS, SteppedStage
from rotemina.drivers.virtual_board.lookahead import AxisResponse, PlantRun
from rotemina.sim.blind import build_machine

__all__ = ("STEPPED_EFFECTS", "BlindRun", "SteppedStage")


@dataclass(frozen=True)
class State:
    """State of the whole machine, as the boards store it."""

    memories: tuple
    time_s: np.ndarray


class BlindPlant:
    """Plant with all axes of a robot, of which one stage follows a blind case."""

    def __init__(self, robot, case, tick_s):
        order = list(robot.axes)
        self._stages = []
        for names in robot.stages.values():
            columns = [order.index(name) for name in names]
            travels = {name: np.array(robot.axes[name].range) for name in names}
            is_of_case = tuple(names) == tuple(case.axis_names)
            machine = case.machine if is_of_case else build_machine(robot, names, travels)
            self._stages.append((columns, SteppedStage(machine, tick_s)))

    def find_rest_state(self, time_s, position):
        """Return the state at rest at ``position`` (axes,)."""
        position = np.asarray(position)
        memories = tuple(
            stage.make_memory_at_rest(position[columns]) for columns, stage in self._stages
        )
        return State(memories, np.array([time_s]))

    def advance(self, state, since_s, commands, *, random_streams):
        """Return positions and readings (ticks, axes), and the state after them."""
        motion, memories = np.empty_like(commands), []
        noise = random_streams.draw(*commands.shape, 0)
        reading = np.empty_like(commands)
        for (columns, stage), memory in zip(self._stages, state.memories, strict=True):
            motion[:, columns], memory_after = stage.advance(memory, commands[:, columns])
            memories.append(memory_after)
            rms = np.array([axis.noise for axis in stage.axes])
            step = np.array([axis.resolution for axis in stage.axes])
            noisy = motion[:, columns] + rms * noise[:, columns]
            reading[:, columns] = np.round(noisy / step) * step
        return AxisResponse(motion, reading), State(tuple(memories), since_s)


class BlindRun(PlantRun):
    """Replacement for the ``PlantRun`` of the boards."""

    def __init__(self, robot, case, tick_s, seed, position):
        super().__init__(BlindPlant(robot, case, tick_s), tick_s, seed, position)
