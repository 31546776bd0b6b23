"""The log window: all messages of the program, with filter and copy."""

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QPersistentModelIndex,
    Qt,
    QTimer,
    Signal,
)
from PySide6.QtGui import QColor, QGuiApplication, QHideEvent, QShowEvent, QTextOption
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.language import marked, translate
from rotemina.app.shell.support.event_loop_watch import EventLoopWatch
from rotemina.app.shell.support.message_log import LogMessage, MessageLog, filter_messages
from rotemina.app.widgets.controls import enable_unless, make_tooltip
from rotemina.app.widgets.style import Theme
from rotemina.app.workbench import Level
from rotemina.sim.messages import format_fixed

REFRESH_MS = 300
_COLUMN_HEADINGS = (
    marked("shell", "Time"),
    marked("shell", "Level"),
    marked("shell", "Source"),
    marked("shell", "Message"),
)
_LEVEL_FILTERS = {
    Level.INFO: marked("shell", "All messages"),
    Level.WARNING: marked("shell", "Warnings and errors"),
    Level.ERROR: marked("shell", "Errors only"),
}
_LEVEL_NAMES = {
    Level.INFO: marked("shell", "info"),
    Level.GOOD: marked("shell", "good"),
    Level.WARNING: marked("shell", "warning"),
    Level.ERROR: marked("shell", "error"),
}
_COLOUR_ROLES = {Level.WARNING: "warning", Level.ERROR: "danger_text", Level.GOOD: "good"}
_LATENESS_TIP = marked(
    "shell",
    "Reaction time of the window since its start. The log names the cause of "
    "any delay above a quarter of a second.",
)
_Index = QModelIndex | QPersistentModelIndex
_NO_PARENT = QModelIndex()


class MessageTableModel(QAbstractTableModel):
    """Table model of messages, newest first."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.theme = theme
        self._rows: tuple[LogMessage, ...] = ()

    def show_messages(self, messages: tuple[LogMessage, ...]) -> None:
        """Replace the messages that are shown."""
        self.beginResetModel()
        self._rows = messages[::-1]
        self.endResetModel()

    def message_at(self, row: int) -> LogMessage:
        """Return the message of a row."""
        return self._rows[row]

    def rowCount(self, parent: _Index = _NO_PARENT) -> int:  # noqa: N802 (Qt's name)
        """Return the number of messages."""
        return 0 if parent.isValid() else len(self._rows)

    def columnCount(self, parent: _Index = _NO_PARENT) -> int:  # noqa: N802 (Qt's name)
        """Return the number of columns."""
        return 0 if parent.isValid() else len(_COLUMN_HEADINGS)

    def headerData(  # noqa: N802 (Qt's name)
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        """Return the heading of a column."""
        is_horizontal = orientation is Qt.Orientation.Horizontal
        is_heading = is_horizontal and role == Qt.ItemDataRole.DisplayRole
        return translate("shell", _COLUMN_HEADINGS[section]) if is_heading else None

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """Return the text, tooltip or colour of a cell."""
        message = self._rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            level = translate("shell", _LEVEL_NAMES[message.level])
            first_line = message.text.partition("\n")[0]
            cells = (f"{message.time:%H:%M:%S}", level, message.source, first_line)
            return cells[index.column()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return make_tooltip(f"{message.time:%Y-%m-%d %H:%M:%S}", *message.text.splitlines())
        if role == Qt.ItemDataRole.ForegroundRole and index.column() == 1:
            return QColor(getattr(self.theme, _COLOUR_ROLES.get(message.level, "text")))
        return None


class LogDialog(QDialog):
    """Separate window with the messages, a filter, copy and help.

    Signals
    -------
    page_asked(str) : the help page of this name should be opened.
    """

    page_asked = Signal(str)

    def __init__(
        self, log: MessageLog, theme: Theme, watch: EventLoopWatch, parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Log"))
        self.resize(860, 420)
        self._log, self._watch, self._shown_count = log, watch, -1
        self.model = MessageTableModel(theme)
        self.level, self.words = QComboBox(), QLineEdit()
        for min_level, text in _LEVEL_FILTERS.items():
            self.level.addItem(translate("shell", text), min_level)
        self.level.setAccessibleName(translate("shell", "Messages to show"))
        self.words.setPlaceholderText(translate("shell", "search words"))
        self.words.setAccessibleName(translate("shell", "Words to search for in the messages"))
        self.words.setClearButtonEnabled(True)
        self.table = self._make_table()
        self.count = QLabel()
        self.count.setProperty("quiet", True)
        self.lateness = QLabel()
        self.lateness.setProperty("quiet", True)
        self.lateness.setToolTip(make_tooltip(translate("shell", _LATENESS_TIP)))
        self.copy = QPushButton(translate("shell", "Copy"))
        self.copy.setAutoDefault(False)
        self.copy.clicked.connect(self.copy_messages)
        self.help = QPushButton("?")
        self.help.setAutoDefault(False)
        self.help.setAccessibleName(translate("shell", "Help on the selected message"))
        self.help.clicked.connect(lambda: self.page_asked.emit(self._find_page()))
        self.table.selectionModel().selectionChanged.connect(lambda *_: self._show_selected())
        self.full_text = QPlainTextEdit()
        self.full_text.setReadOnly(True)
        self.full_text.setWordWrapMode(QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere)
        self.full_text.setAccessibleName(translate("shell", "All of the selected message"))
        self.full_text.hide()
        self._lay_out()
        self.level.currentIndexChanged.connect(lambda _: self._show_messages())
        self.words.textChanged.connect(lambda _: self._show_messages())
        self._timer = QTimer(self, interval=REFRESH_MS)
        self._timer.timeout.connect(self.refresh)

    def refresh(self) -> None:
        """Show messages added since the last refresh, unless a message is selected."""
        if self._log.count != self._shown_count and not self.table.selectionModel().hasSelection():
            self._show_messages()
        self._show_lateness()

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self.model.theme = theme
        self.table.viewport().update()

    def copy_messages(self) -> None:
        """Copy the selected messages, or all that are shown, oldest first."""
        selected = sorted(index.row() for index in self.table.selectionModel().selectedRows())
        rows = selected or range(self.model.rowCount())
        lines = [self.model.message_at(row).line for row in rows]
        QGuiApplication.clipboard().setText("\n".join(reversed(lines)))

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Start the regular refresh."""
        self._show_messages()
        self._show_lateness()
        self._timer.start()
        super().showEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """Stop the regular refresh."""
        self._timer.stop()
        super().hideEvent(event)

    def _show_messages(self) -> None:
        self._shown_count = self._log.count
        messages = self._log.messages()
        filtered = filter_messages(messages, self.level.currentData(), self.words.text())
        self.model.show_messages(filtered)
        self.full_text.hide()
        self.count.setText(
            translate("shell", "{n} of {all} messages").format(n=len(filtered), all=len(messages))
        )
        tip = translate("shell", "Copy the selected messages, or all displayed ones")
        enable_unless(
            self.copy, None if filtered else translate("shell", "no message is shown"), tip
        )
        self._enable_help()

    def _show_selected(self) -> None:
        rows = self.table.selectionModel().selectedRows()
        self.full_text.setVisible(len(rows) == 1)
        if len(rows) == 1:
            self.full_text.setPlainText(self.model.message_at(rows[0].row()).text)
        self._enable_help()

    def _show_lateness(self) -> None:
        lateness = self._watch.lateness
        self.lateness.setVisible(lateness.duration_s > 0.0)
        self.lateness.setText(
            translate("shell", "Window delay: 99th percentile {usual} ms, worst {worst} ms").format(
                usual=format_fixed(1e3 * lateness.percentile_99_s, 0),
                worst=format_fixed(1e3 * lateness.worst_s, 0),
            )
        )

    def _find_page(self) -> str:
        rows = self.table.selectionModel().selectedRows()
        return self.model.message_at(rows[0].row()).page if len(rows) == 1 else ""

    def _enable_help(self) -> None:
        is_single = len(self.table.selectionModel().selectedRows()) == 1
        reason = (
            translate("shell", "no help page describes it")
            if is_single
            else translate("shell", "select one message")
        )
        page = self._find_page()
        enable_unless(
            self.help,
            None if page else reason,
            translate("shell", "Meaning of the message: {page}").format(page=page) if page else "",
        )

    def _make_table(self) -> QTableView:
        table = QTableView()
        table.setModel(self.model)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setAccessibleName(translate("shell", "Messages, newest first"))
        table.verticalHeader().hide()
        table.setShowGrid(False)
        table.setWordWrap(False)
        table.setTabKeyNavigation(False)
        header = table.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        header.setStretchLastSection(True)
        for column, width in enumerate((80, 80, 190)):
            table.setColumnWidth(column, width)
        return table

    def _lay_out(self) -> None:
        top = QHBoxLayout()
        top.addWidget(self.level)
        top.addWidget(self.words, 1)
        top.addWidget(self.count)
        top.addWidget(self.help)
        top.addWidget(self.copy)
        column = QVBoxLayout(self)
        column.addLayout(top)
        column.addWidget(self.table, 2)
        column.addWidget(self.full_text, 1)
        column.addWidget(self.lateness)
