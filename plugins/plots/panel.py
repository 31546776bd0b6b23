"""Plots of every axis: over time, loops, spectra; cursors, a second run, and export."""

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

from rotemina.app.display_units import stages
from rotemina.app.motion.recent_history import LiveWindow
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_S, Area, Panel, offer_in_palette
from rotemina.app.shell.gap_words import LIVE_S
from rotemina.app.shell.language import marked
from rotemina.app.shell.legend import Entry, Legend
from rotemina.app.shell.plot import LINES
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.drivers.clock import Clock
from rotemina.plugins.plots import mark, tr
from rotemina.plugins.plots.axis_plot import AxisPlot, Picture
from rotemina.plugins.plots.cursor_text import Shown, across_text
from rotemina.plugins.plots.exporting import save_picture
from rotemina.plugins.plots.history_signals import SHORT_S, GapHistory, as_record, gaps_of, latest
from rotemina.plugins.plots.overlay_choice import RunBeside
from rotemina.plugins.plots.plot_grid import PlotGrid
from rotemina.plugins.plots.view_plot import ViewPlot
from rotemina.sim.comparison.gap import GapFigure
from rotemina.sim.quantities import rounded
from rotemina.sim.records.writing import write_record

SPANS_S = (2, 5, 10, 30, 60)
_LEAST_HEIGHT = 52  # px: of a strip of plots without the controls
_PARTS = 6  # of the plots, of which one is drawn at a time
_BETWEEN_MS = 3  # two parts, in which the first is painted; else all would be in one go
FIGURES_S = 0.25  # nor are figures
SPECTRUM_S = 0.25  # a spectrum is computed no oftener
LEGEND = (
    (mark("command"), LINES["command"]),
    (mark("model in use"), LINES["model"]),
    (mark("measured"), LINES["measured"]),
)
STRIP_LEGEND = ((mark("gap, last {n} s"), LINES["gap"]), (mark("noise floor"), None))
VIEWS = {
    Shown.POSITION: mark("Position"),
    Shown.GAP: mark("Gap: measured − model"),
    Shown.LOOP: mark("Loop: over command"),
    Shown.SPECTRUM: mark("Spectrum"),
}


class PlotsPanel(Panel):
    """One plot an axis; the stages stand side by side."""

    title = marked("panels", "Plots")
    area = Area.CENTRE
    order = 10
    help_page = "plots.md"

    def __init__(self, workbench: Workbench, clock: Clock = time.monotonic) -> None:
        super().__init__(workbench)
        self._clock, self._drawn_s = clock, float("-inf")
        self._held: LiveWindow | None = None
        self._told_s = float("-inf")
        self._gaps: Mapping[str, GapFigure | None] = {}
        self._course: GapHistory | None = None
        self._picture: Picture | None = None
        self._read_view: Shown | None = None  # the view that the cursors stand in
        self.plots = {
            name: AxisPlot(workbench, column, moved=self._cursor_moved)
            for column, name in enumerate(workbench.robot.axes)
        }
        self.grid = PlotGrid(self.plots, [list(axes) for axes in stages(workbench.robot).values()])
        self._head, header = QWidget(), self._header()
        below = in_row((self._legend, 1), self.age)
        in_column(header, below, on=self._head, margins=0, spacing=3)
        in_column(self._head, (self.grid, 1), on=self, margins=0, spacing=3)
        self.setMinimumHeight(_LEAST_HEIGHT)
        offer_in_palette(self.pause, self.cursors, safe_while_hidden=True)
        self._waiting: list[Sequence[AxisPlot]] = []  # to be drawn as the others are already
        self._next = QTimer(self, singleShot=True, interval=_BETWEEN_MS)
        self._next.timeout.connect(self._draw_next)
        self.follow_frames(self._show_age, shown=True)
        workbench.shown.connect(lambda _: self._refresh_by_parts())
        workbench.replaying.changed.connect(self._begin_anew)
        workbench.theme_changed.connect(self._use_theme)
        workbench.model_changed.connect(self._use_model)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave the controls out and use fewer rows where the panel is low."""
        super().resizeEvent(event)
        head = self._head.sizeHint().height()
        self._head.setVisible(self.grid.arrange(self.width(), self.height(), head))
        self.grid.share_height()

    def refresh(self) -> None:
        """Draw the newest samples, unless paused or out of sight; recording continues."""
        if self._is_due():
            self._draw(self._newest())

    def _refresh_by_parts(self) -> None:
        """Do so with a few plots at a time, between which the window can do something else."""
        if self._is_due() and not self._waiting:
            self._take(self._newest())
            plots = list(self.plots.values())
            self._waiting = [plots[at::_PARTS] for at in range(min(_PARTS, len(plots)))]
            self._draw_next()

    def _show_age(self, state: SessionState) -> None:
        """Turn the curves grey and say how old they are while no new readings come."""
        age_s = state.age_s
        stale = age_s is not None and age_s > STALE_S
        if age_s is not None and stale:
            self.age.setText(tr("The newest reading is {n} s old").format(n=max(1, round(age_s))))
        self.age.setVisible(stale)
        for plot in self.plots.values():
            plot.set_stale(stale)

    def _draw_next(self) -> None:
        if self._waiting and self._picture is not None:
            for plot in self._waiting.pop(0):
                plot.draw(self._picture)
        if self._waiting:
            self._next.start()
        else:
            self._after_drawing()

    def _is_due(self) -> bool:
        if self.pause.isChecked() or not self.isVisible():
            return False
        return self._shown() is not Shown.SPECTRUM or self._clock() - self._drawn_s >= SPECTRUM_S

    def _newest(self) -> LiveWindow:
        return self.workbench.source.history.tail(float(self.span.currentData()))

    def save_data(self, path: Path) -> None:
        """Write what is shown as a record; a failure becomes a notice."""
        window, robot = self._stretch(), self.workbench.robot
        self.workbench.write_file(
            "save plots", path, lambda: write_record(as_record(window, robot), path)
        )

    def save_picture(self, path: Path) -> None:
        """Write a picture of all plots, PNG or SVG by the name."""
        for plot in self.plots.values():
            plot.plot.settle()
        if self.workbench.ask(lambda: save_picture(self.grid, path)):
            self.workbench.notify(Level.GOOD, tr("Saved {path}").format(path=path))

    # --- parts ------------------------------------------------------------------------------------

    def _header(self) -> QHBoxLayout:
        self.shown = _choice(
            tr("Contents of the plots"), ((key, tr(text)) for key, text in VIEWS.items())
        )
        self.span = _choice(tr("Time span of the plots"), ((s, f"{s} s") for s in SPANS_S))
        for box in (self.shown, self.span):
            box.setSizeAdjustPolicy(box.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.shown.setMinimumContentsLength(9)
        self.span.setMinimumContentsLength(4)
        self.span.setCurrentIndex(SPANS_S.index(10))
        self.beside = RunBeside(self, self._stretch, self._whole)
        self.beside.changed.connect(self._draw_other)
        self.shown.currentIndexChanged.connect(lambda _: self._change_view())
        self.span.currentIndexChanged.connect(lambda _: self._draw_again())
        self.cursors = QPushButton(tr("Cursors"))
        self.cursors.setCheckable(True)
        self.cursors.setToolTip(tr("Two lines to drag; their values appear above each plot"))
        self.cursors.toggled.connect(lambda _: self._show_cursors())
        self.pause = QPushButton(tr("Freeze"))
        self.pause.setCheckable(True)
        self.pause.setToolTip(tr("Freeze the plots; motion, recording and replay continue"))
        self.pause.toggled.connect(self._hold)
        self.more = QPushButton(tr("More"))
        self.more.setMenu(self._menu())
        self.more.setToolTip(tr("Alignment, and files of the plots"))
        self._legend = Legend(self.workbench.theme)
        self.age = QLabel()
        self.age.setProperty("tone", "warning")
        self.age.hide()
        self._use_theme(self.workbench.theme)
        parts = (self.shown, 2), (self.beside, 1), self.span, self.cursors, self.pause, self.more
        return in_row(*parts, spacing=4)

    def _menu(self) -> QMenu:
        menu = QMenu(self)
        menu.addAction(tr("Align the other run"), self.beside.align)
        menu.addSeparator()
        for text, name, kinds, save in (
            (tr("Save picture …"), "plots.png", tr("Pictures (*.png *.svg)"), self.save_picture),
            (tr("Save data …"), "plots.csv", tr("Records (*.csv *.csv.gz)"), self.save_data),
        ):
            menu.addAction(text, partial(_ask_path, self, text, name, kinds, save))
        return menu

    # --- what is drawn ----------------------------------------------------------------------------

    def _shown(self) -> Shown:
        return Shown(self.shown.currentData())

    def _whole(self) -> LiveWindow:
        """Return all that may be shown: the history, or what the pause holds of it."""
        return self._held if self._held is not None else self.workbench.source.history.tail()

    def _stretch(self) -> LiveWindow:
        """Return what is drawn."""
        picture = self._picture
        if picture is not None:
            return picture.window
        return latest(self._whole(), float(self.span.currentData()))

    def _take(self, window: LiveWindow) -> Picture:
        self._drawn_s = self._clock()
        span_s = float(self.span.currentData())
        run = self.workbench.run
        self._look_at_gaps(window, span_s)
        self._picture = Picture(
            window,
            span_s,
            self._shown(),
            self.beside.other,
            self.beside.shift_s,
            self._gaps,
            run.gaps if run is not None else {},
            self._course,
        )
        return self._picture

    def _look_at_gaps(self, window: LiveWindow, span_s: float) -> None:
        """Work out the gaps of the last 10 s and their course, no oftener than they can be read."""
        now_s, live = self._clock(), self._held is None
        if live and now_s - self._told_s < FIGURES_S:
            return
        self._told_s = now_s
        self._course = GapHistory.of(window, span_s)
        if live:
            whole = span_s >= LIVE_S
            history = self.workbench.source.history
            self._gaps = gaps_of(latest(window, LIVE_S) if whole else history.tail(LIVE_S))

    def _draw(self, window: LiveWindow) -> None:
        picture = self._take(window)
        self._waiting.clear()
        for plot in self.plots.values():
            plot.draw(picture)
        self._after_drawing()

    def _after_drawing(self) -> None:
        if self._picture is not None and self._read_view is self._picture.shown:
            self._read_cursors()

    def _draw_again(self) -> None:
        held = self._held  # all of the history is tens of megabytes to copy
        self._draw(self._newest() if held is None else latest(held, float(self.span.currentData())))

    def _draw_other(self) -> None:
        self._draw_again()
        self._use_theme(self.workbench.theme)

    def _change_view(self) -> None:
        self._draw_again()
        self._show_cursors()

    def _hold(self, held: bool) -> None:
        self._held = self.workbench.source.history.tail() if held else None
        self._draw_again()

    def _use_model(self, _: object) -> None:
        """Begin the gap again, and name the nominal model where another is in use."""
        self._told_s = float("-inf")
        self._use_theme(self.workbench.theme)

    def _begin_anew(self) -> None:
        """Draw what is shown now: no picture of the machine stays in a replay, nor the reverse."""
        self.pause.setChecked(False)
        self.refresh()

    # --- cursors ----------------------------------------------------------------------------------

    def _show_cursors(self) -> None:
        on, loop = self.cursors.isChecked(), self._shown() is Shown.LOOP
        for plot in self.plots.values():
            plot.plot.show_cursors(across=on, along=on and loop)
        self._read_view = self._shown() if on else None
        if on:
            self._read_cursors()
        else:
            self._use_theme(self.workbench.theme)
            self._draw_again()

    def _cursor_moved(self, moved: ViewPlot) -> None:
        """Move the cursors of all plots with those of one, where all have one scale across."""
        if self._read_view is None:
            return
        if self._read_view is not Shown.LOOP:
            (a, _), (b, _) = moved.cursors
            for plot in self.plots.values():
                if plot.plot is not moved:
                    plot.plot.place_cursors(a, b)
        self._read_cursors()

    def _read_cursors(self) -> None:
        (a, _), (b, _) = next(iter(self.plots.values())).plot.cursors
        shown = self._shown()
        if shown is Shown.SPECTRUM:
            a, b = 10.0**a, 10.0**b
        self._legend.show_text(across_text(shown, a, b))
        for plot in self.plots.values():
            plot.read_cursors()

    def _use_theme(self, theme: Theme) -> None:
        entries = [Entry(tr(name), line) for name, line in LEGEND]
        if self.workbench.session.model.corrected:
            entries.append(Entry(tr("nominal"), LINES["nominal"]))
        if (other := self.beside.other) is not None:
            entries.append(Entry(other.name, LINES["other"]))
        if self._shown() in (Shown.POSITION, Shown.GAP):
            short = rounded(SHORT_S, 2)
            for name, line in STRIP_LEGEND:
                entries.append(Entry(tr(name).format(n=short), line))
        self._legend.show_entries(entries, theme)
        for plot in self.plots.values():
            plot.use_theme(theme)


def _choice(name: str, offered: Iterable[tuple[object, str]]) -> QComboBox:
    box = QComboBox()
    for value, text in offered:
        # Qt would hand an enumeration of text back as plain text anyway.
        box.addItem(text, str(value) if isinstance(value, str) else value)
    box.setAccessibleName(name)
    box.setToolTip(name)
    return box


def _ask_path(
    parent: QWidget, title: str, name: str, kinds: str, save: Callable[[Path], None]
) -> None:
    path, _ = QFileDialog.getSaveFileName(parent, title, name, kinds)
    if path:
        save(Path(path))
