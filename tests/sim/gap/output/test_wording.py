"""The result in sentences: causes, their probability, and the shrinkage of the gap."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.gap.output import write_details, write_findings
from rotemina.sim.gap.output.wording import write_summary
from rotemina.sim.gap.result import (
    UNKNOWN_EFFECT_ID,
    AxisDiagnosis,
    Diagnosis,
    GapCause,
    GapRemainder,
    GapShrinkage,
    GapVerdict,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
ZEROS = np.zeros(3)
RECORD = Record.from_signals(
    np.arange(3.0), {("zn", Tap.CMD): ZEROS, ("zn", Tap.MEAS): ZEROS}, {"zn": "m"}
)
SHRINKAGE = GapShrinkage("zn", Tap.MEAS, 2e-6, 2e-6, 5.7e-7, 1.2e-8, None, 0.9, None, ())
CLOSED = "to the model takes the gap from 2 µm to 570 nm rms on unseen data (noise floor 12 nm)."


def make_cause(effect="hysteresis", probability=0.97, ambiguous_with=(), from_axis=None):
    figures = (2e-6, 5e-7, 0.9, None)
    return GapCause(
        "zn", effect, None, None, Tap.MEAS, from_axis, probability, ambiguous_with, *figures
    )


def make_axis(verdict, *causes, shrinkage=(SHRINKAGE,), **properties):
    return AxisDiagnosis("zn", verdict, (), causes, shrinkage, **properties)


def summarize(zn, **others):
    diagnosis = Diagnosis(ROBOT, {"zn": zn, **others})
    return [str(sentence) for sentence in write_summary(diagnosis, [RECORD])]


def test_one_cause_is_reported_with_its_likelihood_and_its_share_of_the_gap():
    assert summarize(make_axis(GapVerdict.EXPLAINED, make_cause())) == [
        "zn: hysteresis, very likely.",
        f"Adding it {CLOSED}",
    ]


@pytest.mark.parametrize(
    ("probability", "expected"), [(0.951, "very likely"), (0.94, "likely"), (0.6, "possible")]
)
def test_a_probability_is_expressed_in_words(probability, expected):
    sentences = write_findings(
        Diagnosis(ROBOT, {"zn": make_axis(GapVerdict.EXPLAINED, make_cause("creep", probability))})
    )
    assert [str(sentence) for sentence in sentences] == [f"zn: creep, {expected}."]


def test_several_causes_have_likelihoods_and_alternatives_are_marked():
    causes = (make_cause("creep", 0.8), make_cause("backlash", 0.99, ("lost_steps",)))
    assert summarize(make_axis(GapVerdict.EXPLAINED, *causes)) == [
        "zn: creep (likely) and backlash or lost steps (these records cannot distinguish them).",
        f"Adding them {CLOSED}",
    ]


def test_a_coupling_names_the_other_axis():
    coupled = make_axis(
        GapVerdict.EXPLAINED, make_cause("cross_coupling", from_axis="thx"), shrinkage=()
    )
    assert summarize(coupled) == ["zn: cross coupling from thx, very likely."]


def test_the_remainder_is_reported_after_the_sure_cause():
    remainder = GapRemainder(5e-7, 0.1, (("speed", 0.5), ("axis thx", 0.2), ("time", 0.1)))
    partly = make_axis(GapVerdict.PARTLY, make_cause(), remainder=remainder)
    assert summarize(partly)[2:] == [
        "The rest depends on speed and axis thx; no known effect explains it."
    ]
    assert summarize(replace(partly, remainder=replace(remainder, depends_on=())))[2:] == [
        "No known effect explains the rest."
    ]


def test_an_unknown_gap_is_reported_with_its_size():
    unknown = make_axis(GapVerdict.UNKNOWN, make_cause(UNKNOWN_EFFECT_ID))
    assert summarize(unknown)[:2] == [
        "zn: a gap that no known effect explains.",
        "The gap is 2 µm rms (noise floor 12 nm).",
    ]


def test_axes_without_a_gap_come_last_and_poor_records_are_reported():
    poor = make_axis(GapVerdict.INSUFFICIENT, shrinkage=())
    healthy_axes = {name: AxisDiagnosis(name, GapVerdict.NONE, ()) for name in ("x", "y")}
    assert summarize(poor, **healthy_axes) == [
        "zn: the records do not move the axis enough for a diagnosis.",
        "No gap of its own on x and y.",
    ]
    assert write_details(Diagnosis(ROBOT, healthy_axes), []) == write_summary(
        Diagnosis(ROBOT, healthy_axes), []
    )
