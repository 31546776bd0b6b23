"""The run without a display plays once the machine is at rest, and a signal ends it."""

import signal

import numpy as np
import pytest

from rotemina.app.panel import Panel
from rotemina.app.shell.startup import offscreen_run
from rotemina.app.shell.startup.offscreen_run import play_and_compare
from rotemina.sim.records import Record, Tap

PANELS = ()

#: Checks for rest during which a request is still being handed over.
PENDING_CHECKS = 3


def test_a_motion_starts_once_no_request_is_pending(window, monkeypatch):
    bench = window.workbench
    session_class, checks = type(bench.session), []
    at_rest, play = session_class.at_rest, bench.play

    def is_at_rest(session):
        checks.append(at_rest.fget(session))
        return checks[-1] and len(checks) > PENDING_CHECKS

    check_counts_at_play = []
    monkeypatch.setattr(session_class, "at_rest", property(is_at_rest))
    monkeypatch.setattr(bench, "play", lambda: (check_counts_at_play.append(len(checks)), play()))
    time_s = np.arange(60) / 200.0
    command = 32.5e-6 + 1e-6 * np.sin(np.pi * time_s / time_s[-1]) ** 2
    run = play_and_compare(
        window, Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})
    )
    assert run.completed
    (check_count,) = check_counts_at_play
    assert check_count > PENDING_CHECKS


@pytest.fixture
def terminal_signals():
    """Handle SIGINT as in a terminal; a background job would ignore it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_a_signal_while_a_panel_is_made_ends_the_run(
    window, tmp_path, monkeypatch, terminal_signals
):
    class InterruptedPanel(Panel):
        title = "Interrupted"

        def __init__(self, workbench):
            super().__init__(workbench)
            signal.raise_signal(signal.SIGINT)

    def make_window(*_):
        window.panels.panel_types["interrupted"] = InterruptedPanel
        window.panels.placed = lambda *_: None
        assert window.panels.make("interrupted") is not None
        return window

    monkeypatch.setattr(offscreen_run, "make_window", make_window)
    monkeypatch.setattr(window.workbench, "start", lambda: None)  # it is running already
    monkeypatch.setattr(offscreen_run, "load_worn_effects", lambda _: ())
    with pytest.raises(KeyboardInterrupt):
        offscreen_run.run(window.workbench.session, tmp_path)
    assert not (tmp_path / "record.csv").exists()
