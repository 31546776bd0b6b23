"""The answer in sentences: what was found, how sure it is, how far the gap shrinks."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.gap.diagnosis import (
    UNKNOWN,
    AxisDiagnosis,
    Cause,
    Diagnosis,
    Remainder,
    Shrinkage,
    Verdict,
)
from rotemina.sim.gap.output.wording import details, findings, summary
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
ZEROS = np.zeros(3)
RECORD = Record.from_signals(
    np.arange(3.0), {("zn", Tap.CMD): ZEROS, ("zn", Tap.MEAS): ZEROS}, {"zn": "m"}
)
SHRINKAGE = Shrinkage("zn", Tap.MEAS, 2e-6, 2e-6, 5.7e-7, 1.2e-8, None, 0.9, None, ())
CLOSED = "to the model takes the gap from 2 µm to 570 nm rms on unseen data (noise floor 12 nm)."


def cause(effect="hysteresis", probability=0.97, ambiguous_with=(), from_axis=None):
    figures = (2e-6, 5e-7, 0.9, None)
    return Cause(
        "zn", effect, None, None, Tap.MEAS, from_axis, probability, ambiguous_with, *figures
    )


def axis(verdict, *causes, shrinkage=(SHRINKAGE,), **more):
    return AxisDiagnosis("zn", verdict, (), causes, shrinkage, **more)


def said(one, **others):
    return [str(one) for one in summary(Diagnosis(ROBOT, {"zn": one, **others}), [RECORD])]


def test_one_cause_is_told_with_its_likelihood_and_what_it_takes_away():
    assert said(axis(Verdict.EXPLAINED, cause())) == [
        "zn: hysteresis, very likely.",
        f"Adding it {CLOSED}",
    ]


@pytest.mark.parametrize(
    ("probability", "called"), [(0.951, "very likely"), (0.94, "likely"), (0.6, "possible")]
)
def test_a_probability_is_told_in_words(probability, called):
    found = findings(Diagnosis(ROBOT, {"zn": axis(Verdict.EXPLAINED, cause("creep", probability))}))
    assert [str(one) for one in found] == [f"zn: creep, {called}."]


def test_of_several_each_has_its_likelihood_and_a_set_says_that_it_is_one():
    causes = (cause("creep", 0.8), cause("backlash", 0.99, ("lost_steps",)))
    assert said(axis(Verdict.EXPLAINED, *causes)) == [
        "zn: creep (likely) and backlash or lost steps (these records cannot distinguish them).",
        f"Adding them {CLOSED}",
    ]


def test_what_comes_from_another_axis_names_it():
    coupled = axis(Verdict.EXPLAINED, cause("cross_coupling", from_axis="thx"), shrinkage=())
    assert said(coupled) == ["zn: cross coupling from thx, very likely."]


def test_what_is_left_is_told_beside_what_is_sure():
    depending = Remainder(5e-7, 0.1, (("speed", 0.5), ("axis thx", 0.2), ("time", 0.1)))
    partly = axis(Verdict.PARTLY, cause(), remainder=depending)
    assert said(partly)[2:] == [
        "The rest depends on speed and axis thx; no known effect explains it."
    ]
    assert said(replace(partly, remainder=replace(depending, depends_on=())))[2:] == [
        "No known effect explains the rest."
    ]


def test_an_unknown_gap_is_told_with_its_size():
    unknown = axis(Verdict.UNKNOWN, cause(UNKNOWN))
    assert said(unknown)[:2] == [
        "zn: a gap that no known effect explains.",
        "The gap is 2 µm rms (noise floor 12 nm).",
    ]


def test_axes_without_a_gap_come_last_and_poor_records_say_so():
    poor = axis(Verdict.INSUFFICIENT, shrinkage=())
    quiet = {name: AxisDiagnosis(name, Verdict.NONE, ()) for name in ("x", "y")}
    assert said(poor, **quiet) == [
        "zn: the records do not move the axis enough for a diagnosis.",
        "No gap of its own on x and y.",
    ]
    assert details(Diagnosis(ROBOT, quiet), []) == summary(Diagnosis(ROBOT, quiet), [])
