"""A hardening flexure: its static curve, and its resonance, which depends on the position."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
LOW, HIGH = ROBOT.axes["thx"].range
MIDDLE, REACH = (LOW + HIGH) / 2, (HIGH - LOW) / 2
FREQUENCY = 300.0


def simulate_flexure(command, rate_hz=20_000.0, has_effect=True, thy_command=None, **parameters):
    signals = {("thx", Tap.CMD): command}
    if thy_command is not None:
        signals["thy", Tap.CMD] = thy_command
    units = {name: "rad" for name, _ in signals}
    record = Record.from_signals(np.arange(len(command)) / rate_hz, signals, units)
    effect = AxisEffect(axis="thx", id="stiffness_nonlinearity", parameters=parameters)
    return simulate(ROBOT, [effect] if has_effect else (), record)


def find_rest_position(place, **parameters):
    return simulate_flexure(np.full(2, place), **parameters).signal("thx", Tap.REF)[0]


@pytest.mark.parametrize(
    ("hardening", "centre"), [(0.05, 0.0), (1.0, 0.0), (0.5, -REACH), (-0.01, -REACH)]
)
def test_the_axis_rests_where_the_forces_balance(hardening, centre):
    for place in np.linspace(LOW, HIGH, 7):
        q = find_rest_position(place, hardening=hardening, centre=centre)
        bend = (q - MIDDLE - centre) / REACH
        assert q + hardening * REACH * bend**3 == pytest.approx(place, abs=1e-8 * REACH)


def measure_frequency(place, **parameters):
    """Measure the frequency of small free vibrations around a place by zero crossings."""
    command = np.concatenate([[place], np.full(4000, place + 1e-3 * REACH)])
    path = simulate_flexure(command, **parameters).signal("thx", Tap.REF)
    path = path[1:2500] - path[-300:].mean()
    upward_rows = np.flatnonzero((path[:-1] < 0) & (path[1:] >= 0))
    crossings = upward_rows - path[upward_rows] / (path[upward_rows + 1] - path[upward_rows])
    return 20_000.0 / np.diff(crossings[2:20]).mean()


@pytest.mark.parametrize("place", [MIDDLE, HIGH - 0.1 * REACH])
def test_the_resonance_depends_on_the_position(place):
    hardening = 0.3
    bend = (find_rest_position(place, hardening=hardening) - MIDDLE) / REACH
    stiffness_ratio = 1 + 3 * hardening * bend**2
    assert measure_frequency(place, hardening=hardening) == pytest.approx(
        FREQUENCY * np.sqrt(stiffness_ratio), rel=5e-3
    )


def test_the_axis_that_is_coupled_by_mass_also_changes():
    command = MIDDLE + 0.8 * REACH * np.sin(2 * np.pi * 20.0 * np.arange(4000) / 20_000.0)
    constant = np.full(4000, MIDDLE)
    with_effect, without_effect = (
        simulate_flexure(command, has_effect=has_effect, thy_command=constant, **parameters).signal(
            "thy", Tap.REF
        )
        for has_effect, parameters in ((True, {"hardening": 0.5}), (False, {}))
    )
    assert np.ptp(with_effect - without_effect) > 0.1 * np.ptp(without_effect) > 0.0
