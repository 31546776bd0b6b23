"""A plant with some axes under controllers, stepped like a live machine."""

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.errors import LostLoopError, PlantError
from rotemina.sim.feedback import loop_kernel
from rotemina.sim.feedback.axis_loop import make_run_arrays
from rotemina.sim.feedback.controller import SampledController
from rotemina.sim.messages import message
from rotemina.sim.plant import (
    ChainPoint,
    Plant,
    PlantMotion,
    PlantState,
    PlantTables,
    RandomStreams,
    compute_position_gain,
    kernel,
)
from rotemina.sim.units import format_percent, format_quantity

Controllers = Mapping[int, SampledController]

# A loop is opened if its error, or its contribution to the output since its start, exceeds these
# shares of the range. Then the sensor or the actuator does not respond.
_MAX_ERROR_SHARE, _MAX_ADDED_SHARE = 0.1, 0.25
# The error must last this long, because a single wrong reading is harmless.
_MIN_LOST_S = 5e-3


def advance(
    plant: Plant,
    state: PlantState,
    interval_s: float,
    command: FloatArray,
    reference: FloatArray,
    controllers: Controllers,
    random_streams: RandomStreams | None = None,
) -> tuple[PlantMotion, PlantState, FloatArray]:
    """Step a plant by n samples, with a response of its controllers to each.

    Parameters
    ----------
    plant : Plant
    state : PlantState
    interval_s : float
        Interval between samples, and between the state and the first sample.
    command : (n, axes)
        Commands of axes without a controller here, m or rad.
    reference : (n, axes)
        References of the controlled axes, m or rad.
    controllers : mapping int -> SampledController
        By the index of the axis. Their states are updated.
    random_streams : RandomStreams, optional

    Returns
    -------
    motion : PlantMotion
        The ``inputs`` of controlled axes are the outputs of their controllers.
    state : PlantState
    outputs : (n, axes)
        Commands of all axes, m or rad.

    Raises
    ------
    LostLoopError
        If a sensor stays a tenth of the range away from its reference, although no limit keeps the
        axis there, or if a loop contributes a quarter of the range.
    PlantError
        If the response overflows.
    """
    has_delay = plant.assembly.delays_s.any() or any(loop and loop.delay_s for loop in plant.loops)
    run = _advance_by_sample if has_delay or plant.assembly.skews else _advance_compiled
    return run(plant, state, interval_s, command, reference, controllers, random_streams)


def _advance_compiled(
    plant: Plant,
    state: PlantState,
    interval_s: float,
    command: FloatArray,
    reference: FloatArray,
    controllers: Controllers,
    random_streams: RandomStreams | None,
) -> tuple[PlantMotion, PlantState, FloatArray]:
    """Advance the plant in one compiled loop, in which inputs act at their samples."""
    rows, axes = command.shape
    electronics = plant.assembly.has_electronics
    inputs = np.concatenate([state.inputs[-1:], plant.compute_open_loop_inputs(command)])
    effort = np.zeros((rows + 1 if electronics.any() else 0, axes))
    time_s = state.elapsed_s + interval_s * np.arange(rows + 1.0)
    run_arrays = make_run_arrays(state, time_s, inputs, effort)
    kernel_state = kernel.KernelState(state.x.copy(), state.memory.copy(), state.called_s.copy())
    variates = np.zeros((0, axes))
    if random_streams is not None:
        variates = random_streams.draw(rows, axes, plant.assembly.variate_count)
    output = np.empty((rows, len(controllers)))
    feed = [
        controller.feed_forward.continue_run(reference[:, index])
        for index, controller in controllers.items()
    ]
    loops = _make_loop_arrays(plant, controllers)
    loop_kernel.follow(
        *_prepare_machine(plant, interval_s), kernel_state, run_arrays,
        np.ascontiguousarray(command), variates, loops,
        np.ascontiguousarray(reference[:, list(controllers)]), np.stack(feed, axis=1), output,
    )  # fmt: skip
    _check_finite(plant, run_arrays.position)
    for loop_index, (index, controller) in enumerate(controllers.items()):
        reading = run_arrays.reading[1:, index] - loops.offset[loop_index]
        is_unlimited = controller.find_unlimited(output[:, loop_index])
        error = np.where(is_unlimited, reference[:, index] - reading, 0.0)
        added = np.where(
            is_unlimited, output[:, loop_index] - feed[loop_index], controller.initial_integral
        )
        _check_response(plant, index, error, added, controller)
    for memory, controller in zip(loops.memory, controllers.values(), strict=True):
        controller.memory[:] = memory
    outputs = command.copy()
    outputs[:, list(controllers)] = output
    reported_inputs = run_arrays.inputs[1:].copy()
    if len(effort):
        amplified = electronics.copy()
        amplified[list(controllers)] = False
        reported_inputs[:, amplified] = effort[1:, amplified]
    motion = PlantMotion(
        run_arrays.position[1:], run_arrays.velocity[1:], reported_inputs, run_arrays.reading[1:]
    )
    final_state = PlantState(
        state.time_s[-1:] + rows * interval_s,
        inputs[-1:].copy(),
        run_arrays.position[-1:].copy(),
        run_arrays.velocity[-1:].copy(),
        run_arrays.reading[-1:].copy(),
        float(time_s[-1]),
        state.perturbation,
        *kernel_state,
    )
    return motion, final_state, outputs


def _advance_by_sample(
    plant: Plant,
    state: PlantState,
    interval_s: float,
    command: FloatArray,
    reference: FloatArray,
    controllers: Controllers,
    random_streams: RandomStreams | None,
) -> tuple[PlantMotion, PlantState, FloatArray]:
    """Advance the plant sample by sample, which also supports delayed inputs."""
    commands, parts, begin_s = command.copy(), [], float(state.time_s[-1])
    columns, compute_inputs = list(controllers), plant.compute_open_loop_inputs
    offsets = np.array([axis.offset for axis in plant.robot.axes.values()], dtype=np.float64)
    added = np.empty((len(command), len(columns)))
    for k in range(len(command)):
        row = commands[k : k + 1]
        row[0, columns] = [controllers[index].output for index in columns]
        # The time is counted from the previous sample, so that its step matrices can be reused.
        state = replace(state, time_s=state.time_s - state.time_s[-1])
        motion, state = plant.advance(
            state, np.array([interval_s]), row, random_streams=random_streams
        )
        for loop_index, index in enumerate(columns):
            controller, reading = (
                controllers[index],
                float(motion.reading[0, index] - offsets[index]),
            )
            row[0, index] = controller.respond_to_sample(float(reference[k, index]), reading)
            added[k, loop_index] = controller.integral
        state.inputs[-1, columns] = motion.inputs[0, columns] = compute_inputs(row)[0, columns]
        parts.append(motion)
    full_motion = PlantMotion(*(np.concatenate(pieces) for pieces in zip(*parts, strict=True)))
    for loop_index, (index, controller) in enumerate(controllers.items()):
        reading = full_motion.reading[:, index] - offsets[index]
        error = np.where(
            controller.find_unlimited(commands[:, index]), reference[:, index] - reading, 0.0
        )
        _check_response(plant, index, error, added[:, loop_index], controller)
    time_s = state.time_s - state.time_s[-1] + begin_s + len(command) * interval_s
    return full_motion, replace(state, time_s=time_s), commands


def _make_loop_arrays(plant: Plant, controllers: Controllers) -> loop_kernel.LoopArrays:
    axes = list(plant.robot.axes.values())
    controlled_axes = [axes[index] for index in controllers]
    return loop_kernel.LoopArrays(
        np.array(list(controllers), dtype=np.int64),
        np.array([1.0 / compute_position_gain(axis) for axis in controlled_axes]),
        np.array([axis.offset for axis in controlled_axes], dtype=np.float64),
        np.zeros(len(controlled_axes), dtype=np.int64),
        np.stack([controller.numbers for controller in controllers.values()]),
        np.stack([controller.memory for controller in controllers.values()]),
    )


@lru_cache(maxsize=8)
def _prepare_machine(plant: Plant, interval_s: float) -> tuple[PlantTables, kernel.KernelSteps]:
    chain_point = ChainPoint.COMMAND
    return plant.make_tables(chain_point), plant.make_steps(
        np.array([0.0, interval_s]), 1, chain_point
    )


def _check_response(
    plant: Plant, index: int, error: FloatArray, added: FloatArray, controller: SampledController
) -> None:
    """Check whether a loop responds, by its errors (n,) and contributions (n,) to the output.

    Raises
    ------
    LostLoopError
        If the error or the contribution is too large. The loop is then opened.
    """
    span = list(plant.robot.axes.values())[index].span
    is_lost = _find_lasting(np.abs(error) > _MAX_ERROR_SHARE * span, controller)
    is_excessive = np.abs(added - controller.initial_integral) > _MAX_ADDED_SHARE * span
    if not (is_lost | is_excessive).any():
        return
    name = plant.axes[index]
    row = int(np.argmax(is_lost | is_excessive))
    unit = plant.robot.unit(name) or ""
    reason = (
        message(
            "engine",
            "its sensor deviates by {much} from the expected position (at most {share} "
            "of the range)",
        ).fill(
            much=format_quantity(float(error[row]), unit, digits=3),
            share=format_percent(_MAX_ERROR_SHARE),
        )
        if is_lost[row]
        else message(
            "engine", "it has added {much} (at most {share} of the range is permitted)"
        ).fill(
            much=format_quantity(float(added[row] - controller.initial_integral), unit, digits=3),
            share=format_percent(_MAX_ADDED_SHARE),
        )
    )
    raise LostLoopError(
        "axis {name}: its loop was opened because the axis does not respond: {what}; "
        "check the sensor and the actuator, clear the fault, then close the loop again",
        name=name,
        what=reason,
    )


def _find_lasting(is_too_far: BoolArray, controller: SampledController) -> BoolArray:
    """Return the samples (n,) at which ``is_too_far`` (n,) has lasted too long.

    The controller keeps the count from one call to the next.
    """
    if not is_too_far.any():
        controller.lost_count = 0
        return is_too_far
    max_count = _MIN_LOST_S / controller.interval_s
    has_lasted = np.zeros_like(is_too_far)
    for row, sample_is_too_far in enumerate(is_too_far):
        controller.lost_count = controller.lost_count + 1 if sample_is_too_far else 0
        has_lasted[row] = controller.lost_count >= max_count
    return has_lasted


def _check_finite(plant: Plant, position: FloatArray) -> None:
    is_finite = np.isfinite(position).all(axis=0)
    if not is_finite.all():
        raise PlantError(
            "axis {axes}: the response of the loop grows without bound; lower the gains",
            axes=plant.axes[int(np.argmax(~is_finite))],
        )
