"""How a run with effects begins: at rest, as after a rise; and in its steady state."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects import attachment
from rotemina.sim.effects.formulation import Effect, Formulation, Reading, Stage
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
LOOP = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6})


def held(axis, share, rows=400, rate_hz=2000.0):
    """A constant command."""
    own = ROBOT.axes[axis]
    command = np.full(rows, own.range[0] + share * own.span)
    return Record.from_signals(
        np.arange(rows) / rate_hz, {(axis, Tap.CMD): command}, {axis: own.unit}
    )


def sine(axis, rate_hz=2000.0, frequency_hz=5.0, periods=2, metadata=None):
    own = ROBOT.axes[axis]
    time_s = np.arange(round(periods * rate_hz / frequency_hz)) / rate_hz
    wave = np.sin(2 * np.pi * frequency_hz * time_s)
    command = own.range[0] + own.span * (0.5 + 0.2 * wave)
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: own.unit}, metadata)


@pytest.mark.parametrize(
    "effect",
    [
        LOOP,
        AxisEffect(axis="x", id="backlash"),
        AxisEffect(axis="x", id="friction"),
        AxisEffect(axis="x", id="flexible_mode", formulation="appendage"),
        AxisEffect(axis="zn", id="flexible_mode", formulation="series"),
        AxisEffect(axis="zn", id="delay"),
    ],
    ids=lambda effect: effect.id,
)
def test_a_held_command_stays_at_rest(effect):
    record = simulate(ROBOT, [effect], held(effect.axis, 0.37))
    drift = np.ptp(record.signal(effect.axis, Tap.MEAS))
    assert drift <= 1e-9 * ROBOT.axes[effect.axis].span


def test_memory_is_that_of_a_rise_from_the_low_end():
    """The same command reached by a slow rise ends where the run at rest begins."""
    own = ROBOT.axes["zn"]
    high = own.range[0] + 0.6 * own.span
    time_s = np.arange(12001) / 2000.0
    ramp = np.minimum(time_s / 4.0, 1.0)
    smooth = ramp * ramp * (3.0 - 2.0 * ramp)
    rise = Record.from_signals(
        time_s, {("zn", Tap.CMD): own.range[0] + smooth * (high - own.range[0])}, {"zn": "m"}
    )
    risen = simulate(ROBOT, [LOOP], rise).signal("zn", Tap.REF)[-1]
    at_rest = simulate(ROBOT, [LOOP], held("zn", 0.6)).signal("zn", Tap.REF)[0]
    assert risen == pytest.approx(at_rest, abs=1e-6 * own.span)


def test_after_a_rise_friction_and_backlash_hold_the_table_back():
    for effect in (AxisEffect(axis="x", id="friction"), AxisEffect(axis="x", id="backlash")):
        record = simulate(ROBOT, [effect], held("x", 0.5))
        behind = record.signal("x", Tap.CMD)[0] - record.signal("x", Tap.REF)[0]
        assert behind > 1e-8, effect.id


def test_a_periodic_run_with_effects_begins_in_its_steady_state():
    robot = replace(ROBOT, effects=(LOOP,))
    steady = nominal_response(robot, sine("zn", metadata={"history": "periodic"}))
    first, second = np.split(steady.signal("zn", Tap.REF), 2)
    np.testing.assert_allclose(first, second, atol=1e-6 * ROBOT.axes["zn"].span)


def test_effects_count_time_from_the_first_row_of_a_periodic_run():
    """A tone as fast as the samples reads the same at each of them, if it begins with them."""
    tone = AxisEffect(axis="zn", id="vibration", parameters={"frequency": 500.0, "sine": 1e-7})
    commands = sine("zn", metadata={"history": "periodic"})
    still, shaken = (
        nominal_response(replace(ROBOT, effects=effects), commands).signal("zn", Tap.REF)
        for effects in ((), (tone,))
    )
    expected = 1e-7 * np.sin(2 * np.pi * 500.0 * commands.time_s)
    np.testing.assert_allclose(shaken - still, expected, atol=1e-9)


def latched(x, other, t, h, a, b, p, s):
    """Show what it showed first."""
    if t > 0.0:
        return s[0]
    s[0] = x
    return x


def test_what_is_digital_begins_with_what_the_sensor_reads_offset_included(monkeypatch):
    effect = Effect(
        id="latch",
        title="Latch",
        summary="Shows what it showed first.",
        stage=Stage.SENSOR,
        kinds=frozenset({"piezo"}),
        formulations=(
            Formulation(
                name="only",
                equation="y = y₀",
                source="none",
                parameters=(),
                acts=Reading(step=latched, states=1, digital=True),
            ),
        ),
    )
    monkeypatch.setattr(attachment, "effect_named", lambda _: effect)
    axes = {**ROBOT.axes, "zn": replace(ROBOT.axes["zn"], offset=3e-6)}
    robot = replace(ROBOT, axes=axes, effects=(AxisEffect(axis="zn", id="latch"),))
    plant = Plant.of(robot, only=["zn"])
    command = np.full((3, len(plant.axes)), sum(ROBOT.axes["zn"].range) / 2)
    column = plant.axes.index("zn")
    state = plant.at_rest(0.0, command[0])
    motion, _ = plant.advance(state, np.array([1.0, 2.0, 3.0]), command)
    assert motion.reading[:, column] == pytest.approx(command[0, column] + 3e-6, rel=1e-12)


def test_effects_join_the_axis_that_they_come_from():
    plant = Plant.of(
        replace(ROBOT, effects=(AxisEffect(axis="x", id="cross_coupling", from_axis="thy"),)),
        only=["x"],
    )
    assert set(plant.axes) == {"x", "thx", "thy"}


@pytest.mark.parametrize("rate_hz", [200.0, 1000.0, 2000.0, 3000.0])
@pytest.mark.parametrize("samples", [1, 3, 7])
def test_a_delay_of_whole_samples_never_comes_a_sample_late(rate_hz, samples):
    """Times and delays are rounded each by itself; a static axis would show a whole sample."""
    robot = load_robot("picma")
    name = next(iter(robot.axes))
    time_s = np.arange(3000) / rate_hz
    command = 2e-5 + 1e-5 * np.sin(2 * np.pi * 0.5 * time_s)
    record = Record.from_signals(time_s, {(name, Tap.CMD): command}, {name: "m"})
    late = AxisEffect(axis=name, id="delay", parameters={"delay": samples / rate_hz})
    answer = simulate(robot, [late], record)
    np.testing.assert_allclose(
        answer.signal(name, Tap.REF)[samples:], command[:-samples], rtol=1e-12
    )
