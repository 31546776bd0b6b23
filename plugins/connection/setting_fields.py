"""Fields for the settings of a driver. The type of a setting determines its widget."""

from collections.abc import Sequence

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QCheckBox, QFormLayout, QLabel, QLineEdit, QWidget

from rotemina.app.language import describe_error
from rotemina.app.settings import parse_setting
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    make_tooltip,
    set_property,
    show_tooltip,
)
from rotemina.app.workbench import OfferedPort
from rotemina.drivers.contract import DriverSettingError, SettingValue
from rotemina.plugins.connection import mark, tr
from rotemina.sim.messages import localize_number

# The names of the built-in drivers' settings as shown, marked here for translation.
SETTING_NAMES = (
    mark("sample rate"),
    mark("seed"),
    mark("settle"),
    mark("start fraction"),
    mark("start homed"),
    mark("port"),
    mark("second port"),
    mark("baud"),
    mark("watchdog"),
    mark("latency"),
)
_UNIT_SYMBOLS = {"s": "s", "ms": "ms", "hz": "Hz", "v": "V", "m": "m"}


def _format_value(value: SettingValue) -> str:
    return localize_number(f"{value:g}") if isinstance(value, float) else str(value)


class PortChoice(WheelSafeComboBox):
    """Choice of a port. The operator can also type a port that is not listed."""

    def __init__(self) -> None:
        super().__init__(letters=12)
        self.setEditable(True)
        self.setInsertPolicy(self.InsertPolicy.NoInsert)
        line_edit = self.lineEdit()
        assert line_edit is not None
        line_edit.setPlaceholderText(tr("none"))

    def offer_ports(self, ports: Sequence[OfferedPort]) -> None:
        """List ports without changing the text in the field."""
        text = self.currentText()
        self.blockSignals(True)
        self.clear()
        for port in ports:
            self.addItem(port.device)
            self.setItemData(
                self.count() - 1, make_tooltip(port.about), Qt.ItemDataRole.ToolTipRole
            )
        self.setCurrentIndex(-1)
        self.setEditText(text)
        self.blockSignals(False)


class SettingField(QObject):
    """Widget of one setting.

    Signals
    -------
    changed()
        Emitted when the operator has entered or chosen another value.
    """

    changed = Signal()

    def __init__(self, name: str, default: SettingValue, value: SettingValue) -> None:
        super().__init__()
        self.name, self._default = name, default
        self.widget = self._make_widget(value)
        self.widget.setAccessibleName(tr("Setting {name}").format(name=format_setting_name(name)))
        self._tooltip = tr("{name}; default {default}").format(
            name=format_setting_name(name), default=_format_value(default) or tr("none")
        )
        self.widget.setToolTip(make_tooltip(self._tooltip))

    @property
    def is_port(self) -> bool:
        """Whether the setting is a port."""
        return isinstance(self.widget, PortChoice)

    def read_value(self) -> SettingValue:
        """Return the value in the field.

        Raises
        ------
        DriverSettingError
            If the text is not a value of the type of the setting.
        """
        if isinstance(self.widget, QCheckBox):
            return self.widget.isChecked()
        return parse_setting(self.name, self._default, self._read_text())

    def offer_ports(self, ports: Sequence[OfferedPort]) -> None:
        """List ports if the setting is a port."""
        if isinstance(self.widget, PortChoice):
            self.widget.offer_ports(ports)

    def set_text(self, text: str) -> None:
        """Enter a text in the field."""
        if isinstance(self.widget, PortChoice):
            self.widget.setEditText(text)
        elif isinstance(self.widget, QLineEdit):
            self.widget.setText(text)

    def find_problem(self) -> str | None:
        """Return why the value is invalid, or None, and mark or unmark the field accordingly."""
        problem = None
        try:
            self.read_value()
        except DriverSettingError as error:
            problem = describe_error(error)
        set_property(self.widget, "bad", bool(problem))
        show_tooltip(self.widget, self._tooltip, problem or "")
        return problem

    def _read_text(self) -> str:
        if isinstance(self.widget, PortChoice):
            return self.widget.currentText()
        assert isinstance(self.widget, QLineEdit)
        return self.widget.text()

    def _make_widget(self, value: SettingValue) -> QWidget:
        if isinstance(self._default, bool):
            check_box = QCheckBox()
            check_box.setChecked(bool(value))
            check_box.toggled.connect(self.changed)
            return check_box
        if isinstance(self._default, str) and self.name.endswith("port"):
            choice = PortChoice()
            choice.setEditText(str(value))
            choice.activated.connect(lambda _: self.changed.emit())
            choice.lineEdit().editingFinished.connect(self.changed)
            return choice
        text_field = QLineEdit(_format_value(value))
        text_field.editingFinished.connect(self.changed)
        return text_field


class SettingForm(QWidget):
    """Form with the settings of one driver.

    Signals
    -------
    changed()
        Emitted when the value of any field has changed.
    """

    changed = Signal()

    def __init__(self, defaults: dict[str, SettingValue], values: dict[str, SettingValue]) -> None:
        super().__init__()
        form = QFormLayout(self)
        form.setContentsMargins(0, 0, 0, 0)
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(5)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.fields = {name: SettingField(name, defaults[name], values[name]) for name in defaults}
        for name, field in self.fields.items():
            title = QLabel(format_setting_name(name))
            title.setTextFormat(Qt.TextFormat.PlainText)
            title.setBuddy(field.widget)
            form.addRow(title, field.widget)
            field.setParent(self)
            field.changed.connect(self.changed)

    @property
    def port_fields(self) -> list[SettingField]:
        """The fields of the settings that are ports."""
        return [field for field in self.fields.values() if field.is_port]

    def find_problem(self) -> str | None:
        """Return the problem of the first invalid field, or None, and mark all invalid fields."""
        problems = [field.find_problem() for field in self.fields.values()]
        return next((problem for problem in problems if problem is not None), None)

    def read_values(self) -> dict[str, SettingValue]:
        """Return the values of all settings by name.

        Raises
        ------
        DriverSettingError
            If the text of a field is not a value of its type.
        """
        return {name: field.read_value() for name, field in self.fields.items()}


def format_setting_name(name: str) -> str:
    """Return the name of a setting as shown: ``settle_s`` becomes ``settle [s]``."""
    stem, _, unit = name.rpartition("_")
    if stem and unit in _UNIT_SYMBOLS:
        return f"{_translate_name(stem)} [{_UNIT_SYMBOLS[unit]}]"
    return _translate_name(name)


def _translate_name(name: str) -> str:
    return tr(name.replace("_", " "))
