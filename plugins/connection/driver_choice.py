"""Choice of driver and settings; connect, disconnect, reconnect."""

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QStandardItemModel
from PySide6.QtWidgets import QToolButton
from serial.tools import list_ports

from rotemina.app.driver_settings import keep, kept
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.background import Background
from rotemina.app.shell.operator_requests import OfferedPort
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button, named, plain_tip
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.drivers.driver import Driver
from rotemina.drivers.registry import discover_drivers
from rotemina.plugins.connection import tr, unavailable_reasons
from rotemina.plugins.connection.setting_fields import SettingForm


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
        self._workbench = workbench
        workbench.closing.connect(self._background.end)

    def look(self) -> None:
        """Look again."""
        self._background.run("ports", serial_ports, self._take, self._failed)

    def _take(self, ports: object) -> None:
        self._workbench.settled.emit(self)
        self.found.emit(ports)

    def _failed(self, message: str) -> None:
        self._workbench.notify(
            Level.WARNING,
            tr("Serial ports cannot be listed: {message}").format(message=message),
            about=self,
            subject=self,
        )


class DriverChoice(SteadyChoice):
    """The installed drivers; broken ones are there, with their reason, and cannot be chosen."""

    def __init__(self, found: dict[str, type[Driver]], broken: dict[str, str]) -> None:
        super().__init__(
            tr("Driver"),
            tr("Device that the program controls: the simulator, boards, or a device of a plugin"),
            letters=0,
        )
        for name, kind in found.items():
            self.addItem(name, kind)
        model = self.model()
        assert isinstance(model, QStandardItemModel)
        for name, reason in broken.items():
            self.addItem(tr("{name} – cannot be used").format(name=name))
            item = model.item(self.count() - 1)
            item.setEnabled(False)
            item.setToolTip(plain_tip(reason))


class DeviceSection(Section):
    """The choice of a driver, its settings, and the connection to it."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Device"))
        self._workbench = workbench
        discovery = discover_drivers()
        self.choice = DriverChoice(discovery.found, discovery.broken)
        self.find = named(QToolButton(), tr("Refresh the ports"), tr("Refresh the serial ports"))
        self.find.setText("⟳")
        self.add_row(self.choice, self.find, equal=False)
        self.broken = self.add_text()
        self.broken.setText(
            "\n".join(
                tr("{name} is left out: {why}").format(name=name, why=why)
                for name, why in discovery.broken.items()
            )
        )
        self.broken.setVisible(bool(discovery.broken))
        self.form = SettingForm({}, {})
        self._place = self.column.count()
        self.column.addWidget(self.form)
        self.connect_button = button(tr("Connect"), self._connect)
        self.connect_button.setProperty("primary", True)
        self.disconnect_button = button(tr("Disconnect"), workbench.let_go)
        self.reconnect_button = button(tr("Reconnect"), workbench.reconnect)
        self.add_row(self.connect_button, self.disconnect_button, self.reconnect_button)
        self._ports: list[OfferedPort] = []
        self._offered: tuple[OfferedPort, ...] = ()
        self._finder = PortFinder(workbench, self)
        self._finder.found.connect(self._take_ports)
        self.find.clicked.connect(lambda _: self._finder.look())
        self.choice.currentIndexChanged.connect(lambda _: self._show_settings())
        workbench.ports_offered.connect(self.offer_ports)
        self._choose(type(workbench.session.driver))
        self._show_settings()

    @property
    def kind(self) -> type[Driver] | None:
        """The chosen driver."""
        kind = self.choice.currentData()
        return kind if isinstance(kind, type) else None

    def refresh(self, state: SessionState) -> None:
        """Lock what cannot be done now."""
        wrong = tr("no driver is chosen") if self.kind is None else self.form.complaint()
        why = wrong or unavailable_reasons.against_connecting(
            state, same=wrong is None and self._same()
        )
        name = self.choice.currentText()
        allow(
            self.connect_button,
            why,
            tr("Connect to {name}; any other device is disconnected").format(name=name),
        )
        allow(
            self.disconnect_button,
            unavailable_reasons.against_disconnecting(state),
            tr("Stop and disconnect the device; it holds its position"),
        )
        allow(
            self.reconnect_button,
            unavailable_reasons.against_reconnecting(state),
            tr("Connect to {name} again with the same settings").format(
                name=self._workbench.session.driver.name
            ),
        )

    def offer_ports(self, ports: tuple[OfferedPort, ...]) -> None:
        """Offer ports of virtual boards, and fill them in where a driver takes ports."""
        self._offered = ports
        if ports and not self.form.port_fields:
            self._choose_one_with_ports(len(ports))
        self._take_ports(self._ports)
        for field, port in zip(self.form.port_fields, (*ports, None), strict=False):
            if ports:
                field.set_text(port.device if port is not None else "")

    def _choose(self, kind: type[Driver]) -> None:
        for index in range(self.choice.count()):
            if self.choice.itemData(index) is kind:
                self.choice.setCurrentIndex(index)

    def _choose_one_with_ports(self, number: int) -> None:
        """Choose the first driver that has a setting for each of so many ports."""
        for index in range(self.choice.count()):
            kind = self.choice.itemData(index)
            settings = kind.default_settings if isinstance(kind, type) else ()
            if sum(name.endswith("port") for name in settings) >= number:
                self.choice.setCurrentIndex(index)
                return

    def _show_settings(self) -> None:
        kind, session = self.kind, self._workbench.session
        defaults = dict(kind.default_settings) if kind is not None else {}
        values = kept(self._workbench.settings, kind) if kind is not None else {}
        if kind is type(session.driver):
            values = dict(session.driver.settings)
        self.column.removeWidget(self.form)
        self.form.hide()
        self.form.deleteLater()
        self.form = SettingForm(defaults, values)
        self.form.changed.connect(self._keep)
        self.column.insertWidget(self._place, self.form)
        takes_ports = bool(self.form.port_fields)
        self.find.setVisible(takes_ports)
        if takes_ports:
            self._take_ports(self._ports)
            self._finder.look()

    def _keep(self) -> None:
        """Remember what makes sense."""
        if self.kind is not None and self.form.complaint() is None:
            keep(self._workbench.settings, self.kind, self.form.values())

    def _take_ports(self, ports: list[OfferedPort]) -> None:
        self._ports = ports
        for field in self.form.port_fields:
            field.offer((*self._offered, *ports))

    def _same(self) -> bool:
        driver = self._workbench.session.driver
        return self.kind is type(driver) and self.form.values() == dict(driver.settings)

    def _connect(self) -> None:
        kind = self.kind
        if kind is None or self.form.complaint() is not None:
            return
        values = self.form.values()
        if self._workbench.use_driver(kind, values):
            keep(self._workbench.settings, kind, values)
