"""How a panel follows the machine: in its turn while it is seen, else now and then."""

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QTabWidget

from rotemina.app import panel as panels
from rotemina.app.motion.session import MotionSession
from rotemina.app.panel import HIDDEN_S, Panel
from rotemina.app.plugin_kit.panel_bench import panel_bench
from rotemina.app.shell.panel_host import Panels
from rotemina.app.shell.turns import TURNS
from rotemina.drivers.samples import DeviceState


class Looking(Panel):
    title = "Looking"

    def __init__(self, workbench):
        super().__init__(workbench)
        self.looks = 0
        self.follow(self.look)

    def look(self, state):
        assert state.measured
        self.looks += 1


class Failing(Looking):
    def look(self, state):
        raise ValueError("no such axis")


@pytest.fixture
def at_s(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(panels, "monotonic", lambda: now[0])
    return now


def looks_of(bench, at_s, passing_s, frames=4):
    """Return how often the panel looks in some frames, which come at an interval."""
    before = bench.panel.looks
    for _ in range(frames):
        at_s[0] += passing_s
        bench.workbench.refreshed.emit(bench.workbench.session.snapshot())
    return bench.panel.looks - before


def test_a_panel_out_of_sight_looks_less_often(at_s):
    with panel_bench(Looking) as bench:
        assert looks_of(bench, at_s, 0.01) == 4  # no window: whoever made it asks it to
        tabs = QTabWidget()
        tabs.addTab(bench.panel, "one")
        tabs.addTab(Panel(bench.workbench), "other")
        tabs.show()
        assert looks_of(bench, at_s, 0.01) == 4
        tabs.setCurrentIndex(1)
        assert looks_of(bench, at_s, 0.01) == 0
        assert looks_of(bench, at_s, 1.01 * HIDDEN_S) == 4
        tabs.setCurrentIndex(0)
        assert looks_of(bench, at_s, 0.01) == 4
        bench.panel.setParent(None)
        tabs.close()


@pytest.mark.parametrize("change", [{"activity": DeviceState.MOVING}, {"locked": "a reason"}])
def test_texts_are_written_in_turns_and_at_once_when_it_moves_or_is_locked(change):
    with panel_bench(Looking) as bench:
        workbench = bench.workbench
        others = [Looking(workbench) for _ in range(2 * TURNS - 1)]
        panels = [bench.panel, *others]
        state = workbench.session.snapshot()

        def looked(now):
            before = [one.looks for one in panels]
            workbench.turns.begin(now)
            workbench.refreshed.emit(now)
            workbench.turns.end()
            return [one.looks - before_it for one, before_it in zip(panels, before, strict=True)]

        assert looked(state) == [1] * len(panels)  # the first frame
        frames = [looked(state) for _ in range(2 * TURNS)]
        assert all(sum(one) == 2 for one in frames)  # as many in each
        assert [sum(one) for one in zip(*frames, strict=True)] == [2] * len(panels)
        changed = replace(state, **change)
        assert looked(changed) == [1] * len(panels)
        assert sum(looked(changed)) == 2
        workbench.refreshed.emit(changed)  # by hand: all
        assert all(panel.texts_due for panel in panels)


class Following(Panel):
    title = "Following"

    def __init__(self, workbench):
        super().__init__(workbench)
        self.seen = []
        self.follow(lambda state: self.seen.append(state.latched))
        self.follow_frames(lambda state: self.seen.append(state.latched), shown=True)


def test_a_panel_shows_the_present_state_when_it_is_made_and_whenever_it_is_shown():
    with panel_bench(Following) as bench:
        panel = bench.panel
        assert panel.seen == [None, None]  # before any frame
        bench.change_unseen(MotionSession.emergency_stop)
        panel.seen.clear()
        panel.workbench.turns.begin(bench.workbench.session.snapshot())
        panel.show()  # in the middle of a frame too
        panel.workbench.turns.end()
        assert len(panel.seen) == 2
        assert all(panel.seen)


def test_a_panel_that_cannot_show_the_present_state_is_left_out():
    with panel_bench(Looking) as bench:
        host, left_out = Panels(bench.workbench, {"failing": Failing, "good": Looking}), {}
        host.failed = left_out.__setitem__
        host.make_all()
        assert left_out == {"failing": "ValueError: no such axis"}
        assert list(host) == ["good"]
        host["good"].deleteLater()
