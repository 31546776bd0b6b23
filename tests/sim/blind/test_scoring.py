"""Figures of the test from answers made by hand."""

import io
from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.blind.figures_table import markdown_table, page, plain_table
from rotemina.sim.blind.intervals import resampled, share
from rotemina.sim.blind.picture import draw_confusion
from rotemina.sim.blind.scoring import (
    Outcome,
    calibration_table,
    confusion,
    expected_calibration_error,
    halves,
    score,
)
from rotemina.sim.blind.sealing import SealError, seal


def effect(name, axis="x", from_axis=None, **more):
    return {"axis": axis, "effect": name, "from_axis": from_axis, **more}


def cause(name, axis="x", probability=0.9, ambiguous=(), from_axis=None):
    return effect(name, axis, from_axis, probability=probability, ambiguous_with=list(ambiguous))


def outcome(truth, causes, verdict=None, *, floors=10.0, closure=None, told=None):
    label = {"verdict": verdict or ("explained" if truth else "none"), "effects": truth}
    answer = {"verdict": told or ("explained" if causes else "none"), "causes": causes}
    return Outcome("case", {**label, "floors": floors}, answer, 2.0, closure)


def test_the_first_cause_counts_and_must_sit_on_the_right_axis():
    right = outcome([effect("creep")], [cause("creep")])
    elsewhere = outcome([effect("creep")], [cause("creep", "y")])
    second = outcome([effect("creep")], [cause("delay"), cause("creep")], floors=3.0)
    figures = score([right, elsewhere, second])
    assert figures["top_1"].value == pytest.approx(1 / 3)
    assert figures["top_1_large_gap"].value == pytest.approx(1 / 2)
    assert figures["top_1_small_gap"].value == 0.0
    assert figures["set_coverage"].value == pytest.approx(2 / 3)


def test_coupling_counts_with_its_source_alone():
    truth = [effect("cross_coupling", from_axis="y")]
    assert outcome(truth, [cause("cross_coupling", from_axis="y")]).exact
    assert not outcome(truth, [cause("cross_coupling", from_axis="z")]).first_right


def test_a_set_covers_what_it_holds_and_costs_its_size():
    figures = score([outcome([effect("delay")], [cause("amplifier_lag", ambiguous=["delay"])])])
    assert figures["top_1"].value == 0.0
    assert figures["set_coverage"].value == 1.0
    assert figures["set_size"].value == 2.0
    missed = score([outcome([effect("delay")], [cause("amplifier_lag", ambiguous=["creep"])])])
    assert missed["set_coverage"].value == 0.0


def test_two_effects_are_exact_in_any_order_and_with_nothing_beside_them():
    truth = [effect("creep"), effect("delay", "y")]
    both = [cause("delay", "y"), cause("creep")]
    assert score([outcome(truth, both)])["two_exact"].value == 1.0
    assert score([outcome(truth, both[:1])])["two_exact"].value == 0.0
    assert score([outcome(truth, [*both, cause("contact")])])["two_exact"].value == 0.0


def test_first_class_answers_are_recalled_and_the_healthy_not_accused():
    figures = score(
        [
            outcome([], []),
            outcome([], [cause("delay")]),
            outcome([effect("unknown")], [], "unknown", told="unknown"),
            outcome([effect("unknown")], [cause("creep")], "unknown"),
            outcome([], [], "insufficient_excitation", told="insufficient_excitation"),
        ]
    )
    assert figures["false_accusations"].value == 0.5
    assert figures["unknown_recall"].value == 0.5
    assert figures["insufficient_recall"].value == 1.0


def test_a_diagnosis_that_failed_is_wrong():
    failed = Outcome("case", {"verdict": "none", "effects": []}, {"verdict": "failed"}, 1.0)
    assert score([failed])["false_accusations"].value == 1.0
    assert not failed.right


def test_calibration_error_is_how_far_probabilities_are_from_what_comes_true():
    sure = [outcome([effect("creep")], [cause("creep", probability=0.75)])] * 3
    wrong = [outcome([effect("creep")], [cause("delay", probability=0.75)])]
    table = calibration_table([*sure, *wrong])
    assert expected_calibration_error(table) == pytest.approx(0.0)
    assert expected_calibration_error(calibration_table(wrong)) == pytest.approx(0.75)


def test_closure_is_told_by_median_and_tenth_percentile():
    outcomes = [
        outcome([effect("creep")], [cause("creep")], closure=c) for c in np.linspace(0.5, 1.0, 11)
    ]
    figures = score(outcomes)
    assert figures["closure_median"].value == pytest.approx(0.75)
    assert figures["closure_10th_percentile"].value == pytest.approx(0.55)
    low, high = figures["closure_median"].low, figures["closure_median"].high
    assert 0.5 < low < 0.75 < high < 1.0


def test_wilsons_interval_is_the_published_one():
    # Newcombe 1998, table I: 81 of 263, and 0 of 20.
    figure = share([True] * 81 + [False] * 182)
    assert (figure.low, figure.high) == (
        pytest.approx(0.2553, abs=1e-4),
        pytest.approx(0.3662, abs=1e-4),
    )
    none = share([False] * 20)
    assert (none.low, none.high) == (0.0, pytest.approx(0.1611, abs=1e-4))


def test_no_cases_no_figure():
    assert share([]).value is None
    assert resampled(np.array([]), np.median).as_json() == {
        "value": None,
        "interval": [None, None],
        "n": 0,
    }
    assert "–" in plain_table(score([outcome([], [])]))


def test_the_confusion_matrix_counts_and_is_drawn():
    counts = confusion(
        [
            outcome([effect("creep")], [cause("delay")]),
            outcome([effect("creep")], [cause("creep")]),
            outcome([], []),
        ]
    )
    assert counts == {("creep", "delay"): 1, ("creep", "creep"): 1, ("none", "none"): 1}
    file = io.BytesIO()
    draw_confusion(counts, file)
    assert file.getvalue().startswith(b"<?xml")
    again = io.BytesIO()
    draw_confusion(counts, again)
    assert again.getvalue() == file.getvalue()


def test_tables_hold_every_figure_that_any_case_has():
    outcomes = [outcome([effect("creep")], [cause("creep")], closure=0.9)]
    figures = score(outcomes)
    text = page(figures, outcomes, "confusion.svg", "2 cases of seed `3`", {"naive": figures})
    assert "| first cause correct, one effect | (≥ 92 %) | 100.0 % (20.7–100.0) | 100.0 %" in text
    assert "![Confusion matrix" in text
    counted = [one for one in figures.values() if one.number > 0]
    assert 0 < len(counted) < len(figures)
    assert len(markdown_table({"reached": figures}).splitlines()) == len(counted) + 2


def test_a_sealed_label_cannot_be_exchanged():
    label = {"verdict": "none", "effects": []}
    sealed = seal(label, "salt")
    sealed.check({"effects": [], "verdict": "none"}, "salt", "case")
    for other, salt in (({"verdict": "unknown", "effects": []}, "salt"), (label, "pepper")):
        with pytest.raises(SealError, match="case: its label is not the one that was sealed"):
            sealed.check(other, salt, "case")
    assert seal(label, "one").digest != seal(label, "two").digest


def test_causes_count_beside_a_remainder_and_halves_are_told_apart():
    partly = outcome([effect("creep")], [cause("creep")], told="partly")
    rest = replace(partly, label={**partly.label, "remainder": {"axis": "x", "floors": 2.0}})
    extra = outcome([effect("creep")], [cause("creep"), cause("delay")])
    assert score([partly])["top_1"].value == score([partly])["single_exact"].value == 1.0
    figures = score([partly, extra])
    assert figures["extra_causes"].value == 0.5
    assert figures["causes_named"].value == 1.0
    parts = halves([rest, extra, outcome([], [])])
    assert parts == {"without_remainder": [extra], "with_remainder": [rest]}


def test_a_poor_motion_that_tells_the_cause_all_the_same_is_no_error():
    hidden = {"verdict": "insufficient_excitation", "kind": "poor", "effects": []}
    hidden["hidden"] = [effect("creep")]

    def answered(*causes):
        return replace(outcome([], list(causes)), label=hidden)

    right, wrong = answered(cause("creep")), answered(cause("delay"))
    too_much = answered(cause("creep"), cause("delay"))
    silent = replace(right, answer={"verdict": "insufficient_excitation", "causes": []})
    assert [one.right for one in (right, wrong, too_much, silent)] == [True, False, False, True]
    figures = score([right, wrong, too_much, silent])
    assert figures["insufficient_recall"].value == 0.25
    assert figures["insufficient_right"].value == 0.5
    assert calibration_table([right, wrong]).tolist() == [[0.9, 1.0], [0.9, 0.0]]
