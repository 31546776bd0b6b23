"""The page that shows what a support bundle holds before it is written."""

from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QPlainTextEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.display_units import size_text
from rotemina.app.shell.anonymiser import Anonymiser
from rotemina.app.shell.event_loop_watch import LoopWatch
from rotemina.app.shell.file_dialog import ask_where
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.message_log import MessageLog
from rotemina.app.shell.progress_line import Progress
from rotemina.app.shell.support_bundle import Item, gather, write_bundle
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow

_SHOWN = 20_000  # letters of a file; the rest of a record looks alike
_INTRODUCTION = marked(
    "shell",
    "The bundle will contain these files. User names, home folders and the name"
    " of this computer are already removed. Nothing is sent: you choose where "
    "the archive is saved.",
)


class SupportPage(QDialog):
    """Lists the files of a bundle with their content, and saves it."""

    def __init__(
        self, workbench: Workbench, log: MessageLog, watch: LoopWatch, parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Support bundle"))
        self.resize(820, 480)
        self._workbench = workbench
        self.items: tuple[Item, ...] = ()
        introduction = QLabel(translate("shell", _INTRODUCTION))
        introduction.setWordWrap(True)
        self.list, self.view, self.save = (
            QListWidget(),
            QPlainTextEdit(),
            QPushButton(translate("shell", "Save …")),
        )
        self.list.setAccessibleName(translate("shell", "Files of the bundle"))
        self.list.setFixedWidth(230)
        self.list.currentRowChanged.connect(self._show_item)
        self.view.setReadOnly(True)
        self.view.setAccessibleName(translate("shell", "Content of the file"))
        self.view.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.save.clicked.connect(self.ask_where)
        self._allow_saving()
        middle = QHBoxLayout()
        middle.addWidget(self.list)
        middle.addWidget(self.view, 1)
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        buttons.addWidget(self.save)
        column = QVBoxLayout(self)
        column.addWidget(introduction)
        column.addLayout(middle, 1)
        column.addLayout(buttons)
        self._gather(log, watch)

    def ask_where(self) -> None:
        """Ask where to, and write the bundle there."""
        title, kinds = (
            translate("shell", "Save support bundle"),
            translate("shell", "Archives (*.zip)"),
        )
        name = f"rotemina-support-{datetime.now():%Y-%m-%d}.zip"
        ask_where(self, self._workbench, title, kinds, name, self.write)

    def write(self, path: Path) -> None:
        """Write the bundle, away from the window's thread, and close the page."""
        bench, items = self._workbench, self.items

        def work(progress: Progress) -> None:
            write_bundle(path, items, progress.reached)

        bench.long_work(
            "support bundle",
            Progress(translate("shell", "The support bundle is written.")),
            work,
            lambda _: bench.notify(
                Level.GOOD, translate("shell", "Saved {path}").format(path=path)
            ),
        )
        self.close()

    def _gather(self, log: MessageLog, watch: LoopWatch) -> None:
        bench = self._workbench
        preferences, state, record = bench.settings.values, bench.session.snapshot(), bench.record
        driver, robot = bench.session.driver.name, bench.robot.name
        kind = bench.session.driver.machine_kind
        late = watch.lateness.as_json()

        def work(progress: Progress) -> tuple[Item, ...]:
            anonymiser = Anonymiser.of_this_user()
            told = log.messages()
            return gather(
                told,
                preferences,
                state,
                driver,
                robot,
                record,
                anonymiser,
                late,
                progress.reached,
                machine_kind=kind,
            )

        bench.long_work(
            "support items",
            Progress(translate("shell", "The support bundle is being assembled.")),
            work,
            self._show_items,
        )

    def _show_items(self, items: Sequence[Item]) -> None:
        self.items = tuple(items)
        for item in items:
            size = size_text(len(item.text.encode("utf-8")))
            self.list.addItem(f"{item.name}   {size}")
        self.list.setCurrentRow(0)
        self._allow_saving()

    def _allow_saving(self) -> None:
        why_not = None if self.items else translate("shell", "the bundle is still being assembled")
        allow(self.save, why_not, translate("shell", "Write all files into one zip archive"))

    def _show_item(self, row: int) -> None:
        if 0 <= row < len(self.items):
            item = self.items[row]
            cut = item.text[:_SHOWN]
            more = "\n…" if len(item.text) > _SHOWN else ""
            self.view.setPlainText(f"{cut}{more}")
            self.view.setToolTip(item.about)
