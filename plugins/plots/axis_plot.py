"""The live plot of one axis, with its gap or its cursor values as text."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.recent_history import LiveWindow
from rotemina.app.shell.gap_words import LIVE_S, live_gap, run_gap, size, small_print
from rotemina.app.shell.plot import LINES
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.labels import ElidedLabel
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.plots import tr
from rotemina.plugins.plots.cursor_text import Reading, Shown, loop_text, nearest, values_text
from rotemina.plugins.plots.gap_strip import LEAST_HEIGHT, MOST_HEIGHT, GapStrip
from rotemina.plugins.plots.history_signals import GapHistory
from rotemina.plugins.plots.overlay_data import OtherRun
from rotemina.plugins.plots.spectra_and_loops import spectrum
from rotemina.plugins.plots.view_plot import ViewPlot, logarithm
from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.gap import GapFigure
from rotemina.sim.quantities import Scale, scale_in
from rotemina.sim.records.record import Tap

CURVES = {
    "command": LINES["command"],
    "model": LINES["model"],
    "nominal": LINES["nominal"],
    "above": LINES["doubt"],
    "below": LINES["doubt"],
    "other": LINES["other"],
    "measured": LINES["measured"],
}
_STRIP_SHARE = 0.3  # of the height that trace and strip have
_LEAST_TRACE = 40  # px: below it there is no strip
# Least heights of a plot, px: notices and the banner of a replay need room, too.
_WITH_TIMES, _WITHOUT = 62, 36
_SPACING = 1
_NOTHING = np.empty(0)
_LEAST_DECADES = 2.0  # of a spectrum: fewer have no round numbers to stand beside


class Picture(NamedTuple):
    """What one frame draws.

    ``other`` is the run beside the present one, its time ``shift_s`` earlier or later. ``live`` are
    the gaps of the last 10 s by axis, ``run`` those of the run in hand, ``course`` is the gap over
    time.
    """

    window: LiveWindow
    span_s: float
    shown: Shown
    other: OtherRun | None = None
    shift_s: float = 0.0
    live: Mapping[str, GapFigure | None] = MappingProxyType({})
    run: Mapping[tuple[str, Tap], GapFigure | None] = MappingProxyType({})
    course: GapHistory | None = None


class AxisPlot(QWidget):
    """Command, model and measurement of one axis: over time, as a loop, or as spectra."""

    def __init__(
        self,
        workbench: Workbench,
        column: int,
        *,
        moved: Callable[[ViewPlot], None] = lambda _: None,
    ) -> None:
        super().__init__()
        name = tuple(workbench.robot.axes)[column]
        axis = workbench.robot.axes[name]
        self._name, self._si_unit = name, axis.unit or "m"
        self._column, self._times = column, False
        self._scale = axis_scale(axis)
        self._gap = scale_in("urad" if axis.unit == "rad" else "um")
        floor = axis.sensor.noise_floor if axis.sensor else axis.span * 1e-5
        self._floor = floor or axis.span * 1e-6
        self._view: Shown | None = None
        self._read: tuple[FloatArray, FloatArray] = (_NOTHING, _NOTHING)
        self._title, self._unit = QLabel(label(name)), QLabel()
        self.figures = ElidedLabel()
        self._title.setProperty("heading", True)
        self._title.setTextFormat(Qt.TextFormat.PlainText)
        for quiet in (self._unit, self.figures):
            quiet.setProperty("quiet", True)
        self._unit.setTextFormat(Qt.TextFormat.PlainText)
        self.plot = ViewPlot(workbench.theme, moved)
        for curve, line in CURVES.items():
            self.plot.add_curve(curve, line)
        self.strip = GapStrip(workbench.theme, name, axis, self._floor)
        self._strip_height = 0
        self._written: tuple[object, ...] = ()  # what the figures say
        self._course: tuple[GapHistory | None, float] = (None, 0.0)  # what the strip shows
        head = in_row(self._title, self._unit, (self.figures, 1), margins=(4, 0, 4, 0), spacing=6)
        in_column(head, (self.plot, 1), self.strip, on=self, margins=0, spacing=_SPACING)

    def least_height(self, *, times: bool) -> int:
        """Return the height that title and trace need, with or without times below, px."""
        title = self._title.sizeHint().height() + _SPACING
        return title + (_WITH_TIMES if times else _WITHOUT)

    def stand(self, *, times: bool, strip: bool) -> None:
        """Have times below the plot or not; in a strip there is no axis for them either."""
        self.plot.showAxis("bottom", not strip)
        self.plot.setMinimumHeight(_WITH_TIMES if times else _WITHOUT)
        if times is not self._times:
            self._times = times
            if self._view is not None:
                self._name_scales(self._view)

    def share_height(self, height: int) -> None:
        """Part the height of trace and strip, px, where there is room for both."""
        strip = min(round(_STRIP_SHARE * height), MOST_HEIGHT)
        fits = strip >= LEAST_HEIGHT and height - strip >= _LEAST_TRACE
        self._strip_height = strip if fits else 0
        self._show_strip()

    def _show_strip(self) -> None:
        """Show the strip below what is drawn over time."""
        over_time = self._view in (None, Shown.POSITION, Shown.GAP)
        self.strip.setFixedHeight(max(self._strip_height, 1))
        self.strip.setVisible(over_time and self._strip_height > 0)

    def use_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self.plot.set_theme(theme)
        self.strip.set_theme(theme)

    def set_stale(self, stale: bool) -> None:
        """Draw old data in grey."""
        self.plot.set_stale(stale)
        self.strip.set_stale(stale)

    def draw(self, picture: Picture) -> None:
        """Draw a picture; time runs up to 0, the newest sample."""
        shown, window = picture.shown, picture.window
        self._use_view(shown)
        self._read = (_NOTHING, _NOTHING)
        if shown in (Shown.POSITION, Shown.GAP):
            self.plot.set_time(-picture.span_s, 0.0)
        self._draw_strip(picture)
        if len(window) == 0:
            self._written = ()
            self.figures.show_text("")
            for name in CURVES:
                self.plot.clear_signal(name)
            return
        self._show_gap(picture)
        {
            Shown.POSITION: self._draw_position,
            Shown.GAP: self._draw_gap,
            Shown.LOOP: self._draw_loop,
            Shown.SPECTRUM: self._draw_spectrum,
        }[shown](picture)

    def _draw_strip(self, picture: Picture) -> None:
        course, window = picture.course, picture.window
        if course is None or not self.strip.isVisible():
            return
        if self._course[0] is course and self._course[1] == picture.span_s:
            return
        self._course = (course, picture.span_s)
        newest_s = window.device_time_s[-1] if len(window) else 0.0
        self.strip.show_course(
            course.time_s - newest_s, course.gap[:, self._column], picture.span_s
        )

    def _show_gap(self, picture: Picture) -> None:
        """Write the gap of the last 10 s, and of the run in hand where this axis was in it."""
        live, unit = picture.live.get(self._name), self._si_unit
        run = picture.run.get((self._name, Tap.MEAS))
        if self._written == (live, run):
            return
        self._written = (live, run)
        lines = [(live_gap(live, unit), small_print(live, unit))]
        if run is not None:
            lines.append((run_gap(run, unit), small_print(run, unit)))
        # Where the plot is narrow the figure stays, if possible with its span; a cut number lies.
        alone = size(live, unit)
        text = "  ·  ".join(text for text, _ in lines)
        self.figures.show_text(text, f"{LIVE_S:g} s: {alone}", alone, "")
        self.figures.setToolTip(plain_tip(*(f"{text} ({small})" for text, small in lines)))

    def read_cursors(self) -> None:
        """Write what the cursors read in place of the gap."""
        shown, (a, b) = self._view, self.plot.cursors
        if shown is Shown.LOOP:
            self._tell(loop_text(a, b, self._scale.symbol))
            return
        at_a, at_b = (nearest(*self._read, at) for at, _ in (a, b))
        unit = self._unit.text().strip("[]")
        if shown is Shown.SPECTRUM and at_a is not None and at_b is not None:
            at_a, at_b = 10.0**at_a, 10.0**at_b
        self._tell(values_text(at_a, at_b, unit))

    def _tell(self, read: Reading) -> None:
        self._written = ()
        self.figures.show_text(read.short)
        self.figures.setToolTip(plain_tip(read.full))

    # --- views ------------------------------------------------------------------------------------

    def _use_view(self, shown: Shown) -> None:
        if shown is self._view:
            return
        self._view = shown
        self._show_strip()
        self._name_scales(shown)
        unit = self._scale.symbol
        if shown is Shown.GAP:
            unit = self._gap.symbol
        elif shown is Shown.SPECTRUM:
            unit = f"{self._gap.symbol}/√Hz"
        self._unit.setText(f"[{unit}]")
        for name in CURVES:
            self.plot.clear_signal(name)

    def _name_scales(self, shown: Shown) -> None:
        spectral, loop = shown is Shown.SPECTRUM, shown is Shown.LOOP
        across = tr("frequency [Hz]") if spectral else "" if loop else tr("time [s]")
        self.plot.show_scales(across, logarithmic=spectral, numbers=loop or self._times)

    def _draw_gap(self, picture: Picture) -> None:
        window = picture.window
        since = window.device_time_s - window.device_time_s[-1]
        gap = window.measured[:, self._column] - window.model[:, self._column]
        later = window.device_time_s > window.gap_since_s  # another model said what it says
        if later.any():
            since, gap = since[later], gap[later]
        values = self._gap(gap)
        self.plot.show_signal("measured", since, values)
        self._read = (since, values)
        self._follow(self._gap, values)

    def _draw_position(self, picture: Picture) -> None:
        window = picture.window
        newest = window.device_time_s[-1]
        since = window.device_time_s - newest
        signals = {
            "measured": self._shown(window.measured),
            "command": self._shown(window.command),
            "model": self._shown(window.model),
        }
        signals |= self._beside_the_model(window)
        for name in ("nominal", "above", "below"):
            if name not in signals:
                self.plot.clear_signal(name)
        for name, values in signals.items():
            self.plot.show_signal(name, since, values)
        self._read = (since, signals["measured"])
        other = self._other(picture)
        if other is not None:
            time_s, _, measured = other
            self.plot.show_signal("other", time_s - newest, measured)
            seen = measured[(time_s >= newest - picture.span_s) & (time_s <= newest)]
            if len(seen):
                signals["other"] = seen
        self._follow(self._scale, *signals.values())

    def _beside_the_model(self, window: LiveWindow) -> dict[str, FloatArray]:
        """Return the nominal model, where another is in use, and by how much that may be off."""
        found = {}
        column = self._column
        if (window.nominal[:, column] != window.model[:, column]).any():
            found["nominal"] = self._shown(window.nominal)
        if window.doubt[:, column].any():
            found["above"] = self._shown(window.model + window.doubt)
            found["below"] = self._shown(window.model - window.doubt)
        return found

    def _draw_loop(self, picture: Picture) -> None:
        window = picture.window
        command = self._shown(window.command)
        signals = {"model": self._shown(window.model), "measured": self._shown(window.measured)}
        for name, values in signals.items():
            self.plot.show_loop(name, command, values)
        across = [command]
        other = self._other(picture)
        if other is not None and np.isfinite(other[1]).all():
            _, asked, measured = other
            self.plot.show_loop("other", asked, measured)
            across.append(asked)
            signals["other"] = measured
        least = 8.0 * self._floor * self._scale.per_si
        low, high = _extent(across)
        self.plot.follow_across(low, high, least)
        self._follow(self._scale, *signals.values())

    def _draw_spectrum(self, picture: Picture) -> None:
        window, column = picture.window, self._column
        parts = (window.command, window.model, window.measured)
        signals = np.stack([self._gap(part[:, column]) for part in parts], axis=1)
        found = spectrum(window.device_time_s, signals)
        # A reading that is missing has no spectrum, nor has one that never changes.
        if found is None or not np.isfinite(logarithm(found.density[:, -1])).any():
            for name in CURVES:
                self.plot.clear_signal(name)
            return
        across = np.log10(found.frequency_hz)
        levels = dict(zip(("command", "model", "measured"), found.density.T, strict=True))
        self._read = (across, logarithm(levels["measured"]))
        seen = [self._read[1]]
        other = self._other(picture)
        if other is not None:
            time_s, _, measured = other
            again = spectrum(time_s, self._gap(self._si(measured))[:, None])
            if again is not None:
                self._draw_density("other", np.log10(again.frequency_hz), again.density[:, 0])
                seen.append(logarithm(again.density[:, 0]))
        for name, density in levels.items():
            self._draw_density(name, across, density)
        self.plot.follow_across(float(across[0]), float(across[-1]), 0.1)
        # A command at rest has next to no spectrum: its rounding is no reason to zoom out.
        self.plot.follow(*_extent(seen), _LEAST_DECADES)

    def _draw_density(self, name: str, across: FloatArray, density: FloatArray) -> None:
        values = logarithm(density)
        if np.isfinite(values).all():
            self.plot.show_signal(name, across, values)
        else:
            self.plot.clear_signal(name)

    def _other(self, picture: Picture) -> tuple[FloatArray, FloatArray, FloatArray] | None:
        """Return time, command and reading of the other run as they are drawn, or nothing."""
        other = picture.other
        if other is None or not np.isfinite(other.measured[:, self._column]).all():
            self.plot.clear_signal("other")
            return None
        return (
            other.time_s + picture.shift_s,
            self._shown(other.command),
            self._shown(other.measured),
        )

    def _shown(self, values: FloatArray) -> FloatArray:
        return self._scale(values[:, self._column])

    def _si(self, values: FloatArray) -> FloatArray:
        return values / self._scale.per_si

    def _follow(self, scale: Scale, *signals: FloatArray) -> None:
        self.plot.follow(*_extent(signals), 8.0 * self._floor * scale.per_si)


def _extent(signals: "list[FloatArray] | tuple[FloatArray, ...]") -> tuple[float, float]:
    low = min(float(np.nanmin(values)) for values in signals)
    high = max(float(np.nanmax(values)) for values in signals)
    return low, high
