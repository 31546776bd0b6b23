"""The window that hosts the panels: tool bar with the stop button, docks, notices, status."""

from base64 import b64decode, b64encode
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from PySide6.QtCore import QByteArray, Qt
from PySide6.QtGui import QAction, QCloseEvent, QKeySequence
from PySide6.QtWidgets import (
    QApplication,
    QDockWidget,
    QFileDialog,
    QMainWindow,
    QMenu,
    QMessageBox,
    QTabBar,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell import theme as themes
from rotemina.app.shell.column_mapping import ask_columns
from rotemina.app.shell.host import make_panels
from rotemina.app.shell.motion_bar import MotionBar, StopWatch
from rotemina.app.shell.notices import NoticeBar
from rotemina.app.shell.recording_sign import RecordingSign
from rotemina.app.shell.replay_bar import ReplayBar
from rotemina.app.shell.status import StatusText
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.drivers.samples import DeviceState

LAYOUT_VERSION = 1
FILES = "Records and trajectories (*.csv *.txt *.dat *.gz);;All files (*)"
DOCK_AREAS = {
    Area.LEFT: Qt.DockWidgetArea.LeftDockWidgetArea,
    Area.RIGHT: Qt.DockWidgetArea.RightDockWidgetArea,
    Area.BOTTOM: Qt.DockWidgetArea.BottomDockWidgetArea,
}
# Wide tables and long forms: one behind the other, not side by side or one below the other.
TABBED = (Area.BOTTOM, Area.RIGHT)


def _decoded(text: str) -> QByteArray:
    """Return kept bytes; none where they were spoilt, which Qt then ignores."""
    try:
        return QByteArray(b64decode(text, validate=True))
    except ValueError:
        return QByteArray()


class Command(NamedTuple):
    """One entry of a menu."""

    menu: str
    text: str
    shortcut: str
    run: Callable[[], object]
    tip: str


class MainWindow(QMainWindow):
    """The operator's window around a workbench."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.workbench = workbench
        workbench.setParent(self)  # so that Qt ends it with the window, on this thread
        self.setWindowTitle(f"RoTeMiNa – {workbench.robot.name}")
        self.notices = NoticeBar()
        self.replay_bar = ReplayBar(workbench)
        self.panels, broken = make_panels(workbench)
        self.docks: dict[str, QDockWidget] = {}
        self._menus: dict[str, QMenu] = {}
        self._bar = MotionBar(workbench)
        self.stop_button, self.emergency_button = self._bar.stop, self._bar.emergency
        self.addToolBar(self._bar)
        self._make_docks()
        self._make_menus()
        self._make_status_bar()
        self._restore()
        application = QApplication.instance()
        assert application is not None
        self._stop_watch = StopWatch(workbench, self.stop_button, self)
        application.installEventFilter(self._stop_watch)
        workbench.noticed.connect(self.notices.show_notice)
        workbench.refreshed.connect(self._refresh)
        workbench.plan_changed.connect(lambda _: self._bring_up("trajectory"))
        workbench.run_changed.connect(lambda _: self._bring_up("comparison"))
        workbench.ports_offered.connect(lambda ports: ports and self._bring_up("connection"))
        for name, reason in broken.items():
            workbench.notify(Level.ERROR, f"Panel {name!r} is left out: {reason}")

    # --- parts ------------------------------------------------------------------------------------

    def _make_docks(self) -> None:
        centre = QWidget()
        column = QVBoxLayout(centre)
        column.setContentsMargins(6, 6, 6, 6)
        column.addWidget(self.replay_bar)
        column.addWidget(self.notices)
        column.addWidget(self._central_panels(), 1)
        self.setCentralWidget(centre)
        for area in TABBED:
            self.setTabPosition(DOCK_AREAS[area], QTabWidget.TabPosition.North)
        self.setCorner(Qt.Corner.BottomLeftCorner, Qt.DockWidgetArea.LeftDockWidgetArea)
        first: dict[Area, QDockWidget] = {}
        for name, panel in self.panels.items():
            if panel.area is Area.CENTRE:
                continue
            dock = self.docks[name] = self._dock(name, panel)
            if panel.area in TABBED and first.setdefault(panel.area, dock) is not dock:
                self.tabifyDockWidget(first[panel.area], dock)
        for area, dock in first.items():
            dock.raise_()
            self._hide_forgotten_tabs(area)
        if Area.BOTTOM in first:
            self.resizeDocks([first[Area.BOTTOM]], [260], Qt.Orientation.Vertical)
        self._default_state = self.saveState(LAYOUT_VERSION)

    def _hide_forgotten_tabs(self, area: Area) -> None:
        """Hide the tab bars of fewer docks that Qt makes on the way and forgets (seen in 6.11)."""
        titles = {panel.title for panel in self.panels.values() if panel.area is area}
        only_mine = Qt.FindChildOption.FindDirectChildrenOnly
        for bar in self.findChildren(QTabBar, options=only_mine):
            shown = {bar.tabText(number) for number in range(bar.count())}
            if shown < titles:
                bar.hide()

    def _central_panels(self) -> QWidget:
        central = [panel for panel in self.panels.values() if panel.area is Area.CENTRE]
        if len(central) == 1:
            return central[0]
        tabs = QTabWidget()
        for panel in central:
            tabs.addTab(panel, panel.title)
        return tabs

    def _dock(self, name: str, panel: Panel) -> QDockWidget:
        dock = QDockWidget(panel.title)
        dock.setObjectName(f"dock-{name}")
        panel.setObjectName("panel")
        panel.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        dock.setWidget(panel)
        self.addDockWidget(DOCK_AREAS[panel.area], dock)
        return dock

    def _make_menus(self) -> None:
        for command in self.commands():
            menu = self._menu(command.menu)
            action = QAction(command.text, self)
            action.setShortcut(QKeySequence(command.shortcut))
            action.setStatusTip(command.tip)
            action.triggered.connect(lambda _=False, run=command.run: run())
            menu.addAction(action)
        view = self._menu("&View")
        view.addSeparator()
        for dock in self.docks.values():
            view.addAction(dock.toggleViewAction())

    def commands(self) -> list[Command]:
        """Return every command of the menus."""
        bench = self.workbench
        return [
            Command(
                "&File", "Load &trajectory …", "Ctrl+T", self.ask_trajectory, "Load and dry-run"
            ),
            Command("&File", "&Open record …", "Ctrl+O", self.ask_record, "Compare with the model"),
            Command("&File", "&Save record …", "Ctrl+S", self.ask_save, "Save the last record"),
            Command("&File", "&Quit", "Ctrl+Q", self.close, "Stop and leave"),
            Command(
                "&Motion",
                "&Play or pause",
                "Ctrl+P",
                bench.toggle_playback,
                "The loaded trajectory",
            ),
            Command("&Motion", "&Stop", "", bench.stop, "Stop all axes and hold (Esc)"),
            Command("&Motion", "&Emergency stop", "", bench.emergency_stop, "Latched (Shift+Esc)"),
            Command("&Motion", "Re&lease the emergency stop", "", bench.release, "Unlatch it"),
            Command("&Motion", "&Back", "", bench.undo, "Back to before the latest move"),
            Command("&Motion", "&Home all axes", "", bench.home, "Find the limit switches"),
            Command("&Motion", "&Clear fault", "", bench.clear_fault, "Acknowledge it"),
            Command("&Motion", "&Reconnect", "", bench.reconnect, "Connect after a failure"),
            Command("&Motion", "&Disconnect", "", bench.let_go, "Stop, and let go of the device"),
            Command("&View", "&Light theme", "", lambda: self.use_theme("light"), ""),
            Command("&View", "&Dark theme", "", lambda: self.use_theme("dark"), ""),
            Command("&View", "&Restore the layout", "", self.reset_layout, "Bring all docks back"),
        ]

    def _menu(self, title: str) -> QMenu:
        """Return a menu of the menu bar, made when it is first asked for."""
        if title not in self._menus:
            self._menus[title] = self.menuBar().addMenu(title)
        return self._menus[title]

    def _make_status_bar(self) -> None:
        self._status = StatusText(self.workbench)
        self.statusBar().addWidget(self._status, 1)
        self.recording_sign = RecordingSign(self.workbench)
        self.statusBar().addPermanentWidget(self.recording_sign)
        self.statusBar().setSizeGripEnabled(False)

    # --- files ------------------------------------------------------------------------------------

    def ask_trajectory(self) -> None:
        """Ask for a trajectory file and load it."""
        self._ask_and("Load trajectory", self.workbench.load_trajectory)

    def ask_record(self) -> None:
        """Ask for a record file and compare it with the model."""
        self._ask_and("Open record", self.workbench.open_record)

    def _ask_and(self, title: str, use: Callable[[Path, str | None], None]) -> None:
        dialog = self._file_dialog(title, FILES)
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        dialog.fileSelected.connect(lambda name: self.use_file(Path(name), use))
        dialog.show()

    def use_file(self, path: Path, use: Callable[[Path, str | None], None]) -> None:
        """Hand a file on, with its columns named first where it has no header."""
        ask_columns(path, self.workbench, self, use)

    def ask_save(self) -> None:
        """Ask where to, and save the record in hand."""
        if self.workbench.record is None:
            self.workbench.notify(Level.WARNING, "There is no record to save: play or open one.")
            return
        dialog = self._file_dialog("Save record", "Records (*.csv *.csv.gz)")
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.selectFile("record.csv")
        dialog.fileSelected.connect(lambda name: self.workbench.save_record(Path(name)))
        dialog.show()

    def _file_dialog(self, title: str, filters: str) -> QFileDialog:
        """Return a dialog beside which the window, and its stop button, can still be used."""
        settings = self.workbench.settings
        dialog = QFileDialog(self, title, settings.get("files.folder", ""), filters)
        dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.fileSelected.connect(
            lambda name: settings.set("files.folder", str(Path(name).parent))
        )
        return dialog

    # --- layout and theme -------------------------------------------------------------------------

    def use_theme(self, name: str) -> None:
        """Change the colours and remember them."""
        theme = themes.theme_named(name)
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        themes.apply(application, theme)
        self.workbench.settings.set("window.theme", theme.name)
        self.workbench.set_theme(theme)

    def reset_layout(self) -> None:
        """Bring every dock back to where it was at first."""
        self.restoreState(self._default_state, LAYOUT_VERSION)
        for dock in self.docks.values():
            dock.show()

    def _restore(self) -> None:
        self.resize(1280, 800)
        settings = self.workbench.settings
        self.restoreGeometry(_decoded(settings.get("window.geometry", "")))
        self.restoreState(_decoded(settings.get("window.state", "")), LAYOUT_VERSION)

    def _remember(self) -> None:
        kept = {"geometry": self.saveGeometry(), "state": self.saveState(LAYOUT_VERSION)}
        for key, value in kept.items():
            self.workbench.settings.set(f"window.{key}", b64encode(value.data()).decode("ascii"))

    # --- what happens -----------------------------------------------------------------------------

    def _refresh(self, state: SessionState) -> None:
        self._bar.refresh(state)

    def _bring_up(self, name: str) -> None:
        if name in self.docks:
            self.docks[name].raise_()

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802 (Qt's name)
        """Stop first, and then ask where a played record would be lost."""
        self.workbench.stop()
        if self._would_lose_a_record() and not self._may_discard():
            event.ignore()
            return
        self._remember()
        self.workbench.close()
        event.accept()

    def _would_lose_a_record(self) -> bool:
        playing = self.workbench.session.snapshot().activity is DeviceState.PLAYING
        return playing or self.workbench.unsaved is not None

    def _may_discard(self) -> bool:
        button = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self,
            "Quit",
            "The last played record is not kept in any file yet. Quit and lose it?",
            button.Yes | button.No,
            button.No,
        )
        return answer == button.Yes
