"""The figures of inverses side by side, as text and as JSON."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rotemina.sim.messages import Wording, message
from rotemina.sim.quantities import exact, percent, rounded
from rotemina.sim.tables import aligned

if TYPE_CHECKING:
    from rotemina.sim.compensate.inverse_parameters import InverseModel, Kind
    from rotemina.sim.compensate.judgement import Residual
    from rotemina.sim.compensate.training import Trained

_MICRO = 1e6


def table(model: "InverseModel", residuals: Mapping["Kind", "Residual"], wording: Wording) -> str:
    """Return a row for each kind: the difference between its command and the recorded one."""
    from rotemina.sim.compensate.judgement import NAMES

    unit = f"µ{model.unit}"
    head: tuple[str, ...] = (
        message("cli", "inverse"),
        message("cli", "rms [{unit}]").fill(unit=unit),
        message("cli", "rms without offset [{unit}]").fill(unit=unit),
        message("cli", "worst [{unit}]").fill(unit=unit),
        message("cli", "rms / range"),
    )
    rows = [
        (
            message("engine", NAMES[kind]),
            rounded(one.rms * _MICRO),
            rounded(one.aligned * _MICRO),
            rounded(one.worst * _MICRO),
            percent(one.share),
        )
        for kind, one in residuals.items()
    ]
    title = message("cli", "axis {axis}: command of the inverse minus recorded command")
    lines = [
        wording.of(title.fill(axis=model.axis)),
        aligned([[wording.shown(cell) for cell in row] for row in (head, *rows)]),
    ]
    beyond = max(one.beyond for one in residuals.values())
    if beyond > 0.0:
        low, high = model.desired_range
        said = message(
            "cli",
            "{share} of the rows are not judged: they lie outside {low} to {high}, the range of "
            "the training",
        )
        low_text, high_text = (exact(end, model.unit, size=high) for end in (low, high))
        lines.append(wording.of(said.fill(share=percent(beyond), low=low_text, high=high_text)))
    return "\n".join(lines)


def document(
    model: "InverseModel", residuals: Mapping["Kind", "Residual"], trained: "Trained"
) -> dict[str, Any]:
    """Return the same figures, and the recommendation, as JSON."""
    return {
        "axis": model.axis,
        "unit": model.unit,
        "desired_range": list(model.desired_range),
        "lag_s": model.lag_s,
        "residuals": {kind: one.as_json() for kind, one in residuals.items()},
        "recommended": trained.chosen,
        "why": trained.why,
        "remarks": list(trained.remarks),
    }
