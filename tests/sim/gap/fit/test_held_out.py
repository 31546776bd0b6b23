"""What a fit leaves of records that it did not see."""

import numpy as np
import pytest
from tests.sim.gap.fit.test_output_error import measured

from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.held_out import _bounded_minimum, folds, held_out
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")


def test_what_is_held_out_is_predicted_from_the_other_records():
    truth = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 5e-6, "shape": 1.6})
    evidence = Evidence.of(ROBOT, "zn", measured([truth], "zn", (0.3, 0.15)))
    found = fit(evidence, [AxisEffect(axis="zn", id="hysteresis")])
    left = held_out(evidence, found)
    assert float(np.mean(left**2)) == pytest.approx(1.0, abs=0.1)
    # What explains one record alone is of no help with the other: the tone of the first.
    shaken = measured([AxisEffect(axis="zn", id="vibration")], "zn", (0.3,))
    mixed = Evidence.of(ROBOT, "zn", shaken + measured([], "zn", (0.15,), seed=1))
    tone = fit(mixed, [AxisEffect(axis="zn", id="vibration")])
    assert float(np.mean(held_out(mixed, tone) ** 2)) > 1.3 * tone.cost


def test_a_single_record_is_held_out_in_quarters():
    evidence = Evidence.of(ROBOT, "zn", measured([], "zn", (0.3,)))
    out = folds(evidence)
    assert len(out) == 4
    assert np.sum(out, axis=0).tolist() == [1] * len(out[0])


def test_a_fit_of_which_no_row_speaks_stays_where_it_is():
    nothing = np.zeros((2, 2))
    where = _bounded_minimum(nothing, np.zeros(2), np.array([0.3, 4.0]), np.zeros(2), np.ones(2))
    assert where.tolist() == [0.3, 1.0]
