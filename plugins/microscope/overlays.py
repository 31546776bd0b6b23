"""Overlays of the picture, in its pixels."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.app.microscope.click_corrections import Visit
from rotemina.app.microscope.status import Activity, MicroscopeStatus, TipState
from rotemina.app.shell.engine_words import spoken
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.cursor_readout import measured_text
from rotemina.sim.arrays import FloatArray
from rotemina.sim.quantities import exact, fixed

_AROUND = np.linspace(0.0, 2.0 * np.pi, 49)
_BODY_PX = 60.0  # how far the pipette's direction is drawn
_SURE = 2.0  # standard deviations that a ring shows


class Layer(StrEnum):
    """What can be shown or hidden."""

    CROSSHAIR = "crosshair"
    TIP = "tip"
    TARGETS = "targets"
    PATH = "path"
    NANO = "range of the nano stage"
    CELL = "cell"
    MEASURE = "measure"


class Look(StrEnum):
    """Whose colour and line something has."""

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
class Stroke:
    """A line through points (n, 2), px; ``label`` stands at its last."""

    look: Look
    points: FloatArray
    closed: bool = False
    dashed: bool = False
    label: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Cross:
    """A mark at a point (2,), px, as large as the screen has it."""

    look: Look
    at: FloatArray
    label: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Ring:
    """A circle about a point, its radius in px of the picture."""

    look: Look
    at: FloatArray
    radius: float


Shape = Stroke | Cross | Ring


def shapes(status: MicroscopeStatus, shown: frozenset[Layer]) -> list[Shape]:
    """Return everything that is to be drawn, what lies beneath first."""
    found: list[Shape] = []
    if Layer.NANO in shown and status.nano_limits is not None:
        found.append(Stroke(Look.NANO, status.nano_limits, closed=True, label=tr("nano range")))
    if Layer.CELL in shown:
        found += _cell(status)
    if Layer.PATH in shown and status.path is not None and len(status.path) > 1:
        found.append(Stroke(Look.PATH, status.path))
    if Layer.TARGETS in shown:
        found += _targets(status)
    if Layer.MEASURE in shown and status.measured is not None:
        line = np.array([status.measured.begin, status.measured.end])
        found.append(Stroke(Look.MEASURE, line, label=measured_text(status.measured)))
    if Layer.TIP in shown:
        found += _tip(status)
    return found + _ghost(status)


def ghost_text(status: MicroscopeStatus) -> str:
    """Return how far the tip would go, with what, and how surely."""
    plan = status.planned
    if plan is None:
        return ""
    text = tr("{distance} with the {stage} stage").format(
        distance=exact(plan.distance, "m"), stage=spoken(plan.stage)
    )
    return f"{text}, ± {fixed(plan.uncertainty_px, 1)} px"


def _ghost(status: MicroscopeStatus) -> list[Shape]:
    plan = status.planned
    if plan is None or status.activity not in (Activity.NONE, Activity.CLICK):
        return []
    found: list[Shape] = [
        Ring(Look.GHOST, plan.ghost, _SURE * plan.uncertainty_px),
        Cross(Look.GHOST, plan.ghost, exact(plan.distance, "m")),
    ]
    if status.tip.pixel is not None:
        way = np.array([status.tip.pixel, plan.ghost])
        found.insert(0, Stroke(Look.GHOST, way, dashed=True))
    return found


def _tip(status: MicroscopeStatus) -> list[Shape]:
    tip = status.tip
    if tip.pixel is None or tip.state is TipState.OFF:
        return []
    look = Look.TIP if tip.state is TipState.TRACKED else Look.LOST
    found: list[Shape] = []
    if tip.sigma_px is not None:
        found.append(Ring(look, tip.pixel, _SURE * tip.sigma_px))
    if tip.direction is not None:
        way = np.array([np.cos(tip.direction), np.sin(tip.direction)])
        body = np.array([tip.pixel, tip.pixel + _BODY_PX * way])
        found.append(Stroke(look, body, dashed=True))
    return [*found, Cross(look, tip.pixel, tr("tip") if look is Look.TIP else tr("tip lost"))]


def _cell(status: MicroscopeStatus) -> list[Shape]:
    cell = status.cell
    if cell.outline is None:
        return []
    long, short, angle = cell.outline.figures[2:]
    along = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    ring = np.outer(long * np.cos(_AROUND), along) + np.outer(short * np.sin(_AROUND), across)
    found: list[Shape] = [Stroke(Look.CELL, cell.outline.centre + ring, closed=True)]
    ahead, tip = cell.ahead, status.tip
    if ahead is not None and tip.pixel is not None and tip.direction is not None:
        # The body leads away from the tip; the tip thrusts the other way.
        way = -np.array([np.cos(tip.direction), np.sin(tip.direction)])
        line = np.array([tip.pixel, tip.pixel + ahead.distance * way])
        found.append(Stroke(Look.AHEAD, line, dashed=True, label=membrane_text(status)))
    return found


def membrane_text(status: MicroscopeStatus) -> str:
    """Return how far the membrane is from the tip, and at which angle it is met."""
    cell = status.cell
    if cell.ahead is None:
        return ""
    text = f"{fixed(cell.ahead.distance, 1)} ± {fixed(cell.ahead.distance_uncertainty, 1)} px"
    if cell.distance_m is not None and cell.sigma_m is not None:
        text = f"{fixed(1e6 * cell.distance_m, 2)} ± {fixed(1e6 * cell.sigma_m, 2)} µm"
    return f"{text}, {fixed(np.degrees(cell.ahead.angle), 0)}°"


def _targets(status: MicroscopeStatus) -> list[Shape]:
    looks = {Visit.ARRIVED: Look.REACHED, Visit.FAILED: Look.MISSED}
    return [
        Cross(looks.get(target.visit, Look.TARGET), target.pixel, str(number))
        for number, target in enumerate(status.targets, start=1)
    ]
