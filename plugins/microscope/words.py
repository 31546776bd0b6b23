"""Texts about calibration, moves, focus, tip and cell."""

from math import degrees

import numpy as np

from rotemina.app.language import translate_message
from rotemina.app.microscope import (
    DriftStatus,
    FocusAxis,
    FocusStatus,
    MarkedTarget,
    MicroscopeRunState,
    MicroscopeStatus,
    StageCalibration,
    StageCalibrationPhase,
    StageCalibrationStatus,
    TipState,
    TipStatus,
    VisitState,
    VisitStatus,
)
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.overlays import describe_membrane
from rotemina.sim.messages import format_fixed
from rotemina.sim.units import format_exact
from rotemina.sim.vision import StageFit, StageMapGeometry

END_PHASES = (StageCalibrationPhase.DONE, StageCalibrationPhase.FAILED)
_PHASE_TEXTS = {
    StageCalibrationPhase.MEASURING: mark("makes small moves"),
    StageCalibrationPhase.RETURNING: mark("returns to the start"),
    StageCalibrationPhase.DONE: mark("calibrated"),
    StageCalibrationPhase.FAILED: mark("failed"),
}


def describe_stage(name: str, stage: StageCalibration | None) -> str:
    """Return the calibration of a stage: geometry, residual and date."""
    if stage is None:
        return tr("{name}: not calibrated").format(name=translate_message(name))
    geometry, date = stage.map.geometry, stage.date[:16].replace("T", " ")
    return tr("{name}: {found}, residual {residual:.2f} px, {when}").format(
        name=translate_message(name),
        found=describe_geometry(geometry),
        residual=stage.residual_px,
        when=date,
    )


def describe_geometry(geometry: StageMapGeometry) -> str:
    """Return pixel sizes, rotation, handedness and skew with their uncertainties."""
    sizes = " × ".join(format_fixed(1e9 * size, 2) for size in geometry.pixel_size)
    pixel_size_uncertainty = max(1e9 * size for size in geometry.pixel_size_uncertainty)
    mirrored_text = "" if geometry.handedness > 0 else tr(", mirrored")
    return tr(
        "{sizes} ± {doubts:.2f} nm/px, rotated {rotation:.3f} ± {doubt:.3f}°, "
        "skew {skew:.3f}°{hand}"
    ).format(
        sizes=sizes,
        doubts=pixel_size_uncertainty,
        rotation=degrees(geometry.rotation),
        doubt=degrees(geometry.rotation_uncertainty),
        skew=degrees(geometry.skew),
        hand=mirrored_text,
    )


def describe_calibration(status: StageCalibrationStatus | None) -> str:
    """Return the progress or the outcome of the latest calibration."""
    if status is None:
        return ""
    text = tr("{phase}: picture {done} of {moves}").format(
        phase=tr(_PHASE_TEXTS[status.phase]),
        done=status.pictures_taken,
        moves=status.pictures_total,
    )
    if status.phase in END_PHASES:
        text = tr(_PHASE_TEXTS[status.phase])
    if status.reason:
        text = f"{text}: {translate_message(status.reason)}"
    return text


def list_residuals(fit: StageFit | None) -> list[str]:
    """Return the residual of every move, and mark the omitted outliers."""
    if fit is None:
        return []
    sizes = np.linalg.norm(fit.residuals, axis=1)
    return [
        tr("move {number}: {size:.2f} px").format(number=number, size=size)
        + ("" if is_inlier else tr(", omitted"))
        for number, (size, is_inlier) in enumerate(zip(sizes, fit.inliers, strict=True), start=1)
    ]


def describe_visit(status: VisitStatus | None) -> str:
    """Return the outcome of the latest move to a clicked point."""
    if status is None:
        return ""
    if status.state is VisitState.FAILED:
        return tr("Failed: {reason}").format(reason=translate_message(status.reason))
    miss_text = (
        ""
        if status.miss_px is None
        else tr(", {miss:.2f} px off").format(miss=np.linalg.norm(status.miss_px))
    )
    state_text = tr("Arrived") if status.state is VisitState.ARRIVED else tr("Under way")
    corrections = (
        tr("1 correction")
        if status.corrections == 1
        else tr("{n} corrections").format(n=status.corrections)
    )
    return f"{state_text}{miss_text}, {corrections}"


def describe_target(number: int, target: MarkedTarget) -> str:
    """Return a line of the list of targets."""
    text = f"{number}   {format_fixed(target.column, 0)}, {format_fixed(target.row, 0)} px"
    if target.visit is not None:
        text = f"{text}   {translate_message(target.visit)}"
    return f"{text}: {translate_message(target.reason)}" if target.reason else text


def describe_tip(tip: TipStatus) -> str:
    """Return position and uncertainty of the tip, or why it is not tracked."""
    if tip.state is TipState.OFF:
        return tr("off")
    state = translate_message(tip.state)
    lines = [state if not tip.reason else f"{state}: {translate_message(tip.reason)}"]
    if tip.state is not TipState.TRACKED:
        return lines[0]
    if tip.pixel is not None:
        uncertainty = "" if tip.sigma_px is None else f" ± {format_fixed(tip.sigma_px, 2)}"
        lines.append(
            f"{format_fixed(tip.pixel[0], 2)}, {format_fixed(tip.pixel[1], 2)}{uncertainty} px"
        )
    if tip.position_m is not None and tip.sigma_m is not None:
        pairs = zip("xy", 1e6 * tip.position_m, 1e6 * tip.sigma_m, strict=True)
        lines.append(
            ", ".join(
                f"{axis} {format_fixed(position, 3)} ± {format_fixed(uncertainty, 3)}"
                for axis, position, uncertainty in pairs
            )
            + " µm"
        )
    if tip.depth is not None:
        sign = "" if tip.depth.sign_known else "±"
        distance = f"{sign}{format_fixed(1e6 * tip.depth.distance, 2)}"
        lines.append(
            tr("{distance} ± {uncertainty:.2f} µm from focus").format(
                distance=distance, uncertainty=1e6 * tip.depth.uncertainty
            )
        )
    lines.append(tr("quality {quality:.0f} %").format(quality=100.0 * tip.quality))
    return "\n".join(lines)


def describe_cell(status: MicroscopeStatus) -> str:
    """Return the size of the cell, the distance of its membrane and the angle to its normal."""
    cell = status.cell
    if cell.outline is None:
        return translate_message(cell.reason)
    semi_major, semi_minor = cell.outline.parameters[2:4]
    size = f"{format_fixed(2 * semi_major, 0)} × {format_fixed(2 * semi_minor, 0)} px"
    if status.pixel_m is not None:
        length_um = 2e6 * semi_major * status.pixel_m
        width_um = 2e6 * semi_minor * status.pixel_m
        size = f"{format_fixed(length_um, 1)} × {format_fixed(width_um, 1)} µm"
    # A distance and an angle, so that the text ends in the angle from the normal.
    membrane_text = describe_membrane(status)
    return (
        tr("{size}\nmembrane: {ahead} from its normal").format(size=size, ahead=membrane_text)
        if membrane_text
        else size
    )


def describe_drift(status: DriftStatus) -> str:
    """Return how far the background has moved to the right and down."""
    if not status.is_watched:
        return ""
    if status.drift is None:
        return translate_message(status.reason) or tr("watching")
    right, down = status.drift.shift
    return tr("{right:.2f}, {down:.2f} px since the background was taken").format(
        right=right, down=down
    )


def describe_focus(status: FocusStatus | None) -> str:
    """Return the progress or the outcome of the latest autofocus."""
    if status is None:
        return ""
    if status.state is MicroscopeRunState.FAILED:
        return tr("Failed: {reason}").format(reason=translate_message(status.reason))
    if status.peak is None:
        return tr("{places} positions evaluated").format(places=len(status.positions))
    peak = status.peak
    return tr("Sharpest at {place:.2f} ± {doubt:.2f} µm").format(
        place=1e6 * peak.place, doubt=1e6 * peak.uncertainty
    )


def describe_focus_axis(axis: FocusAxis) -> str:
    """Return the name and the position of a drive that can focus."""
    name = tr("focus drive") if axis.name == "focus" else tr("axis {name}").format(name=axis.name)
    return name if axis.position is None else f"{name}: {format_exact(axis.position, 'm')}"
