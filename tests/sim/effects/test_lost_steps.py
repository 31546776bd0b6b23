"""Lost steps: permanent, by four full steps, and only under load."""

import numpy as np
import pytest

from rotemina.sim.effects.lost_steps import event, overload
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
TOOTH = 4 * 0.001 / 200
RATE_HZ = 2000.0


def gap(command, formulation="overload", rate_hz=RATE_HZ, **parameters):
    time_s = np.arange(len(command)) / rate_hz
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    effect = AxisEffect(axis="x", id="lost_steps", formulation=formulation, parameters=parameters)
    with_effect, without = (simulate(ROBOT, e, record).signal("x", Tap.REF) for e in ([effect], []))
    return with_effect - without


def move(speed, ramp_s, seconds=1.0):
    """A move that comes up to speed within ``ramp_s``, and stops as it began."""
    time_s = np.arange(int((seconds + 0.5) * RATE_HZ)) / RATE_HZ
    up, down = time_s - 0.05, time_s - seconds
    rate = speed * (np.clip(up / ramp_s, 0, 1) - np.clip(down / ramp_s, 0, 1))
    return 0.02 + np.cumsum(rate) / RATE_HZ


def test_a_gentle_move_loses_nothing():
    assert np.abs(gap(move(5e-3, 0.2))).max() < 1e-14


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_overload_loses_whole_teeth_for_good_against_the_motion(sign):
    left = gap(move(sign * 2.5e-2, 1e-3))
    lost = left[-1] / TOOTH
    assert lost * sign < -0.5
    assert lost == pytest.approx(round(lost), abs=1e-6)
    assert np.ptp(left[-200:]) < 1e-9


def test_a_stronger_motor_holds():
    command = move(2.5e-2, 1e-3)
    assert abs(gap(command, limit=20e-6)[-1]) < abs(gap(command)[-1])
    assert np.abs(gap(command, limit=200e-6)).max() < 1e-14


def test_a_jump_ends_in_the_nearest_detent():
    s = [0.0]
    for asked, expected in ((9e-6, 0.0), (11e-6, -1.0), (1e-3, -50.0)):
        s[0] = 0.0
        overload(asked, 0.0, 0, 1e-4, 0, 0, [2 * 5e-6, TOOTH], s)
        assert s[0] == expected
    kept = s[0]
    overload(5e-3, 0.0, 0, 0.0, 0, 0, [2 * 5e-6, TOOTH], s)
    assert s[0] == kept  # a mere look loses nothing


def test_an_event_is_a_lasting_jump_at_its_time():
    left = gap(np.full(4000, 0.02), "event", time=0.70015, slips=-2.0)
    assert np.abs(left[: int(0.7 * RATE_HZ)]).max() == 0.0
    assert left[-1] == pytest.approx(-2 * TOOTH, rel=1e-6)
    assert np.abs(gap(np.full(400, 0.02), "event", time=0.1, slips=0.0)).max() == 0.0


def test_an_event_moves_evenly_with_its_time():
    p = [[1.0 + k * 1e-4, TOOTH] for k in range(6)]
    means = [event(0.0, 0, 1.0, 5e-4, 0, 0, each, []) for each in p]
    np.testing.assert_allclose(means, TOOTH * (1 - np.arange(6) / 5), atol=1e-12)
    assert event(0.0, 0, 1.0, 0.0, 0, 0, [1.0, TOOTH], []) == TOOTH
    assert event(0.0, 0, 0.0, 1e9, 0, 0, [1.0, TOOTH], []) == 0.0  # the way to the start
