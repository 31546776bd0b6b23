"""The run without a display waits until the machine is at rest before it plays."""

import numpy as np

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
