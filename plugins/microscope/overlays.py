"""Overlays of the picture: lines, crosses and rings, in pixels of the picture."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.app.language import translate_message
from rotemina.app.microscope import (
    MicroscopeActivity,
    MicroscopeStatus,
    TipState,
    VisitState,
)
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.cursor_readout import format_measurement
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import format_fixed
from rotemina.sim.units import format_exact

_ELLIPSE_ANGLES = np.linspace(0.0, 2.0 * np.pi, 49)
_BODY_LENGTH_PX = 60.0
# The radius of a ring is this many standard deviations.
_RING_SIGMAS = 2.0


class OverlayLayer(StrEnum):
    """Group of overlays that can be shown or hidden."""

    CROSSHAIR = "crosshair"
    TIP = "tip"
    TARGETS = "targets"
    PATH = "path"
    NANO = "range of the nano stage"
    CELL = "cell"
    MEASURE = "measure"


class OverlayStyle(StrEnum):
    """Style of an overlay, which determines its colour."""

    TIP = "tip"
    LOST = "lost"
    GHOST = "ghost"
    TARGET = "target"
    REACHED = "reached"
    MISSED = "missed"
    PATH = "path"
    NANO = "nano"
    CELL = "cell"
    AHEAD = "ahead"
    MEASURE = "measure"


@dataclass(frozen=True, slots=True, eq=False)
class OverlayLine:
    """Line through points (n, 2), px. The label is written at the last point."""

    style: OverlayStyle
    points: FloatArray
    closed: bool = False
    dashed: bool = False
    label: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class OverlayCross:
    """Cross at a point (2,), px. Its size on the screen does not depend on the zoom."""

    style: OverlayStyle
    at: FloatArray
    label: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class OverlayRing:
    """Circle around a point (2,). Centre and radius are in px of the picture."""

    style: OverlayStyle
    at: FloatArray
    radius: float


OverlayShape = OverlayLine | OverlayCross | OverlayRing


def make_shapes(
    status: MicroscopeStatus, visible_layers: frozenset[OverlayLayer]
) -> list[OverlayShape]:
    """Return the shapes in the order in which they are drawn."""
    overlays: list[OverlayShape] = []
    if OverlayLayer.NANO in visible_layers and status.nano_limits is not None:
        overlays.append(
            OverlayLine(OverlayStyle.NANO, status.nano_limits, closed=True, label=tr("nano range"))
        )
    if OverlayLayer.CELL in visible_layers:
        overlays += _make_cell(status)
    if (
        OverlayLayer.PATH in visible_layers
        and status.tip_path is not None
        and len(status.tip_path) > 1
    ):
        overlays.append(OverlayLine(OverlayStyle.PATH, status.tip_path))
    if OverlayLayer.TARGETS in visible_layers:
        overlays += _make_targets(status)
    if OverlayLayer.MEASURE in visible_layers and status.measured_line is not None:
        line = np.array([status.measured_line.begin, status.measured_line.end])
        overlays.append(
            OverlayLine(OverlayStyle.MEASURE, line, label=format_measurement(status.measured_line))
        )
    if OverlayLayer.TIP in visible_layers:
        overlays += _make_tip(status)
    return overlays + _make_planned_move(status)


def describe_planned_move(status: MicroscopeStatus) -> str:
    """Return distance, stage and uncertainty of the planned move, or an empty text."""
    plan = status.planned_move
    if plan is None:
        return ""
    text = tr("{distance} with the {stage} stage").format(
        distance=format_exact(plan.distance, "m"), stage=translate_message(plan.stage)
    )
    return f"{text}, ± {format_fixed(plan.uncertainty_px, 1)} px"


def _make_planned_move(status: MicroscopeStatus) -> list[OverlayShape]:
    plan = status.planned_move
    if plan is None or status.activity not in (MicroscopeActivity.NONE, MicroscopeActivity.CLICK):
        return []
    overlays: list[OverlayShape] = [
        OverlayRing(OverlayStyle.GHOST, plan.predicted_px, _RING_SIGMAS * plan.uncertainty_px),
        OverlayCross(OverlayStyle.GHOST, plan.predicted_px, format_exact(plan.distance, "m")),
    ]
    if status.tip.pixel is not None:
        path = np.array([status.tip.pixel, plan.predicted_px])
        overlays.insert(0, OverlayLine(OverlayStyle.GHOST, path, dashed=True))
    return overlays


def _make_tip(status: MicroscopeStatus) -> list[OverlayShape]:
    tip = status.tip
    if tip.pixel is None or tip.state is TipState.OFF:
        return []
    style = OverlayStyle.TIP if tip.state is TipState.TRACKED else OverlayStyle.LOST
    overlays: list[OverlayShape] = []
    if tip.sigma_px is not None:
        overlays.append(OverlayRing(style, tip.pixel, _RING_SIGMAS * tip.sigma_px))
    if tip.direction is not None:
        direction = np.array([np.cos(tip.direction), np.sin(tip.direction)])
        line = np.array([tip.pixel, tip.pixel + _BODY_LENGTH_PX * direction])
        overlays.append(OverlayLine(style, line, dashed=True))
    return [
        *overlays,
        OverlayCross(style, tip.pixel, tr("tip") if style is OverlayStyle.TIP else tr("tip lost")),
    ]


def _make_cell(status: MicroscopeStatus) -> list[OverlayShape]:
    cell = status.cell
    if cell.outline is None:
        return []
    long, short, angle = cell.outline.parameters[2:]
    along = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    ellipse = np.outer(long * np.cos(_ELLIPSE_ANGLES), along) + np.outer(
        short * np.sin(_ELLIPSE_ANGLES), across
    )
    overlays: list[OverlayShape] = [
        OverlayLine(OverlayStyle.CELL, cell.outline.centre + ellipse, closed=True)
    ]
    ahead, tip = cell.ahead, status.tip
    if ahead is not None and tip.pixel is not None and tip.direction is not None:
        # The direction points from the tip along the body. The tip thrusts the other way.
        direction = -np.array([np.cos(tip.direction), np.sin(tip.direction)])
        line = np.array([tip.pixel, tip.pixel + ahead.distance * direction])
        overlays.append(
            OverlayLine(OverlayStyle.AHEAD, line, dashed=True, label=describe_membrane(status))
        )
    return overlays


def describe_membrane(status: MicroscopeStatus) -> str:
    """Return the distance from tip to membrane, and the angle of the tip to its normal."""
    cell = status.cell
    if cell.ahead is None:
        return ""
    distance, uncertainty = cell.ahead.distance, cell.ahead.distance_uncertainty
    text = f"{format_fixed(distance, 1)} ± {format_fixed(uncertainty, 1)} px"
    if cell.distance_m is not None and cell.sigma_m is not None:
        text = (
            f"{format_fixed(1e6 * cell.distance_m, 2)} ± {format_fixed(1e6 * cell.sigma_m, 2)} µm"
        )
    return f"{text}, {format_fixed(np.degrees(cell.ahead.angle), 0)}°"


def _make_targets(status: MicroscopeStatus) -> list[OverlayShape]:
    styles = {VisitState.ARRIVED: OverlayStyle.REACHED, VisitState.FAILED: OverlayStyle.MISSED}
    return [
        OverlayCross(styles.get(target.visit, OverlayStyle.TARGET), target.pixel, str(number))
        for number, target in enumerate(status.targets, start=1)
    ]
