"""What the tip does to a cell."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.sim.microscope.cell import UNTOUCHED, Cell, dimple, displaced, met
from rotemina.sim.microscope.errors import SceneError

CELL = Cell((0.0, 0.0, 0.0))
EDGE = np.array([22e-6, 0.0, 0.0])  # where the +x axis leaves the cell


def walked(*xs_um, state=UNTOUCHED):
    """Let the tip go along the x axis from place to place, µm."""
    for x in xs_um:
        state = met(CELL, state, np.array([x * 1e-6, 0.0, 0.0]))
    return state


def test_a_tip_outside_leaves_it_alone():
    state = walked(60.0, 23.0)
    assert (state.entry_m, state.pierced) == (None, False)
    np.testing.assert_array_equal(displaced(CELL, state, EDGE), EDGE)


def test_the_membrane_goes_along_until_it_breaks_and_falls_back():
    state = walked(60.0, 19.0)
    np.testing.assert_allclose(state.entry_m, EDGE, atol=1e-12)
    np.testing.assert_allclose(displaced(CELL, state, EDGE), [19e-6, 0.0, 0.0], atol=1e-12)
    assert not state.pierced
    state = walked(17.9, state=state)
    assert state.pierced
    np.testing.assert_allclose(state.hole_m, EDGE, atol=1e-12)
    assert np.linalg.norm(dimple(CELL, state)) == pytest.approx(0.2 * 4e-6)


def test_a_retreat_before_it_breaks_leaves_no_trace():
    state = walked(60.0, 19.0, 60.0)
    assert (state.entry_m, state.hole_m) == (None, None)


def test_the_hole_stays_after_the_retreat():
    state = walked(60.0, 10.0, 60.0)
    assert state.pierced
    assert state.entry_m is None
    np.testing.assert_array_equal(dimple(CELL, state), 0.0)


def test_the_entry_is_where_the_way_crossed_the_membrane():
    state = met(CELL, UNTOUCHED, np.array([40e-6, 5e-6, 0.0]))
    state = met(CELL, state, np.array([0.0, 5e-6, 0.0]))
    assert state.entry_m[1] == pytest.approx(5e-6)
    assert CELL.level(np.array(state.entry_m)) == pytest.approx(1.0)
    assert state.entry_m[0] > 0.0


def test_a_thrust_through_it_between_two_looks_leaves_a_hole():
    state = walked(60.0, -60.0)
    assert state.pierced
    np.testing.assert_allclose(state.hole_m, EDGE, atol=1e-12)


def test_a_graze_between_two_looks_leaves_none():
    state = met(CELL, UNTOUCHED, np.array([60e-6, 17.99e-6, 0.0]))
    assert not met(CELL, state, np.array([-60e-6, 17.99e-6, 0.0])).pierced


def test_a_tip_that_begins_inside():
    assert walked(0.0).entry_m == (0.0, 0.0, 12e-6)


@given(st.lists(st.tuples(*[st.floats(-4e-5, 4e-5)] * 3), min_size=1, max_size=12))
def test_a_hole_never_heals_and_the_dimple_is_bounded(way):
    state = UNTOUCHED
    for place in way:
        pierced = state.pierced
        state = met(CELL, state, np.array(place))
        assert state.pierced >= pierced
        assert np.linalg.norm(dimple(CELL, state)) <= CELL.breaking_m * (1.0 + 1e-9)


def test_what_is_no_cell():
    with pytest.raises(SceneError, match="each must be more than 0"):
        Cell((0.0, 0.0, 0.0), radii_m=(1e-6, 0.0, 1e-6))
