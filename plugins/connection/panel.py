"""The Connection panel: the device, and everything that must be in order before motion."""

from PySide6.QtWidgets import QWidget

from rotemina.app.language import marked
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.widgets.layout import make_column, make_scroll_area
from rotemina.app.workbench import Workbench
from rotemina.plugins.connection.driver_choice import DeviceSection
from rotemina.plugins.connection.homing_and_undo_section import HomingSection
from rotemina.plugins.connection.line_quality import LineQualitySection, StopLatencySection
from rotemina.plugins.connection.parameter_differences import ParameterDifferencesSection
from rotemina.plugins.connection.service_voltage import ServiceVoltageSection
from rotemina.plugins.connection.state_section import StateSection
from rotemina.plugins.connection.tip_floor import TipFloorSection


class ConnectionPanel(Panel):
    """Panel with sections for the state, device, homing, tip, voltage, line and parameters."""

    title = marked("panels", "Connection")
    area = PanelArea.RIGHT
    order = 20
    help_page = "connection.md"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.state = StateSection(workbench)
        self.device = DeviceSection(workbench)
        self.position = HomingSection(workbench)
        self.parameters = ParameterDifferencesSection(workbench)
        self.tip = TipFloorSection(workbench)
        self.voltage = ServiceVoltageSection(workbench)
        self.line = LineQualitySection(workbench)
        self.stop = StopLatencySection(workbench)
        self._sections = (
            self.state,
            self.device,
            self.position,
            self.tip,
            self.voltage,
            self.line,
            self.stop,
            # This section is last, so that no button moves when its table appears.
            self.parameters,
        )
        content = QWidget()
        make_column(*self._sections, 1, on=content, margins=(10, 4, 10, 8), spacing=4)
        make_column(make_scroll_area(content, min_width=300), on=self, margins=0)
        self.follow(self._refresh)
        offer_in_palette(self.device.connect_button, self.device.disconnect_button)
        offer_in_palette(self.state.confirm, self.parameters.write, self.parameters.accept)
        offer_in_palette(self.tip.teach, self.tip.remove)
        self._refresh(workbench.session.snapshot())

    def _refresh(self, state: SessionState) -> None:
        for section in self._sections:
            section.refresh(state)
