"""A visible panel follows the machine in its turn, a hidden one at long intervals."""

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QTabWidget

from rotemina.app.motion.session import MotionSession
from rotemina.app.panel import Panel, panel as panels
from rotemina.app.panel.panel import HIDDEN_UPDATE_PERIOD_S
from rotemina.app.plugin_kit import open_panel_bench
from rotemina.app.shell.panels import PanelCollection
from rotemina.app.workbench.turns import TURN_COUNT
from rotemina.drivers.contract import DeviceState


class CountingPanel(Panel):
    title = "Counting"

    def __init__(self, workbench):
        super().__init__(workbench)
        self.update_count = 0
        self.follow(self.count_update)

    def count_update(self, state):
        assert state.measured
        self.update_count += 1


class FailingPanel(CountingPanel):
    def count_update(self, state):
        raise ValueError("no such axis")


@pytest.fixture
def now_s(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(panels, "monotonic", lambda: now[0])
    return now


def count_updates(bench, now_s, interval_s, frames=4):
    """Return how often the panel is updated in some frames at an interval."""
    before = bench.panel.update_count
    for _ in range(frames):
        now_s[0] += interval_s
        bench.workbench.refreshed.emit(bench.workbench.session.snapshot())
    return bench.panel.update_count - before


def test_a_hidden_panel_is_updated_less_often(now_s):
    with open_panel_bench(CountingPanel) as bench:
        assert count_updates(bench, now_s, 0.01) == 4  # without a window, the caller decides
        tabs = QTabWidget()
        tabs.addTab(bench.panel, "one")
        tabs.addTab(Panel(bench.workbench), "other")
        tabs.show()
        assert count_updates(bench, now_s, 0.01) == 4
        tabs.setCurrentIndex(1)
        assert count_updates(bench, now_s, 0.01) == 0
        assert count_updates(bench, now_s, 1.01 * HIDDEN_UPDATE_PERIOD_S) == 4
        tabs.setCurrentIndex(0)
        assert count_updates(bench, now_s, 0.01) == 4
        bench.panel.setParent(None)
        tabs.close()


@pytest.mark.parametrize("change", [{"activity": DeviceState.MOVING}, {"lock_reason": "a reason"}])
def test_panels_are_updated_in_turns_and_at_once_on_motion_or_lock(change):
    with open_panel_bench(CountingPanel) as bench:
        workbench = bench.workbench
        others = [CountingPanel(workbench) for _ in range(2 * TURN_COUNT - 1)]
        panels = [bench.panel, *others]
        state = workbench.session.snapshot()

        def draw_frame(new_state):
            before = [panel.update_count for panel in panels]
            workbench.turns.begin_frame(new_state)
            workbench.refreshed.emit(new_state)
            workbench.turns.end_frame()
            return [panel.update_count - count for panel, count in zip(panels, before, strict=True)]

        assert draw_frame(state) == [1] * len(panels)  # the first frame
        frames = [draw_frame(state) for _ in range(2 * TURN_COUNT)]
        assert all(sum(updates) == 2 for updates in frames)  # evenly distributed
        assert [sum(updates) for updates in zip(*frames, strict=True)] == [2] * len(panels)
        changed = replace(state, **change)
        assert draw_frame(changed) == [1] * len(panels)
        assert sum(draw_frame(changed)) == 2
        workbench.refreshed.emit(changed)  # outside a frame, all are updated
        assert all(panel.texts_due for panel in panels)


class FollowingPanel(Panel):
    title = "Following"

    def __init__(self, workbench):
        super().__init__(workbench)
        self.latches = []
        self.follow(lambda state: self.latches.append(state.latch_reason))
        self.follow_frames(lambda state: self.latches.append(state.latch_reason), shown=True)


def test_a_panel_is_updated_when_made_and_when_shown():
    with open_panel_bench(FollowingPanel) as bench:
        panel = bench.panel
        assert panel.latches == [None, None]  # before any frame
        bench.change_without_update(MotionSession.emergency_stop)
        panel.latches.clear()
        panel.workbench.turns.begin_frame(bench.workbench.session.snapshot())
        panel.show()  # in the middle of a frame too
        panel.workbench.turns.end_frame()
        assert len(panel.latches) == 2
        assert all(panel.latches)


def test_a_panel_that_cannot_show_the_present_state_is_left_out():
    with open_panel_bench(CountingPanel) as bench:
        host, left_out = (
            PanelCollection(bench.workbench, {"failing": FailingPanel, "good": CountingPanel}),
            {},
        )
        host.on_failed = left_out.__setitem__
        host.make_all()
        assert left_out == {"failing": "ValueError: no such axis"}
        assert list(host) == ["good"]
        host["good"].deleteLater()
