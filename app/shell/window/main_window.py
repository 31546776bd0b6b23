"""The main window: header with stop buttons, docks with panels, menus, notices and status bar."""

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

from rotemina.app.language import marked, translate
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Panel, PanelArea
from rotemina.app.records import LibraryEntry
from rotemina.app.shell.help import (
    DockHelpButton,
    FirstStepsCard,
    HelpDialog,
    TabHelpButton,
    key_help,
)
from rotemina.app.shell.notices import NoticeBoard
from rotemina.app.shell.panels import (
    DeferredPanelLoader,
    PanelKind,
    PanelNews,
    find_panels,
    make_panel_subject,
)
from rotemina.app.shell.records import (
    RecentFilesMenu,
    ask_columns,
    ask_file,
    ask_records,
    ask_save_path,
)
from rotemina.app.shell.support import EventLoopWatch, LogDialog, MessageLog, SupportDialog
from rotemina.app.shell.window import commands, layout_menu, layouts
from rotemina.app.shell.window.central_column import CentralColumn
from rotemina.app.shell.window.folded_panels import FoldedPanelButtons
from rotemina.app.shell.window.language_menu import LanguageMenu, make_language_entries
from rotemina.app.shell.window.machine_badge import MAYBE_REAL, make_window_title
from rotemina.app.shell.window.motion_bar import MotionBar
from rotemina.app.shell.window.palette import CommandPalette
from rotemina.app.shell.window.palette_entries import (
    PaletteEntry,
    PanelGuard,
    make_command_entries,
    make_panel_entries,
)
from rotemina.app.shell.window.quit_dialog import WindowCloser
from rotemina.app.shell.window.replay_bar import ReplayBar
from rotemina.app.shell.window.resume_question import ResumeQuestion
from rotemina.app.shell.window.screen_fit import MIN_WINDOW_SIZE, WHOLE_SCREEN_STATES, ScreenFitter
from rotemina.app.shell.window.status_line import StatusText
from rotemina.app.shell.window.stop_controls import StopInputFilter
from rotemina.app.shell.window.window_layout import ArrangedWindow, WindowArrangement
from rotemina.app.widgets.layout import PanelFrame, find_frame
from rotemina.app.workbench import (
    Level,
    NoticeMessage,
    StatusProgressLine,
    Workbench,
    find_panel_page,
)

# Height of the white line that is shown while a real machine is driven.
TOP_LINE_PX = 4
PLUGIN_FAULTS_PAGE = "plugins.md#what-a-bad-plugin-can-do"
FILE_FILTER = marked("shell", "Records and trajectories (*.csv *.txt *.dat *.gz);;All files (*)")
# Panels in these areas are wide tables and long forms, so they are placed in tabs.
TABBED_AREAS = (PanelArea.BOTTOM, PanelArea.RIGHT)


class MainWindow(ArrangedWindow):
    """The operator's window around a workbench."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        # With animations, Qt would move every dock gradually at each change of layout.
        self.setAnimated(False)
        self.workbench = workbench
        # As a child, the workbench is deleted with the window and on its thread.
        workbench.setParent(self)
        self.notices = NoticeBoard(self)
        self.replay_bar = ReplayBar(workbench)
        self.resume_question = ResumeQuestion(workbench)
        self.panels, broken_entry_points = find_panels(workbench)
        broken_panels = dict(broken_entry_points)
        # Failures are collected until notices can be shown.
        self.panels.on_failed = broken_panels.__setitem__
        self.docks: dict[str, QDockWidget] = {}
        self.panel_room = QSize(MIN_WINDOW_SIZE)
        self._menus: dict[str, QMenu] = {}
        self._closer = WindowCloser(self, workbench)
        self._support: SupportDialog | None = None
        self.help_page = HelpDialog(self)
        workbench.theme_changed.connect(lambda _: self.help_page.restyle())
        self.log = MessageLog()
        logging.getLogger().addHandler(self.log)
        workbench.closing.connect(lambda: logging.getLogger().removeHandler(self.log))
        workbench.notice_posted.connect(self.log.add_notice)
        self._make_header()
        self._make_docks()
        self.news = PanelNews(self, self.docks)
        self.panels.on_ready_to_place = self._place_panel
        self.panel_loader = DeferredPanelLoader(self.panels, self.docks, workbench)
        self.folded = FoldedPanelButtons(self.docks)
        self.arrangement = WindowArrangement(self)
        self._screen_fit = ScreenFitter(self)
        self._make_menus()
        self._make_status_bar()
        # It is started by the function that runs the window.
        self.loop_watch = EventLoopWatch(self)
        workbench.closing.connect(self.loop_watch.close)
        self.log_page = LogDialog(self.log, workbench.theme, self.loop_watch, self)
        workbench.theme_changed.connect(self.log_page.set_theme)
        self.palette_page = CommandPalette(self._make_palette_entries, self)
        self.arrangement.restore()
        self.arrangement.apply_current_theme()
        self._stop_watch = StopInputFilter(workbench, self.stop_button, self.emergency_button, self)
        self._stop_watch.start()
        workbench.closing.connect(self._stop_watch.close)
        self._connect_signals()
        self.panels.on_failed = self._remove_panel
        for name, reason in broken_panels.items():
            self._remove_panel(name, reason)

    def _connect_signals(self) -> None:
        workbench = self.workbench
        workbench.notice_posted.connect(self.notices.show_notice)
        self.notices.page_asked.connect(self.help_page.open_page)
        self.notices.more_asked.connect(self.show_log)
        workbench.acted.connect(self.notices.drop_warnings)
        workbench.settled.connect(self.notices.settle_subject)
        workbench.refreshed.connect(self.notices.drop_settled)
        self.log_page.page_asked.connect(self.help_page.open_page)
        workbench.refreshed.connect(self._refresh)
        # New results raise no panel: that would move the tabs under the mouse.
        news = self.news
        workbench.plan_changed.connect(
            lambda plan: news.note_arrival("trajectory", plan.trajectory)
        )
        workbench.run_changed.connect(lambda run: news.note_arrival("comparison", run.record))
        workbench.ports_offered.connect(
            lambda ports: ports and news.note_arrival("connection", ports)
        )
        workbench.arrived.connect(news.note_arrival)
        workbench.panel_asked.connect(self.bring_up)

    def _make_header(self) -> None:
        self.header = self._bar = MotionBar(self.workbench)
        self.stop_button, self.emergency_button = self._bar.stop, self._bar.emergency
        self.addToolBar(self._bar)
        self._top_line = QFrame(self)
        self._top_line.setObjectName("machineLine")
        self._bar.log_requested.connect(self.show_log)
        self._bar.machine_changed.connect(self._show_machine)
        self._show_machine()

    def _make_docks(self) -> None:
        self.first_steps = FirstStepsCard(self.workbench)
        self.first_steps.panel_asked.connect(self.bring_up)
        bars = self.replay_bar, self.resume_question, self.first_steps
        self.setCentralWidget(CentralColumn(bars, self._make_central_panels()))
        for area in TABBED_AREAS:
            self.setTabPosition(layouts.DOCK_AREAS[area], QTabWidget.TabPosition.North)
        self.setCorner(Qt.Corner.BottomLeftCorner, Qt.DockWidgetArea.LeftDockWidgetArea)
        front_docks: dict[PanelArea, QDockWidget] = {}
        for name, kind in self.panels.panel_types.items():
            if kind.area is PanelArea.CENTRE:
                continue
            dock = self.docks[name] = self._make_dock(name, kind)
            if kind.area in TABBED_AREAS and front_docks.setdefault(kind.area, dock) is not dock:
                self.tabifyDockWidget(front_docks[kind.area], dock)
        for dock in front_docks.values():
            dock.raise_()
        if PanelArea.BOTTOM in front_docks:
            self.resizeDocks([front_docks[PanelArea.BOTTOM]], [260], Qt.Orientation.Vertical)

    def _make_central_panels(self) -> QWidget:
        names = [
            name for name, kind in self.panels.panel_types.items() if kind.area is PanelArea.CENTRE
        ]
        central = [panel for panel in map(self.panels.make, names) if panel is not None]
        self.central_tabs: QTabWidget | None = None
        frames = [PanelFrame(content, self.panel_room) for content in central]
        tabs = self.central_tabs = QTabWidget()
        pages = {
            tabs.addTab(frame, translate("panels", panel.title)): panel.help_page
            for frame, panel in zip(frames, central, strict=True)
        }
        TabHelpButton(tabs, pages, self.help_page.open_page)
        return tabs

    def _make_dock(self, name: str, kind: PanelKind) -> QDockWidget:
        dock = QDockWidget(translate("panels", kind.title))
        dock.setObjectName(f"dock-{name}")
        self.addDockWidget(layouts.DOCK_AREAS[kind.area], dock)
        if kind.help_page:
            DockHelpButton(dock, lambda: self.help_page.open_page(kind.help_page))
        return dock

    def _add_dock(self, name: str, kind: type[Panel]) -> None:
        """Add a dock for a panel that was left out, next to the other docks of its area."""
        dock = self._make_dock(name, kind)
        area = layouts.DOCK_AREAS[kind.area]
        neighbours = (
            other_dock
            for other_dock in self.docks.values()
            if self.dockWidgetArea(other_dock) == area and not other_dock.isFloating()
        )
        neighbour = next(neighbours, None)
        if kind.area in TABBED_AREAS and neighbour is not None:
            self.tabifyDockWidget(neighbour, dock)
        self.docks[name] = dock
        self.news.watch(name, dock)
        self._get_menu(translate("shell", "&View")).addAction(dock.toggleViewAction())
        dock.raise_()

    def _place_panel(self, name: str, panel: Panel) -> None:
        panel.setObjectName("panel")
        panel.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        dock = self.docks[name]
        dock.setWidget(PanelFrame(panel, self.panel_room))

    def frames(self) -> Iterator[PanelFrame]:
        """Yield the frames of all panels that exist so far."""
        tabs = self.central_tabs
        central = [] if tabs is None else map(tabs.widget, range(tabs.count()))
        for widget in (*central, *(dock.widget() for dock in self.docks.values())):
            if isinstance(widget, PanelFrame):
                yield widget

    def _remove_panel(self, name: str, reason: str) -> None:
        dock = self.docks.pop(name, None)
        if dock is not None:
            self.removeDockWidget(dock)
            dock.deleteLater()
        text = translate("shell", "Panel {name!r} is left out: {reason}").format(
            name=name, reason=reason
        )
        subject = make_panel_subject(name)
        message = NoticeMessage(text, PLUGIN_FAULTS_PAGE, subject=subject)
        self.workbench.notify(Level.ERROR, message)

    def _make_menus(self) -> None:
        for command in self.make_commands():
            menu = self._get_menu(command.menu)
            action = QAction(command.text, self)
            action.setShortcut(QKeySequence(command.shortcut))
            # Shortcuts of the whole program also work in floating docks, which are separate
            # windows.
            action.setShortcutContext(Qt.ShortcutContext.ApplicationShortcut)
            # A key that is held down must not play, pause and resume in turn.
            action.setAutoRepeat(False)
            action.setStatusTip(command.tip)
            action.triggered.connect(lambda _=False, run=command.run: run())
            menu.addAction(action)
        file_kinds = {
            "trajectory": (translate("shell", "trajectory"), self.load_trajectory),
            "record": (translate("shell", "record"), self.open_record),
        }
        file = self._get_menu(translate("shell", "&File"))
        self.recent_files = RecentFilesMenu(self.workbench.settings, file_kinds, file)
        file.insertMenu(file.actions()[3], self.recent_files)
        view = self._get_menu(translate("shell", "&View"))
        view.addSeparator()
        arrangement = self.arrangement
        self.layout_menu = layout_menu.SavedLayoutMenu(
            arrangement.saved_layouts, arrangement.use_saved_layout, view
        )
        view.addMenu(self.layout_menu)
        self.language_menu = LanguageMenu(self.workbench, view)
        view.addMenu(self.language_menu)
        view.addSeparator()
        for dock in self.docks.values():
            view.addAction(dock.toggleViewAction())
        self.layout_row = layout_menu.LayoutRow(self.menuBar(), arrangement.arrange, self.folded)

    def make_commands(self) -> list[commands.MenuCommand]:
        """Return every command of the menus."""
        return commands.make_commands(self)

    def _get_menu(self, title: str) -> QMenu:
        if title not in self._menus:
            self._menus[title] = self.menuBar().addMenu(title)
        return self._menus[title]

    def _make_status_bar(self) -> None:
        self._status = StatusText(self.workbench)
        self.statusBar().addWidget(self._status, 1)
        self.progress_line = StatusProgressLine()
        self.statusBar().addPermanentWidget(self.progress_line)
        self.statusBar().setSizeGripEnabled(False)

    def _show_machine(self) -> None:
        """Show the controlled machine in the title; a white line at the top marks a real one."""
        badge = self._bar.badge
        self.setWindowTitle(make_window_title(badge, self.workbench.robot.name))
        self._top_line.setVisible(badge.machine in MAYBE_REAL)
        self._top_line.raise_()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Fit the line at the top and the layout to the new width."""
        super().resizeEvent(event)
        self._top_line.setGeometry(0, 0, self.width(), TOP_LINE_PX)
        self.arrangement.fit()

    def ask_trajectory(self, *, show: bool = True) -> None:
        """Ask for a trajectory file and load it; ``show`` opens the panel that plays it."""

        def load(path: Path) -> None:
            self.load_trajectory(path, show=show)

        self._ask_file(translate("shell", "Load trajectory"), load)

    def ask_record(self) -> None:
        """Ask for a record of the library, or a file, and compare it with the model."""
        title = translate("shell", "Open record")
        ask_records(
            self,
            self.workbench,
            title,
            lambda entries: self._show_panel_and_use(
                "comparison", self.workbench.open_entry, entries[0]
            ),
            lambda: self._ask_file(title, self.open_record),
        )

    def ask_trajectory_of_record(self) -> None:
        """Ask for a record of the library, or a file, and load its commands as a trajectory."""
        ask_records(
            self,
            self.workbench,
            translate("shell", "Trajectory from record"),
            lambda entries: self._show_panel_and_use(
                "trajectory", self.workbench.load_entry, entries[0]
            ),
            self.ask_trajectory,
        )

    def _show_panel_and_use(
        self, name: str, use: Callable[[LibraryEntry], None], entry: LibraryEntry
    ) -> None:
        self.bring_up(name)
        use(entry)

    def load_trajectory(self, path: Path, *, show: bool = True) -> None:
        """Load a trajectory file and add it to the recent files."""
        # Opened before the file is read: afterwards the operator may be doing something else.
        if show:
            self.bring_up("trajectory")
        self.recent_files.add("trajectory", path)
        self.use_file_with_columns(path, self.workbench.planner.load_trajectory)

    def open_record(self, path: Path) -> None:
        """Open a record file and add it to the recent files."""
        self.bring_up("comparison")
        self.recent_files.add("record", path)
        self.use_file_with_columns(path, self.workbench.records.open_record)

    def _ask_file(self, title: str, use: Callable[[Path], None]) -> None:
        ask_file(self, self.workbench, title, translate("shell", FILE_FILTER), use)

    def use_file_with_columns(self, path: Path, use: Callable[[Path, str | None], None]) -> None:
        """Pass on a file; if it has no header, ask for its columns first."""
        ask_columns(path, self.workbench, self, use)

    def ask_save(self) -> None:
        """Ask where to save the loaded record, and save it."""
        if self.workbench.record is None:
            text = translate("shell", "There is no record to save: play or open one.")
            self.workbench.notify(
                Level.WARNING,
                text,
                about="comparison.md",
                until=lambda _: self.workbench.record is not None,
            )
            return
        title, file_filter = (
            translate("shell", "Save record"),
            translate("shell", "Records (*.csv *.csv.gz)"),
        )
        ask_save_path(
            self,
            self.workbench,
            title,
            file_filter,
            "record.csv",
            self.workbench.records.save_record,
        )

    def use_theme(self, name: str) -> None:
        """Change the colours and remember them."""
        self.arrangement.use_theme(name)

    def reset_layout(self) -> None:
        """Return every dock to its original place."""
        self.arrangement.reset()

    def ask_layout_name(self) -> None:
        """Ask for a name and save the layout under it."""
        layout_menu.ask_layout_name(self, self.arrangement.save_layout)

    def bring_up(self, name: str) -> None:
        """Show a panel in front of its neighbours; open its dock if it is closed."""
        panel = self.panels.make(name)
        if panel is None:
            text = translate("shell", "Panel {name!r} is missing: it was left out, see the log.")
            self.workbench.notify(Level.WARNING, text.format(name=name), about=PLUGIN_FAULTS_PAGE)
            return
        if name in self.docks:
            self.docks[name].show()
            self.docks[name].raise_()
        elif self.central_tabs is not None:
            self.central_tabs.setCurrentWidget(find_frame(panel))

    def toggle_palette(self) -> None:
        """Open or close the command palette."""
        if self.palette_page.isVisible():
            self.palette_page.hide()
        else:
            self.palette_page.open_cleared()

    def _make_palette_entries(self) -> Iterator[PaletteEntry]:
        self.panels.make_all()
        guard = PanelGuard(
            self.panels.made,
            self.docks,
            self.bring_up,
            lambda text: self.workbench.notify(Level.INFO, text),
        )
        yield from make_command_entries(self.make_commands(), guard)
        use_saved_layout = self.arrangement.use_saved_layout
        for name in self.arrangement.saved_layouts.list_names():
            yield PaletteEntry(
                translate("shell", "Layout"),
                name,
                "",
                None,
                lambda name=name: use_saved_layout(name),
            )
        yield from make_language_entries(self.workbench)
        yield from make_panel_entries(guard)

    def show_panel_help(self) -> None:
        """Show the page of the panel that has or last had the focus, else that of the window."""
        focus_widgets = (QApplication.focusWidget(), self.focusWidget())
        pages = filter(None, map(find_panel_page, focus_widgets))
        self.help_page.open_page(next(pages, "window.md"))

    def show_help(self) -> None:
        """Show the first page, which links to all others."""
        self.help_page.open_page("index.md")

    def show_keys(self) -> None:
        """List all shortcuts."""
        key_help.ShortcutsDialog(key_help.list_shortcuts(self.findChildren(QAction)), self).show()

    def show_log(self) -> None:
        """Show all messages of the program."""
        _show_in_front(self.log_page)

    def show_support(self) -> None:
        """Prepare a support bundle and show its contents."""
        if self._support is not None:
            self._support.close()
            self._support.deleteLater()
        self._support = SupportDialog(self.workbench, self.log, self.loop_watch, self)
        _show_in_front(self._support)

    def _refresh(self, state: SessionState) -> None:
        self._bar.refresh(state)
        self.progress_line.show_progress(self.workbench.jobs.progress)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Fit the window to its screen, and start to create the panels that are not visible."""
        super().showEvent(event)
        self._screen_fit.fit_soon()
        self.panel_loader.start()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Keep the window on the screen when it no longer fills it."""
        super().changeEvent(event)
        if isinstance(event, QWindowStateChangeEvent) and event.oldState() & WHOLE_SCREEN_STATES:
            self._screen_fit.fit_soon()

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802 (Qt's name)
        """Ask before moving axes are stopped; wait until they rest and everything is written."""
        if not self._closer.may_close():
            event.ignore()
            return
        self.arrangement.save_state()
        self.workbench.close()
        event.accept()


def _show_in_front(page: QDialog) -> None:
    page.show()
    page.raise_()
    page.activateWindow()
