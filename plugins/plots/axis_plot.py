"""Live plot of one axis, with its gap or the values at the cursors as text."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.language import choose_axis_scale, get_axis_label
from rotemina.app.motion.device import HistoryWindow
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.drawing import LINE_STYLES
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import ElidedLabel
from rotemina.app.workbench import (
    LIVE_GAP_WINDOW_S,
    Workbench,
    format_gap_details,
    format_gap_size,
    format_live_gap,
    format_run_gap,
)
from rotemina.plugins.plots import tr
from rotemina.plugins.plots.cursor_text import (
    CursorReading,
    PlotKind,
    describe_loop,
    describe_values,
    find_nearest_value,
)
from rotemina.plugins.plots.gap_strip import MAX_STRIP_HEIGHT_PX, MIN_STRIP_HEIGHT_PX, GapStrip
from rotemina.plugins.plots.history_signals import GapHistory
from rotemina.plugins.plots.overlay_data import OverlayRun
from rotemina.plugins.plots.spectra_and_loops import compute_spectrum
from rotemina.plugins.plots.view_plot import ViewPlot, compute_log10
from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison import GapFigure
from rotemina.sim.records import Tap
from rotemina.sim.units import DisplayScale, make_scale

CURVE_STYLES = {
    "command": LINE_STYLES["command"],
    "model": LINE_STYLES["model"],
    "nominal": LINE_STYLES["nominal"],
    "above": LINE_STYLES["doubt"],
    "below": LINE_STYLES["doubt"],
    "other": LINE_STYLES["other"],
    "measured": LINE_STYLES["measured"],
}
# Height of the strip, relative to the common height of trace and strip.
_STRIP_HEIGHT_RATIO = 0.3
# There is no strip if the trace would be lower than this.
_MIN_TRACE_HEIGHT_PX = 40
# The minimum heights of a plot are low, to leave space for notices and the banner of a replay.
_MIN_HEIGHT_WITH_TIMES_PX, _MIN_HEIGHT_WITHOUT_TIMES_PX = 62, 36
_SPACING_PX = 1
_NO_SAMPLES = np.empty(0)
# The vertical scale of a spectrum shows at least this many decades. A shorter scale might contain
# no power of ten to label.
_MIN_DECADES = 2.0


class PlotFrame(NamedTuple):
    """Everything that the plots draw in one frame.

    Attributes
    ----------
    window : HistoryWindow
        The samples in the shown time span.
    span_s : float
    kind : PlotKind
    overlay : OverlayRun or None
        A second run, drawn together with the current one.
    shift_s : float
        Time shift of the second run.
    live_gaps : mapping from axis to GapFigure or None
        The gaps of the last 10 s.
    run_gaps : mapping from (axis, tap) to GapFigure or None
        The gaps of the latest run.
    gap_history : GapHistory or None
        The gaps over time.
    """

    window: HistoryWindow
    span_s: float
    kind: PlotKind
    overlay: OverlayRun | None = None
    shift_s: float = 0.0
    live_gaps: Mapping[str, GapFigure | None] = MappingProxyType({})
    run_gaps: Mapping[tuple[str, Tap], GapFigure | None] = MappingProxyType({})
    gap_history: GapHistory | None = None


class AxisPlot(QWidget):
    """Plot of command, model and measurement of one axis over time, as a loop or as spectra."""

    def __init__(
        self,
        workbench: Workbench,
        column: int,
        *,
        on_cursor_moved: Callable[[ViewPlot], None] = lambda _: None,
    ) -> None:
        super().__init__()
        name = tuple(workbench.robot.axes)[column]
        axis = workbench.robot.axes[name]
        self._name, self._si_unit = name, axis.unit or "m"
        self._column, self._has_times = column, False
        self._scale = choose_axis_scale(axis)
        self._gap_scale = make_scale("urad" if axis.unit == "rad" else "um")
        floor = axis.sensor.noise_floor if axis.sensor else axis.span * 1e-5
        self._noise_floor = floor or axis.span * 1e-6
        self._kind: PlotKind | None = None
        self._cursor_curve: tuple[FloatArray, FloatArray] = (_NO_SAMPLES, _NO_SAMPLES)
        self._title, self._unit = QLabel(get_axis_label(name)), QLabel()
        self.figures = ElidedLabel()
        self._title.setProperty("heading", True)
        self._title.setTextFormat(Qt.TextFormat.PlainText)
        for label in (self._unit, self.figures):
            label.setProperty("quiet", True)
        self._unit.setTextFormat(Qt.TextFormat.PlainText)
        self.plot = ViewPlot(workbench.theme, on_cursor_moved)
        for curve, style in CURVE_STYLES.items():
            self.plot.add_curve(curve, style)
        self.strip = GapStrip(workbench.theme, name, axis, self._noise_floor)
        self._strip_height = 0
        # The gaps that the text shows. Empty if it shows something else.
        self._shown_figures: tuple[object, ...] = ()
        # The history and the time span that the strip shows.
        self._shown_history: tuple[GapHistory | None, float] = (None, 0.0)
        head = make_row(self._title, self._unit, (self.figures, 1), margins=(4, 0, 4, 0), spacing=6)
        make_column(head, (self.plot, 1), self.strip, on=self, margins=0, spacing=_SPACING_PX)

    def compute_min_height(self, *, times: bool) -> int:
        """Return the minimum height of title and trace, with or without a time axis, px."""
        title = self._title.sizeHint().height() + _SPACING_PX
        return title + (_MIN_HEIGHT_WITH_TIMES_PX if times else _MIN_HEIGHT_WITHOUT_TIMES_PX)

    def set_time_axis(self, *, times: bool, single_row: bool) -> None:
        """Show or hide the numbers of the time axis. In a single row, plots have no time axis."""
        self.plot.showAxis("bottom", not single_row)
        self.plot.setMinimumHeight(
            _MIN_HEIGHT_WITH_TIMES_PX if times else _MIN_HEIGHT_WITHOUT_TIMES_PX
        )
        if times is not self._has_times:
            self._has_times = times
            if self._kind is not None:
                self._label_scales(self._kind)

    def split_height(self, height: int) -> None:
        """Split a height, px, between trace and strip. If it is too small, hide the strip."""
        strip_height = min(round(_STRIP_HEIGHT_RATIO * height), MAX_STRIP_HEIGHT_PX)
        has_strip = (
            strip_height >= MIN_STRIP_HEIGHT_PX and height - strip_height >= _MIN_TRACE_HEIGHT_PX
        )
        self._strip_height = strip_height if has_strip else 0
        self._show_strip()

    def _show_strip(self) -> None:
        has_time_axis = self._kind in (None, PlotKind.POSITION, PlotKind.GAP)
        self.strip.setFixedHeight(max(self._strip_height, 1))
        self.strip.setVisible(has_time_axis and self._strip_height > 0)

    def use_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self.plot.set_theme(theme)
        self.strip.set_theme(theme)

    def set_stale(self, stale: bool) -> None:
        """Draw old data in grey."""
        self.plot.set_stale(stale)
        self.strip.set_stale(stale)

    def draw(self, frame: PlotFrame) -> None:
        """Draw a frame. The time of the newest sample is 0."""
        kind, window = frame.kind, frame.window
        self._use_kind(kind)
        self._cursor_curve = (_NO_SAMPLES, _NO_SAMPLES)
        if kind in (PlotKind.POSITION, PlotKind.GAP):
            self.plot.set_time_span(-frame.span_s, 0.0)
        self._draw_strip(frame)
        if len(window) == 0:
            self._shown_figures = ()
            self.figures.show_text("")
            for name in CURVE_STYLES:
                self.plot.clear_signal(name)
            return
        self._show_gap(frame)
        {
            PlotKind.POSITION: self._draw_position,
            PlotKind.GAP: self._draw_gap,
            PlotKind.LOOP: self._draw_loop,
            PlotKind.SPECTRUM: self._draw_spectrum,
        }[kind](frame)

    def _draw_strip(self, frame: PlotFrame) -> None:
        history, window = frame.gap_history, frame.window
        if history is None or not self.strip.isVisible():
            return
        if self._shown_history[0] is history and self._shown_history[1] == frame.span_s:
            return
        self._shown_history = (history, frame.span_s)
        newest_s = window.device_time_s[-1] if len(window) else 0.0
        self.strip.show_gap_history(
            history.time_s - newest_s, history.gap[:, self._column], frame.span_s
        )

    def _show_gap(self, frame: PlotFrame) -> None:
        """Write the gap of the last 10 s, and of the latest run if it includes this axis."""
        live_figure, unit = frame.live_gaps.get(self._name), self._si_unit
        run_figure = frame.run_gaps.get((self._name, Tap.MEAS))
        if self._shown_figures == (live_figure, run_figure):
            return
        self._shown_figures = (live_figure, run_figure)
        lines = [(format_live_gap(live_figure, unit), format_gap_details(live_figure, unit))]
        if run_figure is not None:
            lines.append((format_run_gap(run_figure, unit), format_gap_details(run_figure, unit)))
        # A narrow plot shows shorter texts, because a number that is cut off would be misleading.
        gap = format_gap_size(live_figure, unit)
        text = "  ·  ".join(text for text, _ in lines)
        self.figures.show_text(text, f"{LIVE_GAP_WINDOW_S:g} s: {gap}", gap, "")
        self.figures.setToolTip(make_tooltip(*(f"{text} ({details})" for text, details in lines)))

    def read_cursors(self) -> None:
        """Write the values at the cursors in place of the gap."""
        kind, (a, b) = self._kind, self.plot.cursors
        if kind is PlotKind.LOOP:
            self._show_reading(describe_loop(a, b, self._scale.symbol))
            return
        value_a, value_b = (find_nearest_value(*self._cursor_curve, x) for x, _ in (a, b))
        unit = self._unit.text().strip("[]")
        # The axes of a spectrum are logarithms.
        if kind is PlotKind.SPECTRUM and value_a is not None and value_b is not None:
            value_a, value_b = 10.0**value_a, 10.0**value_b
        self._show_reading(describe_values(value_a, value_b, unit))

    def _show_reading(self, reading: CursorReading) -> None:
        self._shown_figures = ()
        self.figures.show_text(reading.short)
        self.figures.setToolTip(make_tooltip(reading.full))

    def _use_kind(self, kind: PlotKind) -> None:
        if kind is self._kind:
            return
        self._kind = kind
        self._show_strip()
        self._label_scales(kind)
        unit = self._scale.symbol
        if kind is PlotKind.GAP:
            unit = self._gap_scale.symbol
        elif kind is PlotKind.SPECTRUM:
            unit = f"{self._gap_scale.symbol}/√Hz"
        self._unit.setText(f"[{unit}]")
        for name in CURVE_STYLES:
            self.plot.clear_signal(name)

    def _label_scales(self, kind: PlotKind) -> None:
        is_spectrum, is_loop = kind is PlotKind.SPECTRUM, kind is PlotKind.LOOP
        label = tr("frequency [Hz]") if is_spectrum else "" if is_loop else tr("time [s]")
        self.plot.show_scales(label, logarithmic=is_spectrum, numbers=is_loop or self._has_times)

    def _draw_gap(self, frame: PlotFrame) -> None:
        window = frame.window
        relative_time_s = window.device_time_s - window.device_time_s[-1]
        gap = window.measured[:, self._column] - window.model[:, self._column]
        # Earlier samples were predicted by another model.
        is_current_model = window.device_time_s > window.gap_since_s
        if is_current_model.any():
            relative_time_s, gap = relative_time_s[is_current_model], gap[is_current_model]
        values = self._gap_scale(gap)
        self.plot.show_signal("measured", relative_time_s, values)
        self._cursor_curve = (relative_time_s, values)
        self._fit_scale(self._gap_scale, values)

    def _draw_position(self, frame: PlotFrame) -> None:
        window = frame.window
        newest = window.device_time_s[-1]
        relative_time_s = window.device_time_s - newest
        signals = {
            "measured": self._to_display(window.measured),
            "command": self._to_display(window.command),
            "model": self._to_display(window.model),
        }
        signals |= self._make_model_curves(window)
        for name in ("nominal", "above", "below"):
            if name not in signals:
                self.plot.clear_signal(name)
        for name, values in signals.items():
            self.plot.show_signal(name, relative_time_s, values)
        self._cursor_curve = (relative_time_s, signals["measured"])
        overlay = self._find_overlay_curves(frame)
        if overlay is not None:
            time_s, _, measured = overlay
            self.plot.show_signal("other", time_s - newest, measured)
            # The vertical scale fits only the visible part of the second run.
            visible = measured[(time_s >= newest - frame.span_s) & (time_s <= newest)]
            if len(visible):
                signals["other"] = visible
        self._fit_scale(self._scale, *signals.values())

    def _make_model_curves(self, window: HistoryWindow) -> dict[str, FloatArray]:
        """Return the nominal model, if another one is in use, and the uncertainty bounds."""
        curves = {}
        column = self._column
        if (window.nominal[:, column] != window.model[:, column]).any():
            curves["nominal"] = self._to_display(window.nominal)
        if window.doubt[:, column].any():
            curves["above"] = self._to_display(window.model + window.doubt)
            curves["below"] = self._to_display(window.model - window.doubt)
        return curves

    def _draw_loop(self, frame: PlotFrame) -> None:
        window = frame.window
        command = self._to_display(window.command)
        signals = {
            "model": self._to_display(window.model),
            "measured": self._to_display(window.measured),
        }
        for name, values in signals.items():
            self.plot.show_loop(name, command, values)
        commands = [command]
        overlay = self._find_overlay_curves(frame)
        if overlay is not None and np.isfinite(overlay[1]).all():
            _, overlay_command, measured = overlay
            self.plot.show_loop("other", overlay_command, measured)
            commands.append(overlay_command)
            signals["other"] = measured
        min_width = 8.0 * self._noise_floor * self._scale.per_si
        low, high = _find_extent(commands)
        self.plot.fit_horizontal_scale(low, high, min_width)
        self._fit_scale(self._scale, *signals.values())

    def _draw_spectrum(self, frame: PlotFrame) -> None:
        window, column = frame.window, self._column
        sources = (window.command, window.model, window.measured)
        signals = np.stack([self._gap_scale(source[:, column]) for source in sources], axis=1)
        spectra = compute_spectrum(window.device_time_s, signals)
        # A missing or constant reading has no spectrum.
        if spectra is None or not np.isfinite(compute_log10(spectra.density[:, -1])).any():
            for name in CURVE_STYLES:
                self.plot.clear_signal(name)
            return
        log_frequency = np.log10(spectra.frequency_hz)
        densities = dict(zip(("command", "model", "measured"), spectra.density.T, strict=True))
        self._cursor_curve = (log_frequency, compute_log10(densities["measured"]))
        log_densities = [self._cursor_curve[1]]
        overlay = self._find_overlay_curves(frame)
        if overlay is not None:
            time_s, _, measured = overlay
            other = compute_spectrum(time_s, self._gap_scale(self._to_si(measured))[:, None])
            if other is not None:
                self._draw_density("other", np.log10(other.frequency_hz), other.density[:, 0])
                log_densities.append(compute_log10(other.density[:, 0]))
        for name, density in densities.items():
            self._draw_density(name, log_frequency, density)
        self.plot.fit_horizontal_scale(float(log_frequency[0]), float(log_frequency[-1]), 0.1)
        # The scale ignores the command, whose spectrum at rest consists of rounding errors.
        self.plot.fit_scale(*_find_extent(log_densities), _MIN_DECADES)

    def _draw_density(self, name: str, log_frequency: FloatArray, density: FloatArray) -> None:
        values = compute_log10(density)
        if np.isfinite(values).all():
            self.plot.show_signal(name, log_frequency, values)
        else:
            self.plot.clear_signal(name)

    def _find_overlay_curves(
        self, frame: PlotFrame
    ) -> tuple[FloatArray, FloatArray, FloatArray] | None:
        """Return the times, commands and readings of the second run to draw, or None."""
        other = frame.overlay
        if other is None or not np.isfinite(other.measured[:, self._column]).all():
            self.plot.clear_signal("other")
            return None
        return (
            other.time_s + frame.shift_s,
            self._to_display(other.command),
            self._to_display(other.measured),
        )

    def _to_display(self, values: FloatArray) -> FloatArray:
        return self._scale(values[:, self._column])

    def _to_si(self, values: FloatArray) -> FloatArray:
        return values / self._scale.per_si

    def _fit_scale(self, scale: DisplayScale, *signals: FloatArray) -> None:
        self.plot.fit_scale(*_find_extent(signals), 8.0 * self._noise_floor * scale.per_si)


def _find_extent(signals: "list[FloatArray] | tuple[FloatArray, ...]") -> tuple[float, float]:
    low = min(float(np.nanmin(values)) for values in signals)
    high = max(float(np.nanmax(values)) for values in signals)
    return low, high
