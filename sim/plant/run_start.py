"""Start of a run that does not start at rest: in its steady state, or as measured."""

from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.state import PlantState, RunCommands
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import ForceAxis

# Rows from which position and velocity at the start are estimated.
_START_ROW_COUNT = 8
# An initial velocity counts only if it exceeds this many standard errors; otherwise it is noise.
_MIN_VELOCITY_ERRORS = 3.0
# A change from period to period below this, relative to the motion, counts as steady.
_STEADY_CHANGE_RATIO = 1e-11
# The same for a plant with effects.
_STEADY_CHANGE_WITH_EFFECTS_RATIO = 1e-7
# Change, relative to the range, that is attributed to rounding.
_ROUNDING_RANGE_RATIO = 1e-9
# With effects, this larger change is accepted after the last period.
_NEARLY_STEADY_CHANGE_RATIO = 1e-3
_MAX_PERIOD_COUNT = 60
# From this condition number on, some state does not return to equilibrium over a period.
_MAX_CONDITION = 1e9


def find_steady_start(plant: Plant, run: RunCommands, period_samples: int | None) -> PlantState:
    """Return the state at the first row in the steady state of a periodic run.

    Without closed loops and effects the plant is linear, and the state that repeats after a period
    is computed directly. Otherwise periods are simulated until they repeat.

    Raises
    ------
    PlantError
        If the period is longer than the record or there is no steady state.
    """
    rows = len(run.time_s)
    period = period_samples or rows
    if period > rows:
        raise PlantError(
            "period_samples = {period}: the record has only {rows} rows", period=period, rows=rows
        )
    lead_in = _make_lead_in(run, period)
    if any(plant.loops) or plant.effects:
        return _simulate_until_steady(plant, lead_in, run)
    return _solve_steady_state(plant, lead_in, run)


def estimate_start(
    plant: Plant, record: Record, run: RunCommands, *, settled: bool = False
) -> PlantState:
    """Estimate the state at the first row from position and velocity of the first measured rows.

    With ``settled``, an axis that a spring or a motor holds starts in equilibrium with its first
    command, unless it clearly moves. The difference between its reading and this position is then
    attributed to offset and memory. A model that started at the reading would ring.
    """
    rest = plant.find_rest_state(run.time_s[0], run.command[0])
    position, velocity = rest.position[0].copy(), rest.velocity[0].copy()
    for column, name in enumerate(plant.axes):
        tap = Tap.REF if record.has(name, Tap.REF) else Tap.MEAS
        if record.has(name, tap):
            offset = plant.robot.axes[name].offset if tap is Tap.MEAS else 0.0
            signal = record.signal(name, tap)[:_START_ROW_COUNT] - offset
            motion = _estimate_first_motion(record.time_s[: len(signal)] - record.time_s[0], signal)
            starts_at_command = settled and not isinstance(plant.robot.axes[name], ForceAxis)
            if motion[1] != 0.0 or not starts_at_command:
                position[column], velocity[column] = motion
    return plant.make_state(run.time_s[0], run.inputs[0], position, velocity)


def _estimate_first_motion(elapsed_s: FloatArray, signal: FloatArray) -> tuple[float, float]:
    """Return position and velocity at time 0 by a parabola.

    The velocity is zero unless it is significant: a noisy one would make a stiff model ring while
    the machine stands still.
    """
    if len(signal) < 4:
        return float(signal[0]), 0.0
    matrix = np.vander(elapsed_s / elapsed_s[-1], 3, increasing=True)
    coefficients, *_ = np.linalg.lstsq(matrix, signal, rcond=None)
    variance = float(np.sum((signal - matrix @ coefficients) ** 2)) / max(len(signal) - 3, 1)
    error = np.sqrt(variance * np.linalg.inv(matrix.T @ matrix)[1, 1])
    if abs(coefficients[1]) <= _MIN_VELOCITY_ERRORS * error:
        return float(np.mean(signal)), 0.0
    return float(coefficients[0]), float(coefficients[1] / elapsed_s[-1])


def _make_lead_in(run: RunCommands, period: int) -> RunCommands:
    """Return the first period, shifted in time so that it ends where the record begins."""
    rows = len(run.time_s)
    if period < rows:
        length = run.time_s[period] - run.time_s[0]
    else:
        length = (run.time_s[-1] - run.time_s[0]) * rows / max(rows - 1, 1)
    period_rows = slice(0, period)
    return RunCommands(
        run.time_s[period_rows] - length,
        run.command[period_rows],
        run.add[period_rows],
        run.inputs[period_rows],
    )


def _simulate_until_steady(plant: Plant, lead_in: RunCommands, run: RunCommands) -> PlantState:
    """Simulate periods until they repeat.

    With some effects, such as creep, they never repeat exactly: a small remaining change is then
    accepted. Effects count time from the first row of the run.
    """
    state = plant.find_rest_state(lead_in.time_s[0], run.command[0])
    tolerance = _STEADY_CHANGE_WITH_EFFECTS_RATIO if plant.effects else _STEADY_CHANGE_RATIO
    rounding = np.array([_ROUNDING_RANGE_RATIO * axis.span for axis in plant.robot.axes.values()])
    for period in range(_MAX_PERIOD_COUNT):
        motion, end_state = plant.advance(
            state, lead_in.time_s, lead_in.command, add=lead_in.add, inputs=lead_in.inputs
        )
        motion_range = np.ptp(motion.position, axis=0) + np.ptp(motion.velocity, axis=0)
        change = _compute_change(plant, state, end_state)
        elapsed_s = float(lead_in.time_s[-1] - run.time_s[0])
        end_state = replace(
            end_state,
            elapsed_s=elapsed_s,
            called_s=end_state.called_s + (elapsed_s - end_state.elapsed_s),
        )
        is_last = plant.effects and period == _MAX_PERIOD_COUNT - 1
        if (
            change
            <= (_NEARLY_STEADY_CHANGE_RATIO if is_last else tolerance) * motion_range + rounding
        ).all():
            return end_state
        state = replace(end_state, time_s=end_state.time_s + (lead_in.time_s[0] - run.time_s[0]))
    raise PlantError(
        "the model does not reach a steady state within {most_periods} periods; use '# "
        "history: unknown'",
        most_periods=_MAX_PERIOD_COUNT,
    )


def _compute_change(plant: Plant, before: PlantState, after: PlantState) -> FloatArray:
    axis = plant.assembly.tables.axis
    has_dynamics = axis["place"] >= 0
    change = np.abs(after.position[-1] - before.position[-1])
    state_change = np.abs(after.x - before.x)
    change[has_dynamics] = (
        state_change[axis["place"][has_dynamics]] + state_change[axis["rate"][has_dynamics]]
    )
    return np.asarray(change)


def _solve_steady_state(plant: Plant, lead_in: RunCommands, run: RunCommands) -> PlantState:
    """Solve ``x = Φ x + b`` over one period; Φ comes from displacing each state a little."""
    rest = plant.find_rest_state(lead_in.time_s[0], run.command[0])
    start_motion = np.concatenate([rest.position[-1], rest.velocity[-1]])
    end_motion = _simulate_period(plant, lead_in, run, start_motion)
    axes = len(plant.axes)
    steady_state = start_motion.copy()
    for group in plant.groups:
        states = [plant.axes.index(name) for name in group.axes]
        states += [axes + column for column in states]
        transition = np.empty((len(states), len(states)))
        for column, state in enumerate(states):
            displaced = start_motion.copy()
            step = 1e-3 * (plant.robot.axes[plant.axes[state % axes]].span)
            displaced[state] += step
            transition[:, column] = (_simulate_period(plant, lead_in, run, displaced) - end_motion)[
                states
            ] / step
        system = np.eye(len(states)) - transition
        # Scale the rows: positions and speeds have different units.
        if np.linalg.cond(system / np.abs(system).max(axis=1, keepdims=True)) > _MAX_CONDITION:
            raise PlantError(
                "axis {axes} has no steady state because nothing holds it; use '# "
                "history: unknown'",
                axes=group.axes[0],
            )
        steady_state[states] += np.linalg.solve(system, (end_motion - start_motion)[states])
    return plant.make_state(run.time_s[0], run.inputs[0], steady_state[:axes], steady_state[axes:])


def _simulate_period(
    plant: Plant, lead_in: RunCommands, run: RunCommands, start: FloatArray
) -> FloatArray:
    """Return the state (2·axes,) where the record begins, simulated from one period before."""
    axes = len(plant.axes)
    state = plant.make_state(lead_in.time_s[0], lead_in.inputs[0], start[:axes], start[axes:])
    time_s = np.append(lead_in.time_s, run.time_s[0])
    command = np.vstack([lead_in.command, run.command[:1]])
    inputs = np.vstack([lead_in.inputs, run.inputs[:1]])
    _, end_state = plant.advance(state, time_s, command, inputs=inputs)
    return np.concatenate([end_state.position[-1], end_state.velocity[-1]])
