"""The conformance suite, run on the G-code stage with an emulated controller."""

import pytest

from rotemina.drivers.conformance import CHECKS, CheckVerdict

# Abilities that such a controller lacks.
MISSING_ABILITIES = {
    "VelocityMover", "TrajectoryPlayer", "VoltageOutput", "FastCapturer", "ProfileRunner",
    "TextDisplay", "AnalogInputs", "ToolOutput", "ParameterStore", "EffectCarrier",
    "HysteresisCompensator", "AxisRegulator",
}  # fmt: skip


@pytest.mark.parametrize("single_homing", [True, False])
@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.name)
def test_the_stage_fulfils_the_contract(make_bench, check, single_homing):
    if not single_homing and check.name.startswith("homing"):
        pytest.skip("the check homes a single axis, which this controller refuses")
    result = check.run(make_bench(single_homing=single_homing).make_conformance_bench())
    if result.verdict is CheckVerdict.SKIPPED:
        # The function that advances the clock reads it too, and the bench in memory has no port
        # that can be blocked (test_conformance.py has one).
        missing_ability = result.note.removeprefix("it is no ")
        assert missing_ability in MISSING_ABILITIES or check.name in (
            "stop-when-called",
            "blocked-port",
        ), result.note
    else:
        assert result.verdict is CheckVerdict.PASSED, f"{result.requirement} {result.note}"
