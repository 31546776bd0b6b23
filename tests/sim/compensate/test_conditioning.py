"""The sweep after which an inverse and its axis have the same past."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate.conditioning import conditioning
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Exceedance, Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.dry_run import dry_run

ROBOT = load_robot("rotemina")
ZN = ROBOT.axes["zn"]
MODEL = InverseModel(
    axis="zn",
    unit="m",
    kind="prandtl_ishlinskii",
    sample_s=1e-3,
    origin=0.0,
    command_origin=0.0,
    span=ZN.span,
    desired_range=(1e-6, 70e-6),
    command_range=ZN.range,
    speed=1.0,
    consequents=np.array([[0.0, 0.9, 0.1, 0.1]]),
    radii=np.array([0.1, 0.2]),
    initial=np.zeros(2),
)


@pytest.mark.parametrize("start", [20e-6, 31e-6, 45e-6])
def test_it_nearly_reaches_both_ends_inside_every_limit_and_comes_back(start):
    sweep = conditioning(ROBOT, MODEL, start)
    path = sweep.signal("zn", Tap.CMD)
    assert path[[0, -1]] == pytest.approx(start, abs=1e-15)
    assert path.min() < 15e-6
    assert 50e-6 < path.max() < ZN.range[1]
    assert dry_run(ROBOT, sweep).allowed
    inverse = Inverse(MODEL, 2e-3)
    inverse.run(path)
    assert not inverse.beyond & Exceedance.COMMAND


def test_after_it_no_past_is_left():
    sweep = conditioning(ROBOT, MODEL, 30e-6).signal("zn", Tap.CMD)
    told = []
    for past in ([30e-6], [30e-6, 55e-6, 8e-6, 50e-6, 30e-6]):
        inverse = Inverse(MODEL, 2e-3)
        for place in past:
            before = inverse.step(place)
        told.append((before, inverse.run(sweep)[-1]))
    assert abs(told[0][0] - told[1][0]) > 1e-6
    assert told[0][1] == pytest.approx(told[1][1], abs=1e-15)


def test_what_it_cannot_begin_at_or_be_told_is_refused():
    with pytest.raises(CompensationError, match=r"between 1 µm and 65 µm"):
        conditioning(ROBOT, MODEL, 70e-6)
    steep = replace(MODEL, consequents=np.array([[0.0, 3.0, 0.1, 0.1]]))
    with pytest.raises(CompensationError, match="move the axis to mid-range first"):
        conditioning(ROBOT, steep, 10e-6)
