"""The window that shows the contents of a support bundle before it is written."""

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

from rotemina.app.language import format_file_size, marked, translate
from rotemina.app.shell.records import ask_save_path
from rotemina.app.shell.support.anonymiser import TextAnonymiser
from rotemina.app.shell.support.event_loop_watch import EventLoopWatch
from rotemina.app.shell.support.message_log import MessageLog
from rotemina.app.shell.support.support_bundle import BundleFile, gather_files, write_bundle
from rotemina.app.widgets.controls import enable_unless
from rotemina.app.workbench import Level, Workbench, WorkProgress

# Of a long file such as a record, only the beginning is shown.
_MAX_SHOWN_CHARS = 20_000
_INTRODUCTION = marked(
    "shell",
    "The bundle will contain these files. User names, home folders and the name"
    " of this computer are already removed. Nothing is sent: you choose where "
    "the archive is saved.",
)


class SupportDialog(QDialog):
    """List of the files of a bundle with their contents, and a button to save it."""

    def __init__(
        self, workbench: Workbench, log: MessageLog, watch: EventLoopWatch, parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Support bundle"))
        self.resize(820, 480)
        self._workbench = workbench
        self.items: tuple[BundleFile, ...] = ()
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
        self.save.clicked.connect(self.ask_save_path)
        self._enable_saving()
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
        self._gather_files(log, watch)

    def ask_save_path(self) -> None:
        """Ask where to save the bundle, and write it."""
        title, file_filter = (
            translate("shell", "Save support bundle"),
            translate("shell", "Archives (*.zip)"),
        )
        name = f"rotemina-support-{datetime.now():%Y-%m-%d}.zip"
        ask_save_path(self, self._workbench, title, file_filter, name, self.write)

    def write(self, path: Path) -> None:
        """Write the bundle in the background and close the window."""
        bench, items = self._workbench, self.items

        def work(progress: WorkProgress) -> None:
            write_bundle(path, items, progress.report)

        bench.jobs.long_work(
            "support bundle",
            WorkProgress(translate("shell", "The support bundle is being written.")),
            work,
            lambda _: bench.notify(
                Level.GOOD, translate("shell", "Saved {path}").format(path=path)
            ),
        )
        self.close()

    def _gather_files(self, log: MessageLog, watch: EventLoopWatch) -> None:
        bench = self._workbench
        preferences, state, record = bench.settings.values, bench.session.snapshot(), bench.record
        driver, robot = bench.session.driver.name, bench.robot.name
        kind = bench.session.driver.machine_kind
        lateness = watch.lateness.as_json()

        def work(progress: WorkProgress) -> tuple[BundleFile, ...]:
            anonymiser = TextAnonymiser.for_current_user()
            messages = log.messages()
            return gather_files(
                messages,
                preferences,
                state,
                driver,
                robot,
                record,
                anonymiser,
                lateness,
                progress.report,
                machine_kind=kind,
            )

        bench.jobs.long_work(
            "support items",
            WorkProgress(translate("shell", "The support bundle is being assembled.")),
            work,
            self._show_items,
        )

    def _show_items(self, items: Sequence[BundleFile]) -> None:
        self.items = tuple(items)
        for item in items:
            size = format_file_size(len(item.text.encode("utf-8")))
            self.list.addItem(f"{item.name}   {size}")
        self.list.setCurrentRow(0)
        self._enable_saving()

    def _enable_saving(self) -> None:
        objection = (
            None if self.items else translate("shell", "the bundle is still being assembled")
        )
        enable_unless(
            self.save, objection, translate("shell", "Write all files into one zip archive")
        )

    def _show_item(self, row: int) -> None:
        if 0 <= row < len(self.items):
            item = self.items[row]
            shown_text = item.text[:_MAX_SHOWN_CHARS]
            ellipsis = "\n…" if len(item.text) > _MAX_SHOWN_CHARS else ""
            self.view.setPlainText(f"{shown_text}{ellipsis}")
            self.view.setToolTip(item.about)
