"""The report of a run: one HTML page about a record of the library."""

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

from rotemina.app.display_units import duration_text
from rotemina.app.motion.compared_run import Run
from rotemina.app.motion.penetration.run_log import PenetrationRun
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.recorded_events import Severity, TimelineEvent, timeline_events
from rotemina.app.records.entry import Entry
from rotemina.app.records.file_facts import moment
from rotemina.app.records.library import require_length
from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.gap import GapFigure, gap_figure, gap_text, moving
from rotemina.sim.decimation import envelope
from rotemina.sim.gap.output.report.frame import environment
from rotemina.sim.gap.output.report.pictures import Role, legend, picture
from rotemina.sim.gap.output.report.words import shown, worded
from rotemina.sim.messages import AxisName, Message, Wording, marked, message
from rotemina.sim.quantities import Number, fixed, rounded, scale_of
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import Robot

_WIDTH, _HEIGHT = 11.0, 3.8  # inches of a drawing
_BUCKETS = 500  # in which a curve is drawn
_MOST_EVENTS = 300
_MOST_LETTERS = 300  # of a metadatum
_TOLD_ABOVE = (
    "began", "robot", "robot_file", "driver", "model", "effects", "run", "operator", "sample"
)  # fmt: skip
TEXTS = (
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
    """One axis that moved.

    Attributes
    ----------
    axis, unit : str
    floor : float or None
        Of its sensor, m or rad.
    time_s : (n,)
        From the begin of the record.
    command, model, measured : (n,)
        m or rad; NaN where nobody knows.
    figure : GapFigure or None
        None where no sample counts.
    nominal_known : bool
        Whether ``figure.nominal`` is about the nominal model.
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
    """The content of the page.

    Attributes
    ----------
    name, note, file : str
    duration_s : float
    completed : bool
        False where it is known that it was stopped early.
    model : str
        Id of the model that the figures are from; "" for the robot file's.
    metadata : mapping
        Of the record.
    courses : tuple of AxisTraces
    events : tuple of TimelineEvent or None
        None where the record keeps none.
    penetrations : tuple of PenetrationRun
        Those that were started meanwhile.
    """

    name: str
    note: str
    file: str
    duration_s: float
    completed: bool
    model: str
    metadata: Mapping[str, str]
    courses: tuple[AxisTraces, ...]
    events: tuple[TimelineEvent, ...] | None = None
    penetrations: tuple[PenetrationRun, ...] = ()

    @classmethod
    def of_run(cls, run: Run, robot: Robot, entry: Entry | None = None) -> Self:
        """Return that of a playback, or of another text record, beside a model."""
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
                        _floor(robot, axis),
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
            courses=tuple(courses),
        )

    @classmethod
    def of_recording(
        cls, path: Path, entry: Entry | None = None, penetrations: Sequence[PenetrationRun] = ()
    ) -> Self:
        """Return that of a recording, with the model's answers that it keeps.

        Parameters
        ----------
        path : Path
        entry : Entry, optional
            Of the library.
        penetrations : sequence of PenetrationRun
            Any; those that were under way meanwhile are told of.

        Raises
        ------
        RecordingError
            If it cannot be read.
        LibraryError
            If it is too long.
        """
        recording = Recording.open(path)
        require_length(recording)
        robot, samples = recording.robot, recording.samples()
        counted = moving(samples.host_time_s, samples.command)
        courses = []
        for column, axis in enumerate(recording.axes):
            command, model, measured = (
                values[:, column] for values in (samples.command, samples.model, samples.measured)
            )
            known = command[np.isfinite(command)]
            if len(known) and np.ptp(known) > 0.0:
                time_s = samples.host_time_s - recording.began_s
                figure = gap_figure(counted, measured, model)
                unit, floor = recording.units[axis], _floor(robot, axis)
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
            courses=tuple(courses),
        )
        return report.with_events(recording, penetrations)

    def with_events(self, recording: Recording, penetrations: Sequence[PenetrationRun]) -> Self:
        """Return it with what happened during the recording that it is of."""
        events = timeline_events(recording.events(), recording.began_s)
        began, duration_s = recording.metadata.get("began", ""), recording.ended_s
        return replace(
            self,
            events=tuple(one for one in events if one.weight is not Severity.DETAIL),
            penetrations=_meanwhile(penetrations, began, duration_s - recording.began_s),
        )

    @property
    def worst(self) -> AxisTraces | None:
        """The axis whose gap is largest, in noise floors of its sensor."""
        known = [one for one in self.courses if one.figure is not None]
        return max(known, key=_in_floors, default=None)


def report_text(report: RunReport, wording: Wording | None = None) -> str:
    """Return the page in a language; English unless given."""
    with worded(wording or Wording()):
        made = environment(_said)
        made.filters.update(
            axis=lambda axis: shown(AxisName(axis)),
            gap=lambda size, unit: shown(gap_text(size, unit)),
            drawing=_drawing,
            seconds=lambda at_s: shown(fixed(at_s, 3)),
            kind=lambda word: shown(Message("recorder", word)),
            cut=lambda text: text if len(text) <= _MOST_LETTERS else f"{text[:_MOST_LETTERS]} …",
        )
        template = resources.files(__package__).joinpath("run_report.html").read_text("utf-8")
        return made.from_string(template).render(
            report=report,
            headline=shown(_headline(report)),
            remarks=list(map(shown, _remarks(report))),
            summary=[(_said(name), shown(text)) for name, text in _summary(report) if text],
            most_events=_MOST_EVENTS,
            left_out=_TOLD_ABOVE,
            version=version("rotemina"),
        )


def _said(template: str, **fields: str | float) -> str:
    return shown(Message("engine", template, tuple(fields.items())))


def _headline(report: RunReport) -> Message:
    worst = report.worst
    if worst is None or worst.figure is None:
        return message("engine", "No axis has a gap: none was seen to move.")
    gap = gap_text(worst.figure.rms, worst.unit)
    if not worst.floor:
        return message("engine", "Largest gap: {axis}, {gap}").fill(
            axis=AxisName(worst.axis), gap=gap
        )
    return message("engine", "Largest gap: {axis}, {gap} ({floors} × its noise floor)").fill(
        axis=AxisName(worst.axis),
        gap=gap,
        floors=rounded(worst.figure.rms / worst.floor, 3),
    )


def _remarks(report: RunReport) -> list[Message]:
    told = report.metadata.get("model", "")
    remarks = []
    if not report.completed:
        remarks.append(message("engine", "The run was stopped early."))
    if told and report.model and told != report.model:
        remarks.append(
            message(
                "engine",
                "The figures are from the model {model}; {told} was in use during the run.",
            ).fill(model=report.model, told=told)
        )
    return remarks


def _summary(report: RunReport) -> list[tuple[str, str]]:
    told = report.metadata
    began = moment(told.get("began", ""))
    return [
        (
            marked("engine", "date"),
            "" if began is None else began.isoformat(sep=" ", timespec="seconds"),
        ),
        (marked("engine", "duration"), Number(duration_text(report.duration_s, 1))),
        (marked("engine", "robot"), told.get("robot", "")),
        (marked("engine", "driver"), told.get("driver", "")),
        (marked("engine", "model in use"), told.get("model", "") or report.model),
        (marked("engine", "effects"), told.get("effects", "")),
        (marked("engine", "run"), told.get("run", "")),
        (marked("engine", "operator"), told.get("operator", "")),
        (marked("engine", "sample"), told.get("sample", "")),
    ]


def _drawing(one: AxisTraces) -> Markup:
    """Draw what was commanded, answered and measured, and the gap below."""
    scale = scale_of(one.unit, float(np.nanmax(np.abs(one.command), initial=0.0)))
    gap = one.measured - one.model
    known = np.abs(gap[np.isfinite(gap)])
    fine = scale_of(one.unit, max(float(known.max(initial=0.0)), one.floor or 0.0))

    def draw(figure: Figure) -> None:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 2.0))
        for values, role, dashes, width, name in (
            (one.measured, Role.REAL, "-", 1.6, _said(marked("engine", "measured"))),
            (one.model, Role.CORRECTED, "-", 1.0, _said(marked("engine", "model in use"))),
            (one.command, Role.QUIET, "--", 0.8, _said(marked("engine", "command"))),
        ):
            _line(above, one.time_s, scale(values), role, dashes, width, name)
        _line(below, one.time_s, fine(gap), Role.INK, "-", 0.8, "")
        if one.floor:
            edge = one.floor * fine.per_si
            below.axhspan(-edge, edge, color=Role.FLOOR, alpha=0.25, linewidth=0.0)
        above.set_ylabel(f"[{scale.symbol}]")
        below.set_ylabel(_said(marked("engine", "gap [{unit}]"), unit=fine.symbol))
        below.set_xlabel(_said(marked("engine", "time [s]")))
        legend(figure, above)

    about = marked("engine", "Command, model in use and measured of {axis}, and the gap")
    return picture(_WIDTH, _HEIGHT, draw, _said(about, axis=AxisName(one.axis)))


def _line(
    axes: Axes,
    time_s: FloatArray,
    values: FloatArray,
    role: Role,
    dashes: str,
    width: float,
    name: str,
) -> None:
    known = np.isfinite(values)
    if known.any():
        curve = envelope(time_s[known], values[known], _BUCKETS)
        axes.plot(*curve, dashes, color=role, linewidth=width, label=name)


def _floor(robot: Robot, axis: str) -> float | None:
    described = robot.axes.get(axis)
    return described.sensor.noise_floor if described and described.sensor else None


def _in_floors(one: AxisTraces) -> float:
    return 0.0 if one.figure is None else one.figure.rms / (one.floor or 1.0)


def _meanwhile(
    runs: Sequence[PenetrationRun], began: str, duration_s: float
) -> tuple[PenetrationRun, ...]:
    """Return the penetrations that were under way during a recording."""
    first = moment(began)
    return () if first is None else tuple(one for one in runs if one.during(first, duration_s))
