"""Write the samples of files in this folder: ``python tests/samples/make_samples.py [NAME …]``.

Every file that the program writes and reads again has a sample here, written by the program itself,
and so has every JSON file that it writes for the scripts of others. A sample is made once for each
version of its format, and kept: it stands for the files on the disks of users. Where a sample can
no longer be read, the program has to be changed, not the sample. So nothing that exists is written
over. A new version of a format gets a sample of its own, under a new name, next to the old one.

There is one function for each kind of file; each is named by the sample that it writes. What comes
out is the same each time, but for the version of the program, and for times of change and sizes of
its modules. Folders are as the program lays them out: ``config`` is that of preferences, ``data``
that of records; ``files`` are those that a user saves anywhere, ``outputs`` those for others.
"""

import gzip
import json
import os
import shutil
import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from dataclasses import replace
from datetime import UTC, datetime
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from unittest import mock

import numpy as np

from rotemina.app.files import json_text
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

HERE = Path(__file__).parent
BEGAN = datetime(2026, 3, 4, 5, 6, 7, tzinfo=UTC)
STICK = "hid:046d:c215:0001"
#: A folder that no machine has, for paths that are kept.
RECORDS = Path("/records")
PLAYED = "data/played/2026-03-04_05-06-07-000000_tour.csv.gz"
RECORDED = "data/recordings/2026-03-04_05-06-07-000000_session.arrows"

Maker = Callable[[Path], None]
MAKERS: dict[str, Maker] = {}
OUTPUTS: dict[str, Callable[[], Any]] = {}


def sample(name: str) -> Callable[[Maker], Maker]:
    """Let a function make the sample of a name: a file, or all files of a folder."""

    def register(make: Maker) -> Maker:
        MAKERS[name] = make
        return make

    return register


def output(name: str) -> Callable[[Callable[[], Any]], Callable[[], Any]]:
    """Let a function return a JSON value that others read."""

    def register(make: Callable[[], Any]) -> Callable[[], Any]:
        OUTPUTS[name] = make
        MAKERS[f"outputs/{name}"] = lambda path: path.write_text(json_text(make()) + "\n", "utf-8")
        return make

    return register


# --- what is kept among the preferences -----------------------------------------------------------


@sample("config/settings.json")
def write_preferences(path: Path) -> None:
    """Write each preference by what keeps it, the window by a window with all panels."""
    from PySide6.QtWidgets import QApplication

    from rotemina.app.motion.session import MotionSession
    from rotemina.app.settings import Settings
    from rotemina.app.shell import layouts
    from rotemina.app.shell.window_run import make_window
    from rotemina.drivers.simulator.driver import Simulator

    settings = Settings(path)
    _keep_devices(settings)
    session = MotionSession(Simulator(load_robot("rotemina"), {"settle_s": 0.02}))
    with TemporaryDirectory() as folder:
        window = make_window(session, settings, Path(folder) / "played")
        window.show()
        arrangement = window.arrangement
        arrangement.use_theme("light")
        arrangement.step_scale(1)
        _use_panels(window)
        for layout in layouts.BUILT_IN:
            arrangement.arrange(layout)
            QApplication.processEvents()
            arrangement.keep(f"My {layout.word}")
        arrangement.arrange(layouts.TUNE)
        window.docks["faults"].setFloating(True)
        window.docks["faults"].show()
        window.docks["effects"].close()
        QApplication.processEvents()
        arrangement.keep("Faults & more")
        arrangement.remember()
        window.workbench.close()
        window.hide()


def _keep_devices(settings: Any) -> None:
    """Keep what was chosen of robot, camera, drivers and input devices."""
    from rotemina.app import driver_settings
    from rotemina.app.microscope.camera_memory import CameraMemory, UsedCamera
    from rotemina.app.range_settings import keep_ranges
    from rotemina.drivers.cameras.camera import CameraIdentity
    from rotemina.drivers.cameras.frame import Region
    from rotemina.drivers.cameras.settings import CameraSettings, PixelType, Trigger
    from rotemina.drivers.registry import driver_named

    # Ranges belong to the very contents of a robot file: of this one, which stays as it is.
    robot = load_robot(needed("files/robot.toml"))
    keep_ranges(settings, robot, {"table": (0.01, 0.04), "tilt": (1e-4, 9e-4)})
    camera = CameraSettings(
        exposure_s=0.02,
        gain=3.5,
        rate_hz=12.5,
        region=Region(8, 16, 640, 480),
        pixel_type=PixelType.MONO16,
        trigger=Trigger.SOFTWARE,
        repeat=False,
    )
    identity = CameraIdentity("sequence:/records/cells", "cells", "sequence")
    CameraMemory(settings).keep(UsedCamera(identity, camera, by_address=True))
    for name in ("gcode", "mc68hc11", "simulator"):
        kind = driver_named(name)
        changed = {key: _other(value) for key, value in kind.default_settings.items()}
        driver_settings.keep(settings, kind, changed)


def _other(value: Any) -> Any:
    """Return another value of the same type."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        return f"{value}ttyUSB7" if not value else value[::-1]
    return value + type(value)(1) if isinstance(value, int) else 0.5 * value + 0.125


def _use_panels(window: Any) -> None:
    """Do in the window what is kept."""
    from rotemina.app.motion.run_labels import RunLabels
    from rotemina.app.shell import column_mapping, file_dialog, language_menu, record_library
    from rotemina.plugins.control import overview
    from rotemina.plugins.gap import hidden_machine
    from rotemina.plugins.inputs import profiles
    from rotemina.plugins.microscope import saving_section
    from rotemina.plugins.microscope.picture_section import LayerSection
    from rotemina.plugins.recorder import recording_controls
    from rotemina.sim.records.preview import preview

    bench, settings = window.workbench, window.workbench.settings
    settings.set(language_menu.SETTING, "de")
    window.recent_files.add("record", RECORDS / "run 7.csv.gz")
    window.recent_files.add("trajectory", RECORDS / "tour.csv")
    file_dialog._remembered(bench, str(RECORDS / "tour.csv"))
    bench.library.use_labels(RunLabels("run 7", "an operator", "dish B"))
    settings.set(record_library.BOUND_GB, 25)
    window.first_steps.end()
    with TemporaryDirectory() as folder:
        plain = Path(folder) / "plain.csv"
        plain.write_text("0,0.01,0.02\n0.001,0.01,0.02\n0.002,0.01,0.03\n")
        column_mapping._open_dialog(plain, preview(plain), bench, window, lambda *_: None)
        dialog = window.findChild(column_mapping.ColumnMappingDialog)
        dialog.set_columns("t [s], x [m], y [m]")
        dialog.accept()
    settings.set(overview._SPEED_KEY, 0.25)
    settings.set(hidden_machine.RIGHT, 3)
    settings.set(hidden_machine.PLAYED, 4)
    settings.set(profiles.SETTING, "Two sticks")
    settings.set(saving_section.FOLLOWS, True)
    settings.set(recording_controls.AT_START, True)
    for box in window.findChild(LayerSection).boxes.values():
        box.toggle()


@sample("config/profiles")
def write_profile(folder: Path) -> None:
    """Write a profile of two devices with every action."""
    from rotemina.app.motion.teleoperation.intent import Action
    from rotemina.app.motion.teleoperation.profile import (
        ActionMapping,
        AxisMapping,
        DeviceMapping,
        OperatorRole,
        Profile,
        SilencePolicy,
        save_profile,
    )

    buttons = tuple(
        ActionMapping(control=f"button {number}", action=action)
        for number, action in enumerate(Action, start=1)
    )
    beyond = ActionMapping(control="axis 3", action=Action.FINE, at=-0.6, hysteresis=0.2)
    first = DeviceMapping(
        key=STICK,
        axes=(
            AxisMapping(control="axis 1", drives="x"),
            AxisMapping(control="axis 2", drives="zn", inverted=True),
        ),
        actions=(*buttons, beyond),
    )
    second = DeviceMapping(
        key="board:*", seat=OperatorRole.TRAINEE, when_silent=SilencePolicy.CONTINUE
    )
    save_profile(folder, Profile(name="Two sticks", devices=(first, second)))


@sample("config/calibrations")
def write_calibrations(folder: Path) -> None:
    """Write the calibration of a stick, and those of two sensors of which one is in use."""
    from rotemina.app.calibration.files import CalibrationFile, Iso, KeptFigure, Sensor, Source
    from rotemina.app.calibration.store import CalibrationStore
    from rotemina.app.motion.teleoperation.axis_calibration import (
        AxisCalibration,
        Calibration,
        CalibrationFolder,
    )
    from rotemina.drivers.inputs.device import InputIdentity

    stick = AxisCalibration(
        low=-0.9, centre=0.02, high=0.95, dead_zone=0.03, expo=0.4, inverted=True, travel_m=0.03
    )
    calibration = Calibration(device=STICK, axes={"axis 1": stick})
    CalibrationFolder(folder).save(InputIdentity(STICK, "a stick", "hid"), calibration)
    figures = {
        "accuracy": 4e-7,
        "repeatability": 1e-7,
        "repeatability_up": 1.1e-7,
        "repeatability_down": 1.2e-7,
        "reversal": 5e-8,
        "mean_reversal": -2e-8,
        "systematic": 2e-7,
        "mean_bidirectional": 1.5e-7,
    }
    zn = CalibrationFile(
        robot="RoTeMiNa",
        axis="zn",
        unit="m",
        date=BEGAN.isoformat(),
        travel=(1e-6, 6.4e-5),
        runs=3,
        before_rms=1e-7,
        after_rms=2e-9,
        sensor=Sensor(
            low=0.0,
            high=6.5e-5,
            offset=1e-8,
            gain_error=0.0125,
            bend=(2e-8, -1e-8),
            radii=(3e-8, 1e-7),
            weights=(0.01, 0.02),
            lag="first_order",
            lag_s=1e-4,
        ),
        figures=(
            KeptFigure(name="gain error", value=0.0125, half_width=1e-4, unit="1"),
            KeptFigure(name="noise", value=4e-10, unit="m"),
        ),
        sources=(Source(name="run 7.csv.gz", digest="0123456789abcdef"),),
        notes=("the laser drifted",),
        iso_reading_before=Iso(**figures),
        iso_reading_after=Iso(**{name: 0.5 * value for name, value in figures.items()}),
        iso_reached=Iso(**{name: 0.25 * value for name, value in figures.items()}),
    )
    x = replace(
        zn,
        axis="x",
        travel=(0.001, 0.05),
        sensor=Sensor(
            low=0.0,
            high=0.055,
            offset=1e-7,
            gain_error=-2e-5,
            lag="delay",
            lag_s=2e-4,
            period=2e-5,
            harmonics=(1e-8, 2e-8, 3e-9, 4e-9),
        ),
        iso_reached=None,
    )
    store = CalibrationStore(folder.parent, load_robot("rotemina"))
    store.save(x)
    store.switch("zn", store.save(zn))


@sample("config/health")
def write_health_cards(folder: Path) -> None:
    """Write two cards of an axis."""
    from rotemina.app.calibration.health_book import HealthBook
    from rotemina.sim.calibration.sensor_calibration import Figure

    book = HealthBook(folder.parent, "RoTeMiNa")
    for day, gain in ((4, 0.98), (5, 0.97)):
        figures = (Figure("static gain", gain, 0.002, "1"), Figure("noise", 4e-10, 1e-11, "m"))
        book.add("zn", figures, f"run {day}.csv", BEGAN.replace(day=day))


@sample("config/microscope")
def write_microscope(folder: Path) -> None:
    """Write the calibration of a camera behind an objective, of both stages and the focus."""
    from rotemina.app.microscope import calibration_file as file

    stage = file.StageCalibration(
        date=BEGAN.isoformat(),
        matrix=((3.1e6, 1.5e3), (-1.6e3, 3.2e6)),
        covariance=tuple(tuple(float(4 * i + j) for j in range(4)) for i in range(4)),
        tip_m=(0.01, 0.02, 0.03),
        tip_px=(320.5, 240.25),
        residual_px=0.125,
    )
    calibration = file.MicroscopeCalibration(
        camera="opencv:0",
        objective="20x/0.4",
        view=file.View(left=8, top=16, width=640, height=480),
        micro=stage,
        nano=replace(stage, tip_px=(321.5, 241.25)),
        focus=file.FocusCalibration(
            date=BEGAN.isoformat(), axis="z", sharpest=0.0125, uncertainty=2e-7
        ),
    )
    file.save(folder, calibration)


@sample("config/positions")
def write_positions(folder: Path) -> None:
    """Write the three places with buttons of their own, and another one."""
    from rotemina.app.motion.saved_positions import HOME, LOAD, WORK, SavedPositions

    robot = load_robot("rotemina")
    positions = SavedPositions(folder.parent, robot)
    for share, name in ((0.5, HOME), (0.25, LOAD), (0.75, WORK), (0.125, "dish B, cell 3")):
        place = {
            axis: one.range[0] + share * (one.range[1] - one.range[0])
            for axis, one in robot.axes.items()
        }
        positions.keep(name, place)


@sample("config/scales.toml")
def write_scales(path: Path) -> None:
    """Write a scale of each coordinate of each mode."""
    from rotemina.app.motion.teleoperation.modes import Modes
    from rotemina.app.motion.teleoperation.scales import Scale, Scales
    from rotemina.app.motion.teleoperation.teleoperation_loop import DIRECT

    robot = load_robot("rotemina")
    modes, middle = Modes(robot), {n: sum(one.range) / 2 for n, one in robot.axes.items()}
    scale = Scale(
        way=2e-4,
        speed=3e-4,
        time_constant_s=0.5,
        spring_hz=1.5,
        damping_ratio=0.75,
        contact_gain=0.25,
    )
    scales, coordinates = Scales(), {DIRECT: tuple(robot.axes)}
    coordinates |= {mode: tuple(modes.begin(mode, middle).coordinates) for mode in modes.names}
    for mode, names in coordinates.items():
        for name in names:
            scales = scales.with_scale(mode, name, scale)
    scales.save(path)


@sample("config/penetration.toml")
def write_penetration_parameters(path: Path) -> None:
    """Write parameters none of which is a preset."""
    penetration_parameters().save(path)


def penetration_parameters() -> Any:
    """Return parameters none of which is a preset."""
    from rotemina.app.motion.penetration.parameters import (
        Direction,
        PenetrationParameters,
        Shaping,
        ThrustShape,
    )

    return PenetrationParameters(
        axis="z",
        direction=Direction.UP,
        approach_speed=2e-5,
        approach_distance=3e-5,
        false_alarms_per_hour=0.5,
        drift=0.2,
        drift_length=2e-3,
        contact_pause_s=0.2,
        depth=4e-5,
        duration_s=0.08,
        shape=ThrustShape.TABLE,
        ramp=0.25,
        table=((0.0, 0.0), (0.5, 0.75), (1.0, 1.0)),
        shaping=Shaping.INVERSE,
        hold_s=0.25,
        inject_s=0.75,
        hold_after_s=1.25,
        retract_speed=2e-4,
        depth_tolerance=0.2,
        overload=2e-5,
        armed_s=30.0,
    )


# --- what is kept among the data ------------------------------------------------------------------


@sample("data/penetrations.jsonl")
def write_penetrations(path: Path) -> None:
    """Write a run of each verdict, the first with all that can be known of one."""
    from dataclasses import asdict

    from rotemina.app.motion.penetration.run_log import PenetrationRun, RunLog, Verdict
    from rotemina.app.motion.penetration.status import Phase
    from rotemina.app.motion.penetration.thrust import ThrustMeasured

    phases = tuple((str(phase), 0.25 * number) for number, phase in enumerate(Phase))
    run = PenetrationRun(
        started=BEGAN.isoformat(),
        robot="RoTeMiNa",
        driver="simulator",
        parameters=asdict(penetration_parameters()),
        verdict=Verdict.DONE,
        reason="",
        phases=phases,
        model="nominal-00112233",
        run="run 7",
        operator="an operator",
        sample="dish B",
        start=3e-5,
        contact=2.5e-5,
        contact_measured=2.51e-5,
        contact_height=0.0125,
        contact_delay_s=0.015,
        contact_from_start=False,
        noise_rms=4e-10,
        threshold=12.5,
        planned_average_speed=4.5e-4,
        planned_peak_speed=7.5e-4,
        fit_error=1e-9,
        thrust=ThrustMeasured(
            depth=4.9e-5,
            error=3e-7,
            delay_s=0.002,
            average_speed=4.4e-4,
            peak_speed=7.4e-4,
            rate_hz=1000.0,
        ),
        peak_deviation=5e-7,
        final_deviation=2e-7,
        gave_way=True,
    )
    log = RunLog(path)
    log.append(run)
    short = replace(run, thrust=None, phases=phases[:3], contact=None, gave_way=None)
    for verdict in (Verdict.ABORTED, Verdict.FAILED, Verdict.HELD):
        log.append(replace(short, verdict=verdict, reason=f"it was {verdict}"))


@sample(PLAYED)
def write_playback(path: Path) -> None:
    """Play a motion on a machine with an inverse, a loop, a calibration and an effect."""
    from rotemina.app.motion.model_in_use import NOTED
    from rotemina.sim.records.writing import write_record

    record = played()
    began = {"began": BEGAN.isoformat(timespec="milliseconds")}
    noted = {NOTED: "contact of zn"}
    write_record(replace(record, metadata={**record.metadata, **began, **noted}), path)


def played() -> Record:
    """Return the record of a short playback of two axes."""
    from rotemina.app.motion.compensation import NamedInverse
    from rotemina.app.motion.regulation import NamedRegulation
    from rotemina.app.motion.run_labels import RunLabels
    from rotemina.app.motion.sensor_corrections import AppliedCalibration
    from rotemina.app.motion.session import MotionSession
    from rotemina.app.motion.state import PlaybackFinished
    from rotemina.drivers.clock import VirtualClock
    from rotemina.drivers.simulator.driver import Simulator
    from rotemina.sim.calibration.sensor import SensorModel
    from rotemina.sim.compensate.inverse_parameters import InverseModel
    from rotemina.sim.feedback.gains import Gains
    from rotemina.sim.feedback.regulation import Regulation
    from rotemina.sim.robot.model import AxisEffect

    robot = load_robot("rotemina")
    zn, thx = robot.axes["zn"], robot.axes["thx"]
    clock = VirtualClock(7.0)
    worn = replace(robot, effects=(AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),))
    session = MotionSession(Simulator(worn, {"settle_s": 0.02}, clock=clock))
    events: list[Any] = []
    session.subscribe(events.append)

    def wait(seconds: float) -> None:
        for _ in range(round(seconds / 0.02)):
            clock.advance(0.02)
            session.run_once()

    session.connect()
    wait(0.1)
    session.labels = RunLabels("run 7", "an operator", "dish B")
    gain = InverseModel(
        axis="zn",
        unit="m",
        kind="prandtl_ishlinskii",
        sample_s=1e-3,
        origin=0.0,
        command_origin=0.0,
        span=zn.span,
        desired_range=(1e-6, 6e-5),
        command_range=zn.range,
        speed=1.0,
        consequents=np.array([[0.0, 0.95, 0.05]]),
        radii=np.array([0.1]),
        initial=np.zeros(1),
    )
    session.inverses.apply(NamedInverse(gain, robot.name, "Prandtl-Ishlinskii, zn.json"))
    wait(0.2)
    loop = Regulation(robot, "thx", Gains(integral=5.0), 1000.0)
    session.loops.apply(NamedRegulation(loop, "thx.toml, point 0"))
    sensor = SensorModel(low=thx.range[0], high=thx.range[1], gain_error=0.01)
    calibration = AppliedCalibration("2026-03-04 01234567", sensor, thx.range)
    session.corrections.use("thx", calibration)
    wait(0.2)
    time_s = 0.001 * np.arange(60)
    bow = 0.5 - 0.5 * np.cos(2.0 * np.pi * time_s / time_s[-1])
    signals = {
        (name, Tap.CMD): sum(axis.range) / 2.0 + 0.01 * axis.span * bow
        for name, axis in (("thx", thx), ("zn", zn))
    }
    metadata = {"trajectory": "tour"}
    session.play(Record.from_signals(time_s, signals, {"thx": "rad", "zn": "m"}, metadata))
    wait(4.0)
    session.close()
    (end,) = (one for one in events if isinstance(one, PlaybackFinished) and one.shown)
    assert end.record is not None
    return end.record


@sample(RECORDED)
def write_recording(path: Path) -> None:
    """Record a session with sticks, a tip, all kinds of events and a state that says all."""
    _record(path)


@sample("data/recordings/2026-03-04_06-07-08-000000.arrows.part")
def write_interrupted_recording(path: Path) -> None:
    """Leave a recording as a crash does."""
    _record(path.with_suffix(""), ended=False)


def _record(path: Path, *, ended: bool = True) -> None:
    from rotemina.app.motion.recording import writer
    from rotemina.app.motion.recording.session_recorder import SessionRecorder
    from rotemina.app.motion.run_labels import RunLabels
    from rotemina.app.motion.session import MotionSession
    from rotemina.app.motion.state import Alarmed, CommandRefused, Faulted, PlaybackFinished
    from rotemina.app.motion.teleoperation.intent import Action, Intent
    from rotemina.drivers.clock import VirtualClock
    from rotemina.drivers.simulator.driver import Simulator

    clock = VirtualClock(7.0)
    settings = {"settle_s": 0.02, "sample_rate_hz": 100.0}
    driver = Simulator(load_robot("xyz"), settings, clock=clock)
    session = MotionSession(driver, local_time=lambda: BEGAN)
    session.labels = RunLabels("run 7", "an operator", "dish B")
    session.connect()
    session.run_once()
    with mock.patch.object(writer, "uuid4", return_value=mock.Mock(hex="00112233" * 4)):
        recorder = SessionRecorder(
            session,
            path,
            settings={"control.speed": 0.25},
            began=BEGAN.isoformat(timespec="seconds"),
            clock=clock,
        )
    recorder.start(thread=False)
    (axis, *_) = session.driver.axes
    for step in range(15):
        if step == 2:
            session.jog(axis, 1e-5)
        if step == 12:
            session.stop("a hand in the way")
        if step == 5:
            now_s, held = clock(), frozenset({Action.DEAD_MAN})
            recorder.record_intent(Intent(now_s, {"x": 0.5}, held, held, STICK))
            recorder.record(f"input {STICK}", now_s, {"axis 1": 0.5, "button 1": 1.0})
            recorder.record("tip", now_s, {"x": 12.5, "y": -3.5, "quality": 0.75})
            recorder.note("a note")
        clock.advance(0.02)
        session.run_once()
    recorder._on_event(Faulted("the amplifier is off"))
    recorder._on_event(CommandRefused("the axis is not homed"))
    recorder._on_event(Alarmed("a reading is out of bounds"))
    recorder._on_event(PlaybackFinished(None, completed=True))
    _record_full_state(recorder, session)
    recorder.writer.run_once()
    if ended:
        recorder.close()
    else:
        recorder.writer._file.close()
    session.close()


def _record_full_state(recorder: Any, session: Any) -> None:
    """Record a state in which nothing that is kept of one is as it is at first."""
    from rotemina.app.motion.state import StateChanged
    from rotemina.app.motion.stop import StopRequest
    from rotemina.drivers.samples import DeviceState

    state = replace(
        session.snapshot(),
        activity=DeviceState.FAULT,
        progress=0.75,
        position_known=True,
        fault="the amplifier is off",
        locked="the device reports a fault",
        unhomed=("x",),
        silent_s=1.5,
        stopping=True,
        stop=StopRequest("operator", "a hand in the way", BEGAN),
        latched="the emergency stop was pressed",
        differences=("x: 1 instead of 2",),
        model_id="corrected-00112233",
        unsettled=("y",),
    )
    recorder._on_event(StateChanged(state))


@sample("data/records.sqlite3")
def write_library(path: Path) -> None:
    """List the records next to it and one of elsewhere, of which everything is known."""
    from rotemina.app.motion.compared_run import compared
    from rotemina.app.motion.model_in_use import ModelInUse
    from rotemina.app.records.database import RecordStore
    from rotemina.app.records.entry import Entry, Kind, WorstGap
    from rotemina.app.records.library import Library
    from rotemina.drivers.simulator.driver import Simulator
    from rotemina.sim.records.reading import read_record

    robot, data = load_robot("rotemina"), path.parent
    for name in (PLAYED, RECORDED):
        (data.parent / name).parent.mkdir()
        shutil.copyfile(needed(name), data.parent / name)
        os.utime(data.parent / name, (BEGAN.timestamp(),) * 2)
    library = Library(data)
    library.refresh()
    playback = next(one for one in library.entries if one.kind is Kind.PLAYBACK)
    record = read_record(playback.path, robot=robot)
    run = compared(ModelInUse.nominal_of(Simulator(robot)), "tour", record)
    library.set_gap(playback.path, run, robot)
    library.call(playback.id, name="The first tour", note="the dish was warm")
    elsewhere = Entry(
        path=RECORDS / "run 7.csv",
        kind=Kind.FILE,
        size=1234,
        stamp=1_772_600_767_000_000_000,
        digest="00112233445566778899aabbccddeeff",
        began=BEGAN,
        duration_s=12.5,
        robot="RoTeMiNa",
        machine="0123456789abcdef",
        driver="simulator",
        model="nominal-00112233",
        effects="zn creep",
        run="run 7",
        operator="an operator",
        sample="dish B",
        gap=WorstGap("zn", 1.5e-7, "m"),
        events=3,
        name="Elsewhere",
        note="from another machine",
        problem="its time stands still",
        changed=True,
    )
    RecordStore(data).put([elsewhere])


@sample("data/blind/RoTeMiNa-seed-7")
def write_blind_test(folder: Path) -> None:
    """Do two of three cases of a blind test, with a diagnosis that always says the same."""
    from rotemina.app.blind import resumable_run
    from rotemina.app.blind.cases import GeneratedCases
    from rotemina.app.blind.classifier import classifier_for
    from rotemina.app.blind.diagnosis_process import Answer
    from rotemina.app.blind.naive_methods import CONTESTANTS
    from rotemina.app.blind.shard import Shard
    from rotemina.sim.gap.output.document import as_json

    document = as_json(diagnosis())

    def answer(case: Any) -> Answer:
        predicted = gzip.decompress(case.measured.read_bytes())
        return Answer(document, "00112233" * 8, 12.5, predicted)

    run = resumable_run.BlindRun(folder, GeneratedCases("rotemina", 3, 7))
    others = {name: {"verdict": "none", "causes": []} for name in CONTESTANTS}
    with mock.patch.object(resumable_run.secrets, "token_hex", lambda size: "5a" * size):
        for name in run.pending(Shard())[:2]:
            run.do(name, answer, lambda _: others)
    classifier_for(load_robot("rotemina"), folder / "classifier.npz", 3)


# --- what a user saves anywhere -------------------------------------------------------------------


@sample("files/robot.toml")
def write_robot_file(path: Path) -> None:
    """Write a machine that has every kind of axis, and every table of a robot file."""
    from rotemina.sim.robot import model, plate
    from rotemina.sim.robot.writing import write_robot

    sensor = model.Sensor(kind="linear encoder", resolution=1e-8, noise_rms=2e-8)
    cascade = model.CascadeController(
        kind="cascade", kp=100.0, kv=200.0, limit=9.0, velocity="backward", delay_s=1e-3
    )
    axes = {
        "table": model.StepperAxis(
            kind="stepper",
            range=(0.0, 0.05),
            unit="m",
            mass=40.0,
            damping=8485.0,
            stiffness=2e7,
            offset=1e-6,
            max_speed=0.01,
            max_acceleration=0.2,
            repeatability=5e-8,
            following_bound=1e-3,
            sensor=sensor,
            steps_per_rev=200,
            microsteps_per_step=16,
            pitch=1e-3,
        ),
        "tilt": model.PiezoAxis(
            kind="piezo",
            range=(0.0, 1.16e-3),
            unit="rad",
            natural_frequency_hz=300.0,
            damping_ratio=0.03,
            gain=8.95e-6,
            voltage_range=(0.0, 130.0),
            controller=replace(cascade, limit=120.0),
        ),
        "push": model.ForceAxis(
            kind="force",
            range=(-0.2, 0.2),
            unit="m",
            mass=95.0,
            damping=203.5,
            gain=35.0,
            force_offset=-3.0,
            voltage_range=(-10.0, 10.0),
            controller=cascade,
        ),
        "still": model.PiezoAxis(kind="piezo", range=(0.0, 1e-5), unit="m", gain=1e-7, static=True),
    }
    ring = plate.Cutout(
        kind="slot",
        count=6,
        start=0.125,
        inner_radius=0.008,
        outer_radius=0.014,
        width=0.25,
        twist=0.5,
    )
    holes = plate.Cutout(kind="hole", count=12, circle_radius=0.0158, radius=0.0005)
    write_robot(
        model.Robot(
            name="Everything",
            axes=axes,
            stages={"coarse": ("table",), "fine": ("tilt", "still")},
            couplings=(model.Coupling(matrix="M", axes=("table", "tilt"), value=1e-4),),
            pin_length=0.05,
            piezo_lever_arm=0.011,
            reference=model.Reference(noise_rms=model.ReferenceNoise(linear=1e-9, angular=2e-9)),
            tool=model.Tool(approach_angle=0.75),
            microscope=model.Microscope(
                optical_axis=(0.0, 0.0, 1.0),
                pixel_size=6.5e-6,
                magnification=20.0,
                numerical_aperture=0.4,
                depth_of_field=5.8e-6,
            ),
            keep_out=model.KeepOut(floor=0.001, radius=0.02, objective=0.03),
            plate=plate.Plate(
                rim_radius=0.018,
                hub_radius=0.006,
                thickness=0.0005,
                youngs_modulus=2e11,
                poissons_ratio=0.25,
                density=7900.0,
                yield_stress=9e8,
                cutout=(ring, holes),
                hub=plate.Hub(mass=0.125, inertia=2e-5, product=2e-7),
                pin=plate.Pin(
                    length=0.06,
                    diameter=0.004,
                    youngs_modulus=2.1e11,
                    poissons_ratio=0.3,
                    density=7800.0,
                    yield_stress=8e8,
                ),
                joint=plate.Joint(friction=0.2, clamp_force=900.0, arm=0.003),
            ),
            effects=(
                model.AxisEffect(
                    axis="tilt",
                    id="hysteresis",
                    formulation="bouc_wen",
                    parameters={"width": 1.1e-4},
                    enabled=False,
                ),
                model.AxisEffect(axis="table", id="cross_coupling", from_axis="tilt"),
            ),
        ),
        path,
    )


@sample("files/effects.toml")
def write_effects(path: Path) -> None:
    """Write a machine with every formulation of every effect, each with all its parameters."""
    from rotemina.sim.effects.attachment import Attached
    from rotemina.sim.effects.errors import EffectError
    from rotemina.sim.effects.registry import effect_ids, effect_named, is_built_in
    from rotemina.sim.robot.model import AxisEffect
    from rotemina.sim.robot.writing import write_robot

    rotemina = load_robot("rotemina")
    robot = replace(
        rotemina,
        name="All effects",
        axes={**rotemina.axes, **load_robot("emps").axes},
        couplings=rotemina.couplings,
    )

    def attached(effect: str, formulation: str) -> AxisEffect:
        for axis, source in (
            (axis, source) for source in (None, "x") for axis in reversed(robot.axes)
        ):
            asked = AxisEffect(axis=axis, id=effect, formulation=formulation, from_axis=source)
            try:
                return replace(asked, parameters=Attached.of(robot, asked).values, enabled=False)
            except EffectError:
                continue
        raise AssertionError(f"{effect} {formulation}: no axis")

    effects = tuple(
        attached(name, one.name)
        for name in filter(is_built_in, effect_ids())
        for one in effect_named(name).formulations
    )
    write_robot(replace(robot, effects=effects), path)


@sample("files/twin.toml")
def write_twin(path: Path) -> None:
    """Write the model that a diagnosis has corrected."""
    from rotemina.sim.gap.output import digital_twin

    found = diagnosis()
    digital_twin.write_twin(digital_twin.twin_text(found.robot, found.fitted), path)


@sample("files/record.csv")
def write_whole_record(path: Path) -> None:
    """Write a record of every tap, under a controller, with its own reference noise."""
    from rotemina.sim.records.record import REFERENCE_NOISE
    from rotemina.sim.records.writing import write_record

    time_s = 0.001 * np.arange(8)
    signals = {
        ("q", tap): 0.01 * (number + 1) * np.sin(100.0 * time_s) for number, tap in enumerate(Tap)
    }
    metadata = {
        "mode": "closed_loop",
        "history": "periodic",
        "period_samples": "4",
        f"{REFERENCE_NOISE} q": "1e-09",
        "my key": "my value",
    }
    record = Record.from_signals(time_s, signals, {"q": "m"}, metadata)
    write_record(record, path, units={"q": "um"})


@sample("files/exported.csv")
def write_export(path: Path) -> None:
    """Export the recording."""
    from rotemina.app.motion.recording.exporting import export
    from rotemina.app.motion.recording.recording_reader import Recording

    export(Recording.open(needed(RECORDED)), path)


@sample("files/inverse.json")
def write_inverse(path: Path) -> None:
    """Train inverses in an instant."""
    from rotemina.sim.compensate import anfis
    from rotemina.sim.compensate.file import Provenance, Source, write_trained
    from rotemina.sim.compensate.samples import Samples
    from rotemina.sim.compensate.training import train

    rng = np.random.default_rng(0)
    turns = np.linspace(0.0, 40.0, 3000)
    command = 65e-6 * (0.5 - 0.4 * np.linspace(1.0, 0.2, 3000) * np.cos(turns))
    late = np.concatenate([np.zeros(2), command[:-2]])
    measured = 0.9 * command + 0.02 * late + 1e-9 * rng.standard_normal(3000)
    samples = Samples("run 7.csv", "zn", "m", 1e-3, command, measured)
    settings = anfis.Settings(memberships=3, plays=(0.05,), epochs=2, patience=2)
    about = Provenance(
        robot="RoTeMiNa",
        trained_on=[Source(name="run 7.csv", sha256="00112233" * 8, rows=3000)],
        held_out=[Source(name="run 8.csv", sha256="44556677" * 8, rows=100)],
        seed=3,
        versions={"rotemina": "0.1.0"},
    )
    trained = train(load_robot("rotemina"), [samples], settings=settings)
    write_trained(path, replace(trained, remarks=("the record is short",)), about)


@sample("files/tuning.toml")
def write_tuning(path: Path) -> None:
    """Write a front of two points."""
    from rotemina.sim.feedback.gains import AntiWindup, Gains, Notch
    from rotemina.sim.tuning.objectives import SecondObjective
    from rotemina.sim.tuning.pareto_front import Point
    from rotemina.sim.tuning.performance_figures import Figures
    from rotemina.sim.tuning.tuning_result import Provenance, Tuning, save_tuning

    gains = Gains(
        proportional=0.07,
        integral=1100.0,
        double_integral=300e3,
        derivative=1.7e-4,
        derivative_filter_s=4e-5,
        low_pass_hz=2000.0,
        notch=Notch(420.0, 0.8, 0.03),
        anti_windup=AntiWindup.CONDITIONAL,
        tracking_s=2e-3,
    )
    figures = Figures(
        tracking_rms=0.002,
        settling_s=0.03,
        overshoot=0.01,
        absolute_error=1e-7,
        effort=2.5,
        peak_sensitivity=1.4,
        limited=0.125,
    )
    source = Provenance(
        program="rotemina 0.1.0",
        robot="RoTeMiNa",
        effects=("creep on zn",),
        inverse="zn.json",
        generations=40,
        done=30,
        population=24,
        seed=3,
        against=SecondObjective.SETTLING,
        peak_sensitivity=1.6,
        overshoot=0.05,
        spread=0.1,
    )
    points = (Point(gains=gains, figures=figures), Point(gains=Gains(), figures=figures))
    tuning = Tuning(
        axis="zn",
        rate_hz=5000.0,
        delay=2,
        recommended=0,
        chosen=1,
        provenance=source,
        points=points,
    )
    save_tuning(tuning, path)


@sample("files/diagnosis_calibration.json")
def write_diagnosis_calibration(path: Path) -> None:
    """Copy the calibration that ``gap blind --calibrate`` has written for the program."""
    from importlib import resources

    from rotemina.sim.gap.compare.calibration import SHIPPED

    package, name = SHIPPED
    path.write_bytes(resources.files(package).joinpath(name).read_bytes())


@sample("files/cells.csv")
def write_cells(path: Path) -> None:
    """Export a list with a cell of each outcome."""
    from rotemina.app.files import write_text
    from rotemina.app.motion.penetration.cell_list import CellList, ListedCell, Outcome

    robot = load_robot("rotemina")
    cells = CellList()
    place = {axis: sum(one.range) / 2.0 for axis, one in robot.axes.items()}
    cells.cells = tuple(
        ListedCell(number, place, outcome, 4.5e-5, BEGAN.isoformat(), "a reason")
        for number, outcome in enumerate(Outcome, start=1)
    )
    write_text(path, cells.as_csv(robot))


def picture(number: int = 0) -> Any:
    """Return a small picture of 16 bits."""
    from rotemina.drivers.cameras.frame import Frame, Region

    pixels = (np.arange(48, dtype=np.uint16).reshape(6, 8) + number) * 50
    return Frame(pixels, 7.5 + number, number, 12, Region(1, 2, 8, 6), 0.02, 0, {"focus_m": 0.25})


def circumstances() -> Any:
    """Return all that is kept of a picture."""
    from rotemina.app.cameras.snapshot import Circumstances

    return Circumstances(
        taken=BEGAN.isoformat(),
        camera="simulated:1",
        objective="20x",
        gain=2.5,
        pixel_m=3.25e-7,
        command={"z": 0.01},
        measured={"z": 0.0101},
        recording="session.arrows",
    )


@sample("files/snapshot.tif")
def write_snapshot(path: Path) -> None:
    """Save a picture as the camera gave it."""
    from rotemina.app.cameras.snapshot import write_tiff

    write_tiff(path, picture(), circumstances())


@sample("files/snapshot.png")
def write_shown_picture(path: Path) -> None:
    """Save a picture as it was shown."""
    from rotemina.app.cameras.snapshot import write_png

    write_png(path, (picture().pixels // 10).astype(np.uint8), picture(), circumstances())


@sample("files/stack.tif")
def write_focus_stack(path: Path) -> None:
    """Save a stack of two pictures."""
    from rotemina.app.cameras.snapshot import Page, write_stack

    pages = [Page(0.01 + 1e-6 * n, picture(n), {"z": 0.01}, {"z": 0.0101}) for n in range(2)]
    write_stack(path, pages, "z", circumstances())


@sample("files/film.tif")
def write_film(path: Path) -> None:
    """Save a film of two pictures."""
    from rotemina.app.cameras.video_file import VideoFile

    film = VideoFile(path, {"camera": "simulated:1", "objective": "20x"}, 3.25e-7)
    for number in range(2):
        film.append(picture(number))
    film.close()


# --- what others read -----------------------------------------------------------------------------


def diagnosis() -> Any:
    """Return a diagnosis in which nothing is left out: three axes, none with the same verdict."""
    from rotemina.sim.effects.formulation import Stage
    from rotemina.sim.gap import diagnosis as gap
    from rotemina.sim.gap.location.located_gap import LocatedGap, Portion
    from rotemina.sim.gap.location.regimes import Regime
    from rotemina.sim.messages import message
    from rotemina.sim.robot.model import AxisEffect

    def place(axis: str, floor: float) -> LocatedGap:
        return LocatedGap(
            axis=axis,
            tap=Tap.MEAS,
            stage=Stage.ACTUATOR,
            gap_rms=10.0 * floor,
            noise_floor=floor,
            excess=99.0,
            excess_interval=(80.0, 120.0),
            by_regime={Regime.REVERSAL: Portion(0.8, (0.7, 0.9), 198.0)},
            by_band={(0.5, 4.0): Portion(0.9, (0.8, 1.0))},
        )

    width = gap.FittedParameter("width", 1.2e-4, "rad", (1.1e-4, 1.3e-4), "high")
    cause = gap.Cause(
        axis="thx",
        effect="hysteresis",
        formulation="prandtl_ishlinskii",
        stage=Stage.ACTUATOR,
        tap=Tap.MEAS,
        from_axis=None,
        probability=0.91,
        ambiguous_with=("creep",),
        gap_before=3.2e-5,
        gap_after=7.6e-7,
        closed=0.98,
        closed_interval=(0.97, 0.99),
        parameters=(width, gap.FittedParameter("shape", 4.0, "", None)),
        derived=(gap.Derived("stiffness", 2.5, (2.0, 3.0), "N/m"),),
        weight=0.75,
    )
    shrinkage = gap.Shrinkage(
        axis="thx",
        tap=Tap.MEAS,
        raw=3.3e-5,
        retuned=3.2e-5,
        corrected=7.7e-7,
        floor=4e-7,
        ceiling=5e-7,
        closed=0.97,
        closed_interval=(0.96, 0.98),
        steps=(gap.ShrinkageStep("hysteresis", "thx", 7.8e-7, 0.96),),
    )
    time_s = (0.0, 0.001, 0.002)
    command = (5.8e-4, 5.9e-4, 5.8e-4)
    experiment = gap.Experiment(
        axis="thx",
        splits=("hysteresis", "creep"),
        why=message("gap", "A step and a long rest: creep goes on, hysteresis does not."),
        time_s=time_s,
        commands={"thx": command},
        predictions={"hysteresis": command, "creep": command},
    )
    thx = gap.AxisDiagnosis(
        axis="thx",
        verdict=gap.Verdict.PARTLY,
        places=(place("thx", 4e-7),),
        causes=(cause,),
        shrinkage=(shrinkage,),
        ranking=(gap.Ranked("hysteresis", "prandtl_ishlinskii", None, 0.91, 1.2, (1.1, 1.3)),),
        remarks=(message("gap", "The rest depends on time."),),
        fitted=(
            AxisEffect(
                axis="thx",
                id="hysteresis",
                formulation="prandtl_ishlinskii",
                parameters={"width": 1.2e-4, "shape": 4.0},
            ),
            AxisEffect(
                axis="thx",
                id="cross_coupling",
                formulation="static",
                from_axis="zn",
                parameters={"k": 0.3},
            ),
        ),
        suspected=(gap.Suspected("creep", None, 0.25, in_model=False),),
        remainder=gap.Remainder(1e-6, 0.03, (("time", 0.5),)),
        offsets={Tap.MEAS: gap.Offset(1e-7, 1e-9), Tap.REF: None},
    )
    y = gap.AxisDiagnosis("y", gap.Verdict.NONE, (place("y", 2e-8),))
    zn = gap.AxisDiagnosis("zn", gap.Verdict.INSUFFICIENT, ())
    robot = load_robot("rotemina")
    axes = {"thx": thx, "y": y, "zn": zn}
    return gap.Diagnosis(robot, axes, experiments=(experiment,), seed=3)


@output("gap.json")
def gap_document() -> Any:
    """Return what ``gap diagnose --json`` writes; it is read again too."""
    from rotemina.sim.gap.output.document import ExperimentFiles, as_json

    files = ExperimentFiles("gap_experiment_1.csv", {"creep": "gap_experiment_1_creep.csv"})
    return as_json(diagnosis(), [files])


@output("comparison.json")
def comparison_document() -> Any:
    """Return what an offscreen run and ``compare --json`` write."""
    from rotemina.sim.comparison.comparison import compare

    return compare(load_robot("rotemina"), _measured(0.01), fit=("gain", "offset")).as_json()


@output("comparison_of_runs.json")
def comparison_of_runs_document() -> Any:
    """Return what ``compare --with --json`` writes."""
    from rotemina.sim.comparison.run_comparison import compare_runs

    return compare_runs(load_robot("rotemina"), _measured(0.01), _measured(0.02)).as_json()


def _measured(error: float) -> Record:
    """Return a record of all axes, whose readings are off by a share."""
    robot = load_robot("rotemina")
    time_s = 0.001 * np.arange(50)
    bow = 0.5 - 0.5 * np.cos(2.0 * np.pi * time_s / time_s[-1])
    signals = {}
    for name, axis in robot.axes.items():
        move = 0.01 * axis.span * bow
        signals[name, Tap.CMD] = sum(axis.range) / 2.0 + move
        signals[name, Tap.MEAS] = sum(axis.range) / 2.0 + (1.0 + error) * move
    units = {name: robot.unit(name) or "m" for name in robot.axes}
    return Record.from_signals(time_s, signals, units)


@output("bench.json")
def bench_document() -> Any:
    """Return what ``gap bench --json`` writes: of a diagnosed machine, and one not run."""
    from argparse import Namespace

    from rotemina.app.bench import bench_run
    from rotemina.app.bench.machine import Machine, Truth
    from rotemina.app.bench.residual import Residual
    from rotemina.app.bench.result import NamedCause, Result

    truth = Truth(causes=(("hysteresis",),), also=("creep",), to_beat=2e-6)
    machine = Machine("table", Path("robot.toml"), (), (), truth)
    cause = NamedCause("x", "backlash", 0.9, ("friction",))
    before, after = Residual(1e-3, 1e-2, 1e-5), Residual(2e-5, 1e-2, 1e-5)
    done = Result(machine, "A table", "explained", (cause,), before, after, 12.5, "m")
    results = {"table": done, "other": Result(replace(machine, name="other"), not_run="a reason")}
    with (
        TemporaryDirectory() as folder,
        mock.patch.object(
            bench_run, "machines", return_value=[one.machine for one in results.values()]
        ),
        mock.patch.object(bench_run, "result_of", lambda one, *_: results[one.name]),
    ):
        out = Path(folder) / "out.json"
        with redirect_stdout(StringIO()):
            bench_run.run_bench(
                Namespace(folders=[], jobs=1, longest=1.0, json=str(out), report=None)
            )
        return json.loads(out.read_text("utf-8"))


@output("blind.json")
def blind_document() -> Any:
    """Return what ``gap blind --json`` writes; it is read again too."""
    with TemporaryDirectory() as folder:
        test, out = Path(folder) / "test", Path(folder) / "out.json"
        shutil.copytree(needed("data/blind/RoTeMiNa-seed-7"), test)
        ask = ["gap", "blind", "--cases", "3", "--seed", "7", "--score"]
        _printed([*ask, "--folder", str(test), "--json", str(out)])
        return json.loads(out.read_text("utf-8"))


@output("calibration.json")
def calibration_document() -> Any:
    """Return what ``calibrate --json`` prints."""
    from rotemina.app.calibration.words import as_json
    from rotemina.sim.calibration.iso230 import Positioning
    from rotemina.sim.calibration.sensor import SensorModel
    from rotemina.sim.calibration.sensor_calibration import Calibration, Figure

    iso = Positioning(*(1e-8 * number for number in range(1, 9)))
    nothing = np.zeros(1)
    calibration = Calibration(
        axis="zn",
        unit="m",
        model=SensorModel(low=0.0, high=6.5e-5),
        travel=(1e-6, 6.4e-5),
        figures=(Figure("gain error", 0.0125, 1e-4, "1"), Figure("noise", 4e-10, np.nan, "m")),
        runs=3,
        before_rms=1e-7,
        after_rms=2e-9,
        position=nothing,
        before=nothing,
        after=nothing,
        reading_before=iso,
        reading_after=iso,
        reached=iso,
        notes=("the laser drifted",),
    )
    return as_json(calibration)


@output("calibrations.json")
def calibrations_document() -> Any:
    """Return what ``calibrate list --json`` prints, without its folder."""
    folder = needed("config/calibrations").parent
    told = _printed(["calibrate", "list", "--folder", str(folder), "--json"])
    found = json.loads(told)
    for row in found["calibrations"]:
        row["file"] = Path(row["file"]).name
    return found


@output("shown_calibration.json")
def shown_calibration_document() -> Any:
    """Return what ``calibrate show --json`` prints."""
    (file,) = (needed("config/calibrations") / "RoTeMiNa").glob("zn--*.toml")
    return json.loads(_printed(["calibrate", "show", str(file), "--json"]))


@output("inverses.json")
def inverses_document() -> Any:
    """Return what ``compensate train --json`` and ``compensate check --json`` write."""
    from rotemina.app.cli.compensate_table import document
    from rotemina.sim.compensate.file import read_trained

    trained, _ = read_trained(needed("files/inverse.json"))
    return document(trained.models[trained.chosen], trained.residuals, trained)


@output("tuning.json")
def tuning_document() -> Any:
    """Return what ``tune --json`` writes."""
    from rotemina.sim.tuning.tuning_result import document_of, load_tuning

    return document_of(load_tuning(needed("files/tuning.toml")))


@output("doctor.json")
def doctor_document() -> Any:
    """Return what ``doctor --json`` prints, of one finding."""
    from rotemina.app import machine_check

    finding = machine_check.Finding("serial ports", machine_check.State.BROKEN, "none", "plug in")
    with mock.patch.object(machine_check, "examine", return_value=iter([finding])):
        return json.loads(_printed(["doctor", "--json"]))


def _printed(arguments: list[str]) -> str:
    from rotemina.app.cli.main import main

    printed = StringIO()
    with redirect_stdout(printed):
        main(arguments)
    return printed.getvalue()


# --- making ---------------------------------------------------------------------------------------


def needed(name: str) -> Path:
    """Return a sample that another one is made of; it is made first where it is missing."""
    main([name])
    return HERE / name


def main(names: list[str]) -> None:
    """Make the samples that are missing."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    os.environ["LANGUAGE"] = "en"
    for name in names or MAKERS:
        path = HERE / name
        if path.exists():
            continue
        with TemporaryDirectory() as folder:  # where an error leaves nothing
            draft = Path(folder) / name
            draft.parent.mkdir(parents=True)
            MAKERS[name](draft)
            path.parent.mkdir(parents=True, exist_ok=True)
            shutil.move(draft, path)
        print(f"{name}: written")


if __name__ == "__main__":
    main(sys.argv[1:])
