"""Serial ports of this computer, looked for away from the window's thread."""

from PySide6.QtCore import QObject, Signal
from serial.tools import list_ports

from rotemina.app.shell.background import Background
from rotemina.app.shell.language import translate
from rotemina.app.shell.requests import OfferedPort
from rotemina.app.shell.workbench import Level, Workbench


def serial_ports() -> list[OfferedPort]:
    """Return the serial ports that exist; this may take a moment."""
    return [
        OfferedPort(str(one.device), str(one.description)) for one in sorted(list_ports.comports())
    ]


class PortFinder(QObject):
    """Looks for ports in the background.

    Signals
    -------
    found(list of OfferedPort)
    """

    found = Signal(object)

    def __init__(self, workbench: Workbench, parent: QObject) -> None:
        super().__init__(parent)
        self._background = Background(self)
        self._notify = workbench.notify
        workbench.closing.connect(self._background.wait)

    def look(self) -> None:
        """Look once more."""
        self._background.run("ports", serial_ports, self.found.emit, self._failed)

    def _failed(self, message: str) -> None:
        self._notify(
            Level.WARNING,
            translate("connection", "Serial ports cannot be listed: {message}").format(
                message=message
            ),
            about=self,
        )
