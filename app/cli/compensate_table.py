"""The figures of inverses side by side, as text and as JSON."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rotemina.sim.compensate.judgement import Residual
    from rotemina.sim.compensate.model import InverseModel, Kind
    from rotemina.sim.compensate.training import Trained

_MICRO = 1e6


def table(model: "InverseModel", residuals: Mapping["Kind", "Residual"]) -> str:
    """Return a row for each kind: what is left of the command."""
    from rotemina.sim.compensate.judgement import NAMES

    unit = f"µ{model.unit}"
    head = ("inverse", f"rms {unit}", "but for offset", f"worst {unit}", "rms/range", "MSE")
    rows = [
        (
            NAMES[kind],
            f"{one.rms * _MICRO:.4g}",
            f"{one.aligned * _MICRO:.4g}",
            f"{one.worst * _MICRO:.4g}",
            f"{one.share:.3%}",
            f"{one.mse:.2e}",
        )
        for kind, one in residuals.items()
    ]
    widths = [max(len(row[i]) for row in (head, *rows)) for i in range(len(head))]
    lines = [f"axis {model.axis}: left of the command, of positions fed to the inverse"]
    for row in (head, *rows):
        first, *others = (
            text.ljust(widths[0]) if i == 0 else text.rjust(widths[i]) for i, text in enumerate(row)
        )
        lines.append("  ".join([first, *others]))
    beyond = max(one.beyond for one in residuals.values())
    if beyond > 0.0:
        low, high = model.desired_range
        lines.append(
            f"{beyond:.1%} of the rows lie beyond {low:.6g} to {high:.6g} {model.unit}, which the "
            "inverses saw; they are not judged"
        )
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
