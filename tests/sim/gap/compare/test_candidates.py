"""What may explain a gap, and where its fit begins."""

import sys
from pathlib import Path

from rotemina.sim.gap.compare.candidates import candidates
from rotemina.sim.gap.fit.evidence import Evidence

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from sweeps import ROBOT, sweep


def ids(found):
    return {candidate.id for candidate in found}


def test_every_effect_that_can_be_fitted_is_a_candidate():
    table = candidates(Evidence.of(ROBOT, "x", [sweep([])]))
    plate = candidates(Evidence.of(ROBOT, "thx", [sweep([], ("thx",))]))
    assert {"backlash", "friction", "microstep_error", "delay", "sensor_gain"} <= ids(table)
    assert {"hysteresis", "creep", "slew_limit", "saturation"} <= ids(plate)
    assert not {"hysteresis", "creep"} & ids(table)
    assert not {"backlash", "friction"} & ids(plate)
    assert not {"sensor_noise", "sensor_outliers", "lost_steps"} & (ids(table) | ids(plate))


def test_a_coupling_is_a_candidate_from_each_axis_that_was_commanded():
    found = candidates(Evidence.of(ROBOT, "x", [sweep([], ("x", "y", "thx"))]))
    sources = {one.from_axis for one in found if one.id == "cross_coupling"}
    assert sources == {"y", "thx"}
    assert "cross_coupling" not in ids(candidates(Evidence.of(ROBOT, "x", [sweep([])])))
