"""Errors of the inverses, as a text table and as JSON."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rotemina.sim.messages import MessageWording, format_rounded, message
from rotemina.sim.units import align_columns, format_exact, format_percent

if TYPE_CHECKING:
    from rotemina.sim.compensate import InverseKind, InverseModel, InverseResidual, TrainingResult

_MICRO_PER_SI = 1e6


def format_table(
    model: "InverseModel",
    residuals: Mapping["InverseKind", "InverseResidual"],
    wording: MessageWording,
) -> str:
    """Return a table of the differences between computed and recorded commands.

    The table has one row for each kind of inverse.
    """
    from rotemina.sim.compensate import KIND_NAMES

    unit = f"µ{model.unit}"
    header: tuple[str, ...] = (
        message("cli", "inverse"),
        message("cli", "rms [{unit}]").fill(unit=unit),
        message("cli", "rms without offset [{unit}]").fill(unit=unit),
        message("cli", "worst [{unit}]").fill(unit=unit),
        message("cli", "rms / range"),
    )
    rows = [
        (
            message("engine", KIND_NAMES[kind]),
            format_rounded(residual.rms * _MICRO_PER_SI),
            format_rounded(residual.aligned * _MICRO_PER_SI),
            format_rounded(residual.worst * _MICRO_PER_SI),
            format_percent(residual.share),
        )
        for kind, residual in residuals.items()
    ]
    title = message("cli", "axis {axis}: command of the inverse minus recorded command")
    lines = [
        wording.format_message(title.fill(axis=model.axis)),
        align_columns([[wording.format_field(cell) for cell in row] for row in (header, *rows)]),
    ]
    excluded_share = max(residual.beyond for residual in residuals.values())
    if excluded_share > 0.0:
        low, high = model.desired_range
        warning = message(
            "cli",
            "{share} of the rows are not evaluated, because they are outside the training range, "
            "{low} to {high}",
        )
        low_text, high_text = (format_exact(end, model.unit, size=high) for end in (low, high))
        lines.append(
            wording.format_message(
                warning.fill(share=format_percent(excluded_share), low=low_text, high=high_text)
            )
        )
    return "\n".join(lines)


def make_document(
    model: "InverseModel",
    residuals: Mapping["InverseKind", "InverseResidual"],
    training_result: "TrainingResult",
) -> dict[str, Any]:
    """Return the errors and the recommendation as JSON."""
    return {
        "axis": model.axis,
        "unit": model.unit,
        "desired_range": list(model.desired_range),
        "lag_s": model.lag_s,
        "residuals": {kind: residual.as_json() for kind, residual in residuals.items()},
        "recommended": training_result.recommended_kind,
        "why": training_result.recommendation_reason,
        "remarks": list(training_result.remarks),
    }
