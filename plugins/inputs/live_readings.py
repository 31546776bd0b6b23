"""Live readings of a device, with a bar for each axis and a lamp for each button."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame

from rotemina.app.language import translate_message
from rotemina.app.motion.inputs import InputAxisView, InputCalibration, InputDeviceView
from rotemina.app.widgets.layout import Section, clear_layout, make_column, make_grid
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import (
    ElidedLabel,
    make_plain_label,
    show_or_hide_text,
)
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.reading_bars import AxisBar, ButtonLamps
from rotemina.plugins.inputs.words import format_target_name
from rotemina.sim.messages import format_number

_NAME_WIDTH_PX, _NUMBER_WIDTH_PX = 72, 104


class AxisReadingRow(QFrame):
    """Row with the bar and the numbers of an axis.

    A second line shows which target the axis moves, and the reason if it has no effect.
    """

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        grid = make_grid(on=self, margins=0, spacing=(6, 0), stretched=1)
        title = ElidedLabel()
        title.show_text(name)
        title.setFixedWidth(_NAME_WIDTH_PX)
        self.bar = AxisBar(theme, name)
        self.numbers = make_plain_label("–", quiet=False)
        self.numbers.setMinimumWidth(_NUMBER_WIDTH_PX)
        self.numbers.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.numbers.setAccessibleName(tr("Axis {name}: raw, calibrated").format(name=name))
        self.numbers.setToolTip(tr("Raw value of the device, −1 to 1, and calibrated deflection"))
        self.target_text = ElidedLabel()
        self.target_text.setProperty("quiet", True)
        grid.addWidget(title, 0, 0)
        grid.addWidget(self.bar, 0, 1)
        grid.addWidget(self.numbers, 0, 2)
        grid.addWidget(self.target_text, 1, 0, 1, 3)

    def show_axis(self, axis: InputAxisView, calibration: InputCalibration, stale: bool) -> None:
        """Show the reading of the axis; ``stale`` says that it is out of date."""
        is_trusted = axis.reason is None and not stale
        self.bar.show_axis(
            axis.raw, axis.deflection, is_trusted, calibration.find_axis(axis.control)
        )
        raw = "–" if axis.raw is None else format_number(axis.raw, "+.2f")
        # 0 has no sign, because a sign that flickers between + and − would look like motion.
        percent = f"{100.0 * axis.deflection:+.0f}".replace("-0", "0") if axis.deflection else "0"
        self.numbers.setText(f"{raw}   {percent} %")
        target = "" if axis.drives is None else f"→ {format_target_name(axis.drives)}"
        parts = (target, "" if axis.reason is None else translate_message(axis.reason))
        self.target_text.show_text(": ".join(part for part in parts if part))
        self.target_text.setVisible(bool(self.target_text.text()))


class LiveReadingsSection(Section):
    """Section with a bar for each axis and a lamp for each button of a device."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(tr("Live"))
        self._theme = theme
        self.problem_text = self.add_text()
        self._rows_column = make_column(spacing=4)
        self.column.addLayout(self._rows_column)
        self.rows: dict[str, AxisReadingRow] = {}
        self.lamps = ButtonLamps(theme)
        self.column.addWidget(self.lamps)

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self._theme = theme
        self.lamps.set_theme(theme)
        for row in self.rows.values():
            row.bar.set_theme(theme)

    def show_device(self, view: InputDeviceView | None, age_s: float | None) -> None:
        """Show a device. ``age_s`` is the age of its readings if they are out of date, or None."""
        self.setVisible(view is not None)
        if view is None:
            return
        if tuple(self.rows) != view.device.axes:
            self._make_rows(view.device.axes)
        show_or_hide_text(self.problem_text, _describe_problem(view, age_s))
        for axis in view.axes:
            self.rows[axis.control].show_axis(axis, view.calibration, age_s is not None)
        self.lamps.setVisible(bool(view.device.buttons))
        self.lamps.show_buttons(view.device.buttons, view.pressed_buttons)

    def _make_rows(self, axes: tuple[str, ...]) -> None:
        clear_layout(self._rows_column)
        self.rows = {axis: AxisReadingRow(self._theme, axis) for axis in axes}
        for row in self.rows.values():
            self._rows_column.addWidget(row)


def _describe_problem(view: InputDeviceView, age_s: float | None) -> str:
    if age_s is not None:
        return tr(
            "Outdated: the devices were last read {age_s:.1f} s ago. They do not control any axis."
        ).format(age_s=age_s)
    if view.problem is not None:
        problem = translate_message(view.problem)
        return problem[:1].upper() + problem[1:]
    if view.fault is not None:
        return tr("Reports not understood: {count}. The latest: {fault}").format(
            count=view.fault_count, fault=translate_message(view.fault)
        )
    return (
        ""
        if view.device.axes or view.device.buttons
        else tr("The device has neither axes nor buttons.")
    )
