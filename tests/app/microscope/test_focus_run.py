"""Autofocus that is refused, or finds nothing; test_microscope.py has one that succeeds."""

import pytest

from rotemina.app.microscope import MicroscopeRunState
from rotemina.app.microscope.focus_run import FocusRun
from rotemina.sim.errors import InputError


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
    status = bench.run_until_finished(run)
    assert status.state is MicroscopeRunState.FAILED
    assert "focus" in status.reason
