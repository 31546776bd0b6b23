"""Vibration modes match closed-form solutions."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.modes import compute_damped_modes
from rotemina.sim.robot import assemble_inertia_matrices
from rotemina.sim.robot_files import load_robot, parse_robot

ROBOT = load_robot("rotemina")
DAMPING_FIELDS = ("damping", "damping_ratio")


def make_robot(*axes, couplings=""):
    """Return a robot of force axes (mass, damping, stiffness), free if stiffness is None."""
    names = "abcdef"[: len(axes)]
    text = f"[robot]\nname='m'\naxes={list(names)}\n"
    for name, (mass, damping, stiffness) in zip(names, axes, strict=True):
        text += f"[axis.{name}]\nkind='force'\nunit='m'\nrange=[-1.0,1.0]\ngain=1.0\n"
        text += f"mass={mass}\ndamping={damping}\n"
        text += "" if stiffness is None else f"stiffness={stiffness}\n"
    return parse_robot(text + couplings)


def compute_undamped_modes(robot):
    """Return the modes without damping."""
    axes = {
        name: replace(
            axis, **{field: 0.0 for field in DAMPING_FIELDS if getattr(axis, field) is not None}
        )
        for name, axis in robot.axes.items()
    }
    couplings = tuple(coupling for coupling in robot.couplings if coupling.matrix != "D")
    modes = compute_damped_modes(replace(robot, axes=axes, couplings=couplings))
    np.testing.assert_allclose(modes.shapes.imag, 0.0, atol=1e-12)
    return replace(modes, shapes=modes.shapes.real)


def format_coupling(matrix, value):
    return f"[[coupling]]\nmatrix='{matrix}'\naxes=['a','b']\nvalue={value}\n"


def compute_two_mass_rates(mass, stiffness):
    """Return ω² of det(C − ω² M) = 0 for 2x2 matrices, by the quadratic formula."""
    (m1, mc), (_, m2) = mass
    (k1, kc), (_, k2) = stiffness
    square, linear = m1 * m2 - mc**2, -(m1 * k2 + m2 * k1 - 2 * mc * kc)
    root = np.sqrt(linear**2 - 4 * square * (k1 * k2 - kc**2))
    return np.sort([(-linear - root) / (2 * square), (-linear + root) / (2 * square)])


def test_the_modes_of_the_nominal_robot_match_its_file():
    modes = compute_damped_modes(ROBOT)
    assert [set(modes.dominant[:3]), set(modes.dominant[3:5])] == [{"x", "y", "z"}, {"thx"}]
    file_frequencies_hz = [109.8, 112.5, 112.5, 300.0, 300.0, 420.0]
    # thx and thy shift by half of their 1.5 % shared inertia, zn by half of 0.15/42.
    tolerances = [5e-4, 5e-4, 5e-4, 0.008, 0.008, 0.0021]
    assert (np.abs(modes.frequency_hz / file_frequencies_hz - 1.0) < tolerances).all()
    assert modes.damping_ratio == pytest.approx([0.15, 0.15, 0.15, 0.03, 0.03, 0.025], rel=0.01)


@pytest.mark.parametrize(("mc", "kc"), [(0.0, 50.0), (0.3, 0.0), (-0.9, -120.0)])
def test_frequencies_of_two_coupled_axes_match_the_quadratic_formula(mc, kc):
    robot = make_robot(
        (2.0, 0.0, 300.0),
        (1.0, 0.0, 700.0),
        couplings="".join(format_coupling(m, v) for m, v in (("M", mc), ("C", kc)) if v),
    )
    squared = compute_two_mass_rates([[2.0, mc], [mc, 1.0]], [[300.0, kc], [kc, 700.0]])
    hz = compute_damped_modes(robot).frequency_hz
    np.testing.assert_allclose(hz, np.sqrt(squared) / (2 * np.pi), rtol=1e-10)


def test_shapes_are_orthogonal_and_mass_normalised():
    modes, (_, mass, _, stiffness) = compute_undamped_modes(ROBOT), assemble_inertia_matrices(ROBOT)
    rates = (2 * np.pi * modes.frequency_hz) ** 2
    np.testing.assert_allclose(modes.shapes.T @ mass @ modes.shapes, np.eye(6), atol=1e-12)
    normal = modes.shapes.T @ stiffness @ modes.shapes / rates
    np.testing.assert_allclose(normal, np.eye(6), atol=1e-9)


def test_the_strongest_axis_is_positive_and_equal_tables_do_not_mix():
    modes = compute_undamped_modes(ROBOT)
    strength = np.diag(assemble_inertia_matrices(ROBOT).mass)[:, None] * modes.shapes**2
    for column, name in enumerate(modes.dominant):
        row = modes.axes.index(name)
        assert modes.shapes[row, column] > 0
        assert strength[row, column] == pytest.approx(strength[:, column].max())
    assert modes.dominant == ("z", "x", "y", "thx", "thx", "zn")
    assert (modes.shapes[:, 1] != 0).tolist() == [True] + 5 * [False]
    # The lower tilt mode turns both axes in phase, the upper one in opposition.
    assert modes.shapes[4, 3] == pytest.approx(modes.shapes[3, 3])
    assert modes.shapes[4, 4] == pytest.approx(-modes.shapes[3, 4])


def test_damped_modes_solve_the_quadratic_eigenproblem():
    modes, (_, mass, damping, stiffness) = (
        compute_damped_modes(ROBOT),
        assemble_inertia_matrices(ROBOT),
    )
    for pole, shape in zip(modes.poles, modes.shapes.T, strict=True):
        terms = [pole**2 * mass @ shape, pole * damping @ shape, stiffness @ shape]
        assert np.abs(sum(terms)).max() < 1e-9 * np.abs(terms).max()
        assert (shape.conj() @ mass @ shape).real == pytest.approx(1.0)


@pytest.mark.parametrize("ratio", [0.0, 0.02, 0.7])
def test_an_axis_below_critical_damping_has_one_oscillating_mode(ratio):
    modes = compute_damped_modes(make_robot((2.0, 2 * ratio * 20.0 * 2.0, 800.0)))
    assert modes.frequency_hz == pytest.approx([20.0 / (2 * np.pi)])
    assert modes.damping_ratio == pytest.approx([ratio], abs=1e-12)
    assert modes.poles.imag == pytest.approx(20.0 * np.sqrt(1 - ratio**2))


def test_an_overdamped_axis_has_two_real_modes():
    modes = compute_damped_modes(make_robot((1.0, 50.0, 400.0)))
    np.testing.assert_allclose(modes.poles, [-10.0, -40.0], rtol=1e-12)
    np.testing.assert_allclose(modes.damping_ratio, 1.0)
    assert modes.poles.imag.tolist() == [0.0, 0.0]


def test_a_free_axis_has_no_frequency():
    for damping, poles in ((0.0, [0.0, 0.0]), (6.0, [0.0, -3.0])):
        robot = make_robot((2.0, damping, None))
        modes = compute_damped_modes(robot)
        np.testing.assert_allclose(modes.poles, poles)
        assert np.isnan(modes.damping_ratio[0])


def test_a_slow_axis_is_not_a_free_axis():
    modes = compute_damped_modes(make_robot((1.0, 1000.0, 1e-3)))
    np.testing.assert_allclose(modes.poles.real, [-1e-6, -1000.0], rtol=1e-3)


@pytest.mark.parametrize(
    ("mass", "spring", "damping"), [(2.3, 31.7, 0.0), (0.7, 4.1e5, 0.4), (11.9, 4.1e5, 0.0)]
)
def test_the_frequency_of_a_rigid_motion_is_exactly_zero(mass, spring, damping):
    links = format_coupling("C", -spring) + (format_coupling("D", -damping) if damping else "")
    robot = make_robot((mass, damping, spring), (3.7, damping, spring), couplings=links)
    assert compute_damped_modes(robot).poles[:2].tolist() == [0.0, 0.0]


def test_two_masses_on_one_spring_have_one_rigid_mode():
    """For masses 2 and 3 joined by a spring of 30, C is singular and ω² = 30 (1/2 + 1/3)."""
    robot = make_robot((2.0, 0.0, 30.0), (3.0, 0.0, 30.0), couplings=format_coupling("C", -30.0))
    modes = compute_damped_modes(robot)
    hz = np.unique(np.round(modes.frequency_hz, 12))
    np.testing.assert_allclose(hz, [0.0, 5.0 / (2 * np.pi)], atol=1e-9)
    rigid = modes.shapes[:, 0]
    assert rigid[0] == pytest.approx(rigid[1], rel=1e-6)


def test_a_robot_without_dynamics_has_no_modes():
    robot = load_robot("picma")
    assert compute_damped_modes(robot).shapes.shape == (0, 0)


def test_the_order_of_axes_changes_only_the_order_of_rows():
    reversed_robot = replace(ROBOT, axes=dict(reversed(ROBOT.axes.items())))
    modes, reversed_modes = compute_damped_modes(ROBOT), compute_damped_modes(reversed_robot)
    np.testing.assert_allclose(modes.frequency_hz, reversed_modes.frequency_hz, rtol=1e-12)
