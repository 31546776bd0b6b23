"""The Plots panel: all axes over time, as loops or spectra; cursors, a second run, export."""

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QTimer
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QMenu,
    QPushButton,
    QWidget,
)

from rotemina.app.language import group_axes_by_stage, marked
from rotemina.app.motion.device import HistoryWindow
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    STALE_AGE_S,
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.widgets.drawing import LINE_STYLES, LegendEntry, PlotLegend
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.workbench import LIVE_GAP_WINDOW_S, Level, Workbench
from rotemina.drivers.contract import Clock
from rotemina.plugins.plots import mark, tr
from rotemina.plugins.plots.axis_plot import AxisPlot, PlotFrame
from rotemina.plugins.plots.cursor_text import PlotKind, describe_cursors
from rotemina.plugins.plots.exporting import save_picture
from rotemina.plugins.plots.history_signals import (
    GAP_WINDOW_S,
    GapHistory,
    compute_gaps,
    cut_latest,
    to_record,
)
from rotemina.plugins.plots.overlay_choice import OverlayChoice
from rotemina.plugins.plots.plot_grid import PlotGrid
from rotemina.plugins.plots.view_plot import ViewPlot
from rotemina.sim.comparison import GapFigure
from rotemina.sim.messages import format_rounded
from rotemina.sim.records import write_record

TIME_SPANS_S = (2, 5, 10, 30, 60)
# Height of a single row of plots without the controls.
_MIN_HEIGHT_PX = 52
# The plots are drawn in this many parts, so that the window stays responsive.
_DRAWING_PARTS = 6
# The pause between two parts lets Qt paint the first one. Otherwise Qt would paint all at once.
_PART_INTERVAL_MS = 3
# Minimum time between updates of the gap texts, so that they can be read.
GAP_UPDATE_S = 0.25
# Minimum time between updates of the spectra, which are slow to compute.
SPECTRUM_UPDATE_S = 0.25
LEGEND_ENTRIES = (
    (mark("command"), LINE_STYLES["command"]),
    (mark("model in use"), LINE_STYLES["model"]),
    (mark("measured"), LINE_STYLES["measured"]),
)
STRIP_LEGEND_ENTRIES = ((mark("gap, last {n} s"), LINE_STYLES["gap"]), (mark("noise floor"), None))
PLOT_KIND_NAMES = {
    PlotKind.POSITION: mark("Position"),
    PlotKind.GAP: mark("Gap: measured − model"),
    PlotKind.LOOP: mark("Loop: over command"),
    PlotKind.SPECTRUM: mark("Spectrum"),
}


class PlotsPanel(Panel):
    """Panel with one plot for each axis, in which the stages are side by side."""

    title = marked("panels", "Plots")
    area = PanelArea.CENTRE
    order = 10
    help_page = "plots.md"

    def __init__(self, workbench: Workbench, clock: Clock = time.monotonic) -> None:
        super().__init__(workbench)
        self._clock, self._drawn_s = clock, float("-inf")
        self._frozen_window: HistoryWindow | None = None
        self._gaps_updated_s = float("-inf")
        self._gaps: Mapping[str, GapFigure | None] = {}
        self._gap_history: GapHistory | None = None
        self._plot_frame: PlotFrame | None = None
        # Kind of plot in which the cursors are shown, or None if they are hidden.
        self._cursor_kind: PlotKind | None = None
        self.plots = {
            name: AxisPlot(workbench, column, on_cursor_moved=self._on_cursor_moved)
            for column, name in enumerate(workbench.robot.axes)
        }
        self.grid = PlotGrid(
            self.plots, [list(axes) for axes in group_axes_by_stage(workbench.robot).values()]
        )
        self._head, header = QWidget(), self._make_header()
        bottom_row = make_row((self._legend, 1), self.age)
        make_column(header, bottom_row, on=self._head, margins=0, spacing=3)
        make_column(self._head, (self.grid, 1), on=self, margins=0, spacing=3)
        self.setMinimumHeight(_MIN_HEIGHT_PX)
        offer_in_palette(self.pause, self.cursors, safe_while_hidden=True)
        # The parts of the current frame that are not drawn yet.
        self._waiting_plots: list[Sequence[AxisPlot]] = []
        self._part_timer = QTimer(self, singleShot=True, interval=_PART_INTERVAL_MS)
        self._part_timer.timeout.connect(self._draw_next_part)
        self.follow_frames(self._show_age, shown=True)
        workbench.shown.connect(lambda _: self._refresh_in_parts())
        workbench.replaying.changed.connect(self._on_replay_changed)
        workbench.theme_changed.connect(self._use_theme)
        workbench.model_changed.connect(self._on_model_changed)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Hide the controls and use fewer rows if the panel is low."""
        super().resizeEvent(event)
        head_height = self._head.sizeHint().height()
        self._head.setVisible(self.grid.arrange(self.width(), self.height(), head_height))
        self.grid.equalise_heights()

    def refresh(self) -> None:
        """Draw the newest samples unless the plots are frozen or hidden."""
        if self._is_due():
            self._draw_window(self._read_newest())

    def _refresh_in_parts(self) -> None:
        """Draw a few plots at a time, so that the window can handle other events in between."""
        if self._is_due() and not self._waiting_plots:
            self._make_plot_frame(self._read_newest())
            plots = list(self.plots.values())
            self._waiting_plots = [
                plots[first::_DRAWING_PARTS] for first in range(min(_DRAWING_PARTS, len(plots)))
            ]
            self._draw_next_part()

    def _show_age(self, state: SessionState) -> None:
        age_s = state.age_s
        stale = age_s is not None and age_s > STALE_AGE_S
        if age_s is not None and stale:
            self.age.setText(tr("The newest reading is {n} s old").format(n=max(1, round(age_s))))
        self.age.setVisible(stale)
        for plot in self.plots.values():
            plot.set_stale(stale)

    def _draw_next_part(self) -> None:
        if self._waiting_plots and self._plot_frame is not None:
            for plot in self._waiting_plots.pop(0):
                plot.draw(self._plot_frame)
        if self._waiting_plots:
            self._part_timer.start()
        else:
            self._on_drawn()

    def _is_due(self) -> bool:
        if self.pause.isChecked() or not self.isVisible():
            return False
        return (
            self._get_kind() is not PlotKind.SPECTRUM
            or self._clock() - self._drawn_s >= SPECTRUM_UPDATE_S
        )

    def _read_newest(self) -> HistoryWindow:
        return self.workbench.source.history.tail(float(self.span_choice.currentData()))

    def save_data(self, path: Path) -> None:
        """Save the samples shown as a record. A notice reports a failure."""
        window, robot = self._read_shown_window(), self.workbench.robot
        self.workbench.write_file(
            "save plots", path, lambda: write_record(to_record(window, robot), path)
        )

    def save_picture(self, path: Path) -> None:
        """Save a picture of all plots, as PNG or SVG depending on the file name."""
        for plot in self.plots.values():
            plot.plot.paint_now()
        if self.workbench.run_request(lambda: save_picture(self.grid, path)):
            self.workbench.notify(Level.GOOD, tr("Saved {path}").format(path=path))

    def _make_header(self) -> QHBoxLayout:
        self.kind_choice = _make_choice(
            tr("Contents of the plots"), ((key, tr(text)) for key, text in PLOT_KIND_NAMES.items())
        )
        self.span_choice = _make_choice(
            tr("Time span of the plots"), ((s, f"{s} s") for s in TIME_SPANS_S)
        )
        for box in (self.kind_choice, self.span_choice):
            box.setSizeAdjustPolicy(box.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.kind_choice.setMinimumContentsLength(9)
        self.span_choice.setMinimumContentsLength(4)
        self.span_choice.setCurrentIndex(TIME_SPANS_S.index(10))
        self.overlay_choice = OverlayChoice(self, self._read_shown_window, self._read_whole_window)
        self.overlay_choice.changed.connect(self._on_overlay_changed)
        self.kind_choice.currentIndexChanged.connect(lambda _: self._on_kind_changed())
        self.span_choice.currentIndexChanged.connect(lambda _: self._redraw())
        self.cursors = QPushButton(tr("Cursors"))
        self.cursors.setCheckable(True)
        self.cursors.setToolTip(tr("Two lines to drag; their values appear above each plot"))
        self.cursors.toggled.connect(lambda _: self._show_cursors())
        self.pause = QPushButton(tr("Freeze"))
        self.pause.setCheckable(True)
        self.pause.setToolTip(tr("Freeze the plots; motion, recording and replay continue"))
        self.pause.toggled.connect(self._freeze)
        self.more = QPushButton(tr("More"))
        self.more.setMenu(self._make_menu())
        self.more.setToolTip(tr("Alignment, and files of the plots"))
        self._legend = PlotLegend(self.workbench.theme)
        self.age = QLabel()
        self.age.setProperty("tone", "warning")
        self.age.hide()
        self._use_theme(self.workbench.theme)
        parts = (
            (self.kind_choice, 2),
            (self.overlay_choice, 1),
            self.span_choice,
            self.cursors,
            self.pause,
            self.more,
        )
        return make_row(*parts, spacing=4)

    def _make_menu(self) -> QMenu:
        menu = QMenu(self)
        menu.addAction(tr("Align the other run"), self.overlay_choice.align)
        menu.addSeparator()
        for text, name, file_filter, save in (
            (tr("Save picture …"), "plots.png", tr("Pictures (*.png *.svg)"), self.save_picture),
            (tr("Save data …"), "plots.csv", tr("Records (*.csv *.csv.gz)"), self.save_data),
        ):
            menu.addAction(text, partial(_ask_path, self, text, name, file_filter, save))
        return menu

    def _get_kind(self) -> PlotKind:
        return PlotKind(self.kind_choice.currentData())

    def _read_whole_window(self) -> HistoryWindow:
        """Return all samples that can be shown: the frozen ones or the live history."""
        return (
            self._frozen_window
            if self._frozen_window is not None
            else self.workbench.source.history.tail()
        )

    def _read_shown_window(self) -> HistoryWindow:
        frame = self._plot_frame
        if frame is not None:
            return frame.window
        return cut_latest(self._read_whole_window(), float(self.span_choice.currentData()))

    def _make_plot_frame(self, window: HistoryWindow) -> PlotFrame:
        self._drawn_s = self._clock()
        span_s = float(self.span_choice.currentData())
        run = self.workbench.run
        self._update_gaps(window, span_s)
        self._plot_frame = PlotFrame(
            window,
            span_s,
            self._get_kind(),
            self.overlay_choice.overlay,
            self.overlay_choice.shift_s,
            self._gaps,
            run.gaps if run is not None else {},
            self._gap_history,
        )
        return self._plot_frame

    def _update_gaps(self, window: HistoryWindow, span_s: float) -> None:
        """Compute the gaps of the last 10 s and the gap history at a readable rate."""
        now_s, is_live = self._clock(), self._frozen_window is None
        if is_live and now_s - self._gaps_updated_s < GAP_UPDATE_S:
            return
        self._gaps_updated_s = now_s
        self._gap_history = GapHistory.from_window(window, span_s)
        if is_live:
            is_long_enough = span_s >= LIVE_GAP_WINDOW_S
            history = self.workbench.source.history
            self._gaps = compute_gaps(
                cut_latest(window, LIVE_GAP_WINDOW_S)
                if is_long_enough
                else history.tail(LIVE_GAP_WINDOW_S)
            )

    def _draw_window(self, window: HistoryWindow) -> None:
        frame = self._make_plot_frame(window)
        self._waiting_plots.clear()
        for plot in self.plots.values():
            plot.draw(frame)
        self._on_drawn()

    def _on_drawn(self) -> None:
        if self._plot_frame is not None and self._cursor_kind is self._plot_frame.kind:
            self._read_cursors()

    def _redraw(self) -> None:
        # Only the visible part of the history is read. Copying all of it would take too long.
        frozen_window = self._frozen_window
        self._draw_window(
            self._read_newest()
            if frozen_window is None
            else cut_latest(frozen_window, float(self.span_choice.currentData()))
        )

    def _on_overlay_changed(self) -> None:
        self._redraw()
        self._use_theme(self.workbench.theme)

    def _on_kind_changed(self) -> None:
        self._redraw()
        self._show_cursors()

    def _freeze(self, is_frozen: bool) -> None:
        self._frozen_window = self.workbench.source.history.tail() if is_frozen else None
        self._redraw()

    def _on_model_changed(self, _: object) -> None:
        self._gaps_updated_s = float("-inf")
        self._use_theme(self.workbench.theme)

    def _on_replay_changed(self) -> None:
        """Redraw, so that a replay shows no curves of the machine, and vice versa."""
        self.pause.setChecked(False)
        self.refresh()

    def _show_cursors(self) -> None:
        has_cursors, is_loop = self.cursors.isChecked(), self._get_kind() is PlotKind.LOOP
        for plot in self.plots.values():
            plot.plot.show_cursors(vertical=has_cursors, horizontal=has_cursors and is_loop)
        self._cursor_kind = self._get_kind() if has_cursors else None
        if has_cursors:
            self._read_cursors()
        else:
            self._use_theme(self.workbench.theme)
            self._redraw()

    def _on_cursor_moved(self, moved_plot: ViewPlot) -> None:
        """Move the cursors of all plots together, if all plots have the same horizontal axis."""
        if self._cursor_kind is None:
            return
        if self._cursor_kind is not PlotKind.LOOP:
            (a, _), (b, _) = moved_plot.cursors
            for plot in self.plots.values():
                if plot.plot is not moved_plot:
                    plot.plot.place_cursors(a, b)
        self._read_cursors()

    def _read_cursors(self) -> None:
        (a, _), (b, _) = next(iter(self.plots.values())).plot.cursors
        kind = self._get_kind()
        if kind is PlotKind.SPECTRUM:
            a, b = 10.0**a, 10.0**b
        self._legend.show_text(describe_cursors(kind, a, b))
        for plot in self.plots.values():
            plot.read_cursors()

    def _use_theme(self, theme: Theme) -> None:
        entries = [LegendEntry(tr(name), line) for name, line in LEGEND_ENTRIES]
        if self.workbench.session.model.is_corrected:
            entries.append(LegendEntry(tr("nominal"), LINE_STYLES["nominal"]))
        if (overlay := self.overlay_choice.overlay) is not None:
            entries.append(LegendEntry(overlay.name, LINE_STYLES["other"]))
        if self._get_kind() in (PlotKind.POSITION, PlotKind.GAP):
            window_text = format_rounded(GAP_WINDOW_S, 2)
            for name, line in STRIP_LEGEND_ENTRIES:
                entries.append(LegendEntry(tr(name).format(n=window_text), line))
        self._legend.show_entries(entries, theme)
        for plot in self.plots.values():
            plot.use_theme(theme)


def _make_choice(name: str, options: Iterable[tuple[object, str]]) -> QComboBox:
    box = QComboBox()
    for value, text in options:
        # Qt returns a StrEnum as plain text, so it is stored as plain text as well.
        box.addItem(text, str(value) if isinstance(value, str) else value)
    box.setAccessibleName(name)
    box.setToolTip(name)
    return box


def _ask_path(
    parent: QWidget, title: str, name: str, file_filter: str, save: Callable[[Path], None]
) -> None:
    path, _ = QFileDialog.getSaveFileName(parent, title, name, file_filter)
    if path:
        save(Path(path))
