"""Effects fitted to simulated records: parameters come back, healthy axes stay healthy."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.screening import screen
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.fit.evidence import Evidence, block_rows
from rotemina.sim.gap.fit.held_out import held_out
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


def triangles(axis, share, rate_hz=1000.0, seconds=6.0):
    """Decaying triangles about the middle of the range."""
    own = ROBOT.axes[axis]
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    wave = 2.0 / np.pi * np.arcsin(np.sin(2 * np.pi * 1.0 * time_s))
    command = sum(own.range) / 2 + share * own.span * wave * np.exp(-time_s / 4.0)
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: own.unit})


def measured(effects, axis, shares, seed=0):
    rng = np.random.default_rng(seed)
    return [simulate(ROBOT, effects, triangles(axis, share), rng) for share in shares]


@pytest.mark.parametrize(
    "truth",
    [
        AxisEffect(axis="x", id="backlash", formulation="screw", parameters={"width": 4e-6}),
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 5e-6, "shape": 1.6}),
        AxisEffect(axis="x", id="delay", parameters={"delay": 3.7e-3}),
    ],
    ids=lambda effect: effect.id,
)
def test_the_true_effect_explains_all_and_its_parameters_come_back(truth):
    share = 0.002 if truth.axis == "x" else 0.3
    evidence = Evidence.of(ROBOT, truth.axis, measured([truth], truth.axis, (share, 0.6 * share)))
    before = [np.sqrt(np.mean(gap[Tap.MEAS] ** 2)) for gap in evidence.gaps()]
    start = AxisEffect(axis=truth.axis, id=truth.id, formulation=truth.formulation)
    found = fit(evidence, [start])
    assert min(before) > 5.0
    assert found.cost == pytest.approx(1.0, abs=0.15)
    for name, value in truth.parameters.items():
        assert found.effects[0].parameters[name] == pytest.approx(value, rel=0.02)


def test_deviations_cover_the_truth_and_blind_parameters_are_told():
    truth = AxisEffect(axis="zn", id="delay", parameters={"delay": 3.7e-3})
    evidence = Evidence.of(ROBOT, "zn", measured([truth], "zn", (0.3,)))
    untouched = AxisEffect(axis="zn", id="saturation")
    found = fit(evidence, [AxisEffect(axis="zn", id="delay"), untouched])
    spread = found.deviation(block_rows(evidence))
    value, size = found.effects[0].parameters["delay"], found.free[0].size
    assert abs(value - 3.7e-3) < 4.0 * spread[0] * size
    assert np.isinf(spread[1:]).any()  # no end of the range was reached


def test_a_wrong_effect_leaves_the_gap():
    truth = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 5e-6, "shape": 1.0})
    evidence = Evidence.of(ROBOT, "zn", measured([truth], "zn", (0.3,)))
    found = fit(evidence, [AxisEffect(axis="zn", id="thermal_drift")])
    assert np.sqrt(found.cost) > 20.0


def test_a_healthy_axis_is_at_its_floor():
    evidence = Evidence.of(ROBOT, "thx", measured([], "thx", (0.3, 0.1)))
    for gap in evidence.gaps():
        assert np.sqrt(np.mean(gap[Tap.REF] ** 2)) == pytest.approx(1.0, abs=0.05)
        assert np.sqrt(np.mean(gap[Tap.MEAS] ** 2)) == pytest.approx(1.0, abs=0.05)


def test_an_axis_that_nobody_measured_is_refused():
    with pytest.raises(GapError, match="axis 'zn'"):
        Evidence.of(ROBOT, "zn", [triangles("zn", 0.1)])


def test_a_bound_that_is_hit_is_told():
    truth = AxisEffect(axis="x", id="delay", parameters={"delay": 0.002})
    evidence = Evidence.of(ROBOT, "x", measured([truth], "x", (0.002,)))
    wrong = AxisEffect(axis="x", id="thermal_drift")
    found = fit(evidence, [wrong, AxisEffect(axis="x", id="delay")])
    assert found.effects[1].parameters["delay"] == pytest.approx(0.002, rel=0.01)
    assert set(found.at_bound) <= {(0, "time_constant"), (0, "amplitude")}


class Broken(Evidence):
    """Evidence on which the equations of a delay fail."""

    def residual(self, effects=(), only=None):
        if any(one.id == "delay" for one in effects):
            raise np.linalg.LinAlgError("Singular matrix")
        return super().residual(effects, only)


def test_a_candidate_whose_numbers_fail_is_lost_and_no_other():
    truth = AxisEffect(axis="x", id="backlash", formulation="screw", parameters={"width": 4e-6})
    whole = Evidence.of(ROBOT, "x", measured([truth], "x", (0.002,)))
    broken = Broken(whole.robot, whole.axis, whole.observations)
    begun = fit(broken, [])
    seen = screen(broken, begun, AxisEffect(axis="x", id="delay"), briefly=False)
    assert seen.cost > 0.99 * begun.cost  # nothing was taken away
    assert fit(broken, [AxisEffect(axis="x", id="delay")]).cost > 1e9
    play = AxisEffect(axis="x", id="backlash", formulation="screw")
    assert fit(broken, [play]).cost == fit(whole, [play]).cost < 1.3


def test_a_descent_whose_equations_are_singular_is_lost_and_said_so(caplog, monkeypatch):
    def singular(*_):
        raise np.linalg.LinAlgError("Singular matrix")

    truth = AxisEffect(axis="x", id="delay", parameters={"delay": 3.7e-3})
    evidence = Evidence.of(ROBOT, "x", measured([truth], "x", (0.002, 0.001)))
    found = fit(evidence, [AxisEffect(axis="x", id="delay")])
    monkeypatch.setattr("rotemina.sim.gap.fit.held_out._bounded_minimum", singular)
    assert np.all(held_out(evidence, found) >= 1e6)
    monkeypatch.setattr("rotemina.sim.gap.fit.output_error.descend", singular)
    assert fit(evidence, [AxisEffect(axis="x", id="delay")]).cost > 1e9
    assert "axis x: delay is left out of the diagnosis" in caplog.text
