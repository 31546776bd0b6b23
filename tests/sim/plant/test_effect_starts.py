"""The start of a run with effects: periodic runs, digital effects, source axes and delays."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects import EffectStage, ReadingFunction
from rotemina.sim.plant import Plant, simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
HYSTERESIS = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6})


def make_sine(axis, rate_hz=2000.0, frequency_hz=5.0, periods=2, metadata=None):
    axis_model = ROBOT.axes[axis]
    time_s = np.arange(round(periods * rate_hz / frequency_hz)) / rate_hz
    wave = np.sin(2 * np.pi * frequency_hz * time_s)
    command = axis_model.range[0] + axis_model.span * (0.5 + 0.2 * wave)
    return Record.from_signals(
        time_s, {(axis, Tap.CMD): command}, {axis: axis_model.unit}, metadata
    )


def test_a_periodic_run_with_effects_begins_in_its_steady_state():
    robot = replace(ROBOT, effects=(HYSTERESIS,))
    steady = simulate_nominal_response(robot, make_sine("zn", metadata={"history": "periodic"}))
    first, second = np.split(steady.signal("zn", Tap.REF), 2)
    np.testing.assert_allclose(first, second, atol=1e-6 * ROBOT.axes["zn"].span)


def test_effects_count_time_from_the_first_row_of_a_periodic_run():
    """The tone starts with phase 0 at the first row, although earlier periods were simulated."""
    tone = AxisEffect(axis="zn", id="vibration", parameters={"frequency": 500.0, "sine": 1e-7})
    commands = make_sine("zn", metadata={"history": "periodic"})
    nominal, with_tone = (
        simulate_nominal_response(replace(ROBOT, effects=effects), commands).signal("zn", Tap.REF)
        for effects in ((), (tone,))
    )
    expected = 1e-7 * np.sin(2 * np.pi * 500.0 * commands.time_s)
    np.testing.assert_allclose(with_tone - nominal, expected, atol=1e-9)


def latch(x, other, t, h, a, b, p, s):
    """Return the first value forever."""
    if t > 0.0:
        return s[0]
    s[0] = x
    return x


def test_a_digital_effect_starts_with_the_reading_including_its_offset(install_effect):
    install_effect(ReadingFunction(step=latch, states=1, digital=True), stage=EffectStage.SENSOR)
    axes = {**ROBOT.axes, "zn": replace(ROBOT.axes["zn"], offset=3e-6)}
    robot = replace(ROBOT, axes=axes, effects=(AxisEffect(axis="zn", id="latch"),))
    plant = Plant.of(robot, only=["zn"])
    command = np.full((3, len(plant.axes)), sum(ROBOT.axes["zn"].range) / 2)
    column = plant.axes.index("zn")
    state = plant.find_rest_state(0.0, command[0])
    motion, _ = plant.advance(state, np.array([1.0, 2.0, 3.0]), command)
    assert motion.reading[:, column] == pytest.approx(command[0, column] + 3e-6, rel=1e-12)


def test_the_source_axis_of_an_effect_is_simulated():
    plant = Plant.of(
        replace(ROBOT, effects=(AxisEffect(axis="x", id="cross_coupling", from_axis="thy"),)),
        only=["x"],
    )
    assert set(plant.axes) == {"x", "thx", "thy"}


@pytest.mark.parametrize("rate_hz", [200.0, 1000.0, 3000.0])
@pytest.mark.parametrize("samples", [1, 7])
def test_a_delay_of_whole_samples_is_exact(rate_hz, samples):
    """Times and delays are rounded separately, so a static axis could lag by a whole sample."""
    robot = load_robot("picma")
    name = next(iter(robot.axes))
    time_s = np.arange(3000) / rate_hz
    command = 2e-5 + 1e-5 * np.sin(2 * np.pi * 0.5 * time_s)
    record = Record.from_signals(time_s, {(name, Tap.CMD): command}, {name: "m"})
    delay = AxisEffect(axis=name, id="delay", parameters={"delay": samples / rate_hz})
    response = simulate(robot, [delay], record)
    np.testing.assert_allclose(
        response.signal(name, Tap.REF)[samples:], command[:-samples], rtol=1e-12
    )
