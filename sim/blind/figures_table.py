"""The figures of the blind test: a table for the terminal, a Markdown page, and a picture."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import BinaryIO

import numpy as np

from rotemina.sim.blind.confidence_intervals import IntervalEstimate
from rotemina.sim.blind.scoring import CaseOutcome

# Columns: description, required level ("" if nothing is required) and number format of each figure.
# A level applies to cases without a remainder; a level in brackets applies to cases with one.
FIGURE_ROWS: dict[str, tuple[str, str, str]] = {
    "top_1": ("first cause correct, one effect", "(≥ 92 %)", "share"),
    "top_1_large_gap": ("… where the gap is ≥ 5 floors", "≥ 98 %", "share"),
    "top_1_small_gap": ("… where it is smaller", "≥ 92 %", "share"),
    "single_exact": ("exactly one effect and no other", "", "share"),
    "set_coverage": ("truth in the reported set", "≥ 97.5 % (95 %)", "share"),
    "set_size": ("mean size of the set", "≤ 1.2", "number"),
    "two_exact": ("exactly two effects", "≥ 90 %", "share"),
    "two_exact_large_gap": ("… where the gap is ≥ 5 floors", "", "share"),
    "two_exact_small_gap": ("… where it is smaller", "", "share"),
    "three_exact": ("exactly three effects", "", "share"),
    "extra_causes": ("false cause named", "(≤ 5 %)", "share"),
    "causes_named": ("verdict: explained or partly", "(≥ 95 %)", "share"),
    "false_accusations": ("false alarms on healthy machines", "0", "share"),
    "unknown_recall": ("unknown effects recognised", "≥ 95 %", "share"),
    "insufficient_recall": ("poor excitation recognised", "", "share"),
    "insufficient_right": ("… or exactly its cause named", "", "share"),
    "closure_median": ("gap closed on unseen data, median", "≥ 99.5 %", "share"),
    "closure_10th_percentile": ("gap closed, 10th percentile", "≥ 95 %", "share"),
    "calibration_error": ("expected calibration error", "≤ 0.04", "number"),
    "seconds_median": ("seconds per case, median", "≤ 10 s", "seconds"),
    "seconds_greatest": ("seconds per case, maximum", "≤ 120 s", "seconds"),
    "seconds_healthy_median": ("seconds per healthy case, median", "≤ 3 s", "seconds"),
}

_LEVEL_HEADING = "level (with a remainder)"

# Titles of the two groups of faulty machines.
REMAINDER_GROUP_TITLES = {
    "without_remainder": "faulty, without a remainder",
    "with_remainder": "faulty, with a remainder",
}


def format_figure(figure: IntervalEstimate, form: str) -> str:
    """Return a figure with its interval, or a dash if there was no case."""
    if figure.value is None or figure.low is None or figure.high is None:
        return "–"
    if form == "share":
        low, high = 100.0 * figure.low, 100.0 * figure.high
        return f"{100.0 * figure.value:.1f} % ({low:.1f}–{high:.1f})"
    digits = 1 if form == "seconds" else 3
    return f"{figure.value:.{digits}f} ({figure.low:.{digits}f}–{figure.high:.{digits}f})"


def format_plain_table(figures: Mapping[str, IntervalEstimate]) -> str:
    """Return the figures as lines for a terminal, with 95 % intervals in brackets."""
    lines = [f"{'':40} {_LEVEL_HEADING:>24}  {'reached (95 %)':<24} {'n':>5}"]
    for key, figure in figures.items():
        text, level, form = FIGURE_ROWS[key]
        lines.append(
            f"{text:40} {level:>24}  {format_figure(figure, form):<24} {figure.case_count:>5}"
        )
    return "\n".join(lines)


def format_markdown_table(columns: Mapping[str, Mapping[str, IntervalEstimate]]) -> str:
    """Return the figures of several diagnoses side by side, as Markdown.

    ``columns`` maps headings to figures. Figures without any case are omitted.
    """
    head = ["", _LEVEL_HEADING, *columns, "n"]
    lines = [f"| {' | '.join(head)} |", f"|{'---|' * len(head)}"]
    first = next(iter(columns.values()))
    for key, figure in first.items():
        text, level, form = FIGURE_ROWS[key]
        if figure.case_count == 0:
            continue
        cells = [
            format_figure(column[key], form) if key in column else "–"
            for column in columns.values()
        ]
        lines.append(f"| {text} | {level} | {' | '.join(cells)} | {figure.case_count} |")
    return "\n".join(lines)


def format_page(
    figures: Mapping[str, IntervalEstimate],
    outcomes: Sequence[CaseOutcome],
    picture: str,
    origin: str,
    others: Mapping[str, Mapping[str, IntervalEstimate]] | None = None,
) -> str:
    """Return the report as Markdown.

    Parameters
    ----------
    figures : figures by name.
    outcomes : outcomes of all cases.
    picture : path of the picture of the confusion matrix.
    origin : text that says which cases were used.
    others : figures of other diagnoses, by column heading.
    """
    kinds = Counter(outcome.kind for outcome in outcomes)
    kind_counts = ", ".join(f"{number} {kind}" for kind, number in kinds.most_common())
    heading = f"{len(outcomes)} cases: {kind_counts}. Made by `rotemina gap blind`, {origin}."
    return f"""# Blind test of the diagnosis

{heading} Each figure has its 95 % interval in brackets.

{format_markdown_table({"reached": figures, **(others or {})})}

![Confusion matrix: true effect, and effect named first]({picture})
"""


def draw_confusion(counts: Mapping[tuple[str, str], int], file: BinaryIO) -> None:
    """Draw a confusion matrix as SVG.

    ``counts`` maps (true effect, effect named first) to the number of cases. Rows are the true
    effects; colours show shares of a row.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    names = sorted({name for pair in counts for name in pair})
    table = np.array(
        [[counts.get((true_name, answer), 0) for answer in names] for true_name in names]
    )
    shares = table / np.maximum(table.sum(axis=1, keepdims=True), 1)
    size = max(4.0, 1.5 + 0.28 * len(names))
    with rc_context({"svg.hashsalt": "rotemina"}):
        figure = Figure(figsize=(size, size), layout="constrained")
        axes = figure.subplots()
        axes.imshow(shares, cmap="Blues", vmin=0.0, vmax=1.0)
        axes.set_xticks(range(len(names)), names, rotation=90, fontsize=7)
        axes.set_yticks(range(len(names)), names, fontsize=7)
        axes.set_xlabel("named first")
        axes.set_ylabel("true effect")
        for i, j in zip(*np.nonzero(table), strict=True):
            colour = "white" if shares[i, j] > 0.5 else "black"
            axes.text(j, i, str(table[i, j]), ha="center", va="center", fontsize=6, color=colour)
        figure.savefig(file, format="svg", metadata={"Date": None})
