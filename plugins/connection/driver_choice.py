"""Choice of the driver and its settings, and the buttons that connect and disconnect."""

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QStandardItemModel
from PySide6.QtWidgets import QToolButton
from serial.tools import list_ports

from rotemina.app.motion.state import SessionState
from rotemina.app.settings import load_settings, store_settings
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
    name_widget,
)
from rotemina.app.widgets.layout import Section
from rotemina.app.workbench import BackgroundWorker, Level, OfferedPort, Workbench
from rotemina.drivers.contract import Driver, discover_drivers
from rotemina.plugins.connection import tr, unavailable_reasons
from rotemina.plugins.connection.setting_fields import SettingForm


def list_serial_ports() -> list[OfferedPort]:
    """Return the serial ports of this computer. The operating system may need a moment."""
    return [
        OfferedPort(str(port.device), str(port.description))
        for port in sorted(list_ports.comports())
    ]


class PortFinder(QObject):
    """Background search for serial ports.

    Signals
    -------
    ports_found(list of OfferedPort)
        Emitted after each search.
    """

    ports_found = Signal(object)

    def __init__(self, workbench: Workbench, parent: QObject) -> None:
        super().__init__(parent)
        self._background = BackgroundWorker(self)
        self._workbench = workbench
        workbench.closing.connect(self._background.end)

    def search_ports(self) -> None:
        """Start a search."""
        self._background.run("ports", list_serial_ports, self._on_found, self._on_failed)

    def _on_found(self, ports: object) -> None:
        self._workbench.settled.emit(self)
        self.ports_found.emit(ports)

    def _on_failed(self, message: str) -> None:
        self._workbench.notify(
            Level.WARNING,
            tr("Serial ports cannot be listed: {message}").format(message=message),
            about=self,
            subject=self,
        )


class DriverChoice(WheelSafeComboBox):
    """Choice of an installed driver.

    A driver that cannot be loaded is listed and its tooltip gives the reason, but the operator
    cannot choose it.
    """

    def __init__(self, drivers: dict[str, type[Driver]], broken: dict[str, str]) -> None:
        super().__init__(
            tr("Driver"),
            tr("Device that the program controls: the simulator, boards, or a device of a plugin"),
            letters=0,
        )
        for name, driver_class in drivers.items():
            self.addItem(name, driver_class)
        model = self.model()
        assert isinstance(model, QStandardItemModel)
        for name, reason in broken.items():
            self.addItem(tr("{name} – cannot be used").format(name=name))
            item = model.item(self.count() - 1)
            item.setEnabled(False)
            item.setToolTip(make_tooltip(reason))


class DeviceSection(Section):
    """Section with the choice of a driver, its settings, and the buttons that connect to it."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Device"))
        self._workbench = workbench
        discovery = discover_drivers()
        self.choice = DriverChoice(discovery.plugins, discovery.problems)
        self.find = name_widget(
            QToolButton(), tr("Refresh the ports"), tr("Refresh the serial ports")
        )
        self.find.setText("⟳")
        self.add_row(self.choice, self.find, equal=False)
        self.broken_text = self.add_text()
        self.broken_text.setText(
            "\n".join(
                tr("{name} is left out: {why}").format(name=name, why=problem)
                for name, problem in discovery.problems.items()
            )
        )
        self.broken_text.setVisible(bool(discovery.problems))
        self.form = SettingForm({}, {})
        self._form_index = self.column.count()
        self.column.addWidget(self.form)
        self.connect_button = make_button(tr("Connect"), self._connect_device)
        self.connect_button.setProperty("primary", True)
        self.disconnect_button = make_button(tr("Disconnect"), workbench.disconnect_device)
        self.reconnect_button = make_button(tr("Reconnect"), workbench.reconnect)
        self.add_row(self.connect_button, self.disconnect_button, self.reconnect_button)
        self._ports: list[OfferedPort] = []
        self._offered_ports: tuple[OfferedPort, ...] = ()
        self._finder = PortFinder(workbench, self)
        self._finder.ports_found.connect(self._show_ports)
        self.find.clicked.connect(lambda _: self._finder.search_ports())
        self.choice.currentIndexChanged.connect(lambda _: self._show_settings())
        workbench.ports_offered.connect(self.offer_ports)
        self._choose_driver(type(workbench.session.driver))
        self._show_settings()

    @property
    def driver_class(self) -> type[Driver] | None:
        """The chosen driver, or None if no usable driver is chosen."""
        driver_class = self.choice.currentData()
        return driver_class if isinstance(driver_class, type) else None

    def refresh(self, state: SessionState) -> None:
        """Enable the buttons that are available in this state, and disable the others."""
        settings_problem = (
            tr("no driver is chosen") if self.driver_class is None else self.form.find_problem()
        )
        connect_objection = settings_problem or unavailable_reasons.find_connect_objection(
            state, is_in_use=settings_problem is None and self._is_in_use()
        )
        name = self.choice.currentText()
        enable_unless(
            self.connect_button,
            connect_objection,
            tr("Connect to {name}; any other device is disconnected").format(name=name),
        )
        enable_unless(
            self.disconnect_button,
            unavailable_reasons.find_disconnect_objection(state),
            tr("Stop and disconnect the device; it holds its position"),
        )
        enable_unless(
            self.reconnect_button,
            unavailable_reasons.find_reconnect_objection(state),
            tr("Connect to {name} again with the same settings").format(
                name=self._workbench.session.driver.name
            ),
        )

    def offer_ports(self, ports: tuple[OfferedPort, ...]) -> None:
        """Offer the ports of virtual boards, and enter them in the port fields of the driver.

        If the chosen driver has no port fields, choose the first driver that has enough of them.
        """
        self._offered_ports = ports
        if ports and not self.form.port_fields:
            self._choose_driver_with_ports(len(ports))
        self._show_ports(self._ports)
        for field, port in zip(self.form.port_fields, (*ports, None), strict=False):
            if ports:
                field.set_text(port.device if port is not None else "")

    def _choose_driver(self, driver_class: type[Driver]) -> None:
        for index in range(self.choice.count()):
            if self.choice.itemData(index) is driver_class:
                self.choice.setCurrentIndex(index)

    def _choose_driver_with_ports(self, count: int) -> None:
        for index in range(self.choice.count()):
            driver_class = self.choice.itemData(index)
            settings = driver_class.default_settings if isinstance(driver_class, type) else ()
            if sum(name.endswith("port") for name in settings) >= count:
                self.choice.setCurrentIndex(index)
                return

    def _show_settings(self) -> None:
        driver_class, session = self.driver_class, self._workbench.session
        defaults = dict(driver_class.default_settings) if driver_class is not None else {}
        values = (
            load_settings(self._workbench.settings, driver_class)
            if driver_class is not None
            else {}
        )
        if driver_class is type(session.driver):
            values = dict(session.driver.settings)
        self.column.removeWidget(self.form)
        self.form.hide()
        self.form.deleteLater()
        self.form = SettingForm(defaults, values)
        self.form.changed.connect(self._save_settings)
        self.column.insertWidget(self._form_index, self.form)
        has_port_fields = bool(self.form.port_fields)
        self.find.setVisible(has_port_fields)
        if has_port_fields:
            self._show_ports(self._ports)
            self._finder.search_ports()

    def _save_settings(self) -> None:
        """Save the settings if all fields are valid."""
        if self.driver_class is not None and self.form.find_problem() is None:
            store_settings(self._workbench.settings, self.driver_class, self.form.read_values())

    def _show_ports(self, ports: list[OfferedPort]) -> None:
        self._ports = ports
        for field in self.form.port_fields:
            field.offer_ports((*self._offered_ports, *ports))

    def _is_in_use(self) -> bool:
        """Return whether the session uses the chosen driver with the settings in the fields."""
        driver = self._workbench.session.driver
        return self.driver_class is type(driver) and self.form.read_values() == dict(
            driver.settings
        )

    def _connect_device(self) -> None:
        driver_class = self.driver_class
        if driver_class is None or self.form.find_problem() is not None:
            return
        values = self.form.read_values()
        if self._workbench.use_driver(driver_class, values):
            store_settings(self._workbench.settings, driver_class, values)
