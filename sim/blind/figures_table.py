"""The figures of the blind test as text: a table for the terminal, a page of Markdown."""

from collections import Counter
from collections.abc import Mapping, Sequence

from rotemina.sim.blind.intervals import Figure
from rotemina.sim.blind.scoring import Outcome

# What each figure is, the level that it is to reach on cases without a remainder and in brackets on
# those with one ("" where there is none), and its form.
ROWS: dict[str, tuple[str, str, str]] = {
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

_LEVEL = "level (with a remainder)"

# The halves of the faulty machines, as they are headed.
HALVES = {
    "without_remainder": "faulty, without a remainder",
    "with_remainder": "faulty, with a remainder",
}


def shown(figure: Figure, form: str) -> str:
    """Return a figure with its interval, or a dash without a case."""
    if figure.value is None or figure.low is None or figure.high is None:
        return "–"
    if form == "share":
        low, high = 100.0 * figure.low, 100.0 * figure.high
        return f"{100.0 * figure.value:.1f} % ({low:.1f}–{high:.1f})"
    digits = 1 if form == "seconds" else 3
    return f"{figure.value:.{digits}f} ({figure.low:.{digits}f}–{figure.high:.{digits}f})"


def plain_table(figures: Mapping[str, Figure]) -> str:
    """Return the figures as lines for a terminal, 95 % intervals in brackets."""
    lines = [f"{'':40} {_LEVEL:>24}  {'reached (95 %)':<24} {'n':>5}"]
    for key, figure in figures.items():
        text, level, form = ROWS[key]
        lines.append(f"{text:40} {level:>24}  {shown(figure, form):<24} {figure.number:>5}")
    return "\n".join(lines)


def markdown_table(columns: Mapping[str, Mapping[str, Figure]]) -> str:
    """Return the figures of several contestants side by side; ``columns``: heading -> figures.

    A figure of no case is left out.
    """
    head = ["", _LEVEL, *columns, "n"]
    lines = [f"| {' | '.join(head)} |", f"|{'---|' * len(head)}"]
    first = next(iter(columns.values()))
    for key, figure in first.items():
        text, level, form = ROWS[key]
        if figure.number == 0:
            continue
        cells = [shown(each[key], form) if key in each else "–" for each in columns.values()]
        lines.append(f"| {text} | {level} | {' | '.join(cells)} | {figure.number} |")
    return "\n".join(lines)


def page(
    figures: Mapping[str, Figure],
    outcomes: Sequence[Outcome],
    picture: str,
    origin: str,
    others: Mapping[str, Mapping[str, Figure]] | None = None,
) -> str:
    """Return the report as Markdown.

    ``origin``: which cases these are; ``others``: figures of other contestants by their names.
    """
    kinds = Counter(outcome.kind for outcome in outcomes)
    made_of = ", ".join(f"{number} {kind}" for kind, number in kinds.most_common())
    heading = f"{len(outcomes)} cases: {made_of}. Made by `rotemina gap blind`, {origin}."
    return f"""# Blind test of the diagnosis

{heading} Every figure with its 95 % interval.

{markdown_table({"reached": figures, **(others or {})})}

![Confusion matrix: what is there, and what was named first]({picture})
"""
