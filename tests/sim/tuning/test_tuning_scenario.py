"""Steps and triangles stay within the limits of their axis."""

import numpy as np
import pytest

from rotemina.sim.errors import TuningError
from rotemina.sim.robot_files import load_robot
from rotemina.sim.tuning.tuning_scenario import make_step, make_triangle

RATE_HZ = 5000.0
ROBOT = load_robot("rotemina")


@pytest.mark.parametrize("name", ["x", "thx", "zn"])
@pytest.mark.parametrize("make_scenario", [make_step, make_triangle])
def test_speed_and_acceleration_stay_within_the_limits(name, make_scenario):
    axis = ROBOT.axes[name]
    reference = make_scenario(axis, RATE_HZ).reference
    assert np.abs(np.diff(reference)).max() * RATE_HZ <= axis.max_speed * 1.001
    assert np.abs(np.diff(reference, 2)).max() * RATE_HZ**2 <= axis.max_acceleration * 1.01
    assert reference.min() >= axis.range[0]
    assert reference.max() <= axis.range[1]


def test_a_step_has_its_distance_and_is_centred_in_the_range():
    axis = ROBOT.axes["zn"]
    step = make_step(axis, RATE_HZ, -20e-6)
    assert step.distance == pytest.approx(-20e-6)
    assert step.reference[0] == pytest.approx(42.5e-6)
    assert step.target == pytest.approx(22.5e-6)
    assert np.ptp(step.reference[: int(step.begin_s * RATE_HZ)]) == 0.0


def test_a_triangle_is_straight_between_its_rounded_corners():
    axis = ROBOT.axes["zn"]
    reference = make_triangle(axis, RATE_HZ, 5.0, 20e-6).reference
    speed = np.diff(reference) * RATE_HZ
    assert np.mean(np.isclose(np.abs(speed), 2 * 20e-6 * 5.0, rtol=1e-6)) > 0.9
    assert 19.5e-6 < np.ptp(reference) < 20e-6
    assert reference[-1] == pytest.approx(32.5e-6, abs=0.3e-6)


def test_distances_out_of_range_are_refused():
    with pytest.raises(TuningError, match=r"step of 100 µm: .* 65 µm"):
        make_step(ROBOT.axes["zn"], RATE_HZ, 1e-4)
    with pytest.raises(TuningError, match="triangle of 0 µm:"):
        make_triangle(ROBOT.axes["zn"], RATE_HZ, None, 0.0)
