"""Candidates for the cause of a gap."""

import sys
from pathlib import Path

from rotemina.sim.gap.compare import candidates
from rotemina.sim.gap.fit import Evidence

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from sweeps import ROBOT, simulate_sweep


def get_ids(candidate_list):
    return {candidate.id for candidate in candidate_list}


def test_every_effect_that_can_be_fitted_is_a_candidate():
    x_candidates = candidates(Evidence.of(ROBOT, "x", [simulate_sweep([], seconds=1.0)]))
    thx_candidates = candidates(
        Evidence.of(ROBOT, "thx", [simulate_sweep([], ("thx",), seconds=1.0)])
    )
    assert {"backlash", "friction", "microstep_error", "delay", "sensor_gain"} <= get_ids(
        x_candidates
    )
    assert {"hysteresis", "creep", "slew_limit", "saturation"} <= get_ids(thx_candidates)
    assert not {"hysteresis", "creep"} & get_ids(x_candidates)
    assert not {"backlash", "friction"} & get_ids(thx_candidates)
    assert not {"sensor_noise", "sensor_outliers", "lost_steps"} & (
        get_ids(x_candidates) | get_ids(thx_candidates)
    )


def test_a_coupling_is_a_candidate_from_each_axis_that_was_commanded():
    candidate_list = candidates(
        Evidence.of(ROBOT, "x", [simulate_sweep([], ("x", "y", "thx"), seconds=1.0)])
    )
    sources = {
        candidate.from_axis for candidate in candidate_list if candidate.id == "cross_coupling"
    }
    assert sources == {"y", "thx"}
    assert "cross_coupling" not in get_ids(
        candidates(Evidence.of(ROBOT, "x", [simulate_sweep([], seconds=1.0)]))
    )
