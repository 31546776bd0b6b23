"""Effects fitted to simulated records: parameters are found, healthy axes stay healthy."""

import numpy as np
import pytest

from rotemina.sim.errors import GapError
from rotemina.sim.gap.compare.screening import screen
from rotemina.sim.gap.fit import Evidence, block_rows, fit, held_out
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


def make_commands(axis, share, rate_hz=1000.0, seconds=6.0):
    """Return decaying triangles around the middle of the range."""
    description = ROBOT.axes[axis]
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    wave = 2.0 / np.pi * np.arcsin(np.sin(2 * np.pi * 1.0 * time_s))
    command = sum(description.range) / 2 + share * description.span * wave * np.exp(-time_s / 4.0)
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: description.unit})


def simulate_records(effects, axis, shares, seed=0):
    rng = np.random.default_rng(seed)
    return [simulate(ROBOT, effects, make_commands(axis, share), rng) for share in shares]


@pytest.mark.parametrize(
    "truth",
    [
        AxisEffect(axis="x", id="backlash", formulation="screw", parameters={"width": 4e-6}),
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 5e-6, "shape": 1.6}),
        AxisEffect(axis="x", id="delay", parameters={"delay": 3.7e-3}),
    ],
    ids=lambda effect: effect.id,
)
def test_the_true_effect_explains_the_gap_and_its_parameters_are_found(truth):
    share = 0.002 if truth.axis == "x" else 0.3
    evidence = Evidence.of(
        ROBOT, truth.axis, simulate_records([truth], truth.axis, (share, 0.6 * share))
    )
    rms_before = [np.sqrt(np.mean(gap[Tap.MEAS] ** 2)) for gap in evidence.gaps()]
    start = AxisEffect(axis=truth.axis, id=truth.id, formulation=truth.formulation)
    result = fit(evidence, [start])
    assert min(rms_before) > 5.0
    assert result.cost == pytest.approx(1.0, abs=0.15)
    for name, value in truth.parameters.items():
        assert result.effects[0].parameters[name] == pytest.approx(value, rel=0.02)


def test_deviations_cover_the_truth_and_are_infinite_without_information():
    truth = AxisEffect(axis="zn", id="delay", parameters={"delay": 3.7e-3})
    evidence = Evidence.of(ROBOT, "zn", simulate_records([truth], "zn", (0.3,)))
    saturation = AxisEffect(axis="zn", id="saturation")
    result = fit(evidence, [AxisEffect(axis="zn", id="delay"), saturation])
    deviation = result.deviation(block_rows(evidence))
    value, size = result.effects[0].parameters["delay"], result.free[0].size
    assert abs(value - 3.7e-3) < 4.0 * deviation[0] * size
    # No end of the range was reached.
    assert np.isinf(deviation[1:]).any()


def test_a_wrong_effect_leaves_the_gap():
    truth = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 5e-6, "shape": 1.0})
    evidence = Evidence.of(ROBOT, "zn", simulate_records([truth], "zn", (0.3,)))
    result = fit(evidence, [AxisEffect(axis="zn", id="thermal_drift")])
    assert np.sqrt(result.cost) > 20.0


def test_a_healthy_axis_is_at_its_floor():
    evidence = Evidence.of(ROBOT, "thx", simulate_records([], "thx", (0.3, 0.1)))
    for gap in evidence.gaps():
        assert np.sqrt(np.mean(gap[Tap.REF] ** 2)) == pytest.approx(1.0, abs=0.05)
        assert np.sqrt(np.mean(gap[Tap.MEAS] ** 2)) == pytest.approx(1.0, abs=0.05)


def test_an_axis_without_measurements_is_refused():
    with pytest.raises(GapError, match="axis 'zn'"):
        Evidence.of(ROBOT, "zn", [make_commands("zn", 0.1)])


def test_a_bound_that_is_reached_is_reported():
    """The gain of the machine, 1.96, is beyond what a fit may assume."""
    truth = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.4})
    evidence = Evidence.of(ROBOT, "zn", simulate_records([truth, truth], "zn", (0.1,)))
    result = fit(evidence, [AxisEffect(axis="zn", id="gain_error")])
    assert result.at_bound == {(0, "error"): "high"}


class FailingEvidence(Evidence):
    """Evidence on which the equations of a delay fail."""

    def residual(self, effects=(), only=None):
        if any(effect.id == "delay" for effect in effects):
            raise np.linalg.LinAlgError("Singular matrix")
        return super().residual(effects, only)


def test_only_the_candidate_with_failing_equations_is_lost():
    truth = AxisEffect(axis="x", id="backlash", formulation="screw", parameters={"width": 4e-6})
    evidence = Evidence.of(ROBOT, "x", simulate_records([truth], "x", (0.002,)))
    failing_evidence = FailingEvidence(evidence.robot, evidence.axis, evidence.observations)
    start = fit(failing_evidence, [])
    screening = screen(failing_evidence, start, AxisEffect(axis="x", id="delay"), briefly=False)
    # The gap did not become smaller.
    assert screening.cost > 0.99 * start.cost
    assert fit(failing_evidence, [AxisEffect(axis="x", id="delay")]).cost > 1e9
    play = AxisEffect(axis="x", id="backlash", formulation="screw")
    assert fit(failing_evidence, [play]).cost == fit(evidence, [play]).cost < 1.3


def test_a_descent_with_singular_equations_is_lost_and_logged(caplog, monkeypatch):
    def raise_singular(*_):
        raise np.linalg.LinAlgError("Singular matrix")

    truth = AxisEffect(axis="x", id="delay", parameters={"delay": 3.7e-3})
    evidence = Evidence.of(ROBOT, "x", simulate_records([truth], "x", (0.002, 0.001)))
    result = fit(evidence, [AxisEffect(axis="x", id="delay")])
    monkeypatch.setattr("rotemina.sim.gap.fit.held_out_folds._bounded_minimum", raise_singular)
    assert np.all(held_out(evidence, result) >= 1e6)
    monkeypatch.setattr("rotemina.sim.gap.fit.output_error.descend", raise_singular)
    assert fit(evidence, [AxisEffect(axis="x", id="delay")]).cost > 1e9
    assert "axis x: delay is left out of the diagnosis" in caplog.text
