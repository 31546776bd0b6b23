"""Morley's plate element: patch test, orders of convergence, exact solutions of round plates."""

import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.sparse.linalg import LinearOperator, eigsh
from scipy.spatial import Delaunay
from skfem import Basis, ElementTriMorley, LinearForm, MeshTri

from rotemina.sim.plate.bending import assemble_bending, factorize
from rotemina.sim.plate.curvature_recovery import recover_at_points

sys.path.insert(
    0, str(Path(__file__).parent)
)  # for the closed-form solutions, which are no test module
import thin_plates

RATIO = 0.26
RIGIDITY, RADIUS, AREAL_MASS = 2.1, 0.017, 3.8


def find_edge_middles(mesh):
    return mesh.p[:, mesh.facets].mean(axis=1)


def solve_plate(bending, load, fixed, prescribed=None):
    """Return the unknowns with a load, where those of ``fixed`` are prescribed (or zero)."""
    unknowns = np.zeros(bending.basis.N) if prescribed is None else prescribed.copy()
    free = np.setdiff1d(np.arange(bending.basis.N), fixed)
    unknowns[free] = 0.0
    right = (load - bending.stiffness @ unknowns)[free]
    unknowns[free] = factorize(bending.stiffness[free][:, free]).solve(right)
    return unknowns


def test_constant_curvature_is_exact_on_an_irregular_mesh():
    mesh = MeshTri().refined(3)
    inside = mesh.interior_nodes()
    shift = np.random.default_rng(1).uniform(-0.03, 0.03, (2, inside.size))
    points = mesh.p.copy()
    points[:, inside] += shift
    mesh = MeshTri(points, mesh.t)
    bending = assemble_bending(mesh, 1.0, RIGIDITY, RATIO, 1.0)
    (x, y), (mx, my) = mesh.p, find_edge_middles(mesh)
    exact = bending.interpolate(
        1.0 + x - 2.0 * y + 3.0 * x**2 - x * y + 0.5 * y**2,
        np.stack([1.0 + 6.0 * mx - my, -2.0 - mx + my]),
    )
    border = bending.basis.get_dofs().all()
    solution = solve_plate(bending, np.zeros(bending.basis.N), border, exact)
    assert np.abs(solution - exact).max() < 1e-11
    expected = np.tile([[6.0], [1.0], [-1.0]], mesh.t.shape[1])
    assert np.abs(bending.curvatures(solution) - expected).max() < 1e-9


def compute_manufactured_errors(refinements):
    """Return errors of w and its curvature for ``w = sin²πx sin²πy``, clamped on all edges."""
    mesh = MeshTri().refined(refinements)
    bending = assemble_bending(mesh, 1.0, RIGIDITY, RATIO, 1.0)
    basis = Basis(mesh, ElementTriMorley(), intorder=6)

    def cosine(value):
        return np.cos(2.0 * np.pi * value)

    @LinearForm
    def load(v, w):
        # Δ² of (1 - cos 2πx)(1 - cos 2πy) / 4
        x, y = w.x
        factor = 4.0 * np.pi**4 * RIGIDITY
        return factor * (4.0 * cosine(x) * cosine(y) - cosine(x) - cosine(y)) * v

    solution = solve_plate(bending, load.assemble(basis), bending.basis.get_dofs().all())
    field = basis.interpolate(solution)
    x, y = np.asarray(basis.global_coordinates())
    exact = 0.25 * (1.0 - cosine(x)) * (1.0 - cosine(y))
    exact_xx = np.pi**2 * cosine(x) * (1.0 - cosine(y))
    weights = basis.dx
    return [
        np.sqrt(np.sum(weights * (np.asarray(field) - exact) ** 2)),
        np.sqrt(np.sum(weights * (field.hess[0, 0] - exact_xx) ** 2)),
    ]


def test_a_manufactured_solution_converges_with_the_order_of_the_element():
    errors = np.array([compute_manufactured_errors(n) for n in (2, 3, 4)])
    orders = np.log2(errors[:-1] / errors[1:])
    assert orders[-1, 0] == pytest.approx(2.0, abs=0.15)  # deflection: h²
    assert orders[-1, 1] == pytest.approx(1.0, abs=0.1)  # curvature, constant in elements: h


def test_recovery_reproduces_a_linear_curvature_up_to_the_border():
    mesh = MeshTri().refined(3)
    x, y = mesh.p[:, mesh.t].mean(axis=1)
    recovered = recover_at_points(mesh, np.stack([2.0 + x - 3.0 * y]))
    px, py = mesh.p
    assert np.abs(recovered[0] - (2.0 + px - 3.0 * py)).max() < 1e-10


@pytest.fixture(scope="module")
def disc():
    """A clamped disc with as many unknowns as the default mesh, and the unknowns of its rim."""
    rings = 37
    angles = [np.linspace(0.0, 2.0 * np.pi, 6 * k, endpoint=False) for k in range(1, rings + 1)]
    points = [np.zeros((2, 1))]
    points += [
        k / rings * np.stack([np.cos(ring_angles), np.sin(ring_angles)])
        for k, ring_angles in enumerate(angles, start=1)
    ]
    points = np.concatenate(points, axis=1)
    mesh = MeshTri(points, np.ascontiguousarray(Delaunay(points.T).simplices.T))
    bending = assemble_bending(mesh, RADIUS, RIGIDITY, RATIO, AREAL_MASS)
    return bending, bending.basis.get_dofs().all()


def find_centre(mesh):
    return int(np.argmin(np.hypot(*mesh.p)))


def test_deflection_by_a_force_at_the_centre_of_a_clamped_disc(disc):
    bending, rim = disc
    mesh = bending.basis.mesh
    assert bending.basis.N < 17_100
    load = np.zeros(bending.basis.N)
    load[bending.points[find_centre(mesh)]] = 1.0
    solution = solve_plate(bending, load, rim)[bending.points]
    radius = RADIUS * np.hypot(*mesh.p)
    exact = thin_plates.compute_centre_load_deflection(RIGIDITY, RADIUS, radius)
    assert exact[find_centre(mesh)] == pytest.approx(RADIUS**2 / (16.0 * np.pi * RIGIDITY))
    assert np.abs(solution - exact).max() < 0.01 * exact.max()


def test_deflection_by_a_moment_at_the_centre_of_a_clamped_disc(disc):
    bending, rim = disc
    mesh = bending.basis.mesh
    x, y = mesh.p
    on_axis = np.flatnonzero((np.abs(y) < 1e-9) & (x > 1e-9))
    right = on_axis[np.argmin(x[on_axis])]
    left = int(np.argmin(np.hypot(x + x[right], y)))
    arm = RADIUS * (x[right] - x[left])
    load = np.zeros(bending.basis.N)
    load[bending.points[right]], load[bending.points[left]] = 1.0 / arm, -1.0 / arm
    solution = solve_plate(bending, load, rim)[bending.points]
    radius = np.hypot(x, y)
    exact = thin_plates.compute_centre_moment_deflection(RIGIDITY, RADIUS, RADIUS * radius)
    exact *= np.divide(x, radius, out=np.zeros_like(x), where=radius > 0.0)
    # The exact slope is infinite at the point of the moment, which is modelled by two forces.
    is_far = radius > 0.2
    assert np.abs(solution - exact)[is_far].max() < 0.01 * np.abs(exact[is_far]).max()


def test_first_frequencies_of_a_clamped_disc(disc):
    bending, rim = disc
    free = np.setdiff1d(np.arange(bending.basis.N), rim)
    stiffness = bending.stiffness[free][:, free].tocsc()
    inverse = LinearOperator(stiffness.shape, matvec=factorize(stiffness).solve, dtype=float)
    squares = eigsh(
        stiffness,
        6,
        M=bending.mass[free][:, free].tocsc(),
        sigma=0.0,
        OPinv=inverse,
        v0=np.ones(free.size),
        return_eigenvectors=False,
    )
    found_hz = np.sqrt(np.sort(squares)) / (2.0 * np.pi)
    # By nodal diameters: 0, 1 and 1, 2 and 2, 0 with a nodal circle.
    expected = thin_plates.compute_frequencies_hz(RIGIDITY, RADIUS, AREAL_MASS, 4)
    assert [n for n, _ in expected] == [0, 1, 2, 0]
    f0, f1, f2, f3 = (value for _, value in expected)
    assert found_hz == pytest.approx([f0, f1, f1, f2, f2, f3], rel=0.01)


def test_frequency_parameters_match_leissa():
    parameters = [
        2.0 * np.pi * value for _, value in thin_plates.compute_frequencies_hz(1.0, 1.0, 1.0, 4)
    ]
    assert parameters == pytest.approx([10.2158, 21.26, 34.88, 39.771], rel=2e-4)
