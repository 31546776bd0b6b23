"""Text about calibration, moves, focus, tip and cell."""

from math import degrees

import numpy as np

from rotemina.app.microscope.calibration_file import StageCalibration
from rotemina.app.microscope.calibration_run import CalibrationStatus, Phase
from rotemina.app.microscope.click_corrections import Visit, VisitStatus
from rotemina.app.microscope.focus_run import FocusStatus, Search
from rotemina.app.microscope.status import DriftSeen, FocusAxis, MicroscopeStatus, TipSeen, TipState
from rotemina.app.microscope.targets import Target
from rotemina.app.shell.engine_words import spoken
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.overlays import membrane_text
from rotemina.sim.quantities import exact, fixed
from rotemina.sim.vision.calibration import Geometry, StageFit

ENDED = (Phase.DONE, Phase.FAILED)
_PHASES = {
    Phase.LOOKING: mark("makes small moves"),
    Phase.RETURNING: mark("returns to the start"),
    Phase.DONE: mark("calibrated"),
    Phase.FAILED: mark("failed"),
}


def stage_text(name: str, stage: StageCalibration | None) -> str:
    """Return the calibration of a stage, in a few lines."""
    if stage is None:
        return tr("{name}: not calibrated").format(name=spoken(name))
    found, when = stage.map.geometry, stage.date[:16].replace("T", " ")
    return tr("{name}: {found}, residual {residual:.2f} px, {when}").format(
        name=spoken(name), found=geometry_text(found), residual=stage.residual_px, when=when
    )


def geometry_text(found: Geometry) -> str:
    """Return pixel sizes, rotation, handedness and skew with their uncertainties."""
    sizes = " × ".join(fixed(1e9 * size, 2) for size in found.pixel_size)
    doubts = max(1e9 * one for one in found.pixel_size_uncertainty)
    hand = "" if found.handedness > 0 else tr(", mirrored")
    return tr(
        "{sizes} ± {doubts:.2f} nm/px, turned {rotation:.3f} ± {doubt:.3f}°, skew {skew:.3f}°{hand}"
    ).format(
        sizes=sizes,
        doubts=doubts,
        rotation=degrees(found.rotation),
        doubt=degrees(found.rotation_uncertainty),
        skew=degrees(found.skew),
        hand=hand,
    )


def calibration_text(status: CalibrationStatus | None) -> str:
    """Return how the latest calibration continues, or went."""
    if status is None:
        return ""
    text = tr("{phase}: picture {done} of {moves}").format(
        phase=tr(_PHASES[status.phase]), done=status.done, moves=status.moves
    )
    if status.phase in ENDED:
        text = tr(_PHASES[status.phase])
    if status.reason:
        text = f"{text}: {spoken(status.reason)}"
    return text


def residual_lines(fit: StageFit | None) -> list[str]:
    """Return the residual of every move, and which were left out as outliers."""
    if fit is None:
        return []
    sizes = np.linalg.norm(fit.residuals, axis=1)
    return [
        tr("move {number}: {size:.2f} px").format(number=number, size=size)
        + ("" if kept else tr(", omitted"))
        for number, (size, kept) in enumerate(zip(sizes, fit.kept, strict=True), start=1)
    ]


def visit_text(status: VisitStatus | None) -> str:
    """Return the outcome of the latest move to a clicked point."""
    if status is None:
        return ""
    if status.visit is Visit.FAILED:
        return tr("Failed: {reason}").format(reason=spoken(status.reason))
    miss = (
        ""
        if status.miss is None
        else tr(", {miss:.2f} px off").format(miss=np.linalg.norm(status.miss))
    )
    head = tr("Arrived") if status.visit is Visit.ARRIVED else tr("Under way")
    many = (
        tr("1 correction")
        if status.corrections == 1
        else tr("{n} corrections").format(n=status.corrections)
    )
    return f"{head}{miss}, {many}"


def target_text(number: int, target: Target) -> str:
    """Return a line of the list of targets."""
    text = f"{number}   {fixed(target.column, 0)}, {fixed(target.row, 0)} px"
    if target.visit is not None:
        text = f"{text}   {spoken(target.visit)}"
    return f"{text}: {spoken(target.note)}" if target.note else text


def tip_text(tip: TipSeen) -> str:
    """Return where the tip is and how surely, or why it is not seen."""
    if tip.state is TipState.OFF:
        return tr("off")
    state = spoken(tip.state)
    lines = [state if not tip.reason else f"{state}: {spoken(tip.reason)}"]
    if tip.state is not TipState.TRACKED:
        return lines[0]
    if tip.pixel is not None:
        doubt = "" if tip.sigma_px is None else f" ± {fixed(tip.sigma_px, 2)}"
        lines.append(f"{fixed(tip.pixel[0], 2)}, {fixed(tip.pixel[1], 2)}{doubt} px")
    if tip.place_m is not None and tip.sigma_m is not None:
        pairs = zip("xy", 1e6 * tip.place_m, 1e6 * tip.sigma_m, strict=True)
        lines.append(
            ", ".join(f"{axis} {fixed(at, 3)} ± {fixed(doubt, 3)}" for axis, at, doubt in pairs)
            + " µm"
        )
    if tip.depth is not None:
        sign = "" if tip.depth.sign_known else "±"
        distance = f"{sign}{fixed(1e6 * tip.depth.distance, 2)}"
        lines.append(
            tr("{distance} ± {uncertainty:.2f} µm from focus").format(
                distance=distance, uncertainty=1e6 * tip.depth.uncertainty
            )
        )
    lines.append(tr("quality {quality:.0f} %").format(quality=100.0 * tip.quality))
    return "\n".join(lines)


def cell_text(status: MicroscopeStatus) -> str:
    """Return the cell's size, and how far its membrane is."""
    cell = status.cell
    if cell.outline is None:
        return spoken(cell.reason)
    long, short = cell.outline.figures[2:4]
    size = f"{fixed(2 * long, 0)} × {fixed(2 * short, 0)} px"
    if status.pixel_m is not None:
        size = (
            f"{fixed(2e6 * long * status.pixel_m, 1)} × {fixed(2e6 * short * status.pixel_m, 1)} µm"
        )
    ahead = membrane_text(status)
    return (
        tr("{size}\nmembrane: {ahead} from its normal").format(size=size, ahead=ahead)
        if ahead
        else size
    )


def drift_text(seen: DriftSeen) -> str:
    """Return by how much the background has moved."""
    if not seen.watched:
        return ""
    if seen.drift is None:
        return spoken(seen.reason) or tr("watching")
    right, down = seen.drift.shift
    return tr("{right:.2f}, {down:.2f} px since the background was taken").format(
        right=right, down=down
    )


def focus_text(status: FocusStatus | None) -> str:
    """Return how the latest autofocus continues, or went."""
    if status is None:
        return ""
    if status.search is Search.FAILED:
        return tr("Failed: {reason}").format(reason=spoken(status.reason))
    if status.peak is None:
        return tr("{places} positions evaluated").format(places=len(status.places))
    peak = status.peak
    return tr("Sharpest at {place:.2f} ± {doubt:.2f} µm").format(
        place=1e6 * peak.place, doubt=1e6 * peak.uncertainty
    )


def focus_name(axis: FocusAxis) -> str:
    """Return something that can be focused with, by name and place."""
    name = tr("focus drive") if axis.name == "focus" else tr("axis {name}").format(name=axis.name)
    return name if axis.position is None else f"{name}: {exact(axis.position, 'm')}"
