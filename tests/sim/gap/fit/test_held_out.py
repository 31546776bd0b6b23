"""Residual of a fit on records that it did not see."""

import numpy as np
import pytest
from tests.sim.gap.fit.test_output_error import simulate_records

from rotemina.sim.gap.fit import Evidence, fit, folds, held_out
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def test_held_out_records_are_predicted_from_the_other_records():
    truth = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 5e-6, "shape": 1.6})
    evidence = Evidence.of(ROBOT, "zn", simulate_records([truth], "zn", (0.3, 0.15)))
    result = fit(evidence, [AxisEffect(axis="zn", id="hysteresis")])
    residual = held_out(evidence, result)
    assert float(np.mean(residual**2)) == pytest.approx(1.0, abs=0.1)
    # The vibration of the first record does not help to explain the second.
    vibrating_records = simulate_records([AxisEffect(axis="zn", id="vibration")], "zn", (0.3,))
    mixed_evidence = Evidence.of(
        ROBOT, "zn", vibrating_records + simulate_records([], "zn", (0.15,), seed=1)
    )
    vibration_fit = fit(mixed_evidence, [AxisEffect(axis="zn", id="vibration")])
    assert float(np.mean(held_out(mixed_evidence, vibration_fit) ** 2)) > 1.3 * vibration_fit.cost


def test_a_single_record_is_held_out_in_quarters():
    evidence = Evidence.of(ROBOT, "zn", simulate_records([], "zn", (0.3,)))
    held_out_rows = folds(evidence)
    assert len(held_out_rows) == 4
    assert np.sum(held_out_rows, axis=0).tolist() == [1] * len(held_out_rows[0])
