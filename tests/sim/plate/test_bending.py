"""Morley's plate against exact solutions: patch test, orders of convergence, round plates."""

import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.sparse.linalg import LinearOperator, eigsh, spsolve
from scipy.spatial import Delaunay
from skfem import Basis, ElementTriMorley, LinearForm, MeshTri

from rotemina.sim.plate.bending import assemble, factorized
from rotemina.sim.plate.curvature_recovery import at_points

sys.path.insert(0, str(Path(__file__).parent))  # no test module: the closed forms
import thin_plates

RATIO = 0.26
RIGIDITY, RADIUS, AREAL_MASS = 2.1, 0.017, 3.8


def middles(mesh):
    return mesh.p[:, mesh.facets].mean(axis=1)


def solved(bending, load, fixed, prescribed=None):
    """Return the unknowns under a load, with those of ``fixed`` prescribed (or zero)."""
    unknowns = np.zeros(bending.basis.N) if prescribed is None else prescribed.copy()
    free = np.setdiff1d(np.arange(bending.basis.N), fixed)
    unknowns[free] = 0.0
    right = (load - bending.stiffness @ unknowns)[free]
    unknowns[free] = factorized(bending.stiffness[free][:, free]).solve(right)
    return unknowns


def test_constant_curvature_is_exact_on_an_irregular_mesh():
    mesh = MeshTri().refined(3)
    inside = mesh.interior_nodes()
    shift = np.random.default_rng(1).uniform(-0.03, 0.03, (2, inside.size))
    points = mesh.p.copy()
    points[:, inside] += shift
    mesh = MeshTri(points, mesh.t)
    bending = assemble(mesh, 1.0, RIGIDITY, RATIO, 1.0)
    (x, y), (mx, my) = mesh.p, middles(mesh)
    exact = bending.interpolate(
        1.0 + x - 2.0 * y + 3.0 * x**2 - x * y + 0.5 * y**2,
        np.stack([1.0 + 6.0 * mx - my, -2.0 - mx + my]),
    )
    border = bending.basis.get_dofs().all()
    found = solved(bending, np.zeros(bending.basis.N), border, exact)
    assert np.abs(found - exact).max() < 1e-11
    expected = np.tile([[6.0], [1.0], [-1.0]], mesh.t.shape[1])
    assert np.abs(bending.curvatures(found) - expected).max() < 1e-9


def manufactured_errors(refinements):
    """Return errors of w and of its curvature for ``w = sin²πx sin²πy``, clamped all round."""
    mesh = MeshTri().refined(refinements)
    bending = assemble(mesh, 1.0, RIGIDITY, RATIO, 1.0)
    basis = Basis(mesh, ElementTriMorley(), intorder=6)

    def c(value):
        return np.cos(2.0 * np.pi * value)

    @LinearForm
    def load(v, w):
        # Δ² of (1 - cos 2πx)(1 - cos 2πy) / 4
        x, y = w.x
        factor = 4.0 * np.pi**4 * RIGIDITY
        return factor * (4.0 * c(x) * c(y) - c(x) - c(y)) * v

    found = solved(bending, load.assemble(basis), bending.basis.get_dofs().all())
    field = basis.interpolate(found)
    x, y = np.asarray(basis.global_coordinates())
    exact = 0.25 * (1.0 - c(x)) * (1.0 - c(y))
    exact_xx = np.pi**2 * c(x) * (1.0 - c(y))
    weights = basis.dx
    return [
        np.sqrt(np.sum(weights * (np.asarray(field) - exact) ** 2)),
        np.sqrt(np.sum(weights * (field.hess[0, 0] - exact_xx) ** 2)),
    ]


def test_manufactured_solution_converges_at_the_element_s_order():
    errors = np.array([manufactured_errors(n) for n in (2, 3, 4)])
    orders = np.log2(errors[:-1] / errors[1:])
    assert orders[-1, 0] == pytest.approx(2.0, abs=0.15)  # deflection: h²
    assert orders[-1, 1] == pytest.approx(1.0, abs=0.1)  # curvature, constant in elements: h


def test_recovered_curvature_is_a_linear_one_up_to_the_border():
    mesh = MeshTri().refined(3)
    x, y = mesh.p[:, mesh.t].mean(axis=1)
    found = at_points(mesh, np.stack([2.0 + x - 3.0 * y]))
    px, py = mesh.p
    assert np.abs(found[0] - (2.0 + px - 3.0 * py)).max() < 1e-10


@pytest.fixture(scope="module")
def disc():
    """A full clamped plate with as many unknowns as the default mesh, and those of its rim."""
    rings = 37
    turns = [np.linspace(0.0, 2.0 * np.pi, 6 * k, endpoint=False) for k in range(1, rings + 1)]
    points = [np.zeros((2, 1))]
    points += [
        k / rings * np.stack([np.cos(turn), np.sin(turn)]) for k, turn in enumerate(turns, start=1)
    ]
    points = np.concatenate(points, axis=1)
    mesh = MeshTri(points, np.ascontiguousarray(Delaunay(points.T).simplices.T))
    bending = assemble(mesh, RADIUS, RIGIDITY, RATIO, AREAL_MASS)
    return bending, bending.basis.get_dofs().all()


def centre(mesh):
    return int(np.argmin(np.hypot(*mesh.p)))


def test_force_at_the_centre_of_a_clamped_disc(disc):
    bending, rim = disc
    mesh = bending.basis.mesh
    assert bending.basis.N < 17_100
    load = np.zeros(bending.basis.N)
    load[bending.points[centre(mesh)]] = 1.0
    found = solved(bending, load, rim)[bending.points]
    radius = RADIUS * np.hypot(*mesh.p)
    exact = thin_plates.centre_load_deflection(RIGIDITY, RADIUS, radius)
    assert exact[centre(mesh)] == pytest.approx(RADIUS**2 / (16.0 * np.pi * RIGIDITY))
    assert np.abs(found - exact).max() < 0.01 * exact.max()


def test_moment_at_the_centre_of_a_clamped_disc(disc):
    bending, rim = disc
    mesh = bending.basis.mesh
    x, y = mesh.p
    on_axis = np.flatnonzero((np.abs(y) < 1e-9) & (x > 1e-9))
    right = on_axis[np.argmin(x[on_axis])]
    left = int(np.argmin(np.hypot(x + x[right], y)))
    arm = RADIUS * (x[right] - x[left])
    load = np.zeros(bending.basis.N)
    load[bending.points[right]], load[bending.points[left]] = 1.0 / arm, -1.0 / arm
    found = solved(bending, load, rim)[bending.points]
    radius = np.hypot(x, y)
    exact = thin_plates.centre_moment_deflection(RIGIDITY, RADIUS, RADIUS * radius)
    exact *= np.divide(x, radius, out=np.zeros_like(x), where=radius > 0.0)
    # A moment at a point turns the plate there without bound: and there it is two forces.
    away = radius > 0.2
    assert np.abs(found - exact)[away].max() < 0.01 * np.abs(exact[away]).max()


def test_first_frequencies_of_a_clamped_disc(disc):
    bending, rim = disc
    free = np.setdiff1d(np.arange(bending.basis.N), rim)
    stiffness = bending.stiffness[free][:, free].tocsc()
    inverse = LinearOperator(stiffness.shape, matvec=factorized(stiffness).solve, dtype=float)
    squares = eigsh(
        stiffness,
        6,
        M=bending.mass[free][:, free].tocsc(),
        sigma=0.0,
        OPinv=inverse,
        v0=np.ones(free.size),
        return_eigenvectors=False,
    )
    found = np.sqrt(np.sort(squares)) / (2.0 * np.pi)
    # By nodal diameters: 0, 1 and 1, 2 and 2, 0 with a nodal circle.
    expected = thin_plates.frequencies_hz(RIGIDITY, RADIUS, AREAL_MASS, 4)
    assert [n for n, _ in expected] == [0, 1, 2, 0]
    f0, f1, f2, f3 = (value for _, value in expected)
    assert found == pytest.approx([f0, f1, f1, f2, f2, f3], rel=0.01)


def test_frequency_parameters_are_leissa_s():
    unit = [2.0 * np.pi * value for _, value in thin_plates.frequencies_hz(1.0, 1.0, 1.0, 4)]
    assert unit == pytest.approx([10.2158, 21.26, 34.88, 39.771], rel=2e-4)


def test_factorization_solves():
    mesh = MeshTri().refined(3)
    bending = assemble(mesh, 1.0, 1.0, RATIO, 1.0)
    free = np.setdiff1d(np.arange(bending.basis.N), bending.basis.get_dofs().all())
    matrix = bending.stiffness[free][:, free].tocsc()
    right = np.random.default_rng(0).standard_normal(free.size)
    assert factorized(matrix).solve(right) == pytest.approx(spsolve(matrix, right), rel=1e-8)
