"""The log page: all that the program told, to be filtered and copied."""

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

from rotemina.app.shell.event_loop_watch import LoopWatch
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.message_log import Message, MessageLog, chosen
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level
from rotemina.app.widgets.controls import allow, plain_tip
from rotemina.sim.quantities import fixed

REFRESH_MS = 300
_HEADINGS = (
    marked("shell", "Time"),
    marked("shell", "Level"),
    marked("shell", "Source"),
    marked("shell", "Message"),
)
_LEAST = {
    Level.INFO: marked("shell", "All messages"),
    Level.WARNING: marked("shell", "Warnings and errors"),
    Level.ERROR: marked("shell", "Errors only"),
}
_LEVELS = {
    Level.INFO: marked("shell", "info"),
    Level.GOOD: marked("shell", "good"),
    Level.WARNING: marked("shell", "warning"),
    Level.ERROR: marked("shell", "error"),
}
_ROLES = {Level.WARNING: "warning", Level.ERROR: "danger_text", Level.GOOD: "good"}
_ABOUT_LATENESS = marked(
    "shell",
    "Reaction time of the window since its start. The log names the cause of "
    "any delay above a quarter of a second.",
)
_Index = QModelIndex | QPersistentModelIndex
_TOP = QModelIndex()


class MessageTable(QAbstractTableModel):
    """Messages as rows, the newest first."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.theme = theme
        self._rows: tuple[Message, ...] = ()

    def show_messages(self, messages: tuple[Message, ...]) -> None:
        """Show others."""
        self.beginResetModel()
        self._rows = messages[::-1]
        self.endResetModel()

    def message(self, row: int) -> Message:
        """Return the message of a row."""
        return self._rows[row]

    def rowCount(self, parent: _Index = _TOP) -> int:  # noqa: N802 (Qt's name)
        """Return how many messages there are."""
        return 0 if parent.isValid() else len(self._rows)

    def columnCount(self, parent: _Index = _TOP) -> int:  # noqa: N802 (Qt's name)
        """Return how many columns there are."""
        return 0 if parent.isValid() else len(_HEADINGS)

    def headerData(  # noqa: N802 (Qt's name)
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        """Return the heading of a column."""
        across = orientation is Qt.Orientation.Horizontal
        shown = across and role == Qt.ItemDataRole.DisplayRole
        return translate("shell", _HEADINGS[section]) if shown else None

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """Return the text, tip or colour of a cell."""
        message = self._rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            level = translate("shell", _LEVELS[message.level])
            first_line = message.text.partition("\n")[0]
            cells = (f"{message.time:%H:%M:%S}", level, message.source, first_line)
            return cells[index.column()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return plain_tip(f"{message.time:%Y-%m-%d %H:%M:%S}", *message.text.splitlines())
        if role == Qt.ItemDataRole.ForegroundRole and index.column() == 1:
            return QColor(getattr(self.theme, _ROLES.get(message.level, "text")))
        return None


class LogPage(QDialog):
    """A window of its own beside the operator's, with filter, copy and help.

    Signals
    -------
    asked(str) : which page of the help is to be opened.
    """

    asked = Signal(str)

    def __init__(self, log: MessageLog, theme: Theme, watch: LoopWatch, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Log"))
        self.resize(860, 420)
        self._log, self._watch, self._shown = log, watch, -1
        self.model = MessageTable(theme)
        self.level, self.words = QComboBox(), QLineEdit()
        for least, text in _LEAST.items():
            self.level.addItem(translate("shell", text), least)
        self.level.setAccessibleName(translate("shell", "Messages to show"))
        self.words.setPlaceholderText(translate("shell", "search words"))
        self.words.setAccessibleName(translate("shell", "Words to search for in the messages"))
        self.words.setClearButtonEnabled(True)
        self.table = self._make_table()
        self.count = QLabel()
        self.count.setProperty("quiet", True)
        self.lateness = QLabel()
        self.lateness.setProperty("quiet", True)
        self.lateness.setToolTip(plain_tip(translate("shell", _ABOUT_LATENESS)))
        self.copy = QPushButton(translate("shell", "Copy"))
        self.copy.setAutoDefault(False)
        self.copy.clicked.connect(self.copy_messages)
        self.help = QPushButton("?")
        self.help.setAutoDefault(False)
        self.help.setAccessibleName(translate("shell", "Help on the selected message"))
        self.help.clicked.connect(lambda: self.asked.emit(self._page()))
        self.table.selectionModel().selectionChanged.connect(lambda *_: self._show_selected())
        self.whole = QPlainTextEdit()
        self.whole.setReadOnly(True)
        self.whole.setWordWrapMode(QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere)
        self.whole.setAccessibleName(translate("shell", "All of the selected message"))
        self.whole.hide()
        self._lay_out()
        self.level.currentIndexChanged.connect(lambda _: self._show_messages())
        self.words.textChanged.connect(lambda _: self._show_messages())
        self._timer = QTimer(self, interval=REFRESH_MS)
        self._timer.timeout.connect(self.refresh)

    def refresh(self) -> None:
        """Show what has been added since; a selection is left alone."""
        if self._log.count != self._shown and not self.table.selectionModel().hasSelection():
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
        lines = [self.model.message(row).line for row in rows]
        QGuiApplication.clipboard().setText("\n".join(reversed(lines)))

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin to look for new messages."""
        self._show_messages()
        self._show_lateness()
        self._timer.start()
        super().showEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """Look no longer."""
        self._timer.stop()
        super().hideEvent(event)

    def _show_messages(self) -> None:
        self._shown = self._log.count
        messages = self._log.messages()
        picked = chosen(messages, self.level.currentData(), self.words.text())
        self.model.show_messages(picked)
        self.whole.hide()
        self.count.setText(
            translate("shell", "{n} of {all} messages").format(n=len(picked), all=len(messages))
        )
        tip = translate("shell", "Copy the selected messages, or all displayed ones")
        allow(self.copy, None if picked else translate("shell", "no message is shown"), tip)
        self._allow_help()

    def _show_selected(self) -> None:
        """Show all of the text of one message, which has but a line in the table."""
        rows = self.table.selectionModel().selectedRows()
        self.whole.setVisible(len(rows) == 1)
        if len(rows) == 1:
            self.whole.setPlainText(self.model.message(rows[0].row()).text)
        self._allow_help()

    def _show_lateness(self) -> None:
        late = self._watch.lateness
        self.lateness.setVisible(late.watched_s > 0.0)
        self.lateness.setText(
            translate("shell", "Window delay: at most {usual} ms in 99 %, worst {worst} ms").format(
                usual=fixed(1e3 * late.usual_s, 0), worst=fixed(1e3 * late.worst_s, 0)
            )
        )

    def _page(self) -> str:
        rows = self.table.selectionModel().selectedRows()
        return self.model.message(rows[0].row()).page if len(rows) == 1 else ""

    def _allow_help(self) -> None:
        one = len(self.table.selectionModel().selectedRows()) == 1
        none = (
            translate("shell", "no page describes it")
            if one
            else translate("shell", "select one message")
        )
        page = self._page()
        allow(
            self.help,
            None if page else none,
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
        column.addWidget(self.whole, 1)
        column.addWidget(self.lateness)
