"""Live readings of a device: axis bars and button lamps."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame

from rotemina.app.motion.teleoperation.axis_calibration import Calibration
from rotemina.app.motion.teleoperation.input_arbiter import DeviceView
from rotemina.app.motion.teleoperation.mapped_device import AxisView
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.labels import ElidedLabel, plain_text, show_text
from rotemina.app.widgets.layouts import in_column, in_grid
from rotemina.app.widgets.section import Section, clear
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.reading_bars import AxisBar, Lamps
from rotemina.plugins.inputs.words import target_name
from rotemina.sim.quantities import formatted

_NAME_WIDTH, _NUMBER_WIDTH = 72, 104


class AxisRow(QFrame):
    """One axis: its bar, its numbers, what it drives, or why it is not trusted."""

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        grid = in_grid(on=self, margins=0, spacing=(6, 0), stretched=1)
        title = ElidedLabel()
        title.show_text(name)
        title.setFixedWidth(_NAME_WIDTH)
        self.bar = AxisBar(theme, name)
        self.numbers = plain_text("–", quiet=False)
        self.numbers.setMinimumWidth(_NUMBER_WIDTH)
        self.numbers.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.numbers.setAccessibleName(tr("Axis {name}: raw, calibrated").format(name=name))
        self.numbers.setToolTip(tr("Raw value of the device, −1 to 1, and calibrated deflection"))
        self.about = ElidedLabel()
        self.about.setProperty("quiet", True)
        grid.addWidget(title, 0, 0)
        grid.addWidget(self.bar, 0, 1)
        grid.addWidget(self.numbers, 0, 2)
        grid.addWidget(self.about, 1, 0, 1, 3)

    def show_axis(self, axis: AxisView, calibration: Calibration, stale: bool) -> None:
        """Show what the axis says; ``stale``: that is old."""
        trusted = axis.reason is None and not stale
        self.bar.show_axis(axis.raw, axis.deflection, trusted, calibration.axis(axis.control))
        said = "–" if axis.raw is None else formatted(axis.raw, "+.2f")
        # 0 without a sign: one that flickers between +0 and -0 is at rest.
        percent = f"{100.0 * axis.deflection:+.0f}".replace("-0", "0") if axis.deflection else "0"
        self.numbers.setText(f"{said}   {percent} %")
        drives = "" if axis.drives is None else f"→ {target_name(axis.drives)}"
        parts = (drives, "" if axis.reason is None else spoken(axis.reason))
        self.about.show_text(": ".join(part for part in parts if part))
        self.about.setVisible(bool(self.about.text()))


class LiveSection(Section):
    """Bars and lamps of one device."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(tr("Live"))
        self._theme = theme
        self.said = self.add_text()
        self._rows_column = in_column(spacing=4)
        self.column.addLayout(self._rows_column)
        self.rows: dict[str, AxisRow] = {}
        self.lamps = Lamps(theme)
        self.column.addWidget(self.lamps)

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self._theme = theme
        self.lamps.set_theme(theme)
        for row in self.rows.values():
            row.bar.set_theme(theme)

    def show_device(self, view: DeviceView | None, age_s: float | None) -> None:
        """Show a device; ``age_s``: how old all of it is, where that is too old."""
        self.setVisible(view is not None)
        if view is None:
            return
        if tuple(self.rows) != view.device.axes:
            self._make_rows(view.device.axes)
        show_text(self.said, _said(view, age_s))
        for axis in view.axes:
            self.rows[axis.control].show_axis(axis, view.calibration, age_s is not None)
        self.lamps.setVisible(bool(view.device.buttons))
        self.lamps.show_buttons(view.device.buttons, view.lit)

    def _make_rows(self, axes: tuple[str, ...]) -> None:
        clear(self._rows_column)
        self.rows = {axis: AxisRow(self._theme, axis) for axis in axes}
        for row in self.rows.values():
            self._rows_column.addWidget(row)


def _said(view: DeviceView, age_s: float | None) -> str:
    if age_s is not None:
        return tr(
            "Outdated: the devices were last read {age_s:.1f} s ago. They do not control any axis."
        ).format(age_s=age_s)
    if view.problem is not None:
        problem = spoken(view.problem)
        return problem[:1].upper() + problem[1:]
    if view.fault is not None:
        return tr("Reports not understood: {count}. The latest: {fault}").format(
            count=view.faults, fault=spoken(view.fault)
        )
    return (
        ""
        if view.device.axes or view.device.buttons
        else tr("The device has neither axes nor buttons.")
    )
