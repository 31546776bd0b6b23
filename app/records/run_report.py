"""The run report: an HTML page about a record of the library."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import resources
from importlib.metadata import version
from pathlib import Path
from typing import Self

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rotemina.app.language import format_duration
from rotemina.app.motion.penetration import PenetrationRun
from rotemina.app.motion.playback import ComparedRun
from rotemina.app.motion.recording import Recording
from rotemina.app.records.entry import LibraryEntry
from rotemina.app.records.file_facts import parse_time
from rotemina.app.records.library import check_length
from rotemina.app.records.recorded_events import EventSeverity, TimelineEvent, make_timeline_events
from rotemina.sim.arrays import FloatArray, decimate_to_envelope
from rotemina.sim.comparison import (
    GapFigure,
    compute_gap_figure,
    find_moving_samples,
    format_gap,
)
from rotemina.sim.gap.output import (
    ColourRole,
    add_legend,
    draw_picture,
    localize,
    make_environment,
    use_wording,
)
from rotemina.sim.messages import (
    AxisName,
    Message,
    MessageWording,
    NumberText,
    format_fixed,
    format_rounded,
    marked,
    message,
)
from rotemina.sim.records import Tap
from rotemina.sim.robot import Robot
from rotemina.sim.units import choose_scale

# Size of a drawing, inch.
_WIDTH_INCH, _HEIGHT_INCH = 11.0, 3.8
# A curve is drawn through the smallest and largest values in this many intervals.
_CURVE_BUCKETS = 500
_MAX_EVENTS = 300
# Longer metadata are truncated.
_MAX_METADATA_LENGTH = 300
# The list of metadata leaves these out, because the page shows them elsewhere.
_SUMMARY_KEYS = (
    "began", "robot", "robot_file", "driver", "model", "effects", "run", "operator", "sample"
)  # fmt: skip
TEMPLATE_TEXTS = (
    marked("engine", "en"),
    marked("engine", "Run report: {name}"),
    marked("engine", "Gap"),
    marked("engine", "Signals"),
    marked("engine", "Penetrations"),
    marked("engine", "Events"),
    marked("engine", "Facts"),
    marked("engine", "Note: {note}"),
    marked("engine", "axis"),
    marked("engine", "gap, this run"),
    marked("engine", "without offset"),
    marked("engine", "nominal model"),
    marked("engine", "noise floor of the sensor"),
    marked(
        "engine",
        "Gap: rms of measured − model in use, offset included, while anything moves and 0.5 s "
        "after.",
    ),
    marked("engine", "No axis moved."),
    marked(
        "engine",
        "Above: command, model in use and measured. Below: the gap; the band is the noise floor "
        "of the sensor.",
    ),
    marked("engine", "began"),
    marked("engine", "result"),
    marked("engine", "reason"),
    marked("engine", "contact at"),
    marked("engine", "depth"),
    marked("engine", "peak speed"),
    marked("engine", "peak deviation"),
    marked("engine", "time [s]"),
    marked("engine", "event"),
    marked("engine", "text"),
    marked("engine", "The first {shown} of {all} events."),
    marked("engine", "Nothing was noted."),
    marked("engine", "Written by RoTeMiNa {version} from {file}."),
)


@dataclass(frozen=True, slots=True, eq=False)
class AxisTraces:
    """Signals and gap of one axis that moved.

    Attributes
    ----------
    axis, unit : str
    floor : float or None
        Noise floor of the axis' sensor, m or rad.
    time_s : (n,)
        Time since the start of the record.
    command, model, measured : (n,)
        Positions, m or rad; NaN where they are unknown.
    figure : GapFigure or None
        The gap; None if no sample counts.
    nominal_known : bool
        Whether ``figure.nominal`` is the gap from the nominal model.
    """

    axis: str
    unit: str
    floor: float | None
    time_s: FloatArray
    command: FloatArray
    model: FloatArray
    measured: FloatArray
    figure: GapFigure | None
    nominal_known: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class RunReport:
    """The content of the report page.

    Attributes
    ----------
    name, note, file : str
    duration_s : float
    completed : bool
        False if the run is known to have been stopped early.
    model : str
        Id of the model that the gaps refer to; empty for the model of the robot file.
    metadata : mapping
        Metadata of the record.
    courses : tuple of AxisTraces
    events : tuple of TimelineEvent or None
        None if the record stores no events.
    penetrations : tuple of PenetrationRun
        Penetrations that were started during the record.
    """

    name: str
    note: str
    file: str
    duration_s: float
    completed: bool
    model: str
    metadata: Mapping[str, str]
    axis_traces: tuple[AxisTraces, ...]
    events: tuple[TimelineEvent, ...] | None = None
    penetrations: tuple[PenetrationRun, ...] = ()

    @classmethod
    def from_run(cls, run: ComparedRun, robot: Robot, entry: LibraryEntry | None = None) -> Self:
        """Return the report about a playback or another text record, compared with a model."""
        record, response = run.record, run.comparison.response
        courses = []
        for axis in record.axes:
            if not (record.has(axis, Tap.CMD) and record.has(axis, Tap.MEAS)):
                continue
            command = record.signal(axis, Tap.CMD)
            if np.ptp(command) > 0.0:
                courses.append(
                    AxisTraces(
                        axis,
                        record.units[axis],
                        _find_floor(robot, axis),
                        record.time_s - record.time_s[0],
                        command,
                        response.signal(axis, Tap.MEAS),
                        record.signal(axis, Tap.MEAS),
                        run.gaps.get((axis, Tap.MEAS)),
                    )
                )
        return cls(
            name=run.name if entry is None else entry.name,
            note="" if entry is None else entry.note,
            file=run.name if entry is None else entry.path.name,
            duration_s=record.duration_s,
            completed=run.completed,
            model=run.model_id,
            metadata=record.metadata,
            axis_traces=tuple(courses),
        )

    @classmethod
    def from_recording(
        cls,
        path: Path,
        entry: LibraryEntry | None = None,
        penetrations: Sequence[PenetrationRun] = (),
    ) -> Self:
        """Return the report about a recording, which contains the positions of the model.

        Parameters
        ----------
        path : Path
        entry : LibraryEntry, optional
            Its entry in the library.
        penetrations : sequence of PenetrationRun
            Known penetrations; the report includes those during the recording.

        Raises
        ------
        RecordingError
            If the recording cannot be read.
        LibraryError
            If it is too long.
        """
        recording = Recording.open(path)
        check_length(recording)
        robot, samples = recording.robot, recording.read_samples()
        is_moving = find_moving_samples(samples.host_time_s, samples.command)
        courses = []
        for column, axis in enumerate(recording.axes):
            command, model, measured = (
                values[:, column] for values in (samples.command, samples.model, samples.measured)
            )
            known_command = command[np.isfinite(command)]
            if len(known_command) and np.ptp(known_command) > 0.0:
                time_s = samples.host_time_s - recording.began_s
                figure = compute_gap_figure(is_moving, measured, model)
                unit, floor = recording.units[axis], _find_floor(robot, axis)
                signals = (time_s, command, model, measured)
                courses.append(AxisTraces(axis, unit, floor, *signals, figure, nominal_known=False))
        report = cls(
            name=path.stem if entry is None else entry.name,
            note="" if entry is None else entry.note,
            file=path.name,
            duration_s=recording.ended_s - recording.began_s,
            completed=True,
            model=recording.metadata.get("model", ""),
            metadata=recording.metadata,
            axis_traces=tuple(courses),
        )
        return report.with_events(recording, penetrations)

    def with_events(self, recording: Recording, penetrations: Sequence[PenetrationRun]) -> Self:
        """Return a copy with the events and penetrations during a recording."""
        events = make_timeline_events(recording.read_events(), recording.began_s)
        duration_s = recording.ended_s - recording.began_s
        return replace(
            self,
            events=tuple(event for event in events if event.severity is not EventSeverity.DETAIL),
            penetrations=_select_concurrent(
                penetrations, recording.metadata.get("began", ""), duration_s
            ),
        )

    @property
    def worst_axis(self) -> AxisTraces | None:
        """The axis whose gap is largest relative to the noise floor of its sensor."""
        candidates = [traces for traces in self.axis_traces if traces.figure is not None]
        return max(candidates, key=_compute_gap_to_floor_ratio, default=None)


def render_report(report: RunReport, wording: MessageWording | None = None) -> str:
    """Return the page in a language; by default in English."""
    with use_wording(wording or MessageWording()):
        template_environment = make_environment(_translate)
        template_environment.filters.update(
            axis=lambda axis: localize(AxisName(axis)),
            gap=lambda size, unit: localize(format_gap(size, unit)),
            drawing=_draw_axis,
            seconds=lambda at_s: localize(format_fixed(at_s, 3)),
            kind=lambda word: localize(Message("recorder", word)),
            cut=lambda text: (
                text if len(text) <= _MAX_METADATA_LENGTH else f"{text[:_MAX_METADATA_LENGTH]} …"
            ),
        )
        template = resources.files(__package__).joinpath("run_report.html").read_text("utf-8")
        return template_environment.from_string(template).render(
            report=report,
            headline=localize(_make_headline(report)),
            remarks=list(map(localize, _make_remarks(report))),
            summary=[
                (_translate(name), localize(text)) for name, text in _make_summary(report) if text
            ],
            most_events=_MAX_EVENTS,
            left_out=_SUMMARY_KEYS,
            version=version("rotemina"),
        )


def _translate(template: str, **fields: str | float) -> str:
    return localize(Message("engine", template, tuple(fields.items())))


def _make_headline(report: RunReport) -> Message:
    traces = report.worst_axis
    if traces is None or traces.figure is None:
        return message("engine", "No axis has a gap: none moved.")
    gap = format_gap(traces.figure.rms, traces.unit)
    if not traces.floor:
        return message("engine", "Largest gap: {axis}, {gap}").fill(
            axis=AxisName(traces.axis), gap=gap
        )
    return message("engine", "Largest gap: {axis}, {gap} ({floors} × its noise floor)").fill(
        axis=AxisName(traces.axis),
        gap=gap,
        floors=format_rounded(traces.figure.rms / traces.floor, 3),
    )


def _make_remarks(report: RunReport) -> list[Message]:
    model_in_use = report.metadata.get("model", "")
    remarks = []
    if not report.completed:
        remarks.append(message("engine", "The run was stopped early."))
    if model_in_use and report.model and model_in_use != report.model:
        remarks.append(
            message(
                "engine",
                "The gaps refer to the model {model}; {told} was in use during the run.",
            ).fill(model=report.model, told=model_in_use)
        )
    return remarks


def _make_summary(report: RunReport) -> list[tuple[str, str]]:
    metadata = report.metadata
    began = parse_time(metadata.get("began", ""))
    return [
        (
            marked("engine", "date"),
            "" if began is None else began.isoformat(sep=" ", timespec="seconds"),
        ),
        (marked("engine", "duration"), NumberText(format_duration(report.duration_s, 1))),
        (marked("engine", "robot"), metadata.get("robot", "")),
        (marked("engine", "driver"), metadata.get("driver", "")),
        (marked("engine", "model in use"), metadata.get("model", "") or report.model),
        (marked("engine", "effects"), metadata.get("effects", "")),
        (marked("engine", "run"), metadata.get("run", "")),
        (marked("engine", "operator"), metadata.get("operator", "")),
        (marked("engine", "sample"), metadata.get("sample", "")),
    ]


def _draw_axis(traces: AxisTraces) -> Markup:
    scale = choose_scale(traces.unit, float(np.nanmax(np.abs(traces.command), initial=0.0)))
    gap = traces.measured - traces.model
    gap_sizes = np.abs(gap[np.isfinite(gap)])
    gap_scale = choose_scale(
        traces.unit, max(float(gap_sizes.max(initial=0.0)), traces.floor or 0.0)
    )

    def draw(figure: Figure) -> None:
        signal_axes, gap_axes = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 2.0))
        for values, role, dashes, width, name in (
            (traces.measured, ColourRole.REAL, "-", 1.6, _translate(marked("engine", "measured"))),
            (
                traces.model,
                ColourRole.CORRECTED,
                "-",
                1.0,
                _translate(marked("engine", "model in use")),
            ),
            (traces.command, ColourRole.QUIET, "--", 0.8, _translate(marked("engine", "command"))),
        ):
            _draw_line(signal_axes, traces.time_s, scale(values), role, dashes, width, name)
        _draw_line(gap_axes, traces.time_s, gap_scale(gap), ColourRole.INK, "-", 0.8, "")
        if traces.floor:
            edge = traces.floor * gap_scale.per_si
            gap_axes.axhspan(-edge, edge, color=ColourRole.FLOOR, alpha=0.25, linewidth=0.0)
        signal_axes.set_ylabel(f"[{scale.symbol}]")
        gap_axes.set_ylabel(_translate(marked("engine", "gap [{unit}]"), unit=gap_scale.symbol))
        gap_axes.set_xlabel(_translate(marked("engine", "time [s]")))
        add_legend(figure, signal_axes)

    description = marked("engine", "Command, model in use and measured of {axis}, and the gap")
    return draw_picture(
        _WIDTH_INCH, _HEIGHT_INCH, draw, _translate(description, axis=AxisName(traces.axis))
    )


def _draw_line(
    axes: Axes,
    time_s: FloatArray,
    values: FloatArray,
    role: ColourRole,
    dashes: str,
    width: float,
    name: str,
) -> None:
    is_known = np.isfinite(values)
    if is_known.any():
        curve = decimate_to_envelope(time_s[is_known], values[is_known], _CURVE_BUCKETS)
        axes.plot(*curve, dashes, color=role, linewidth=width, label=name)


def _find_floor(robot: Robot, axis: str) -> float | None:
    robot_axis = robot.axes.get(axis)
    return robot_axis.sensor.noise_floor if robot_axis and robot_axis.sensor else None


def _compute_gap_to_floor_ratio(traces: AxisTraces) -> float:
    return 0.0 if traces.figure is None else traces.figure.rms / (traces.floor or 1.0)


def _select_concurrent(
    runs: Sequence[PenetrationRun], began: str, duration_s: float
) -> tuple[PenetrationRun, ...]:
    start = parse_time(began)
    return () if start is None else tuple(run for run in runs if run.overlaps(start, duration_s))
