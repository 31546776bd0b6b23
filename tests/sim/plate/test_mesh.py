"""Meshes of plates: the area they cover, and refused plates."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import PlateError
from rotemina.sim.plate.mesh import make_mesh
from rotemina.sim.robot import (
    Plate,
    PlateCutout,
    PlatePin,
)
from rotemina.sim.robot.plate import PlateHub

PLATE = Plate()
SLOT = PlateCutout(kind="slot", count=3, inner_radius=0.007, outer_radius=0.012, width=0.3)
SPIRAL = replace(SLOT, twist=1.2, start=2.0)
HOLES = PlateCutout(kind="hole", count=8, circle_radius=0.0145, radius=0.001, start=0.1)


def compute_triangle_areas(mesh):
    a, b, c = (mesh.points[:, corner] for corner in mesh.triangles)
    u, v = b - a, c - a
    return 0.5 * (u[0] * v[1] - u[1] * v[0])


def compute_ring_area(plate):
    return np.pi * (plate.rim_radius**2 - plate.hub_radius**2)


SLOT_AREA = 3 * 0.5 * 0.3 * (0.012**2 - 0.007**2)


@pytest.mark.parametrize(
    ("cutouts", "cutout_area"),
    [
        ((), 0.0),
        ((SLOT,), SLOT_AREA),
        ((SPIRAL,), SLOT_AREA),
        ((HOLES,), 8 * np.pi * 0.001**2),
        ((SPIRAL, HOLES), SLOT_AREA + 8 * np.pi * 0.001**2),
    ],
    ids=["plain", "straight", "spiral", "holes", "both"],
)
def test_mesh_covers_the_plate_without_its_cutouts(cutouts, cutout_area):
    plate = replace(PLATE, cutout=cutouts)
    mesh = make_mesh(plate)
    areas = compute_triangle_areas(mesh)
    assert areas.min() > 0.0
    assert areas.sum() == pytest.approx(compute_ring_area(plate) - cutout_area, rel=0.004)
    # Every edge belongs to two triangles or to a border.
    edges = np.sort(
        np.concatenate(
            [mesh.triangles[[0, 1]], mesh.triangles[[1, 2]], mesh.triangles[[2, 0]]], axis=1
        ),
        axis=0,
    )
    counts = np.unique(edges, axis=1, return_counts=True)[1]
    assert set(counts) == {1, 2}
    # Euler: points - edges + triangles = 1 - holes, where the hub is one of the holes.
    holes = 1 + sum(cutout.count for cutout in cutouts)
    assert mesh.points.shape[1] - counts.size + mesh.triangles.shape[1] == 1 - holes


def test_hub_and_rim_are_circles():
    mesh = make_mesh(PLATE, 48)
    radius = np.hypot(*mesh.points)
    assert mesh.hub.sum() == mesh.rim.sum() == 48
    assert radius[mesh.hub] == pytest.approx(PLATE.hub_radius)
    assert radius[mesh.rim] == pytest.approx(PLATE.rim_radius)


@pytest.mark.parametrize("start", [0.15, 2 * np.pi - 0.15, -1e-12])
def test_a_slot_may_begin_anywhere(start):
    mesh = make_mesh(replace(PLATE, cutout=(replace(SLOT, start=start),)), 48)
    assert compute_triangle_areas(mesh).sum() == pytest.approx(
        compute_ring_area(PLATE) - SLOT_AREA, rel=0.01
    )


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"hub_radius": 0.02}, "hub_radius = 0.02: must be at most 0.98 of rim_radius"),
        ({"hub_radius": 1e-5}, "hub_radius = 1e-05: must be at least 0.02"),
        ({"thickness": 0.005}, "thickness = 0.005: must be .* a thin plate"),
        ({"thickness": 1e-6}, "thickness = 1e-06: must be "),
        ({"rim_radius": 3.0}, "rim_radius = 3.0: must be at most 1 m"),
        ({"hub": PlateHub(inertia=1e-6, product=1e-5)}, "hub.product = 1e-05"),
        (
            {"pin": PlatePin(diameter=0.02)},
            "pin.diameter = 0.02: must be at most the diameter of the hub",
        ),
        ({"cutout": (replace(SLOT, width=None),)}, r"cutout\[0\].width = missing: a slot needs it"),
        ({"cutout": (replace(SLOT, radius=0.1),)}, "radius = 0.1: a slot has none"),
        ({"cutout": (replace(SLOT, inner_radius=0.013),)}, "outer_radius = .* above inner_radius"),
        ({"cutout": (replace(SLOT, outer_radius=0.02),)}, "it must stay between hub"),
        ({"cutout": (replace(SLOT, width=2.1),)}, "leave no material in between"),
        ({"cutout": (replace(HOLES, radius=0.003),)}, "it must stay between hub"),
        ({"cutout": (replace(HOLES, count=40),)}, "leave no material in between"),
        ({"cutout": (replace(HOLES, twist=0.1),)}, "twist = 0.1: a hole has none"),
        ({"cutout": (SLOT, SPIRAL)}, "overlaps another one"),
    ],
)
def test_impossible_plates_are_refused(change, message):
    with pytest.raises(PlateError, match=message):
        make_mesh(replace(PLATE, **change))


def test_sliver_elements_are_refused_with_their_place():
    other = PlateCutout(
        kind="slot", count=3, inner_radius=0.013, outer_radius=0.015, width=0.3, start=1e-5
    )
    with pytest.raises(PlateError, match=r"no mesh can be made: the element at x .* mm, y"):
        make_mesh(replace(PLATE, cutout=(SLOT, other)))


@pytest.mark.parametrize("divisions", [3, 100_000])
def test_divisions_out_of_bounds_are_refused(divisions):
    with pytest.raises(PlateError, match=f"= {divisions}: must be 16 to 2000"):
        make_mesh(PLATE, divisions)


def is_covered(mesh, radius, angle):
    """Return whether a triangle of the mesh covers a place."""
    place = radius * np.array([np.cos(angle), np.sin(angle)])[:, None]
    a, b, c = (mesh.points[:, corner] - place for corner in mesh.triangles)
    sides = [u[0] * v[1] - u[1] * v[0] for u, v in ((a, b), (b, c), (c, a))]
    return bool(np.any(np.all(np.array(sides) >= 0.0, axis=0)))


def test_a_spiral_slot_is_where_its_twist_puts_it():
    mesh = make_mesh(replace(PLATE, cutout=(SPIRAL,)), 60)
    inner, outer = 2.0, 2.0 + SPIRAL.twist
    assert not is_covered(mesh, 0.0072, inner + 0.05)
    assert not is_covered(mesh, 0.0118, outer - 0.05)
    assert is_covered(mesh, 0.0118, inner)
    assert is_covered(mesh, 0.0072, outer)


def test_slots_that_are_aligned_up_to_rounding_share_their_lines():
    other = replace(SLOT, inner_radius=0.013, outer_radius=0.015, start=1e-12)
    mesh = make_mesh(replace(PLATE, cutout=(SLOT, other)), 48)
    alone = make_mesh(replace(PLATE, cutout=(SLOT,)), 48)
    assert mesh.hub.sum() == alone.hub.sum()
