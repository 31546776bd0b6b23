"""A hardening flexure: its static curve, and its resonance, which moves with position."""

import numpy as np
import pytest

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.stiffness_nonlinearity import cubic
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
LOW, HIGH = ROBOT.axes["thx"].range
MIDDLE, REACH = (LOW + HIGH) / 2, (HIGH - LOW) / 2
FREQUENCY = 300.0


def bent(command, rate_hz=20_000.0, effects=True, other=None, **parameters):
    signals = {("thx", Tap.CMD): command}
    if other is not None:
        signals["thy", Tap.CMD] = other
    units = {name: "rad" for name, _ in signals}
    record = Record.from_signals(np.arange(len(command)) / rate_hz, signals, units)
    effect = AxisEffect(axis="thx", id="stiffness_nonlinearity", parameters=parameters)
    return simulate(ROBOT, [effect] if effects else (), record)


def where_it_rests(place, **parameters):
    return bent(np.full(2, place), **parameters).signal("thx", Tap.REF)[0]


@pytest.mark.parametrize("hardening", [0.05, 0.5, 1.0, -0.01])
@pytest.mark.parametrize("centre", [0.0, -REACH])
def test_it_rests_where_the_forces_balance(hardening, centre):
    for place in np.linspace(LOW, HIGH, 7):
        q = where_it_rests(place, hardening=hardening, centre=centre)
        bend = (q - MIDDLE - centre) / REACH
        assert q + hardening * REACH * bend**3 == pytest.approx(place, abs=1e-8 * REACH)


def ringing_frequency(place, **parameters):
    """Frequency of small free vibrations about a place, by its zero crossings."""
    command = np.concatenate([[place], np.full(4000, place + 1e-3 * REACH)])
    path = bent(command, **parameters).signal("thx", Tap.REF)
    path = path[1:2500] - path[-300:].mean()
    up = np.flatnonzero((path[:-1] < 0) & (path[1:] >= 0))
    exact = up - path[up] / (path[up + 1] - path[up])
    return 20_000.0 / np.diff(exact[2:20]).mean()


@pytest.mark.parametrize("place", [LOW + 0.1 * REACH, MIDDLE, HIGH - 0.1 * REACH])
def test_the_resonance_moves_with_the_position(place):
    hardening = 0.3
    bend = (where_it_rests(place, hardening=hardening) - MIDDLE) / REACH
    stiffer = 1 + 3 * hardening * bend**2
    assert ringing_frequency(place, hardening=hardening) == pytest.approx(
        FREQUENCY * np.sqrt(stiffer), rel=5e-3
    )


def test_without_hardening_the_axis_is_nominal():
    command = MIDDLE + 0.5 * REACH * np.sin(2 * np.pi * 20.0 * np.arange(4000) / 20_000.0)
    one = bent(command, hardening=0.0).signal("thx", Tap.REF)
    none = bent(command, effects=False).signal("thx", Tap.REF)
    np.testing.assert_allclose(one, none, rtol=0, atol=1e-10 * REACH)


def test_the_axis_that_a_mass_couples_to_it_feels_it():
    command = MIDDLE + 0.8 * REACH * np.sin(2 * np.pi * 20.0 * np.arange(4000) / 20_000.0)
    still = np.full(4000, MIDDLE)
    with_, without = (
        bent(command, effects=effects, other=still, **figures).signal("thy", Tap.REF)
        for effects, figures in ((True, {"hardening": 0.5}), (False, {}))
    )
    assert np.ptp(with_ - without) > 0.1 * np.ptp(without) > 0.0


def test_it_grows_evenly_with_its_parameter():
    command = MIDDLE + 0.9 * REACH * np.sin(2 * np.pi * 20.0 * np.arange(2000) / 20_000.0)
    paths = [bent(command, hardening=e).signal("thx", Tap.REF) for e in (0.0, 1e-3, 2e-3)]
    first, second = paths[1] - paths[0], paths[2] - paths[0]
    assert np.linalg.norm(second - 2 * first) < 0.02 * np.linalg.norm(second)


def test_plain_python_solves_the_midpoint_rule():
    attached = Attached.of(ROBOT, AxisEffect(axis="thx", id="stiffness_nonlinearity"))
    numbers = list(attached.formulation.numbers(attached.values, attached.facts))
    a = 1e-4
    force = cubic(HIGH, 0.0, 0.0, 1e-4, a, 0.0, numbers, [])
    assert force == pytest.approx(-numbers[0] * (HIGH + a * force / 2 - numbers[1]) ** 3, rel=1e-6)
