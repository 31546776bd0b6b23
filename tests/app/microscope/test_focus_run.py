"""Autofocus with the focus drive and with z."""

import numpy as np
import pytest

from rotemina.app.microscope import MicroscopeRunState
from rotemina.app.microscope.focus_run import FocusRun
from rotemina.sim.errors import InputError


def make_tip_window(bench):
    column, row = np.rint(bench.true_pixel()).astype(int)
    return slice(row - 25, row + 26), slice(column - 25, column + 26)


def run_until_finished(bench, run):
    for _ in range(600):
        bench.step()
        if run.step(bench.clock()).state is not MicroscopeRunState.UNDER_WAY:
            return run.status
    raise AssertionError(run.status)


@pytest.mark.slow
def test_focus_drive_ends_where_the_tip_is_sharp(bench):
    run = FocusRun(
        bench.session,
        bench.get_newest_frame,
        lambda place, _: bench.camera.move_focus(place),
        -30e-6,
        40e-6,
        now_s=bench.clock(),
        window=make_tip_window(bench),
    )
    status = run_until_finished(bench, run)
    assert status.state is MicroscopeRunState.DONE, status.reason
    assert bench.camera.focus_m == status.peak.place
    assert abs(status.peak.place) < 4e-6
    assert len(status.positions) == 16


def test_axis_move_refused_by_the_session_raises(bench):
    def move(place, _):
        bench.session.go_to({"z": place})

    with pytest.raises(InputError, match="axis z"):
        FocusRun(bench.session, bench.get_newest_frame, move, -1e-3, 1e-3, now_s=bench.clock())


def test_empty_field_has_no_focus(bench):
    bench.session.go_to({"x": 0.05})
    bench.settle()
    bench.step(5)
    window = slice(0, 80), slice(0, 80)
    run = FocusRun(
        bench.session,
        bench.get_newest_frame,
        lambda place, _: bench.camera.move_focus(place),
        -30e-6,
        30e-6,
        now_s=bench.clock(),
        window=window,
    )
    status = run_until_finished(bench, run)
    assert status.state is MicroscopeRunState.FAILED
    assert "focus" in status.reason
