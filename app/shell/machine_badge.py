"""Which machine this window drives: simulated, virtual boards, or a real one."""

from enum import StrEnum

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.display_units import label
from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import plain_tip
from rotemina.drivers.driver import Driver, MachineKind

_MARGIN = 10  # px beside the words


class Machine(StrEnum):
    """What moves when this window says so."""

    SIMULATOR = "simulator"
    VIRTUAL_BOARDS = "virtual boards"
    MACHINE = "machine"
    #: A device is being opened that has never said what it is.
    UNIDENTIFIED = "unidentified"


_OF_KIND = {
    MachineKind.SIMULATED: Machine.SIMULATOR,
    MachineKind.VIRTUAL: Machine.VIRTUAL_BOARDS,
    MachineKind.REAL: Machine.MACHINE,
}
#: What may be a real machine, and looks like one.
MAYBE_REAL = (Machine.MACHINE, Machine.UNIDENTIFIED)
WORDS = {
    Machine.SIMULATOR: marked("shell", "SIMULATOR"),
    Machine.VIRTUAL_BOARDS: marked("shell", "VIRTUAL BOARDS"),
    Machine.MACHINE: marked("shell", "MACHINE"),
    Machine.UNIDENTIFIED: marked("shell", "CONNECTING …"),
}
TIPS = {
    Machine.SIMULATOR: marked("shell", "The built-in simulator: no real machine moves."),
    Machine.VIRTUAL_BOARDS: marked(
        "shell", "Boards that say that a program emulates them: no real machine moves."
    ),
    Machine.MACHINE: marked("shell", "Commands of this window move a real machine."),
    Machine.UNIDENTIFIED: marked(
        "shell", "The device has not said yet what it is: treat it as a real machine."
    ),
}


def machine_of(driver: Driver, connection: Connection) -> Machine:
    """Return what a driver drives, or drove last; what is not known for sure is a real machine.

    It changes at most twice when another device is connected, and not while a link is lost or the
    same device is connected again: that is what it was until it says something else.
    """
    if connection is Connection.CONNECTING and not driver.is_identified:
        return Machine.UNIDENTIFIED
    return _OF_KIND[driver.machine_kind]


def ports_of(driver: Driver) -> tuple[str, ...]:
    """Return the ports that a driver talks through."""
    found = (value for name, value in driver.settings.items() if name.endswith("port"))
    return tuple(port for port in found if isinstance(port, str) and port)


class MachineBadge(QWidget):
    """The kind of machine in large letters, with its port: each kind looks its own way."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.machine = Machine.SIMULATOR
        self.words = self.port = ""
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.refresh(workbench.session.snapshot())

    def refresh(self, state: SessionState) -> bool:
        """Look which driver is in use; return whether it is another than before."""
        driver = self._workbench.session.driver
        machine = machine_of(driver, state.connection)
        port = ", ".join(ports_of(driver)) or driver.name
        if machine is Machine.SIMULATOR:
            port = self._describe_wear() or port
        words = translate("shell", WORDS[machine])
        if (machine, port, words) == (self.machine, self.port, self.words):
            return False
        self.machine, self.port, self.words = machine, port, words
        self.setAccessibleName(f"{self.words}, {self.port}")
        self.setToolTip(plain_tip(translate("shell", TIPS[machine]), self.port))
        self.update()
        return True

    def _describe_wear(self) -> str:
        """Return whether a worn machine is simulated, and where; "" where that is hidden."""
        effects = self._workbench.session.service.effects
        if effects is None:
            return ""
        axes = dict.fromkeys(label(effect.axis) for effect in effects if effect.enabled)
        if not axes:
            return translate("shell", "nominal")
        return translate("shell", "worn: {axes}").format(axes=", ".join(axes))

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the size of the large header."""
        return QSize(280, 56)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw an outline with hatches, a violet ground, or a white one."""
        painter, theme = QPainter(self), self._workbench.theme
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QRectF(self.rect()).adjusted(1, 1, -1, -1)
        violet = QColor(theme.virtual)
        painter.setPen(QPen(violet, 2))
        painter.setBrush(violet)
        ink = theme.on_virtual
        if self.machine is Machine.SIMULATOR:
            faint = QColor(violet)
            faint.setAlphaF(0.25)
            painter.setBrush(QBrush(faint, Qt.BrushStyle.BDiagPattern))
            ink = theme.text
        elif self.machine in MAYBE_REAL:
            painter.setPen(QPen(QColor("#000000"), 2))
            painter.setBrush(QColor("#ffffff"))
            ink = "#000000"
        painter.drawRoundedRect(frame, 4, 4)
        painter.setPen(QColor(ink))
        self._write(painter, frame)

    def _write(self, painter: QPainter, frame: QRectF) -> None:
        """Write the kind as large as it fits, 20 px at most, and the port below it."""
        inner = frame.adjusted(_MARGIN, 3, -_MARGIN, -3)
        large, small = self.font(), self.font()
        large.setBold(True)
        base = self.fontMetrics().height() / 16.0
        size = round(min(20 * base, 0.46 * frame.height()))
        large.setPixelSize(size)
        small.setPixelSize(round(min(12 * base, 0.29 * frame.height())))
        painter.setFont(large)
        while painter.fontMetrics().horizontalAdvance(self.words) > inner.width() and size > 10:
            size -= 1
            large.setPixelSize(size)
            painter.setFont(large)
        side = Qt.AlignmentFlag.AlignLeft
        painter.drawText(inner, int(side | Qt.AlignmentFlag.AlignTop), self.words)
        painter.setFont(small)
        middle, width = Qt.TextElideMode.ElideMiddle, round(inner.width())
        port = painter.fontMetrics().elidedText(self.port, middle, width)
        painter.drawText(inner, int(side | Qt.AlignmentFlag.AlignBottom), port)


def window_title(badge: MachineBadge, robot: str) -> str:
    """Return the window's title, by which two of them are told apart."""
    return f"RoTeMiNa – {badge.words} {badge.port} – {robot}"
