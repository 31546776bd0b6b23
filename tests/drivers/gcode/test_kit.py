"""The G-code stage, put to the conformance kit over a line in memory to an emulated controller."""

import pytest

from rotemina.drivers.conformance.check import Verdict
from rotemina.drivers.conformance.suite import CHECKS

# What such a controller cannot do; its clock is read by what advances it too, and the bench in
# memory has no port that could be blocked (test_conformance.py has one).
NOT_HERE = {
    "VelocityMover", "TrajectoryPlayer", "VoltageOutput", "Capturer", "ProfileRunner", "Display",
    "AnalogInputs", "ToolOutput", "Parameterised", "EffectCarrier", "Compensator", "Regulator",
}  # fmt: skip


@pytest.mark.parametrize("single_homing", [True, False])
@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.name)
def test_the_stage_keeps_the_contract(joined, check, single_homing):
    if not single_homing and check.name.startswith("homing"):
        pytest.skip("these home one axis, which this controller refuses")
    result = check.run(joined(single_homing=single_homing).kit())
    if result.verdict is Verdict.SKIPPED:
        lacking = result.note.removeprefix("it is no ")
        assert lacking in NOT_HERE or check.name in ("stop-when-called", "blocked-port"), (
            result.note
        )
    else:
        assert result.verdict is Verdict.PASSED, f"{result.demand} {result.note}"
