"""Geometry of a plate: checks of its dimensions, and the rings that contain its cut-outs."""

from collections.abc import Iterator
from itertools import pairwise
from math import asin, pi
from typing import NamedTuple

from rotemina.sim.messages import format_rounded, marked, message
from rotemina.sim.robot.plate import Plate, PlateCutout

# Limits of the ratio of the thickness to the width from hub to rim. Plate theory neglects shear,
# whose share of the deflection grows with (thickness / width)².
MIN_THICKNESS_RATIO, MAX_THICKNESS_RATIO = 1e-3, 0.2
MAX_RIM_RADIUS_M = 1.0
# Keys that each kind of cut-out requires.
_REQUIRED_KEYS = {
    "slot": ("inner_radius", "outer_radius", "width"),
    "hole": ("circle_radius", "radius"),
}
# Width of the meshed patch around a hole, as a share of the hole's radius.
_HOLE_MARGIN_RATIO = 0.6


class PlateProblem(NamedTuple):
    """A key of ``[plate]`` with an invalid value, and the bound of the value."""

    key: str
    value: object
    bound: str


class CutoutRing(NamedTuple):
    """A cut-out and the ring of the plate that it occupies, including the mesh around it.

    Attributes
    ----------
    cutout : PlateCutout
    inner, outer : float
        Radii of the ring, m.
    half_angle : float
        Half the angle of one slot or hole with the mesh around it, rad.
    """

    cutout: PlateCutout
    inner: float
    outer: float
    half_angle: float


def make_ring(cutout: PlateCutout) -> CutoutRing:
    """Return the ring of a cut-out that has all required keys."""
    if cutout.kind == "slot":
        assert cutout.inner_radius is not None
        assert cutout.outer_radius is not None
        assert cutout.width is not None
        return CutoutRing(cutout, cutout.inner_radius, cutout.outer_radius, cutout.width / 2.0)
    assert cutout.circle_radius is not None
    assert cutout.radius is not None
    half_width = (1.0 + _HOLE_MARGIN_RATIO) * cutout.radius
    inner = cutout.circle_radius - half_width
    # The patch is bounded by the radial lines that are tangent to a circle of radius
    # ``half_width``.
    sine = half_width / cutout.circle_radius
    return CutoutRing(cutout, inner, cutout.circle_radius + half_width, asin(min(sine, 1.0)))


def make_rings(plate: Plate) -> list[CutoutRing]:
    """Return the rings of a valid plate from the hub outwards."""
    return sorted((make_ring(cutout) for cutout in plate.cutout), key=lambda ring: ring.inner)


def find_plate_problems(plate: Plate) -> Iterator[PlateProblem]:
    """Yield the problems that make a plate invalid."""
    if plate.rim_radius > MAX_RIM_RADIUS_M:
        yield PlateProblem(
            "rim_radius",
            plate.rim_radius,
            message("engine", "must be at most {largest} m").fill(largest=MAX_RIM_RADIUS_M),
        )
    width = plate.rim_radius - plate.hub_radius
    if width < 0.02 * plate.rim_radius:
        yield PlateProblem(
            "hub_radius",
            plate.hub_radius,
            message("engine", "must be at most 0.98 of rim_radius, which is {rim_radius} m").fill(
                rim_radius=plate.rim_radius
            ),
        )
        return
    if plate.hub_radius < 0.02 * plate.rim_radius:
        yield PlateProblem(
            "hub_radius",
            plate.hub_radius,
            message("engine", "must be at least 0.02 of rim_radius, which is {rim_radius} m").fill(
                rim_radius=plate.rim_radius
            ),
        )
    if not MIN_THICKNESS_RATIO * width <= plate.thickness <= MAX_THICKNESS_RATIO * width:
        yield PlateProblem(
            "thickness",
            plate.thickness,
            message(
                "engine",
                "must be {thinnest} to {thickest} m: a thin plate has {least_share} to "
                "{most_share} of its width from hub to rim",
            ).fill(
                thinnest=format_rounded(MIN_THICKNESS_RATIO * width, 3),
                thickest=format_rounded(MAX_THICKNESS_RATIO * width, 3),
                least_share=MIN_THICKNESS_RATIO,
                most_share=MAX_THICKNESS_RATIO,
            ),
        )
    if abs(plate.hub.product) > plate.hub.inertia:
        yield PlateProblem(
            "hub.product",
            plate.hub.product,
            message("engine", "must be within ± inertia {inertia}").fill(inertia=plate.hub.inertia),
        )
    if plate.pin.diameter > 2.0 * plate.hub_radius:
        yield PlateProblem(
            "pin.diameter",
            plate.pin.diameter,
            marked("engine", "must be at most the diameter of the hub"),
        )
    for index, cutout in enumerate(plate.cutout):
        for problem in _find_cutout_problems(cutout, plate):
            yield problem._replace(key=f"cutout[{index}].{problem.key}")
            return
    yield from _find_ring_overlaps(plate)


def _find_cutout_problems(cutout: PlateCutout, plate: Plate) -> Iterator[PlateProblem]:
    for kind, keys in _REQUIRED_KEYS.items():
        for key in keys:
            value = getattr(cutout, key)
            if kind == cutout.kind and value is None:
                yield PlateProblem(
                    key, None, message("engine", "a {kind} needs it").fill(kind=kind)
                )
                return
            if kind != cutout.kind and value is not None:
                yield PlateProblem(
                    key,
                    value,
                    message("engine", "a {kind} has none; remove it").fill(kind=cutout.kind),
                )
                return
    if abs(cutout.twist) > 2.0 * pi or (cutout.kind == "hole" and cutout.twist != 0.0):
        bound = (
            marked("engine", "must be within ± 6.28 rad")
            if cutout.kind == "slot"
            else marked("engine", "a hole has none")
        )
        yield PlateProblem("twist", cutout.twist, bound)
    inner, outer, half_angle = make_ring(cutout)[1:]
    is_slot = cutout.kind == "slot"
    if inner >= outer:
        yield PlateProblem(
            "outer_radius",
            outer,
            message("engine", "must be above inner_radius {inner}").fill(inner=inner),
        )
    elif inner <= plate.hub_radius or outer >= plate.rim_radius:
        key = "inner_radius" if is_slot else "circle_radius"
        yield PlateProblem(
            key,
            getattr(cutout, key),
            (
                message(
                    "engine",
                    "the cut-out reaches from {inner} to {outer} m; it must stay between hub "
                    "{hub_radius} and rim {rim_radius} m",
                )
                if is_slot
                else message(
                    "engine",
                    "the cut-out with its surroundings reaches from {inner} to {outer} m; it must "
                    "stay between hub {hub_radius} and rim {rim_radius} m",
                )
            ).fill(
                inner=inner, outer=outer, hub_radius=plate.hub_radius, rim_radius=plate.rim_radius
            ),
        )
    elif half_angle * cutout.count >= 0.98 * pi:
        key = "width" if is_slot else "radius"
        yield PlateProblem(
            key,
            getattr(cutout, key),
            message(
                "engine",
                "{count} of them leave no material in between; make them smaller, or use fewer",
            ).fill(count=cutout.count),
        )


def _find_ring_overlaps(plate: Plate) -> Iterator[PlateProblem]:
    rings = make_rings(plate)
    for previous, following in pairwise(rings):
        if following.inner <= previous.outer:
            yield PlateProblem(
                f"cutout[{plate.cutout.index(following.cutout)}]",
                following.cutout.kind,
                message(
                    "engine",
                    "its ring from {inner} to {outer} m overlaps another one, which ends at "
                    "{one_outer} m; put the cut-outs into separate rings",
                ).fill(inner=following.inner, outer=following.outer, one_outer=previous.outer),
            )
            return
