"""What the panel says of calibration, moves, focus, tip and cell. Free of Qt."""

from math import degrees

import numpy as np

from rotemina.app.microscope.calibration_file import StageCalibration
from rotemina.app.microscope.calibration_run import CalibrationStatus, Phase
from rotemina.app.microscope.click_run import Visit, VisitStatus
from rotemina.app.microscope.focus_run import FocusStatus, Search
from rotemina.app.microscope.sight import DriftSeen, FocusPlace, Sight, TipSeen, TipState
from rotemina.app.microscope.targets import Target
from rotemina.plugins.microscope.overlays import membrane_text
from rotemina.sim.trajectory.wording import readable
from rotemina.sim.vision.calibration import Geometry, StageFit

ENDED = (Phase.DONE, Phase.FAILED)
_PHASES = {
    Phase.LOOKING: "moves a little, and looks",
    Phase.RETURNING: "goes back to where it began",
    Phase.DONE: "calibrated",
    Phase.FAILED: "failed",
}


def stage_text(name: str, stage: StageCalibration | None) -> str:
    """Return what is known of a stage, in a few lines."""
    if stage is None:
        return f"{name}: not calibrated"
    found, when = stage.map.geometry, stage.date[:16].replace("T", " ")
    return f"{name}: {geometry_text(found)}, residual {stage.residual_px:.2f} px, of {when}"


def geometry_text(found: Geometry) -> str:
    """Return pixel sizes, rotation, handedness and skew with their uncertainties."""
    sizes = " × ".join(f"{1e9 * size:.2f}" for size in found.pixel_size)
    doubts = max(1e9 * one for one in found.pixel_size_uncertainty)
    hand = "" if found.handedness > 0 else ", mirrored"
    return (
        f"{sizes} ± {doubts:.2f} nm/px, turned {degrees(found.rotation):.3f} ± "
        f"{degrees(found.rotation_uncertainty):.3f}°, skew {degrees(found.skew):.3f}°{hand}"
    )


def calibration_text(status: CalibrationStatus | None) -> str:
    """Return how the latest calibration goes on, or went."""
    if status is None:
        return ""
    text = f"{_PHASES[status.phase]}: look {status.done} of {status.moves}"
    if status.phase in ENDED:
        text = _PHASES[status.phase]
    if status.reason:
        text = f"{text}: {status.reason}"
    return text


def residual_lines(fit: StageFit | None) -> list[str]:
    """Return the residual of every move, and which were left out as outliers."""
    if fit is None:
        return []
    sizes = np.linalg.norm(fit.residuals, axis=1)
    return [
        f"move {number}: {size:.2f} px" + ("" if kept else ", left out")
        for number, (size, kept) in enumerate(zip(sizes, fit.kept, strict=True), start=1)
    ]


def visit_text(status: VisitStatus | None) -> str:
    """Return what became of the latest move to a clicked place."""
    if status is None:
        return ""
    if status.visit is Visit.FAILED:
        return f"Failed: {status.reason}"
    miss = "" if status.miss is None else f", {np.linalg.norm(status.miss):.2f} px off"
    head = "Arrived" if status.visit is Visit.ARRIVED else "Under way"
    many = "" if status.corrections == 1 else "s"
    return f"{head}{miss}, {status.corrections} correction{many}"


def target_text(number: int, target: Target) -> str:
    """Return a line of the list of targets."""
    text = f"{number}   {target.column:.0f}, {target.row:.0f} px"
    if target.visit is not None:
        text = f"{text}   {target.visit.value}"
    return f"{text}: {target.note}" if target.note else text


def tip_text(tip: TipSeen) -> str:
    """Return where the tip is and how surely, or why it is not seen."""
    if tip.state is TipState.OFF:
        return "off"
    lines = [tip.state.value if not tip.reason else f"{tip.state.value}: {tip.reason}"]
    if tip.state is not TipState.TRACKED:
        return lines[0]
    if tip.pixel is not None:
        doubt = "" if tip.sigma_px is None else f" ± {tip.sigma_px:.2f}"
        lines.append(f"{tip.pixel[0]:.2f}, {tip.pixel[1]:.2f}{doubt} px")
    if tip.place_m is not None and tip.sigma_m is not None:
        pairs = zip("xy", 1e6 * tip.place_m, 1e6 * tip.sigma_m, strict=True)
        lines.append(
            ", ".join(f"{axis} {at:.3f} ± {doubt:.3f}" for axis, at, doubt in pairs) + " µm"
        )
    if tip.depth is not None:
        sign = "" if tip.depth.sign_known else "±"
        distance = f"{sign}{1e6 * tip.depth.distance:.2f}"
        lines.append(f"{distance} ± {1e6 * tip.depth.uncertainty:.2f} µm from focus")
    lines.append(f"quality {100.0 * tip.quality:.0f} %")
    return "\n".join(lines)


def cell_text(sight: Sight) -> str:
    """Return the cell's size, and how far its membrane is."""
    cell = sight.cell
    if cell.outline is None:
        return cell.reason
    long, short = cell.outline.figures[2:4]
    size = f"{2 * long:.0f} × {2 * short:.0f} px"
    if sight.pixel_m is not None:
        size = f"{2e6 * long * sight.pixel_m:.1f} × {2e6 * short * sight.pixel_m:.1f} µm"
    ahead = membrane_text(sight)
    return f"{size}\nmembrane: {ahead} from head on" if ahead else size


def drift_text(seen: DriftSeen) -> str:
    """Return by how much the background has moved."""
    if not seen.watched:
        return ""
    if seen.drift is None:
        return seen.reason or "watching"
    right, down = seen.drift.shift
    return f"{right:.2f}, {down:.2f} px since the background was taken"


def focus_text(status: FocusStatus | None) -> str:
    """Return how the latest autofocus goes on, or went."""
    if status is None:
        return ""
    if status.search is Search.FAILED:
        return f"Failed: {status.reason}"
    if status.peak is None:
        return f"{len(status.places)} places looked at"
    peak = status.peak
    return f"Sharpest at {1e6 * peak.place:.2f} ± {1e6 * peak.uncertainty:.2f} µm"


def focus_name(place: FocusPlace) -> str:
    """Return something that can be focused with, by name and place."""
    name = "focus drive" if place.name == "focus" else f"axis {place.name}"
    return name if place.place is None else f"{name}: {readable(place.place, 'm')}"
