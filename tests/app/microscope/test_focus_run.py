"""Autofocus with the focus drive and with z."""

import numpy as np
import pytest

from rotemina.app.microscope.focus_run import FocusRun, Search
from rotemina.sim.errors import InputError


def about_the_tip(bench):
    column, row = np.rint(bench.true_pixel()).astype(int)
    return slice(row - 25, row + 26), slice(column - 25, column + 26)


def run_until_over(bench, run):
    for _ in range(600):
        bench.step()
        if run.step(bench.clock()).search is not Search.UNDER_WAY:
            return run.status
    raise AssertionError(run.status)


@pytest.mark.slow
def test_the_focus_drive_ends_where_the_tip_is_sharp(bench):
    run = FocusRun(
        bench.session,
        bench.newest,
        lambda place, _: bench.camera.move_focus(place),
        -30e-6,
        40e-6,
        now_s=bench.clock(),
        part=about_the_tip(bench),
    )
    status = run_until_over(bench, run)
    assert status.search is Search.DONE, status.reason
    assert bench.camera.focus_m == status.peak.place
    assert abs(status.peak.place) < 4e-6
    assert len(status.places) == 16


def test_an_axis_moves_through_the_session_which_may_refuse(bench):
    def move(place, _):
        bench.session.go_to({"z": place})

    with pytest.raises(InputError, match="axis z"):
        FocusRun(bench.session, bench.newest, move, -1e-3, 1e-3, now_s=bench.clock())


def test_an_empty_field_has_no_focus(bench):
    bench.session.go_to({"x": 0.05})
    bench.rest()
    bench.step(5)
    place = slice(0, 80), slice(0, 80)
    run = FocusRun(
        bench.session,
        bench.newest,
        lambda place, _: bench.camera.move_focus(place),
        -30e-6,
        30e-6,
        now_s=bench.clock(),
        part=place,
    )
    status = run_until_over(bench, run)
    assert status.search is Search.FAILED
    assert "focus" in status.reason
