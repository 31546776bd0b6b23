"""Records looked at before a diagnosis: faults are refused or told, effects pass."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.gap.intake.record_checks import check
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from intake_records import AXES, ROBOT, changed, make_commands, measured, refusal


def test_healthy_records_pass_without_a_word():
    records = [measured(), measured(seed=1, rate_hz=2000.0), measured(seed=2, share=0.1)]
    assert check(ROBOT, records) == ()


def effects_on(axis):
    for effect in all_effects()[0].values():
        for formulation in effect.formulations:
            source = ("zn" if axis == "x" else "x") if effect.coupled else None
            asked = AxisEffect(
                axis=axis, id=effect.id, formulation=formulation.name, from_axis=source
            )
            try:
                Attached.of(ROBOT, asked)
            except EffectError:
                continue
            yield asked


@pytest.mark.parametrize("axis", AXES)
def test_no_effect_is_taken_for_a_fault(axis):
    taken = {
        (asked.id, asked.formulation): cautions
        for asked in effects_on(axis)
        if (cautions := check(ROBOT, [measured([asked], rows=3000)]))
    }
    assert not taken


@pytest.mark.parametrize(
    ("axis", "effect", "parameters"),
    [
        ("thx", "gain_error", {"error": -0.5}),
        ("thx", "sensor_gain", {"error": 0.5}),
        ("x", "sensor_quantization", {"step": 2e-5}),
        ("x", "backlash", {"width": 2e-4}),
        ("thx", "sensor_outliers", {"rate": 100.0}),
        ("thx", "contact", {}),
        ("thx", "saturation", {"high_margin": 0.25}),
        ("zn", "thermal_drift", {}),
        ("x", "cross_coupling", {"k": -0.9}),
    ],
)
def test_strong_effects_are_none_either(axis, effect, parameters):
    source = "zn" if effect == "cross_coupling" else None
    asked = AxisEffect(axis=axis, id=effect, parameters=parameters, from_axis=source)
    assert check(ROBOT, [measured([asked])]) == ()


def test_what_is_missing_is_told():
    record = measured()
    bare = changed(
        record,
        {
            ("x", Tap.REF): None,
            ("thx", Tap.MEAS): None,
            **{("zn", tap): None for tap in (Tap.U, Tap.REF, Tap.MEAS)},
        },
    )
    texts = {one.axis: str(one.text) for one in check(ROBOT, [bare])}
    assert texts["x"].startswith("No independent reference (ref)")
    assert texts["thx"].startswith("The axis' own sensor was not recorded")
    assert texts["zn"] == "The axis was commanded but not measured: it is not diagnosed."
    assert not [one for one in check(ROBOT, [bare, measured(seed=1)]) if one.axis == "x"]


def test_an_axis_that_never_moved_is_told_and_not_refused():
    still = make_commands(("thx",), share=0.0)
    record = simulate(ROBOT, (), still, np.random.default_rng(0))
    [caution] = check(ROBOT, [record])
    assert str(caution.text).startswith("The axis was never commanded to move")
    assert caution.axis == "thx"


@pytest.mark.parametrize(
    ("records", "message"),
    [
        ([], "no record was given"),
        (
            [lambda: measured(rows=99)],
            "record 1 (99 rows, 0.098 s): 99 rows; a diagnosis needs 100 rows",
        ),
        ([make_commands], "no measured channel (u, ref or meas) but only commands"),
    ],
)
def test_nothing_to_go_by_is_refused(records, message):
    assert message in refusal(*(make() for make in records))


def test_records_of_another_robot_are_refused():
    record = measured()
    assert "has no axis 'x'; its axes are p" in refusal(record, robot=load_robot("picma"))
    odd = Record(record.time_s, record.columns, record.values, dict.fromkeys(AXES, "m"))
    said = refusal(odd, names=["odd.csv"])
    assert said.startswith("odd.csv: axis 'thx' is in units of m, but robot 'RoTeMiNa'")
    time_s = np.arange(500) / 1000.0
    force = Record.from_signals(
        time_s, {("q", Tap.CMD): 0.1 + 0.0 * time_s, ("q", Tap.MEAS): time_s}, {"q": "m"}
    )
    assert "no q.u column tells which" in refusal(force, robot=load_robot("emps"))


def test_a_command_beyond_the_range_is_told():
    record = measured(axes=("zn",))
    beyond = changed(record, {("zn", Tap.CMD): record.signal("zn", Tap.CMD) + 2e-5})
    [caution] = check(ROBOT, [beyond])
    assert str(caution.text).startswith("A command of 7")


def test_a_robot_that_differs_in_one_figure_only_fits():
    robot = replace(ROBOT, name="other")
    assert check(robot, [measured()]) == ()


@pytest.mark.parametrize("rate_hz", [0.1, 1e5])
def test_slow_and_fast_records_are_welcome(rate_hz):
    records = [measured(seed=seed, rate_hz=rate_hz, axes=("zn",), rows=400) for seed in (0, 1)]
    assert check(ROBOT, records) == ()
    assert diagnose(ROBOT, records).verdict is Verdict.NONE


def test_a_split_record_is_diagnosed_in_pieces():
    """The machine went on moving between the pieces."""
    wrong = AxisEffect(axis="x", id="gain_error", parameters={"error": 0.02})
    record = measured([wrong], axes=("x",))
    kept = np.r_[0:1500, 2600:4000]
    lost = Record(record.time_s[kept], record.columns, record.values[kept], record.units)
    answer = diagnose(ROBOT, [lost])
    assert answer.causes[0].effect == "gain_error"
    assert any(str(one).startswith("Time jumps 1 ×") for one in answer.axes["x"].remarks)
