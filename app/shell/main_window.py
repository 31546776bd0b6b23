"""The window that hosts the panels: tool bar with the stop button, docks, notices, status."""

import logging
from collections.abc import Callable, Iterator
from pathlib import Path

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import (
    QAction,
    QCloseEvent,
    QKeySequence,
    QResizeEvent,
    QShowEvent,
    QWindowStateChangeEvent,
)
from PySide6.QtWidgets import (
    QApplication,
    QDialog,
    QDockWidget,
    QFrame,
    QMenu,
    QTabWidget,
    QWidget,
)

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell import commands, key_help, layout_menu, layouts
from rotemina.app.shell.central_column import CentralColumn
from rotemina.app.shell.column_mapping import ask_columns
from rotemina.app.shell.deferred_panels import LatePanels
from rotemina.app.shell.event_loop_watch import LoopWatch
from rotemina.app.shell.file_dialog import ask_file, ask_where
from rotemina.app.shell.first_steps import FirstSteps
from rotemina.app.shell.folded_panels import FoldedPanels
from rotemina.app.shell.help_button import DockHelp, TabHelp
from rotemina.app.shell.help_page import HelpPage
from rotemina.app.shell.help_topics import Explained, page_at
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.language_menu import LanguageMenu, language_entries
from rotemina.app.shell.log_page import LogPage
from rotemina.app.shell.machine_badge import MAYBE_REAL, window_title
from rotemina.app.shell.message_log import MessageLog
from rotemina.app.shell.motion_bar import MotionBar
from rotemina.app.shell.notices import NoticeBoard
from rotemina.app.shell.palette import Palette
from rotemina.app.shell.palette_entries import Entry, PanelGuard, command_entries, panel_entries
from rotemina.app.shell.panel_declarations import PanelKind
from rotemina.app.shell.panel_host import find_panels
from rotemina.app.shell.panel_news import PanelNews
from rotemina.app.shell.progress_line import ProgressLine
from rotemina.app.shell.quit_dialog import Leaving
from rotemina.app.shell.recent_files import RecentFiles
from rotemina.app.shell.record_chooser import ask_records
from rotemina.app.shell.reloading import Reloading, ReloadMenu, panel_subject
from rotemina.app.shell.replay_bar import ReplayBar
from rotemina.app.shell.resume_question import ResumeQuestion
from rotemina.app.shell.screen_fit import LEAST, WHOLE_SCREEN, ScreenFit
from rotemina.app.shell.status_line import StatusText
from rotemina.app.shell.stop_controls import StopWatch
from rotemina.app.shell.support_page import SupportPage
from rotemina.app.shell.window_layout import ArrangedWindow, Arrangement
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.scroll_areas import PanelFrame, frame_of

TOP_LINE = 4  # px: white where a real machine is driven
PLUGIN_FAULTS = "plugins.md#what-a-bad-plugin-can-do"
FILES = marked("shell", "Records and trajectories (*.csv *.txt *.dat *.gz);;All files (*)")
# Wide tables and long forms: one behind the other, not side by side or one below the other.
TABBED = (Area.BOTTOM, Area.RIGHT)


class MainWindow(ArrangedWindow):
    """The operator's window around a workbench."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setAnimated(False)  # Qt would move every dock by an animation at each new layout
        self.workbench = workbench
        workbench.setParent(self)  # so that Qt ends it with the window, on this thread
        self.notices = NoticeBoard(self)
        self.replay_bar = ReplayBar(workbench)
        self.resume_question = ResumeQuestion(workbench)
        self.panels, found_broken = find_panels(workbench)
        broken = dict(found_broken)
        self.panels.failed = broken.__setitem__  # until there is a place to tell it
        self.docks: dict[str, QDockWidget] = {}
        self.panel_room = QSize(LEAST)
        self._menus: dict[str, QMenu] = {}
        self._leaving = Leaving(self, workbench)
        self._support: SupportPage | None = None
        self.help_page = HelpPage(self)
        workbench.theme_changed.connect(lambda _: self.help_page.restyle())
        self.log = MessageLog()
        logging.getLogger().addHandler(self.log)
        workbench.closing.connect(lambda: logging.getLogger().removeHandler(self.log))
        workbench.noticed.connect(self.log.notice)
        self._make_header()
        self._make_docks()
        self.news = PanelNews(self, self.docks)
        self.panels.placed = self._place
        self.reloading = Reloading(workbench, self.panels, self.docks, self._add_dock)
        self.late_panels = LatePanels(self.panels, self.docks, workbench)
        self.folded = FoldedPanels(self.docks)
        self.arrangement = Arrangement(self)
        self._screen_fit = ScreenFit(self)
        self._make_menus()
        self._make_status_bar()
        self.loop_watch = LoopWatch(self)  # started by whoever runs the window
        workbench.closing.connect(self.loop_watch.close)
        self.log_page = LogPage(self.log, workbench.theme, self.loop_watch, self)
        workbench.theme_changed.connect(self.log_page.set_theme)
        self.palette_page = Palette(self._entries, self)
        self.arrangement.restore()
        self.arrangement.dress()
        self._stop_watch = StopWatch(workbench, self.stop_button, self.emergency_button, self)
        self._stop_watch.start()
        workbench.closing.connect(self._stop_watch.close)
        self._connect()
        self.panels.failed = self._leave_out
        for name, reason in broken.items():
            self._leave_out(name, reason)

    def _connect(self) -> None:
        workbench = self.workbench
        workbench.noticed.connect(self.notices.show_notice)
        self.notices.asked.connect(self.help_page.open_page)
        self.notices.more_asked.connect(self.show_log)
        workbench.acted.connect(self.notices.act)
        workbench.settled.connect(self.notices.settle)
        workbench.refreshed.connect(self.notices.look_at)
        self.log_page.asked.connect(self.help_page.open_page)
        workbench.refreshed.connect(self._refresh)
        # What arrives by itself raises no panel: that would change the tabs under the mouse.
        news = self.news
        workbench.plan_changed.connect(lambda plan: news.arrived("trajectory", plan.trajectory))
        workbench.run_changed.connect(lambda run: news.arrived("comparison", run.record))
        workbench.ports_offered.connect(lambda ports: ports and news.arrived("connection", ports))
        workbench.arrived.connect(news.arrived)
        workbench.panel_asked.connect(self.bring_up)

    # --- parts ------------------------------------------------------------------------------------

    def _make_header(self) -> None:
        self.header = self._bar = MotionBar(self.workbench)
        self.stop_button, self.emergency_button = self._bar.stop, self._bar.emergency
        self.addToolBar(self._bar)
        self._top_line = QFrame(self)
        self._top_line.setObjectName("machineLine")
        self._bar.events_asked.connect(self.show_log)
        self._bar.machine_changed.connect(self._name_machine)
        self._name_machine()

    def _make_docks(self) -> None:
        self.first_steps = FirstSteps(self.workbench)
        self.first_steps.asked.connect(self.bring_up)
        bars = self.replay_bar, self.resume_question, self.first_steps
        self.setCentralWidget(CentralColumn(bars, self._central_panels()))
        for area in TABBED:
            self.setTabPosition(layouts.DOCK_AREAS[area], QTabWidget.TabPosition.North)
        self.setCorner(Qt.Corner.BottomLeftCorner, Qt.DockWidgetArea.LeftDockWidgetArea)
        first: dict[Area, QDockWidget] = {}
        for name, kind in self.panels.kinds.items():
            if kind.area is Area.CENTRE:
                continue
            dock = self.docks[name] = self._dock(name, kind)
            if kind.area in TABBED and first.setdefault(kind.area, dock) is not dock:
                self.tabifyDockWidget(first[kind.area], dock)
        for dock in first.values():
            dock.raise_()
        if Area.BOTTOM in first:
            self.resizeDocks([first[Area.BOTTOM]], [260], Qt.Orientation.Vertical)

    def _central_panels(self) -> QWidget:
        names = [name for name, kind in self.panels.kinds.items() if kind.area is Area.CENTRE]
        central = [panel for panel in map(self.panels.make, names) if panel is not None]
        self.central_tabs: QTabWidget | None = None
        frames = [PanelFrame(one, self.panel_room) for one in central]
        tabs = self.central_tabs = QTabWidget()
        pages = {
            tabs.addTab(frame, translate("panels", panel.title)): panel.help_page
            for frame, panel in zip(frames, central, strict=True)
        }
        TabHelp(tabs, pages, self.help_page.open_page)
        return tabs

    def _dock(self, name: str, kind: PanelKind) -> QDockWidget:
        """Return a dock for a panel, which is not made yet."""
        dock = QDockWidget(translate("panels", kind.title))
        dock.setObjectName(f"dock-{name}")
        self.addDockWidget(layouts.DOCK_AREAS[kind.area], dock)
        if kind.help_page:
            DockHelp(dock, lambda: self.help_page.open_page(kind.help_page))
        return dock

    def _add_dock(self, name: str, kind: type[Panel]) -> None:
        """Make a dock for a panel that was left out, beside those of its area."""
        dock = self._dock(name, kind)
        area = layouts.DOCK_AREAS[kind.area]
        others = (one for one in self.docks.values() if self.dockWidgetArea(one) == area)
        beside = next((one for one in others if not one.isFloating()), None)
        if kind.area in TABBED and beside is not None:
            self.tabifyDockWidget(beside, dock)
        self.docks[name] = dock
        self.news.watch(name, dock)
        self._menu(translate("shell", "&View")).addAction(dock.toggleViewAction())
        dock.raise_()

    def _place(self, name: str, panel: Panel) -> None:
        """Put a panel that has just been made into its dock."""
        panel.setObjectName("panel")
        panel.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        dock = self.docks[name]
        before = dock.widget()
        dock.setWidget(PanelFrame(panel, self.panel_room))
        if before is not None:  # of a panel that was reloaded
            before.deleteLater()

    def frames(self) -> Iterator[PanelFrame]:
        """Yield the frames of all panels that are made."""
        tabs = self.central_tabs
        central = [] if tabs is None else map(tabs.widget, range(tabs.count()))
        for widget in (*central, *(dock.widget() for dock in self.docks.values())):
            if isinstance(widget, PanelFrame):
                yield widget

    def _leave_out(self, name: str, reason: str) -> None:
        """Tell that there is a panel less, and take its dock away."""
        dock = self.docks.pop(name, None)
        if dock is not None:
            self.removeDockWidget(dock)
            dock.deleteLater()
        text = translate("shell", "Panel {name!r} is left out: {reason}").format(
            name=name, reason=reason
        )
        subject = panel_subject(name)
        message = Explained(text, PLUGIN_FAULTS, self.reloading.remedy(name), subject=subject)
        self.workbench.notify(Level.ERROR, message)

    def _make_menus(self) -> None:
        for command in self.commands():
            menu = self._menu(command.menu)
            action = QAction(command.text, self)
            action.setShortcut(QKeySequence(command.shortcut))
            # Of the whole program: a floating dock is a window of its own.
            action.setShortcutContext(Qt.ShortcutContext.ApplicationShortcut)
            action.setAutoRepeat(False)  # a key that is held must not play, pause and resume
            action.setStatusTip(command.tip)
            action.triggered.connect(lambda _=False, run=command.run: run())
            menu.addAction(action)
        kinds = {
            "trajectory": (translate("shell", "trajectory"), self.load_trajectory),
            "record": (translate("shell", "record"), self.open_record),
        }
        file = self._menu(translate("shell", "&File"))
        self.recent_files = RecentFiles(self.workbench.settings, kinds, file)
        file.insertMenu(file.actions()[3], self.recent_files)
        view = self._menu(translate("shell", "&View"))
        view.addSeparator()
        arrangement = self.arrangement
        self.layout_menu = layout_menu.KeptLayoutMenu(arrangement.kept, arrangement.use_kept, view)
        view.addMenu(self.layout_menu)
        self.language_menu = LanguageMenu(self.workbench, view)
        view.addMenu(self.language_menu)
        self.reload_menu = ReloadMenu(self.reloading, view)
        view.addMenu(self.reload_menu)
        view.aboutToShow.connect(self.reload_menu.look)
        view.addSeparator()
        for dock in self.docks.values():
            view.addAction(dock.toggleViewAction())
        self.layout_row = layout_menu.LayoutRow(self.menuBar(), arrangement.arrange, self.folded)

    def commands(self) -> list[commands.Command]:
        """Return every command of the menus."""
        return commands.commands(self)

    def _menu(self, title: str) -> QMenu:
        """Return a menu of the menu bar, made when it is first asked for."""
        if title not in self._menus:
            self._menus[title] = self.menuBar().addMenu(title)
        return self._menus[title]

    def _make_status_bar(self) -> None:
        self._status = StatusText(self.workbench)
        self.statusBar().addWidget(self._status, 1)
        self.progress_line = ProgressLine()
        self.statusBar().addPermanentWidget(self.progress_line)
        self.statusBar().setSizeGripEnabled(False)

    def _name_machine(self) -> None:
        """Say in the title, and by a white line across the top, which machine is driven."""
        badge = self._bar.badge
        self.setWindowTitle(window_title(badge, self.workbench.robot.name))
        self._top_line.setVisible(badge.machine in MAYBE_REAL)
        self._top_line.raise_()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Keep the line across the whole top, and what fits the width at the side."""
        super().resizeEvent(event)
        self._top_line.setGeometry(0, 0, self.width(), TOP_LINE)
        self.arrangement.fit()

    # --- files ------------------------------------------------------------------------------------

    def ask_trajectory(self, *, show: bool = True) -> None:
        """Ask for a trajectory file and load it; ``show`` brings up the panel that plays it."""

        def load(path: Path) -> None:
            self.load_trajectory(path, show=show)

        self._ask_and(translate("shell", "Load trajectory"), load)

    def ask_record(self) -> None:
        """Ask for a record of the library, or a file, and compare it with the model."""
        title = translate("shell", "Open record")
        ask_records(
            self,
            self.workbench,
            title,
            lambda chosen: self._show_and("comparison", self.workbench.open_entry, chosen[0]),
            lambda: self._ask_and(title, self.open_record),
        )

    def ask_trajectory_of_record(self) -> None:
        """Ask for a record of the library, or a file, and take its commands in hand."""
        ask_records(
            self,
            self.workbench,
            translate("shell", "Trajectory from record"),
            lambda chosen: self._show_and("trajectory", self.workbench.load_entry, chosen[0]),
            self.ask_trajectory,
        )

    def _show_and(self, name: str, use: Callable[[Entry], None], entry: Entry) -> None:
        """Bring up a panel, and hand an entry of the library on whose answer it will show."""
        self.bring_up(name)
        use(entry)

    def load_trajectory(self, path: Path, *, show: bool = True) -> None:
        """Load a trajectory file, and keep it among the recent ones."""
        if show:  # now, not when it is read: the operator may press something else by then
            self.bring_up("trajectory")
        self.recent_files.add("trajectory", path)
        self.use_file(path, self.workbench.load_trajectory)

    def open_record(self, path: Path) -> None:
        """Open a record file, and keep it among the recent ones."""
        self.bring_up("comparison")
        self.recent_files.add("record", path)
        self.use_file(path, self.workbench.open_record)

    def _ask_and(self, title: str, use: Callable[[Path], None]) -> None:
        ask_file(self, self.workbench, title, translate("shell", FILES), use)

    def use_file(self, path: Path, use: Callable[[Path, str | None], None]) -> None:
        """Hand a file on, with its columns named first where it has no header."""
        ask_columns(path, self.workbench, self, use)

    def ask_save(self) -> None:
        """Ask where to, and save the record in hand."""
        if self.workbench.record is None:
            text = translate("shell", "There is no record to save: play or open one.")
            self.workbench.notify(
                Level.WARNING,
                text,
                about="comparison.md",
                until=lambda _: self.workbench.record is not None,
            )
            return
        title, kinds = (
            translate("shell", "Save record"),
            translate("shell", "Records (*.csv *.csv.gz)"),
        )
        ask_where(self, self.workbench, title, kinds, "record.csv", self.workbench.save_record)

    # --- layout and theme -------------------------------------------------------------------------

    def use_theme(self, name: str) -> None:
        """Change the colours and remember them."""
        self.arrangement.use_theme(name)

    def reset_layout(self) -> None:
        """Bring every dock back to where it was at first."""
        self.arrangement.reset()

    def ask_layout_name(self) -> None:
        """Ask for a name, and keep the layout under it."""
        layout_menu.ask_name(self, self.arrangement.keep)

    def bring_up(self, name: str) -> None:
        """Show a panel, in front of those beside it, whether its dock was closed or not."""
        panel = self.panels.make(name)
        if panel is None:
            text = translate("shell", "Panel {name!r} is missing: it was left out, see the log.")
            self.workbench.notify(Level.WARNING, text.format(name=name), about=PLUGIN_FAULTS)
            return
        if name in self.docks:
            self.docks[name].show()
            self.docks[name].raise_()
        elif self.central_tabs is not None:
            self.central_tabs.setCurrentWidget(frame_of(panel))

    # --- help -------------------------------------------------------------------------------------

    def toggle_palette(self) -> None:
        """Open the command palette, or close it."""
        if self.palette_page.isVisible():
            self.palette_page.hide()
        else:
            self.palette_page.open_anew()

    def _entries(self) -> Iterator[Entry]:
        self.panels.make_all()
        guard = PanelGuard(
            self.panels.made,
            self.docks,
            self.bring_up,
            lambda text: self.workbench.notify(Level.INFO, text),
        )
        yield from command_entries(self.commands(), guard)
        use = self.arrangement.use_kept
        for name in self.arrangement.kept.names():
            yield Entry(translate("shell", "Layout"), name, "", None, lambda name=name: use(name))
        yield from language_entries(self.workbench)
        yield from self.reloading.entries()
        yield from panel_entries(guard)

    def help_here(self) -> None:
        """Show the page of the panel that has the focus, or had it last; else the window's."""
        focused = (QApplication.focusWidget(), self.focusWidget())
        pages = filter(None, map(page_at, focused))
        self.help_page.open_page(next(pages, "window.md"))

    def show_help(self) -> None:
        """Show the first page, from which all others are reached."""
        self.help_page.open_page("index.md")

    def show_keys(self) -> None:
        """List all shortcuts."""
        key_help.KeyHelp(key_help.keys(self.findChildren(QAction)), self).show()

    def show_log(self) -> None:
        """Show all that the program told."""
        _come_up(self.log_page)

    def show_support(self) -> None:
        """Put a support bundle together and show what is in it."""
        if self._support is not None:
            self._support.close()
            self._support.deleteLater()
        self._support = SupportPage(self.workbench, self.log, self.loop_watch, self)
        _come_up(self._support)

    # --- what happens -----------------------------------------------------------------------------

    def _refresh(self, state: SessionState) -> None:
        self._bar.refresh(state)
        self.progress_line.show_progress(self.workbench.progress)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin to make what was not needed until now."""
        super().showEvent(event)
        self._screen_fit.fit_soon()
        self.late_panels.start()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Stay on the screen when the window no longer takes all of it."""
        super().changeEvent(event)
        if isinstance(event, QWindowStateChangeEvent) and event.oldState() & WHOLE_SCREEN:
            self._screen_fit.fit_soon()

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802 (Qt's name)
        """Ask before what moves is stopped; wait until it rests, and for what is being written."""
        if not self._leaving.may_close():
            event.ignore()
            return
        self.arrangement.remember()
        self.workbench.close()
        event.accept()


def _come_up(page: QDialog) -> None:
    page.show()
    page.raise_()
    page.activateWindow()
