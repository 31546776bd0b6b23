"""The records that are to be diagnosed: files, and what was played or opened last."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFileDialog, QMenu, QToolButton

from rotemina.app.shell.column_mapping import ask_columns
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Level, Run, Workbench
from rotemina.plugins.gap.tips import tip
from rotemina.sim.records.preview import preview
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot

_ENOUGH = 3  # each then serves as data that a fit has not seen
FILES = marked("gap", "Records (*.csv *.txt *.dat *.gz);;All files (*)")


@dataclass(frozen=True, slots=True, eq=False)
class Chosen:
    """A record and what it is called; ``followed`` gives way to the next that is played."""

    name: str
    record: Record
    followed: bool = False


class RecordChoice(QToolButton):
    """A button that says which records are chosen; its menu adds files and takes records away.

    Until something else is chosen it follows the workbench: the record that was played or opened
    last.

    Signals
    -------
    changed() : ``chosen`` did.
    complete() : the files that were asked for last are read, as far as they can be.
    """

    changed = Signal()
    complete = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self._robot: Robot = workbench.robot
        self.chosen: tuple[Chosen, ...] = ()
        self._unread = 0  # of the files that were asked for last
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        menu = QMenu(self)
        menu.aboutToShow.connect(self._fill)
        self.setMenu(menu)
        self._fill()
        self._show()
        workbench.run_changed.connect(self._follow)
        if workbench.run is not None:
            self._follow(workbench.run)

    def use_robot(self, robot: Robot) -> None:
        """Read further files with the axes and units of this robot."""
        self._robot = robot

    def add_files(self, paths: Sequence[Path]) -> None:
        """Read files and add them as they come; one that cannot be read becomes a notice."""
        self._unread = len(paths)
        for path in paths:
            self._read(path, alone=len(paths) == 1)

    def take(self, run: Run) -> None:
        """Add the record that was played or opened last."""
        self._set((*self._kept(), Chosen(run.name, run.record)))

    def join(self, names: Sequence[str], records: Sequence[Record], run: Run) -> None:
        """Choose the records of an answer and the one that was played for it."""
        old = (Chosen(*each) for each in zip(names, records, strict=True))
        self._set((*old, Chosen(run.name, run.record)))

    def remove(self, one: Chosen) -> None:
        """Take a record away."""
        self._set(tuple(each for each in self.chosen if each is not one))

    def _follow(self, run: Run) -> None:
        if all(each.followed for each in self.chosen):
            self._set((Chosen(run.name, run.record, followed=True),))

    def _kept(self) -> tuple[Chosen, ...]:
        return tuple(each for each in self.chosen if not each.followed)

    def _set(self, chosen: tuple[Chosen, ...]) -> None:
        self.chosen = chosen
        self._show()
        self.changed.emit()

    def _show(self) -> None:
        count = len(self.chosen)
        text = translate("gap", "{n} records").format(n=count)
        if count < 2:
            text = translate("gap", "1 record") if count else translate("gap", "Records …")
        self.setText(text)
        names = [each.name for each in self.chosen]
        few = (
            translate("gap", "Three records of different motions or more tell best.")
            if count < _ENOUGH
            else ""
        )
        said = names or [translate("gap", "Choose the records of the real machine")]
        self.setToolTip(
            tip(translate("gap", "Records that are diagnosed:") if names else "", *said, few)
        )

    # --- reading ----------------------------------------------------------------------------------

    def _read(self, path: Path, *, alone: bool) -> None:
        robot = self._robot

        def work() -> Record | None:
            return read_record(path, robot=robot) if preview(path).has_header else None

        def done(record: Record | None) -> None:
            if record is not None:
                self._set((*self._kept(), Chosen(path.name, record)))
            elif alone:
                ask_columns(path, self._workbench, self.window(), self._read_named)
            else:
                self._workbench.notify(
                    Level.WARNING,
                    translate(
                        "gap", "{name}: it has no header; add it by itself to name its columns"
                    ).format(name=path.name),
                    about=self,
                )
            self._count_read()

        self._workbench.work(
            f"gap record {path}",
            translate("gap", "Reading {name} …").format(name=path.name),
            work,
            done,
            self._count_read,
        )

    def _count_read(self) -> None:
        self._unread -= 1
        if self._unread == 0:
            self.complete.emit()

    def _read_named(self, path: Path, columns: str | None) -> None:
        robot = self._robot
        self._workbench.work(
            f"gap record {path}",
            translate("gap", "Reading {name} …").format(name=path.name),
            lambda: read_record(path, columns=columns, robot=robot),
            lambda record: self._set((*self._kept(), Chosen(path.name, record))),
        )

    # --- the menu ---------------------------------------------------------------------------------

    def _fill(self) -> None:
        menu = self.menu()
        menu.clear()
        self._add(menu, translate("gap", "Add files …")).triggered.connect(self.ask)
        run = self._workbench.run
        last = self._add(
            menu,
            translate("gap", "Add {name}").format(name=run.name)
            if run is not None
            else translate("gap", "Add the last playback"),
        )
        last.setEnabled(run is not None)
        last.triggered.connect(lambda: self.take(self._workbench.run))
        if self.chosen:
            menu.addSeparator()
        for each in self.chosen:
            action = self._add(menu, translate("gap", "Remove {name}").format(name=each.name))
            action.triggered.connect(lambda _=False, one=each: self.remove(one))

    @staticmethod
    def _add(menu: QMenu, text: str) -> QAction:
        return menu.addAction(text.replace("&", "&&"))  # a file's name marks no shortcut

    def ask(self) -> None:
        """Ask for files, and add them."""
        settings = self._workbench.settings
        dialog = QFileDialog(
            self.window(),
            translate("gap", "Records of the real machine"),
            settings.get("files.folder", ""),
            translate("gap", FILES),
        )
        dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.setFileMode(QFileDialog.FileMode.ExistingFiles)
        dialog.filesSelected.connect(
            lambda names: settings.set("files.folder", str(Path(names[0]).parent))
        )
        dialog.filesSelected.connect(lambda names: self.add_files([Path(name) for name in names]))
        dialog.show()
