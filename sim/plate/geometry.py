"""Which plates are possible, and the rings that their cut-outs divide them into."""

from collections.abc import Iterator
from itertools import pairwise
from math import asin, pi
from typing import NamedTuple

from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.plate import Cutout, Plate

# Plate theory leaves out shear: its share of the deflection grows with (thickness / width)².
THINNEST, THICKEST = 1e-3, 0.2
LARGEST = 1.0  # m
_NEEDED = {
    "slot": ("inner_radius", "outer_radius", "width"),
    "hole": ("circle_radius", "radius"),
}
_ROOM = 0.6  # of a hole's radius is meshed around it, where there is room


class Impossible(NamedTuple):
    """A key of ``[plate]`` whose value cannot be, and its bound."""

    key: str
    value: object
    bound: str


class Ring(NamedTuple):
    """A cut-out with the ring (radii, m) of the plate that it and its surroundings take."""

    cutout: Cutout
    inner: float
    outer: float
    half_angle: float  # of one piece that holds one slot or hole with its surroundings, rad


def ring(cutout: Cutout) -> Ring:
    """Return the ring of a complete cut-out."""
    if cutout.kind == "slot":
        assert cutout.inner_radius is not None
        assert cutout.outer_radius is not None
        assert cutout.width is not None
        return Ring(cutout, cutout.inner_radius, cutout.outer_radius, cutout.width / 2.0)
    assert cutout.circle_radius is not None
    assert cutout.radius is not None
    half = (1.0 + _ROOM) * cutout.radius
    inner = cutout.circle_radius - half
    # Radial lines through (inner, half angle) pass the hole at no less than they do outside.
    sine = half / cutout.circle_radius
    return Ring(cutout, inner, cutout.circle_radius + half, asin(min(sine, 1.0)))


def rings(plate: Plate) -> list[Ring]:
    """Return the rings of a possible plate from the hub outwards."""
    return sorted((ring(cutout) for cutout in plate.cutout), key=lambda one: one.inner)


def impossible(plate: Plate) -> Iterator[Impossible]:
    """Yield what makes a plate impossible."""
    if plate.rim_radius > LARGEST:
        yield Impossible(
            "rim_radius",
            plate.rim_radius,
            message("engine", "must be at most {largest} m").fill(largest=LARGEST),
        )
    width = plate.rim_radius - plate.hub_radius
    if width < 0.02 * plate.rim_radius:
        yield Impossible(
            "hub_radius",
            plate.hub_radius,
            message("engine", "must be at most 0.98 of rim_radius, which is {rim_radius} m").fill(
                rim_radius=plate.rim_radius
            ),
        )
        return
    if plate.hub_radius < 0.02 * plate.rim_radius:
        yield Impossible(
            "hub_radius",
            plate.hub_radius,
            message("engine", "must be at least 0.02 of rim_radius, which is {rim_radius} m").fill(
                rim_radius=plate.rim_radius
            ),
        )
    if not THINNEST * width <= plate.thickness <= THICKEST * width:
        yield Impossible(
            "thickness",
            plate.thickness,
            message(
                "engine",
                "must be {thinnest} to {thickest} m: a thin plate has {least_share} to "
                "{most_share} of its width from hub to rim",
            ).fill(
                thinnest=rounded(THINNEST * width, 3),
                thickest=rounded(THICKEST * width, 3),
                least_share=THINNEST,
                most_share=THICKEST,
            ),
        )
    if abs(plate.hub.product) > plate.hub.inertia:
        yield Impossible(
            "hub.product",
            plate.hub.product,
            message("engine", "must be within ± inertia {inertia}").fill(inertia=plate.hub.inertia),
        )
    if plate.pin.diameter > 2.0 * plate.hub_radius:
        yield Impossible(
            "pin.diameter", plate.pin.diameter, marked("engine", "must be at most the hub's")
        )
    for index, cutout in enumerate(plate.cutout):
        for problem in _cutout(cutout, plate):
            yield problem._replace(key=f"cutout[{index}].{problem.key}")
            return
    yield from _overlap(plate)


def _cutout(cutout: Cutout, plate: Plate) -> Iterator[Impossible]:
    for kind, keys in _NEEDED.items():
        for key in keys:
            value = getattr(cutout, key)
            if kind == cutout.kind and value is None:
                yield Impossible(key, None, message("engine", "a {kind} needs it").fill(kind=kind))
                return
            if kind != cutout.kind and value is not None:
                yield Impossible(
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
        yield Impossible("twist", cutout.twist, bound)
    inner, outer, half_angle = ring(cutout)[1:]
    slot = cutout.kind == "slot"
    if inner >= outer:
        yield Impossible(
            "outer_radius",
            outer,
            message("engine", "must be above inner_radius {inner}").fill(inner=inner),
        )
    elif inner <= plate.hub_radius or outer >= plate.rim_radius:
        key = "inner_radius" if slot else "circle_radius"
        yield Impossible(
            key,
            getattr(cutout, key),
            (
                message(
                    "engine",
                    "the cut-out reaches from {inner} to {outer} m; it must stay between hub "
                    "{hub_radius} and rim {rim_radius} m",
                )
                if slot
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
        key = "width" if slot else "radius"
        yield Impossible(
            key,
            getattr(cutout, key),
            message(
                "engine", "{count} of them leave nothing between them; make them smaller or fewer"
            ).fill(count=cutout.count),
        )


def _overlap(plate: Plate) -> Iterator[Impossible]:
    ordered = rings(plate)
    for one, other in pairwise(ordered):
        if other.inner <= one.outer:
            yield Impossible(
                f"cutout[{plate.cutout.index(other.cutout)}]",
                other.cutout.kind,
                message(
                    "engine",
                    "its ring from {inner} to {outer} m meets another's, which ends at "
                    "{one_outer} m; put them into separate rings",
                ).fill(inner=other.inner, outer=other.outer, one_outer=one.outer),
            )
            return
