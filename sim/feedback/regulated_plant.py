"""A plant with some axes under controllers, stepped like a live machine."""

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.feedback import loop_kernel
from rotemina.sim.feedback.axis_loop import rows_after
from rotemina.sim.feedback.controller import Controller
from rotemina.sim.feedback.errors import LostLoopError
from rotemina.sim.messages import message
from rotemina.sim.plant import kernel
from rotemina.sim.plant.coupled_groups import asked_position
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.plant_arrays import Machine
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.plant.state import Behind, Motion, PlantState
from rotemina.sim.quantities import amount, percent

Controllers = Mapping[int, Controller]

# Shares of the range at which a loop is given up: its sensor, or its actuator, does not answer it.
_LOST, _LED = 0.1, 0.25  # by error, by what it has added since it began
_LOST_S = 5e-3  # for so long at least: a single wrong reading is none


def advance(
    plant: Plant,
    state: PlantState,
    interval_s: float,
    command: FloatArray,
    reference: FloatArray,
    controllers: Controllers,
    chance: Chance | None = None,
) -> tuple[Motion, PlantState, FloatArray]:
    """Sample a plant n times, its controllers answering each sample.

    Parameters
    ----------
    plant : Plant
    state : PlantState
    interval_s : float
        From sample to sample, and from the state to the first.
    command : (n, axes)
        What axes without a controller here are told, m or rad.
    reference : (n, axes)
        Where those with one shall be, m or rad.
    controllers : mapping int -> Controller
        By the number of the axis; they continue.
    chance : Chance, optional

    Returns
    -------
    motion : Motion
        ``inputs`` of axes under a controller are what that asks for.
    state : PlantState
    asked : (n, axes)
        What every axis was told, m or rad.

    Raises
    ------
    LostLoopError
        If a sensor stays a tenth of the range away from its reference, though no limit keeps the
        axis there, or a loop has added a quarter of the range.
    PlantError
        If the response leaves what a number can hold.
    """
    late = plant.assembly.delays_s.any() or any(one and one.delay_s for one in plant.loops)
    run = _by_sample if late or plant.assembly.skews else _compiled
    return run(plant, state, interval_s, command, reference, controllers, chance)


def _compiled(
    plant: Plant,
    state: PlantState,
    interval_s: float,
    command: FloatArray,
    reference: FloatArray,
    controllers: Controllers,
    chance: Chance | None,
) -> tuple[Motion, PlantState, FloatArray]:
    """Do it in one compiled loop: inputs act at their samples."""
    rows, axes = command.shape
    electronics = plant.assembly.electronics
    inputs = np.concatenate([state.inputs[-1:], plant.open_loop_inputs(command)])
    effort = np.zeros((rows + 1 if electronics.any() else 0, axes))
    time_s = state.elapsed_s + interval_s * np.arange(rows + 1.0)
    filled = rows_after(state, time_s, inputs, effort)
    moving = kernel.State(state.x.copy(), state.memory.copy(), state.seen.copy())
    drawn = np.zeros((0, axes))
    if chance is not None:
        drawn = chance.draw(rows, axes, plant.assembly.random)
    output = np.empty((rows, len(controllers)))
    feed = [one.feed_forward.go_on(reference[:, index]) for index, one in controllers.items()]
    loops = _loops(plant, controllers)
    loop_kernel.follow(
        *_prepared(plant, interval_s), moving, filled, np.ascontiguousarray(command), drawn, loops,
        np.ascontiguousarray(reference[:, list(controllers)]), np.stack(feed, axis=1), output,
    )  # fmt: skip
    _check(plant, filled.position)
    for number, (index, one) in enumerate(controllers.items()):
        read = filled.reading[1:, index] - loops.offset[number]
        within = one.within(output[:, number])
        error = np.where(within, reference[:, index] - read, 0.0)
        added = np.where(within, output[:, number] - feed[number], one.begun_at)
        _watch(plant, index, error, added, one)
    for memory, one in zip(loops.memory, controllers.values(), strict=True):
        one.memory[:] = memory
    asked = command.copy()
    asked[:, list(controllers)] = output
    told = filled.inputs[1:].copy()
    if len(effort):
        amplified = electronics.copy()
        amplified[list(controllers)] = False
        told[:, amplified] = effort[1:, amplified]
    motion = Motion(filled.position[1:], filled.velocity[1:], told, filled.reading[1:])
    after = PlantState(
        state.time_s[-1:] + rows * interval_s,
        inputs[-1:].copy(),
        filled.position[-1:].copy(),
        filled.velocity[-1:].copy(),
        filled.reading[-1:].copy(),
        float(time_s[-1]),
        state.perturbation,
        *moving,
    )
    return motion, after, asked


def _by_sample(
    plant: Plant,
    state: PlantState,
    interval_s: float,
    command: FloatArray,
    reference: FloatArray,
    controllers: Controllers,
    chance: Chance | None,
) -> tuple[Motion, PlantState, FloatArray]:
    """Do it sample by sample, which serves every plant: inputs may act late."""
    asked, parts, begin_s = command.copy(), [], float(state.time_s[-1])
    columns, open_loop = list(controllers), plant.open_loop_inputs
    offsets = np.array([axis.offset for axis in plant.robot.axes.values()], dtype=np.float64)
    added = np.empty((len(command), len(columns)))
    for k in range(len(command)):
        told = asked[k : k + 1]
        told[0, columns] = [controllers[index].output for index in columns]
        # Counted from the sample before: so the steps are those that were made for that one.
        state = replace(state, time_s=state.time_s - state.time_s[-1])
        motion, state = plant.advance(state, np.array([interval_s]), told, chance=chance)
        for number, index in enumerate(columns):
            one, read = controllers[index], float(motion.reading[0, index] - offsets[index])
            told[0, index] = one.answer(float(reference[k, index]), read)
            added[k, number] = one.integral
        state.inputs[-1, columns] = motion.inputs[0, columns] = open_loop(told)[0, columns]
        parts.append(motion)
    whole = Motion(*(np.concatenate(one) for one in zip(*parts, strict=True)))
    for number, (index, one) in enumerate(controllers.items()):
        read = whole.reading[:, index] - offsets[index]
        error = np.where(one.within(asked[:, index]), reference[:, index] - read, 0.0)
        _watch(plant, index, error, added[:, number], one)
    time_s = state.time_s - state.time_s[-1] + begin_s + len(command) * interval_s
    return whole, replace(state, time_s=time_s), asked


def _loops(plant: Plant, controllers: Controllers) -> loop_kernel.Loops:
    axes = list(plant.robot.axes.values())
    own = [axes[index] for index in controllers]
    return loop_kernel.Loops(
        np.array(list(controllers), dtype=np.int64),
        np.array([1.0 / asked_position(axis) for axis in own]),
        np.array([axis.offset for axis in own], dtype=np.float64),
        np.zeros(len(own), dtype=np.int64),
        np.stack([one.numbers for one in controllers.values()]),
        np.stack([one.memory for one in controllers.values()]),
    )


@lru_cache(maxsize=8)
def _prepared(plant: Plant, interval_s: float) -> tuple[Machine, kernel.Steps]:
    behind = Behind.COMMAND
    return plant.machine(behind), plant.steps(np.array([0.0, interval_s]), 1, behind)


def _watch(
    plant: Plant, index: int, error: FloatArray, added: FloatArray, controller: Controller
) -> None:
    """Give a loop up that nothing answers, from its errors (n,) and what it added (n,)."""
    span = list(plant.robot.axes.values())[index].span
    lost = _lasting(np.abs(error) > _LOST * span, controller)
    led = np.abs(added - controller.begun_at) > _LED * span
    if not (lost | led).any():
        return
    name = plant.axes[index]
    row = int(np.argmax(lost | led))
    unit = plant.robot.unit(name) or ""
    what = (
        message(
            "engine",
            "its sensor deviates by {much} from the expected position (at most {share} "
            "of the range)",
        ).fill(much=amount(float(error[row]), unit, digits=3), share=percent(_LOST))
        if lost[row]
        else message(
            "engine", "it has added {much} (at most {share} of the range is permitted)"
        ).fill(
            much=amount(float(added[row] - controller.begun_at), unit, digits=3),
            share=percent(_LED),
        )
    )
    raise LostLoopError(
        message(
            "engine",
            "axis {name}: its loop was opened because the axis does not respond: {what}; "
            "check the sensor and the actuator, clear the fault, then close the loop again",
        ).fill(name=name, what=what)
    )


def _lasting(off: BoolArray, controller: Controller) -> BoolArray:
    """Return at which samples (n,) it has been ``off`` (n,) for long; the controller counts."""
    if not off.any():
        controller.astray = 0
        return off
    enough = _LOST_S / controller.interval_s
    lasting = np.zeros_like(off)
    for row, one in enumerate(off):
        controller.astray = controller.astray + 1 if one else 0
        lasting[row] = controller.astray >= enough
    return lasting


def _check(plant: Plant, position: FloatArray) -> None:
    finite = np.isfinite(position).all(axis=0)
    if not finite.all():
        raise PlantError(
            message(
                "engine",
                "axis {axes}: the response of the loop grows without bound; lower the gains",
            ).fill(axes=plant.axes[int(np.argmax(~finite))])
        )
