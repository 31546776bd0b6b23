"""How a run starts that does not start at rest: in its steady state, or as it was measured."""

from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.run import Run
from rotemina.sim.plant.state import PlantState
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import ForceAxis

_FIRST_ROWS = 8  # rows from which position and velocity at the start are taken
_SURE = 3.0  # standard errors from which a first velocity is told from noise
_SETTLED = 1e-11  # change from period to period, over the motion, that counts as steady
_ROUNDING = 1e-9  # of a range: an axis that stands still, or is but shaken by rounding, has settled
_SETTLED_EFFECTS = 1e-7  # the same for a plant with effects
_NEARLY_SETTLED = 1e-3  # and what is still enough after the last period
_MOST_PERIODS = 60
_UNHELD = 1e9  # condition from which a period leaves some state as it was


def steady_start(plant: Plant, run: Run, period_samples: int | None) -> PlantState:
    """Return the state at the first row in the steady state of a periodic run.

    Without closed loops and effects the plant is linear, and the state that a period brings back
    to itself is solved for; else periods are run until they repeat.

    Raises
    ------
    PlantError
        If the period is longer than the record or there is no steady state.
    """
    rows = len(run.time_s)
    period = period_samples or rows
    if period > rows:
        raise PlantError(
            message("engine", "period_samples = {period}: the record has only {rows} rows").fill(
                period=period, rows=rows
            )
        )
    lead = _lead(run, period)
    if any(plant.loops) or plant.effects:
        return _settle(plant, lead, run)
    return _solve(plant, lead, run)


def measured_start(plant: Plant, record: Record, run: Run, *, settled: bool = False) -> PlantState:
    """Return the state at the first row by position and velocity of the first rows measured.

    ``settled``: an axis that a spring or a motor holds, and that does not move for sure, is in
    equilibrium with its first command. How far a reading is from there is offset and memory; a
    model that began aside would ring.
    """
    rest = plant.at_rest(run.time_s[0], run.command[0])
    position, velocity = rest.position[0].copy(), rest.velocity[0].copy()
    for column, name in enumerate(plant.axes):
        tap = Tap.REF if record.has(name, Tap.REF) else Tap.MEAS
        if record.has(name, tap):
            offset = plant.robot.axes[name].offset if tap is Tap.MEAS else 0.0
            signal = record.signal(name, tap)[:_FIRST_ROWS] - offset
            begun = _first(record.time_s[: len(signal)] - record.time_s[0], signal)
            held = settled and not isinstance(plant.robot.axes[name], ForceAxis)
            if begun[1] != 0.0 or not held:
                position[column], velocity[column] = begun
    return plant.at(run.time_s[0], run.inputs[0], position, velocity)


def _first(since_s: FloatArray, signal: FloatArray) -> tuple[float, float]:
    """Return position and velocity at 0 by a parabola; at rest where no velocity is sure.

    A noisy velocity would make a stiff model ring that in truth stands still.
    """
    if len(signal) < 4:
        return float(signal[0]), 0.0
    matrix = np.vander(since_s / since_s[-1], 3, increasing=True)
    curve, *_ = np.linalg.lstsq(matrix, signal, rcond=None)
    scatter = float(np.sum((signal - matrix @ curve) ** 2)) / max(len(signal) - 3, 1)
    error = np.sqrt(scatter * np.linalg.inv(matrix.T @ matrix)[1, 1])
    if abs(curve[1]) <= _SURE * error:
        return float(np.mean(signal)), 0.0
    return float(curve[0]), float(curve[1] / since_s[-1])


def _lead(run: Run, period: int) -> Run:
    """Return the first period, moved to end where the record begins."""
    rows = len(run.time_s)
    if period < rows:
        length = run.time_s[period] - run.time_s[0]
    else:
        length = (run.time_s[-1] - run.time_s[0]) * rows / max(rows - 1, 1)
    first = slice(0, period)
    return Run(run.time_s[first] - length, run.command[first], run.add[first], run.inputs[first])


def _settle(plant: Plant, lead: Run, run: Run) -> PlantState:
    """Run periods until they repeat.

    Some effects, creep among them, never quite do: what they still change is then allowed to be
    small instead of nothing. Effects count time from the first row of the run.
    """
    state = plant.at_rest(lead.time_s[0], run.command[0])
    enough = _SETTLED_EFFECTS if plant.effects else _SETTLED
    rounding = np.array([_ROUNDING * axis.span for axis in plant.robot.axes.values()])
    for period in range(_MOST_PERIODS):
        motion, after = plant.advance(
            state, lead.time_s, lead.command, add=lead.add, inputs=lead.inputs
        )
        size = np.ptp(motion.position, axis=0) + np.ptp(motion.velocity, axis=0)
        change = _change(plant, state, after)
        elapsed_s = float(lead.time_s[-1] - run.time_s[0])
        after = replace(after, elapsed_s=elapsed_s, seen=after.seen + (elapsed_s - after.elapsed_s))
        last = plant.effects and period == _MOST_PERIODS - 1
        if (change <= (_NEARLY_SETTLED if last else enough) * size + rounding).all():
            return after
        state = replace(after, time_s=after.time_s + (lead.time_s[0] - run.time_s[0]))
    raise PlantError(
        message(
            "engine",
            "the model does not reach a steady state within {most_periods} periods; use '# "
            "history: unknown'",
        ).fill(most_periods=_MOST_PERIODS)
    )


def _change(plant: Plant, before: PlantState, after: PlantState) -> FloatArray:
    """Return by how much positions and speeds (axes,) have changed, apart from what time does."""
    axis = plant.assembly.machine.axis
    moving = axis["place"] >= 0
    change = np.abs(after.position[-1] - before.position[-1])
    gap = np.abs(after.x - before.x)
    change[moving] = gap[axis["place"][moving]] + gap[axis["rate"][moving]]
    return np.asarray(change)


def _solve(plant: Plant, lead: Run, run: Run) -> PlantState:
    """Solve ``x = Φ x + b`` over one period; Φ is found by starting each state a little aside."""
    rest = plant.at_rest(lead.time_s[0], run.command[0])
    start = np.concatenate([rest.position[-1], rest.velocity[-1]])
    end = _end(plant, lead, run, start)
    axes = len(plant.axes)
    solved = start.copy()
    for group in plant.groups:
        own = [plant.axes.index(name) for name in group.axes]
        own += [axes + column for column in own]
        map_ = np.empty((len(own), len(own)))
        for number, state in enumerate(own):
            aside = start.copy()
            step = 1e-3 * (plant.robot.axes[plant.axes[state % axes]].span)
            aside[state] += step
            map_[:, number] = (_end(plant, lead, run, aside) - end)[own] / step
        lasting = np.eye(len(own)) - map_
        if np.linalg.cond(lasting / np.abs(lasting).max(axis=1, keepdims=True)) > _UNHELD:
            raise PlantError(
                message(
                    "engine",
                    "axis {axes} has no steady state because nothing holds it; use '# "
                    "history: unknown'",
                ).fill(axes=group.axes[0])
            )
        solved[own] += np.linalg.solve(lasting, (end - start)[own])
    return plant.at(run.time_s[0], run.inputs[0], solved[:axes], solved[axes:])


def _end(plant: Plant, lead: Run, run: Run, start: FloatArray) -> FloatArray:
    """Return the state (2·axes,) where the record begins, from one a period before."""
    axes = len(plant.axes)
    state = plant.at(lead.time_s[0], lead.inputs[0], start[:axes], start[axes:])
    time_s = np.append(lead.time_s, run.time_s[0])
    command = np.vstack([lead.command, run.command[:1]])
    inputs = np.vstack([lead.inputs, run.inputs[:1]])
    _, after = plant.advance(state, time_s, command, inputs=inputs)
    return np.concatenate([after.position[-1], after.velocity[-1]])
