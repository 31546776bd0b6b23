"""The run without a display: it plays once the machine is at rest, and a signal ends it."""

import signal

import numpy as np
import pytest

from rotemina.app.panel import Panel
from rotemina.app.shell import offscreen_run
from rotemina.app.shell.offscreen_run import play
from rotemina.sim.records.record import Record, Tap

PANELS = ()

LOOKS = 3  # of the window, while a request is still being handed over


def test_a_motion_begins_once_nothing_is_handed_over_any_more(window, monkeypatch):
    bench = window.workbench
    kind, looks = type(bench.session), []
    at_rest, begin = kind.at_rest, bench.play

    def rests(session):
        looks.append(at_rest.fget(session))
        return looks[-1] and len(looks) > LOOKS

    began = []
    monkeypatch.setattr(kind, "at_rest", property(rests))
    monkeypatch.setattr(bench, "play", lambda: (began.append(len(looks)), begin()))
    time_s = np.arange(60) / 200.0
    way = 32.5e-6 + 1e-6 * np.sin(np.pi * time_s / time_s[-1]) ** 2
    run = play(window, Record.from_signals(time_s, {("zn", Tap.CMD): way}, {"zn": "m"}))
    assert run.completed
    (after,) = began
    assert after > LOOKS


@pytest.fixture
def terminal_signals():
    """Handle SIGINT as a program of a terminal does; in a job of the background it is ignored."""
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
        window.panels.kinds["interrupted"] = InterruptedPanel
        window.panels.placed = lambda *_: None
        assert window.panels.make("interrupted") is not None
        return window

    monkeypatch.setattr(offscreen_run, "make_window", make_window)
    monkeypatch.setattr(window.workbench, "start", lambda: None)  # it is running
    monkeypatch.setattr(offscreen_run, "worn_effects", lambda _: ())
    with pytest.raises(KeyboardInterrupt):
        offscreen_run.run(window.workbench.session, tmp_path)
    assert not (tmp_path / "record.csv").exists()
