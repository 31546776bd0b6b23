"""What is drawn over the picture, in its pixels.."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.app.microscope.click_run import Visit
from rotemina.app.microscope.sight import Activity, Sight, TipState
from rotemina.app.shell.language import translate
from rotemina.plugins.microscope.engine_words import spoken
from rotemina.plugins.microscope.readout import measured_text
from rotemina.sim.arrays import FloatArray
from rotemina.sim.trajectory.wording import readable

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


def shapes(sight: Sight, shown: frozenset[Layer]) -> list[Shape]:
    """Return everything that is to be drawn, what lies beneath first."""
    found: list[Shape] = []
    if Layer.NANO in shown and sight.nano_limits is not None:
        found.append(
            Stroke(
                Look.NANO,
                sight.nano_limits,
                closed=True,
                label=translate("microscope", "nano range"),
            )
        )
    if Layer.CELL in shown:
        found += _cell(sight)
    if Layer.PATH in shown and sight.path is not None and len(sight.path) > 1:
        found.append(Stroke(Look.PATH, sight.path))
    if Layer.TARGETS in shown:
        found += _targets(sight)
    if Layer.MEASURE in shown and sight.measured is not None:
        line = np.array([sight.measured.begin, sight.measured.end])
        found.append(Stroke(Look.MEASURE, line, label=measured_text(sight.measured)))
    if Layer.TIP in shown:
        found += _tip(sight)
    return found + _ghost(sight)


def ghost_text(sight: Sight) -> str:
    """Return how far the tip would go, with what, and how surely."""
    plan = sight.planned
    if plan is None:
        return ""
    text = translate("microscope", "{distance} with the {stage} stage").format(
        distance=readable(plan.distance, "m"), stage=spoken(plan.stage)
    )
    return f"{text}, ± {plan.uncertainty_px:.1f} px"


def _ghost(sight: Sight) -> list[Shape]:
    plan = sight.planned
    if plan is None or sight.activity not in (Activity.NONE, Activity.CLICK):
        return []
    found: list[Shape] = [
        Ring(Look.GHOST, plan.ghost, _SURE * plan.uncertainty_px),
        Cross(Look.GHOST, plan.ghost, readable(plan.distance, "m")),
    ]
    if sight.tip.pixel is not None:
        way = np.array([sight.tip.pixel, plan.ghost])
        found.insert(0, Stroke(Look.GHOST, way, dashed=True))
    return found


def _tip(sight: Sight) -> list[Shape]:
    tip = sight.tip
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
    return [
        *found,
        Cross(
            look,
            tip.pixel,
            translate("microscope", "tip")
            if look is Look.TIP
            else translate("microscope", "tip lost"),
        ),
    ]


def _cell(sight: Sight) -> list[Shape]:
    cell = sight.cell
    if cell.outline is None:
        return []
    long, short, angle = cell.outline.figures[2:]
    along = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    ring = np.outer(long * np.cos(_AROUND), along) + np.outer(short * np.sin(_AROUND), across)
    found: list[Shape] = [Stroke(Look.CELL, cell.outline.centre + ring, closed=True)]
    ahead, tip = cell.ahead, sight.tip
    if ahead is not None and tip.pixel is not None and tip.direction is not None:
        # The body leads away from the tip; the tip thrusts the other way.
        way = -np.array([np.cos(tip.direction), np.sin(tip.direction)])
        line = np.array([tip.pixel, tip.pixel + ahead.distance * way])
        found.append(Stroke(Look.AHEAD, line, dashed=True, label=membrane_text(sight)))
    return found


def membrane_text(sight: Sight) -> str:
    """Return how far the membrane is from the tip, and at which angle it is met."""
    cell = sight.cell
    if cell.ahead is None:
        return ""
    text = f"{cell.ahead.distance:.1f} ± {cell.ahead.distance_uncertainty:.1f} px"
    if cell.distance_m is not None and cell.sigma_m is not None:
        text = f"{1e6 * cell.distance_m:.2f} ± {1e6 * cell.sigma_m:.2f} µm"
    return f"{text}, {np.degrees(cell.ahead.angle):.0f}°"


def _targets(sight: Sight) -> list[Shape]:
    looks = {Visit.ARRIVED: Look.REACHED, Visit.FAILED: Look.MISSED}
    return [
        Cross(looks.get(target.visit, Look.TARGET), target.pixel, str(number))
        for number, target in enumerate(sight.targets, start=1)
    ]
