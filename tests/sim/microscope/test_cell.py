"""Deformation and piercing of a cell by the tip."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import SceneError
from rotemina.sim.microscope import (
    UNTOUCHED_CELL_STATE,
    SimulatedCell,
    advance_cell_state,
)
from rotemina.sim.microscope.cell import dimple_displacement, displace_points

CELL = SimulatedCell((0.0, 0.0, 0.0))
EDGE = np.array([22e-6, 0.0, 0.0])  # intersection of the +x axis and the membrane


def move_tip(*xs_um, state=UNTOUCHED_CELL_STATE):
    """Return the state after the tip has moved along the x axis through these positions."""
    for x in xs_um:
        state = advance_cell_state(CELL, state, np.array([x * 1e-6, 0.0, 0.0]))
    return state


def test_a_tip_outside_does_not_change_the_cell():
    state = move_tip(60.0, 23.0)
    assert (state.entry_m, state.is_pierced) == (None, False)
    np.testing.assert_array_equal(displace_points(CELL, state, EDGE), EDGE)


def test_the_membrane_follows_the_tip_until_it_breaks_and_springs_back():
    state = move_tip(60.0, 19.0)
    np.testing.assert_allclose(state.entry_m, EDGE, atol=1e-12)
    np.testing.assert_allclose(displace_points(CELL, state, EDGE), [19e-6, 0.0, 0.0], atol=1e-12)
    assert not state.is_pierced
    state = move_tip(17.9, state=state)
    assert state.is_pierced
    np.testing.assert_allclose(state.hole_m, EDGE, atol=1e-12)
    assert np.linalg.norm(dimple_displacement(CELL, state)) == pytest.approx(0.2 * 4e-6)


def test_a_hole_stays_after_the_retreat_but_a_dent_leaves_no_trace():
    dented = move_tip(60.0, 19.0, 60.0)
    assert (dented.entry_m, dented.hole_m) == (None, None)
    state = move_tip(60.0, 10.0, 60.0)
    assert state.is_pierced
    assert state.entry_m is None
    np.testing.assert_array_equal(dimple_displacement(CELL, state), 0.0)


def test_the_entry_is_where_the_path_crosses_the_membrane():
    state = advance_cell_state(CELL, UNTOUCHED_CELL_STATE, np.array([40e-6, 5e-6, 0.0]))
    state = advance_cell_state(CELL, state, np.array([0.0, 5e-6, 0.0]))
    assert state.entry_m[1] == pytest.approx(5e-6)
    assert CELL.radius_ratio_at(np.array(state.entry_m)) == pytest.approx(1.0)
    assert state.entry_m[0] > 0.0


def test_between_two_samples_a_thrust_leaves_a_hole_and_grazing_leaves_none():
    thrust = move_tip(60.0, -60.0)
    assert thrust.is_pierced
    np.testing.assert_allclose(thrust.hole_m, EDGE, atol=1e-12)
    state = advance_cell_state(CELL, UNTOUCHED_CELL_STATE, np.array([60e-6, 17.99e-6, 0.0]))
    assert not advance_cell_state(CELL, state, np.array([-60e-6, 17.99e-6, 0.0])).is_pierced


def test_the_entry_of_a_tip_that_begins_inside_is_at_the_top():
    assert move_tip(0.0).entry_m == (0.0, 0.0, 12e-6)


@given(st.lists(st.tuples(*[st.floats(-4e-5, 4e-5)] * 3), min_size=1, max_size=12))
def test_a_hole_never_heals_and_the_dimple_is_bounded(positions):
    state = UNTOUCHED_CELL_STATE
    for position in positions:
        was_pierced = state.is_pierced
        state = advance_cell_state(CELL, state, np.array(position))
        assert state.is_pierced >= was_pierced
        assert np.linalg.norm(dimple_displacement(CELL, state)) <= CELL.breaking_m * (1.0 + 1e-9)


def test_a_cell_without_size_is_refused():
    with pytest.raises(SceneError, match="each must be more than 0"):
        SimulatedCell((0.0, 0.0, 0.0), radii_m=(1e-6, 0.0, 1e-6))
