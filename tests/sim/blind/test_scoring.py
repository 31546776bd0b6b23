"""Figures of the blind test for hand-made answers."""

import io
from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.blind import (
    CaseOutcome,
    count_confusion,
    draw_confusion,
    format_page,
    format_plain_table,
    score,
    seal_label,
    split_by_remainder,
)
from rotemina.sim.blind.confidence_intervals import estimate_by_bootstrap, estimate_share
from rotemina.sim.blind.figures_table import format_markdown_table
from rotemina.sim.blind.scoring import compute_calibration_error, make_calibration_table
from rotemina.sim.errors import SealError


def make_effect(name, axis="x", from_axis=None, **entries):
    return {"axis": axis, "effect": name, "from_axis": from_axis, **entries}


def make_cause(name, axis="x", probability=0.9, ambiguous=(), from_axis=None):
    return make_effect(
        name, axis, from_axis, probability=probability, ambiguous_with=list(ambiguous)
    )


def make_outcome(truth, causes, verdict=None, *, floors=10.0, closure=None, answered_verdict=None):
    label = {"verdict": verdict or ("explained" if truth else "none"), "effects": truth}
    answer = {"verdict": answered_verdict or ("explained" if causes else "none"), "causes": causes}
    return CaseOutcome("case", {**label, "floors": floors}, answer, 2.0, closure)


def test_only_the_first_cause_counts_and_only_with_the_right_axis_and_source():
    right = make_outcome([make_effect("creep")], [make_cause("creep")])
    elsewhere = make_outcome([make_effect("creep")], [make_cause("creep", "y")])
    second = make_outcome(
        [make_effect("creep")], [make_cause("delay"), make_cause("creep")], floors=3.0
    )
    figures = score([right, elsewhere, second])
    assert figures["top_1"].value == pytest.approx(1 / 3)
    assert figures["top_1_large_gap"].value == pytest.approx(1 / 2)
    assert figures["top_1_small_gap"].value == 0.0
    assert figures["set_coverage"].value == pytest.approx(2 / 3)
    truth = [make_effect("cross_coupling", from_axis="y")]
    assert make_outcome(truth, [make_cause("cross_coupling", from_axis="y")]).is_exact
    assert not make_outcome(truth, [make_cause("cross_coupling", from_axis="z")]).is_first_correct


def test_a_set_of_causes_covers_its_members_and_counts_its_size():
    for member, coverage in (("delay", 1.0), ("creep", 0.0)):
        cause = make_cause("amplifier_lag", ambiguous=[member])
        figures = score([make_outcome([make_effect("delay")], [cause])])
        assert figures["top_1"].value == 0.0
        assert figures["set_coverage"].value == coverage
        assert figures["set_size"].value == 2.0


def test_two_effects_are_exact_in_any_order_but_not_with_a_third():
    truth = [make_effect("creep"), make_effect("delay", "y")]
    both = [make_cause("delay", "y"), make_cause("creep")]
    assert score([make_outcome(truth, both)])["two_exact"].value == 1.0
    assert score([make_outcome(truth, both[:1])])["two_exact"].value == 0.0
    assert score([make_outcome(truth, [*both, make_cause("contact")])])["two_exact"].value == 0.0


def test_recall_of_verdicts_and_false_accusations_of_healthy_machines():
    figures = score(
        [
            make_outcome([], []),
            make_outcome([], [make_cause("delay")]),
            make_outcome([make_effect("unknown")], [], "unknown", answered_verdict="unknown"),
            make_outcome([make_effect("unknown")], [make_cause("creep")], "unknown"),
            make_outcome(
                [], [], "insufficient_excitation", answered_verdict="insufficient_excitation"
            ),
        ]
    )
    assert figures["false_accusations"].value == 0.5
    assert figures["unknown_recall"].value == 0.5
    assert figures["insufficient_recall"].value == 1.0


def test_a_failed_diagnosis_is_wrong():
    failed = CaseOutcome("case", {"verdict": "none", "effects": []}, {"verdict": "failed"}, 1.0)
    assert score([failed])["false_accusations"].value == 1.0
    assert not failed.is_correct


def test_calibration_error_is_the_distance_of_probabilities_from_frequencies():
    sure = [make_outcome([make_effect("creep")], [make_cause("creep", probability=0.75)])] * 3
    wrong = [make_outcome([make_effect("creep")], [make_cause("delay", probability=0.75)])]
    table = make_calibration_table([*sure, *wrong])
    assert compute_calibration_error(table) == pytest.approx(0.0)
    assert compute_calibration_error(make_calibration_table(wrong)) == pytest.approx(0.75)


def test_closure_is_given_as_median_and_tenth_percentile():
    outcomes = [
        make_outcome([make_effect("creep")], [make_cause("creep")], closure=c)
        for c in np.linspace(0.5, 1.0, 11)
    ]
    figures = score(outcomes)
    assert figures["closure_median"].value == pytest.approx(0.75)
    assert figures["closure_10th_percentile"].value == pytest.approx(0.55)
    low, high = figures["closure_median"].low, figures["closure_median"].high
    assert 0.5 < low < 0.75 < high < 1.0


def test_wilsons_interval_matches_published_values():
    # Newcombe 1998, table I: 81 of 263, and 0 of 20.
    figure = estimate_share([True] * 81 + [False] * 182)
    assert (figure.low, figure.high) == (
        pytest.approx(0.2553, abs=1e-4),
        pytest.approx(0.3662, abs=1e-4),
    )
    figure_of_none = estimate_share([False] * 20)
    assert (figure_of_none.low, figure_of_none.high) == (0.0, pytest.approx(0.1611, abs=1e-4))


def test_without_cases_there_is_no_figure():
    assert estimate_share([]).value is None
    assert estimate_by_bootstrap(np.array([]), np.median).as_json() == {
        "value": None,
        "interval": [None, None],
        "n": 0,
    }
    assert "–" in format_plain_table(score([make_outcome([], [])]))


def test_the_confusion_matrix_is_counted_and_drawn_reproducibly():
    counts = count_confusion(
        [
            make_outcome([make_effect("creep")], [make_cause("delay")]),
            make_outcome([make_effect("creep")], [make_cause("creep")]),
            make_outcome([], []),
        ]
    )
    assert counts == {("creep", "delay"): 1, ("creep", "creep"): 1, ("none", "none"): 1}
    first, second = io.BytesIO(), io.BytesIO()
    for file in (first, second):
        draw_confusion(counts, file)
    assert first.getvalue().startswith(b"<?xml")
    assert second.getvalue() == first.getvalue()


def test_tables_contain_every_figure_that_has_cases():
    outcomes = [make_outcome([make_effect("creep")], [make_cause("creep")], closure=0.9)]
    figures = score(outcomes)
    text = format_page(
        figures, outcomes, "confusion.svg", "2 cases of seed `3`", {"naive": figures}
    )
    assert "| first cause correct, one effect | (≥ 92 %) | 100.0 % (20.7–100.0) | 100.0 %" in text
    assert "![Confusion matrix" in text
    figures_with_cases = [figure for figure in figures.values() if figure.case_count > 0]
    assert 0 < len(figures_with_cases) < len(figures)
    assert (
        len(format_markdown_table({"reached": figures}).splitlines()) == len(figures_with_cases) + 2
    )


def test_a_sealed_label_cannot_be_exchanged():
    label = {"verdict": "none", "effects": []}
    sealed = seal_label(label, "salt")
    sealed.check({"effects": [], "verdict": "none"}, "salt", "case")
    for other, salt in (({"verdict": "unknown", "effects": []}, "salt"), (label, "pepper")):
        with pytest.raises(SealError, match="case: its label is not the one that was sealed"):
            sealed.check(other, salt, "case")
    assert seal_label(label, "one").digest != seal_label(label, "two").digest


def test_causes_count_despite_a_remainder_and_outcomes_are_split_by_it():
    partly = make_outcome([make_effect("creep")], [make_cause("creep")], answered_verdict="partly")
    with_remainder = replace(
        partly, label={**partly.label, "remainder": {"axis": "x", "floors": 2.0}}
    )
    extra = make_outcome([make_effect("creep")], [make_cause("creep"), make_cause("delay")])
    assert score([partly])["top_1"].value == score([partly])["single_exact"].value == 1.0
    figures = score([partly, extra])
    assert figures["extra_causes"].value == 0.5
    assert figures["causes_named"].value == 1.0
    split = split_by_remainder([with_remainder, extra, make_outcome([], [])])
    assert split == {"without_remainder": [extra], "with_remainder": [with_remainder]}


def test_the_right_cause_from_a_poor_motion_is_no_error():
    hidden = {"verdict": "insufficient_excitation", "kind": "poor", "effects": []}
    hidden["hidden"] = [make_effect("creep")]

    def make_answer(*causes):
        return replace(make_outcome([], list(causes)), label=hidden)

    right, wrong = make_answer(make_cause("creep")), make_answer(make_cause("delay"))
    too_much = make_answer(make_cause("creep"), make_cause("delay"))
    silent = replace(right, answer={"verdict": "insufficient_excitation", "causes": []})
    assert [outcome.is_correct for outcome in (right, wrong, too_much, silent)] == [
        True,
        False,
        False,
        True,
    ]
    figures = score([right, wrong, too_much, silent])
    assert figures["insufficient_recall"].value == 0.25
    assert figures["insufficient_right"].value == 0.5
    assert make_calibration_table([right, wrong]).tolist() == [[0.9, 1.0], [0.9, 0.0]]
