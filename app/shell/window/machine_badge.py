"""The badge that shows what the window controls: simulator, virtual boards or real machine."""

from enum import StrEnum

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.language import get_axis_label, marked, translate
from rotemina.app.motion.state import ConnectionState, SessionState
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.workbench import Workbench
from rotemina.drivers.contract import Driver, MachineKind

_MARGIN_PX = 10


class DisplayedMachine(StrEnum):
    """The kind of machine that the window shows as moving."""

    SIMULATOR = "simulator"
    VIRTUAL_BOARDS = "virtual boards"
    MACHINE = "machine"
    #: A device is being opened that has not identified itself yet.
    UNIDENTIFIED = "unidentified"


_MACHINE_BY_KIND = {
    MachineKind.SIMULATED: DisplayedMachine.SIMULATOR,
    MachineKind.VIRTUAL: DisplayedMachine.VIRTUAL_BOARDS,
    MachineKind.REAL: DisplayedMachine.MACHINE,
}
#: Kinds that may be a real machine. They are drawn alike.
MAYBE_REAL = (DisplayedMachine.MACHINE, DisplayedMachine.UNIDENTIFIED)
MACHINE_NAMES = {
    DisplayedMachine.SIMULATOR: marked("shell", "SIMULATOR"),
    DisplayedMachine.VIRTUAL_BOARDS: marked("shell", "VIRTUAL BOARDS"),
    DisplayedMachine.MACHINE: marked("shell", "MACHINE"),
    DisplayedMachine.UNIDENTIFIED: marked("shell", "CONNECTING …"),
}
MACHINE_TIPS = {
    DisplayedMachine.SIMULATOR: marked("shell", "The built-in simulator: no real machine moves."),
    DisplayedMachine.VIRTUAL_BOARDS: marked(
        "shell", "Boards that identify themselves as emulated: no real machine moves."
    ),
    DisplayedMachine.MACHINE: marked("shell", "Commands of this window move a real machine."),
    DisplayedMachine.UNIDENTIFIED: marked(
        "shell", "The device has not said yet what it is: treat it as a real machine."
    ),
}


def identify_machine(driver: Driver, connection: ConnectionState) -> DisplayedMachine:
    """Return the kind of machine that a driver controls.

    Until the device has identified itself, it must be treated as a real machine. The kind changes
    at most twice when another device is connected. It does not change when the link is lost or the
    same device is connected again, unless the device reports another kind.
    """
    if connection is ConnectionState.CONNECTING and not driver.is_identified:
        return DisplayedMachine.UNIDENTIFIED
    return _MACHINE_BY_KIND[driver.machine_kind]


def find_ports(driver: Driver) -> tuple[str, ...]:
    """Return the ports through which a driver communicates."""
    values = (value for name, value in driver.settings.items() if name.endswith("port"))
    return tuple(port for port in values if isinstance(port, str) and port)


class MachineBadge(QWidget):
    """Badge with the kind of machine in large letters and its port; each kind looks different."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.machine = DisplayedMachine.SIMULATOR
        self.words = self.port = ""
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.refresh(workbench.session.snapshot())

    def refresh(self, state: SessionState) -> bool:
        """Show the machine of the driver in use; return whether it has changed."""
        driver = self._workbench.session.driver
        machine = identify_machine(driver, state.connection)
        port = ", ".join(find_ports(driver)) or driver.name
        if machine is DisplayedMachine.SIMULATOR:
            port = self._describe_wear() or port
        words = translate("shell", MACHINE_NAMES[machine])
        if (machine, port, words) == (self.machine, self.port, self.words):
            return False
        self.machine, self.port, self.words = machine, port, words
        self.setAccessibleName(f"{self.words}, {self.port}")
        self.setToolTip(make_tooltip(translate("shell", MACHINE_TIPS[machine]), self.port))
        self.update()
        return True

    def _describe_wear(self) -> str:
        """Return which simulated axes have effects of wear, or "" if these are kept secret."""
        effects = self._workbench.session.service.effects
        if effects is None:
            return ""
        axes = dict.fromkeys(get_axis_label(effect.axis) for effect in effects if effect.enabled)
        if not axes:
            return translate("shell", "nominal")
        return translate("shell", "worn: {axes}").format(axes=", ".join(axes))

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the size in the large header."""
        return QSize(280, 56)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the badge: hatched for the simulator, violet for virtual boards, else white."""
        painter, theme = QPainter(self), self._workbench.theme
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QRectF(self.rect()).adjusted(1, 1, -1, -1)
        violet = QColor(theme.virtual)
        painter.setPen(QPen(violet, 2))
        painter.setBrush(violet)
        text_colour = theme.on_virtual
        if self.machine is DisplayedMachine.SIMULATOR:
            hatch_colour = QColor(violet)
            hatch_colour.setAlphaF(0.25)
            painter.setBrush(QBrush(hatch_colour, Qt.BrushStyle.BDiagPattern))
            text_colour = theme.text
        elif self.machine in MAYBE_REAL:
            painter.setPen(QPen(QColor("#000000"), 2))
            painter.setBrush(QColor("#ffffff"))
            text_colour = "#000000"
        painter.drawRoundedRect(frame, 4, 4)
        painter.setPen(QColor(text_colour))
        self._draw_text(painter, frame)

    def _draw_text(self, painter: QPainter, frame: QRectF) -> None:
        text_area = frame.adjusted(_MARGIN_PX, 3, -_MARGIN_PX, -3)
        kind_font, port_font = self.font(), self.font()
        kind_font.setBold(True)
        text_scale = self.fontMetrics().height() / 16.0
        size = round(min(20 * text_scale, 0.46 * frame.height()))
        kind_font.setPixelSize(size)
        port_font.setPixelSize(round(min(12 * text_scale, 0.29 * frame.height())))
        painter.setFont(kind_font)
        while painter.fontMetrics().horizontalAdvance(self.words) > text_area.width() and size > 10:
            size -= 1
            kind_font.setPixelSize(size)
            painter.setFont(kind_font)
        left_aligned = Qt.AlignmentFlag.AlignLeft
        painter.drawText(text_area, int(left_aligned | Qt.AlignmentFlag.AlignTop), self.words)
        painter.setFont(port_font)
        elide_mode, width = Qt.TextElideMode.ElideMiddle, round(text_area.width())
        port = painter.fontMetrics().elidedText(self.port, elide_mode, width)
        painter.drawText(text_area, int(left_aligned | Qt.AlignmentFlag.AlignBottom), port)


def make_window_title(badge: MachineBadge, robot: str) -> str:
    """Return a window title that distinguishes several windows."""
    return f"RoTeMiNa – {badge.words} {badge.port} – {robot}"
