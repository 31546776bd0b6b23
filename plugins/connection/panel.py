"""The connected device and its state: everything to settle before motion."""

from PySide6.QtWidgets import QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.language import marked
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.layouts import in_column
from rotemina.app.widgets.scroll_areas import scrolled
from rotemina.plugins.connection.driver_choice import DeviceSection
from rotemina.plugins.connection.homing_section import PositionSection
from rotemina.plugins.connection.line_quality import LineSection, StopSection
from rotemina.plugins.connection.parameter_differences import ParameterSection
from rotemina.plugins.connection.service_voltage import VoltageSection
from rotemina.plugins.connection.state_section import StateSection
from rotemina.plugins.connection.tip_floor import TipSection


class ConnectionPanel(Panel):
    """State, device, position, tip, voltage, line, stop latency and parameters, in one column."""

    title = marked("panels", "Connection")
    area = Area.RIGHT
    order = 20
    help_page = "connection.md"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.state = StateSection(workbench)
        self.device = DeviceSection(workbench)
        self.position = PositionSection(workbench)
        self.parameters = ParameterSection(workbench)
        self.tip = TipSection(workbench)
        self.voltage = VoltageSection(workbench)
        self.line = LineSection(workbench)
        self.stop = StopSection(workbench)
        self._sections = (
            self.state,
            self.device,
            self.position,
            self.tip,
            self.voltage,
            self.line,
            self.stop,
            self.parameters,  # last: no button moves when a table of differences appears
        )
        content = QWidget()
        in_column(*self._sections, 1, on=content, margins=(10, 4, 10, 8), spacing=4)
        in_column(scrolled(content, least=300), on=self, margins=0)
        self.follow(self._refresh)
        offer_in_palette(self.device.connect_button, self.device.disconnect_button)
        offer_in_palette(self.state.confirm, self.parameters.write, self.parameters.accept)
        offer_in_palette(self.tip.teach, self.tip.remove)
        self._refresh(workbench.session.snapshot())

    def _refresh(self, state: SessionState) -> None:
        for section in self._sections:
            section.refresh(state)
