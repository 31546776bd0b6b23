"""Fields for the settings of a driver, each by its type."""

from collections.abc import Sequence

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QCheckBox, QFormLayout, QLabel, QLineEdit, QWidget

from rotemina.app.driver_settings import typed
from rotemina.app.shell.engine_words import error_text
from rotemina.app.shell.operator_requests import OfferedPort
from rotemina.app.widgets.controls import plain_tip, set_property, show_tip
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.plugins.connection import mark, tr
from rotemina.sim.quantities import localized

# Settings of the program's own drivers, as people say them.
NAMES = (
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
_UNITS = {"s": "s", "ms": "ms", "hz": "Hz", "v": "V", "m": "m"}


def _written(value: SettingValue) -> str:
    """Return a value as a field holds it, a number with the decimal sign in use."""
    return localized(f"{value:g}") if isinstance(value, float) else str(value)


class PortChoice(SteadyChoice):
    """The ports that exist, and room to type another."""

    def __init__(self) -> None:
        super().__init__(letters=12)
        self.setEditable(True)
        self.setInsertPolicy(self.InsertPolicy.NoInsert)
        edit = self.lineEdit()
        assert edit is not None
        edit.setPlaceholderText(tr("none"))

    def offer(self, ports: Sequence[OfferedPort]) -> None:
        """Put ports into the list; what is written stays."""
        text = self.currentText()
        self.blockSignals(True)
        self.clear()
        for port in ports:
            self.addItem(port.device)
            self.setItemData(self.count() - 1, plain_tip(port.about), Qt.ItemDataRole.ToolTipRole)
        self.setCurrentIndex(-1)
        self.setEditText(text)
        self.blockSignals(False)


class SettingField(QObject):
    """The widget of one setting.

    Signals
    -------
    changed() : someone has written or chosen something else.
    """

    changed = Signal()

    def __init__(self, name: str, default: SettingValue, value: SettingValue) -> None:
        super().__init__()
        self.name, self._default = name, default
        self.widget = self._made(value)
        self.widget.setAccessibleName(tr("Setting {name}").format(name=spoken(name)))
        self._about = tr("{name}; preset {default}").format(
            name=spoken(name), default=_written(default) or tr("none")
        )
        self.widget.setToolTip(plain_tip(self._about))

    @property
    def is_port(self) -> bool:
        """Whether it names a port."""
        return isinstance(self.widget, PortChoice)

    def value(self) -> SettingValue:
        """Return what the field holds.

        Raises
        ------
        SettingError
            If that is no value of its type.
        """
        if isinstance(self.widget, QCheckBox):
            return self.widget.isChecked()
        return typed(self.name, self._default, self._text())

    def offer(self, ports: Sequence[OfferedPort]) -> None:
        """Offer ports, where the field names one."""
        if isinstance(self.widget, PortChoice):
            self.widget.offer(ports)

    def set_text(self, text: str) -> None:
        """Write into the field."""
        if isinstance(self.widget, PortChoice):
            self.widget.setEditText(text)
        elif isinstance(self.widget, QLineEdit):
            self.widget.setText(text)

    def complaint(self) -> str | None:
        """Return the problem of the field and mark it, or None."""
        wrong = None
        try:
            self.value()
        except SettingError as error:
            wrong = error_text(error)
        set_property(self.widget, "bad", bool(wrong))
        show_tip(self.widget, self._about, wrong or "")
        return wrong

    def _text(self) -> str:
        if isinstance(self.widget, PortChoice):
            return self.widget.currentText()
        assert isinstance(self.widget, QLineEdit)
        return self.widget.text()

    def _made(self, value: SettingValue) -> QWidget:
        if isinstance(self._default, bool):
            switch = QCheckBox()
            switch.setChecked(bool(value))
            switch.toggled.connect(self.changed)
            return switch
        if isinstance(self._default, str) and self.name.endswith("port"):
            choice = PortChoice()
            choice.setEditText(str(value))
            choice.activated.connect(lambda _: self.changed.emit())
            choice.lineEdit().editingFinished.connect(self.changed)
            return choice
        edit = QLineEdit(_written(value))
        edit.editingFinished.connect(self.changed)
        return edit


class SettingForm(QWidget):
    """The settings of one driver.

    Signals
    -------
    changed() : any field did.
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
            title = QLabel(spoken(name))
            title.setTextFormat(Qt.TextFormat.PlainText)
            title.setBuddy(field.widget)
            form.addRow(title, field.widget)
            field.setParent(self)
            field.changed.connect(self.changed)

    @property
    def port_fields(self) -> list[SettingField]:
        """Those that name a port."""
        return [field for field in self.fields.values() if field.is_port]

    def complaint(self) -> str | None:
        """Return the first problem, and mark all invalid fields."""
        wrong = [field.complaint() for field in self.fields.values()]
        return next((one for one in wrong if one is not None), None)

    def values(self) -> dict[str, SettingValue]:
        """Return all settings.

        Raises
        ------
        SettingError
            If a field holds no value of its type.
        """
        return {name: field.value() for name, field in self.fields.items()}


def spoken(name: str) -> str:
    """Return a setting's name as people say it: ``settle_s`` is ``settle [s]``."""
    head, _, unit = name.rpartition("_")
    if head and unit in _UNITS:
        return f"{_translated(head)} [{_UNITS[unit]}]"
    return _translated(name)


def _translated(name: str) -> str:
    return tr(name.replace("_", " "))
