"""The plate with hub: stiffness, stress, balance and frequencies match closed forms."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.errors import PlateError
from rotemina.sim.plate import (
    clamp_plate,
    compute_eigenmodes,
    principal_stresses,
    solve_unit_motions,
    surface_stress,
    von_mises,
)
from rotemina.sim.plate.statics import hub_inertia
from rotemina.sim.robot import (
    Plate,
    PlateCutout,
    PlatePin,
)
from rotemina.sim.robot.plate import PlateHub

sys.path.insert(
    0, str(Path(__file__).parent)
)  # for the closed-form solutions, which are no test module
import thin_plates

PLATE = Plate()
LENGTH = 0.04


def compute_exact_stiffness(plate):
    sizes = plate.flexural_rigidity, plate.rim_radius, plate.hub_radius
    return thin_plates.compute_axial_stiffness(*sizes), thin_plates.compute_tilt_stiffness(*sizes)


def test_the_stiffness_matches_the_annular_plate(solutions):
    axial, tilt = compute_exact_stiffness(PLATE)
    assert np.diag(solutions.stiffness) == pytest.approx([axial, tilt, tilt], rel=0.01)
    scale = np.sqrt(np.diag(solutions.stiffness))
    assert np.abs(solutions.stiffness / np.outer(scale, scale) - np.eye(3)).max() < 1e-6


def test_stiffness_converges_with_the_square_of_the_element_size():
    axial, tilt = compute_exact_stiffness(PLATE)
    exact = np.array([axial, tilt])
    errors = [
        np.abs(np.diag(solve_unit_motions(clamp_plate(PLATE, n)).stiffness)[:2] / exact - 1.0)
        for n in (20, 40, 80)
    ]
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert orders[-1] == pytest.approx([2.0, 2.0], abs=0.3)


@pytest.mark.parametrize("change", [{"thickness": 2e-5}, {"hub_radius": 0.01, "rim_radius": 0.05}])
def test_stiffness_is_right_for_any_thinness_and_size(change):
    plate = replace(PLATE, **change)
    axial, tilt = compute_exact_stiffness(plate)
    assert np.diag(solve_unit_motions(clamp_plate(plate, 60)).stiffness) == pytest.approx(
        [axial, tilt, tilt], rel=0.03
    )


def test_the_rim_force_balances_the_hub_force(solutions):
    assert solutions.rim_force[0] == pytest.approx(-solutions.stiffness[0, 0], rel=1e-9)
    assert np.abs(solutions.rim_force[1:]).max() < 1e-4


def test_the_stress_at_hub_and_rim_matches_the_closed_form(solutions):
    rise = 65e-6
    k = PLATE.hub_radius / PLATE.rim_radius
    ln = np.log(k)
    conditions = [
        [1, 1, 0, 0],
        [0, 2, 1, 1],
        [1, k**2, ln, k**2 * ln],
        [0, 2 * k, 1 / k, 2 * k * ln + k],
    ]
    _, c2, c3, c4 = np.linalg.solve(conditions, [0.0, 0.0, rise, 0.0])
    factor = PLATE.youngs_modulus * PLATE.thickness / (2.0 * (1.0 - PLATE.poissons_ratio**2))
    stress = surface_stress(solutions, np.array([rise, 0.0, 0.0]))
    mesh = solutions.clamped.mesh
    for ring, r in ((mesh.hub, k), (mesh.rim, 1.0)):
        # The slope is zero there, so the circumferential curvature is zero and σ_φ = ν σ_r.
        bend = (2.0 * c2 - c3 / r**2 + c4 * (2.0 * np.log(r) + 3.0)) / PLATE.rim_radius**2
        radial = abs(factor * bend)
        expected = radial * np.sqrt(1.0 - PLATE.poissons_ratio + PLATE.poissons_ratio**2)
        assert von_mises(stress)[ring] == pytest.approx(expected, rel=0.02)
        assert np.abs(np.stack(principal_stresses(stress))[:, ring]).max() == pytest.approx(
            radial, rel=0.02
        )


def test_the_hub_moves_as_in_the_kinematics(solutions):
    """A tilt about x lifts the +y side of the hub, a tilt about y lowers its +x side."""
    mesh = solutions.clamped.mesh
    x, y = mesh.points[:, mesh.hub]
    assert solutions.deflection[0, mesh.hub] == pytest.approx(1.0)
    assert solutions.deflection[1, mesh.hub] == pytest.approx(y, abs=1e-12)
    assert solutions.deflection[2, mesh.hub] == pytest.approx(-x, abs=1e-12)
    assert np.abs(solutions.deflection[:, mesh.rim]).max() == 0.0


@pytest.mark.parametrize(
    "cutout",
    [
        PlateCutout(
            kind="slot", count=3, inner_radius=0.007, outer_radius=0.012, width=0.2, twist=1.0
        ),
        PlateCutout(kind="hole", count=4, circle_radius=0.011, radius=0.003, start=0.3),
    ],
    ids=["spiral slots", "holes"],
)
def test_symmetric_cutouts_reduce_the_stiffness_equally_in_all_directions(cutout, solutions):
    """A plate with three- or fourfold symmetry is equally stiff in all directions."""
    cut = solve_unit_motions(clamp_plate(replace(PLATE, cutout=(cutout,)), 60)).stiffness
    assert cut[0, 0] < 0.95 * solutions.stiffness[0, 0]
    assert cut[1, 1] == pytest.approx(cut[2, 2], rel=1e-3)
    scale = np.sqrt(np.diag(cut))
    assert np.abs(cut / np.outer(scale, scale) - np.eye(3)).max() < 1e-3


def test_two_slots_make_one_direction_softer():
    slots = PlateCutout(kind="slot", count=2, inner_radius=0.008, outer_radius=0.012, width=0.8)
    stiffness = solve_unit_motions(clamp_plate(replace(PLATE, cutout=(slots,)), 60)).stiffness
    # The slots lie on the x axis, where a tilt about y bends the plate most.
    assert stiffness[2, 2] < 0.9 * stiffness[1, 1]


def test_the_modes_of_a_heavy_hub_follow_from_its_stiffness():
    plate = replace(PLATE, hub=PlateHub(mass=0.15, inertia=2e-5, product=0.0))
    clamped = clamp_plate(plate, 48)
    solutions = solve_unit_motions(clamped)
    modes = compute_eigenmodes(clamped, LENGTH, 10)
    mass = solutions.mass + hub_inertia(plate, LENGTH)
    tilt, axial = (np.sqrt(solutions.stiffness[i, i] / mass[i, i]) / (2.0 * np.pi) for i in (1, 0))
    assert modes.frequencies_hz[:3] == pytest.approx([tilt, tilt, axial], rel=1e-4)
    assert np.abs(modes.hub[2, 0]) == pytest.approx(1.0, abs=1e-6)
    assert np.abs(modes.deflection).max(axis=1) == pytest.approx(np.ones(10))
    assert np.all(np.diff(modes.frequencies_hz) >= 0.0)


def test_a_massless_hub_vibrates_with_the_mass_of_the_plate():
    """With a rigid hub without mass, only the plate between hub and rim has mass."""
    plate = replace(
        PLATE, hub=PlateHub(mass=0.0, inertia=0.0, product=0.0), pin=PlatePin(density=1e-9)
    )
    clamped = clamp_plate(plate, 60)
    frequency_hz = compute_eigenmodes(clamped, LENGTH, 1).frequencies_hz[0]
    solutions = solve_unit_motions(clamped)
    rayleigh_hz = np.sqrt(solutions.stiffness[0, 0] / solutions.mass[0, 0]) / (2.0 * np.pi)
    assert 0.9 * rayleigh_hz < frequency_hz < rayleigh_hz  # Rayleigh's quotient is an upper bound


def test_the_inertia_of_the_pin_is_that_of_a_rod_about_its_end():
    plate = replace(PLATE, hub=PlateHub(mass=0.1, inertia=1e-5, product=2e-7))
    rod = plate.pin.density * np.pi / 4.0 * plate.pin.diameter**2 * LENGTH
    inertia = hub_inertia(plate, LENGTH)
    assert inertia[0, 0] == pytest.approx(0.1 + rod)
    assert inertia[1, 1] == pytest.approx(1e-5 + rod * LENGTH**2 / 3.0, rel=1e-3)
    assert inertia[1, 2] == 2e-7


@pytest.mark.parametrize("count", [0, 61])
def test_a_number_of_modes_out_of_bounds_is_refused(solutions, count):
    with pytest.raises(PlateError, match=f"modes = {count}: must be 1 to 60"):
        compute_eigenmodes(solutions.clamped, LENGTH, count)
