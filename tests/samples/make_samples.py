"""Write the sample files in this folder: ``python tests/samples/make_samples.py [NAME …]``.

Every file that the program writes and reads again has a sample here, written by the program itself.
So has every JSON file that it writes for other programs. A sample is made once for each version of
its format and never changed, because it represents the files of users. If a sample can no longer
be read, change the program, not the sample. Therefore existing samples are never overwritten. A new
version of a format gets another sample with a new name.

Each kind of file has one function, which is registered with the name of its sample. The result is
the same each time, except for the version of the program, and modification times and sizes of its
modules. Only the preferences were written by a window with all panels; a new one is added by hand.
The folders are those of the program: ``config`` contains preferences, ``data`` records, ``files``
what a user saves anywhere, and ``outputs`` what other programs read.
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

from rotemina.app.settings import format_json
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

HERE = Path(__file__).parent
START_TIME = datetime(2026, 3, 4, 5, 6, 7, tzinfo=UTC)
STICK = "hid:046d:c215:0001"
#: A folder that exists on no machine, for stored paths.
RECORDS = Path("/records")
PLAYBACK_SAMPLE = "data/played/2026-03-04_05-06-07-000000_tour.csv.gz"
RECORDING_SAMPLE = "data/recordings/2026-03-04_05-06-07-000000_session.arrows"

Maker = Callable[[Path], None]
MAKERS: dict[str, Maker] = {}
OUTPUTS: dict[str, Callable[[], Any]] = {}


def sample(name: str) -> Callable[[Maker], Maker]:
    """Register a function that makes the sample of this name: a file, or all files of a folder."""

    def register(make: Maker) -> Maker:
        MAKERS[name] = make
        return make

    return register


def output(name: str) -> Callable[[Callable[[], Any]], Callable[[], Any]]:
    """Register a function that returns a JSON value for other programs."""

    def register(make: Callable[[], Any]) -> Callable[[], Any]:
        OUTPUTS[name] = make
        MAKERS[f"outputs/{name}"] = lambda path: path.write_text(
            format_json(make()) + "\n", "utf-8"
        )
        return make

    return register


@sample("config/profiles")
def write_profile(folder: Path) -> None:
    """Write a profile of two devices with every action."""
    from rotemina.app.motion.inputs.profile import save_profile

    save_profile(folder, make_profile())


def make_profile() -> Any:
    """Return a profile of two devices with every action."""
    from rotemina.app.motion.inputs import (
        ActionMapping,
        AxisMapping,
        DeviceMapping,
        InputProfile,
        OperatorAction,
        OperatorRole,
        SilencePolicy,
    )

    buttons = tuple(
        ActionMapping(control=f"button {number}", action=action)
        for number, action in enumerate(OperatorAction, start=1)
    )
    axis_action = ActionMapping(
        control="axis 3", action=OperatorAction.FINE, at=-0.6, hysteresis=0.2
    )
    first = DeviceMapping(
        key=STICK,
        axes=(
            AxisMapping(control="axis 1", drives="x"),
            AxisMapping(control="axis 2", drives="zn", inverted=True),
        ),
        actions=(*buttons, axis_action),
    )
    second = DeviceMapping(
        key="board:*", seat=OperatorRole.TRAINEE, when_silent=SilencePolicy.CONTINUE
    )
    return InputProfile(name="Two sticks", devices=(first, second))


@sample("config/calibrations")
def write_calibrations(folder: Path) -> None:
    """Write the calibration of a stick, and of two sensors, one of them in use."""
    from rotemina.app.calibration import CalibrationStore
    from rotemina.app.motion.inputs.axis_calibration import InputCalibrationFolder
    from rotemina.drivers.inputs import InputIdentity

    stick = InputIdentity(STICK, "a stick", "hid")
    InputCalibrationFolder(folder).save(stick, make_stick_calibration())
    store, calibrations = CalibrationStore(folder.parent, load_robot("rotemina")), {}
    for axis, calibration in make_sensor_calibrations().items():
        calibrations[axis] = store.save(calibration)
    store.select("zn", calibrations["zn"])


def make_stick_calibration() -> Any:
    """Return the calibration of an axis of a stick."""
    from rotemina.app.motion.inputs import InputAxisCalibration, InputCalibration

    axis = InputAxisCalibration(
        low=-0.9, centre=0.02, high=0.95, dead_zone=0.03, expo=0.4, inverted=True, travel_m=0.03
    )
    return InputCalibration(device=STICK, axes={"axis 1": axis})


def make_sensor_calibrations() -> dict[str, Any]:
    """Return the calibrations of the sensors of two axes."""
    from rotemina.app.calibration import CalibrationFile, SourceRecord
    from rotemina.app.calibration.files import IsoFigures, StoredFigure, StoredSensorModel

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
        date=START_TIME.isoformat(),
        travel=(1e-6, 6.4e-5),
        runs=3,
        before_rms=1e-7,
        after_rms=2e-9,
        sensor=StoredSensorModel(
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
            StoredFigure(name="gain error", value=0.0125, half_width=1e-4, unit="1"),
            StoredFigure(name="noise", value=4e-10, unit="m"),
        ),
        sources=(SourceRecord(name="run 7.csv.gz", digest="0123456789abcdef"),),
        notes=("the laser drifted",),
        iso_reading_before=IsoFigures(**figures),
        iso_reading_after=IsoFigures(**{name: 0.5 * value for name, value in figures.items()}),
        iso_reached=IsoFigures(**{name: 0.25 * value for name, value in figures.items()}),
    )
    x = replace(
        zn,
        axis="x",
        travel=(0.001, 0.05),
        sensor=StoredSensorModel(
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
    return {"x": x, "zn": zn}


@sample("config/health")
def write_health_cards(folder: Path) -> None:
    """Write two cards of an axis."""
    from rotemina.app.calibration import HealthBook
    from rotemina.sim.calibration import SensorFigureEstimate

    book = HealthBook(folder.parent, "RoTeMiNa")
    for day, gain in ((4, 0.98), (5, 0.97)):
        figures = (
            SensorFigureEstimate("static gain", gain, 0.002, "1"),
            SensorFigureEstimate("noise", 4e-10, 1e-11, "m"),
        )
        book.add("zn", figures, f"run {day}.csv", START_TIME.replace(day=day))


@sample("config/microscope")
def write_microscope(folder: Path) -> None:
    """Write the calibration of both stages and the focus, for a camera behind an objective."""
    from rotemina.app.microscope.calibration_file import save_calibration

    save_calibration(folder, make_microscope_calibration())


def make_microscope_calibration() -> Any:
    """Return the calibration of both stages and the focus."""
    from rotemina.app.microscope import calibration_file as file

    stage = file.StageCalibration(
        date=START_TIME.isoformat(),
        matrix=((3.1e6, 1.5e3), (-1.6e3, 3.2e6)),
        covariance=tuple(tuple(float(4 * i + j) for j in range(4)) for i in range(4)),
        tip_m=(0.01, 0.02, 0.03),
        tip_px=(320.5, 240.25),
        residual_px=0.125,
    )
    return file.MicroscopeCalibration(
        camera="opencv:0",
        objective="20x/0.4",
        view=file.CalibratedRegion(left=8, top=16, width=640, height=480),
        micro=stage,
        nano=replace(stage, tip_px=(321.5, 241.25)),
        focus=file.FocusCalibration(
            date=START_TIME.isoformat(), axis="z", sharpest=0.0125, uncertainty=2e-7
        ),
    )


@sample("config/positions")
def write_positions(folder: Path) -> None:
    """Write the three positions with their own buttons, and another one."""
    from rotemina.app.motion.session import (
        HOME,
        LOAD,
        WORK,
        SavedPositions,
    )

    robot = load_robot("rotemina")
    positions = SavedPositions(folder.parent, robot)
    for share, name in ((0.5, HOME), (0.25, LOAD), (0.75, WORK), (0.125, "dish B, cell 3")):
        position = {
            axis: entry.range[0] + share * (entry.range[1] - entry.range[0])
            for axis, entry in robot.axes.items()
        }
        positions.save(name, position)


@sample("config/scales.toml")
def write_scales(path: Path) -> None:
    """Write a scale of each coordinate of each mode."""
    from rotemina.app.motion.teleoperation import CoordinateScale, ModeScales
    from rotemina.app.motion.teleoperation.modes import SteeringModes
    from rotemina.app.motion.teleoperation.teleoperation_loop import DIRECT_MODE

    robot = load_robot("rotemina")
    modes, middle = (
        SteeringModes(robot),
        {name: sum(axis.range) / 2 for name, axis in robot.axes.items()},
    )
    scale = CoordinateScale(
        way=2e-4,
        speed=3e-4,
        time_constant_s=0.5,
        spring_hz=1.5,
        damping_ratio=0.75,
        contact_gain=0.25,
    )
    scales, coordinates = ModeScales(), {DIRECT_MODE: tuple(robot.axes)}
    coordinates |= {mode: tuple(modes.begin_mode(mode, middle).coordinates) for mode in modes.names}
    for mode, names in coordinates.items():
        for name in names:
            scales = scales.with_scale(mode, name, scale)
    scales.save(path)


@sample("config/penetration.toml")
def write_penetration_parameters(path: Path) -> None:
    """Write parameters that all differ from the presets."""
    make_penetration_parameters().save(path)


def make_penetration_parameters() -> Any:
    """Return parameters that all differ from the presets."""
    from rotemina.app.motion.penetration import (
        CellDirection,
        InputShaping,
        PenetrationParameters,
        ThrustShape,
    )

    return PenetrationParameters(
        axis="z",
        direction=CellDirection.UP,
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
        shaping=InputShaping.INVERSE,
        hold_s=0.25,
        inject_s=0.75,
        hold_after_s=1.25,
        retract_speed=2e-4,
        depth_tolerance=0.2,
        overload=2e-5,
        armed_s=30.0,
    )


@sample("data/penetrations.jsonl")
def write_penetrations(path: Path) -> None:
    """Write a run of each verdict, the first with all possible entries."""
    from rotemina.app.motion.penetration import RunLog

    log = RunLog(path)
    for run in make_penetrations():
        log.append(run)


def make_penetrations() -> list[Any]:
    """Return a run of each verdict, the first with all possible entries."""
    from dataclasses import asdict

    from rotemina.app.motion.penetration import (
        PenetrationPhase,
        PenetrationRun,
        PenetrationVerdict,
    )
    from rotemina.app.motion.penetration.thrust import MeasuredThrust

    phases = tuple((str(phase), 0.25 * number) for number, phase in enumerate(PenetrationPhase))
    run = PenetrationRun(
        started=START_TIME.isoformat(),
        robot="RoTeMiNa",
        driver="simulator",
        parameters=asdict(make_penetration_parameters()),
        verdict=PenetrationVerdict.DONE,
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
        thrust=MeasuredThrust(
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
    incomplete_run = replace(run, thrust=None, phases=phases[:3], contact=None, gave_way=None)
    verdicts = PenetrationVerdict.ABORTED, PenetrationVerdict.FAILED, PenetrationVerdict.HELD
    return [
        run,
        *(replace(incomplete_run, verdict=v, reason=f"it was {v}") for v in verdicts),
    ]


@sample(PLAYBACK_SAMPLE)
def write_playback(path: Path) -> None:
    """Play a motion on a machine with an inverse, a loop, a calibration and an effect."""
    from rotemina.app.motion.model import NOTED_KEY
    from rotemina.sim.records import write_record

    record = make_played_record()
    start = {"began": START_TIME.isoformat(timespec="milliseconds")}
    note = {NOTED_KEY: "contact of zn"}
    write_record(replace(record, metadata={**record.metadata, **start, **note}), path)


def make_played_record() -> Record:
    """Return the record of a short playback of two axes."""
    from rotemina.app.motion.device import AppliedCalibration
    from rotemina.app.motion.session import MotionSession, NamedInverse, NamedRegulation
    from rotemina.app.motion.state import PlaybackFinished, RunLabels
    from rotemina.drivers.contract import VirtualClock
    from rotemina.drivers.simulator import Simulator
    from rotemina.sim.calibration import SensorModel
    from rotemina.sim.compensate import InverseModel
    from rotemina.sim.feedback import AxisRegulation, ControllerGains
    from rotemina.sim.robot import AxisEffect

    robot = load_robot("rotemina")
    zn, thx = robot.axes["zn"], robot.axes["thx"]
    clock = VirtualClock(7.0)
    worn_robot = replace(
        robot, effects=(AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),)
    )
    session = MotionSession(Simulator(worn_robot, {"settle_s": 0.02}, clock=clock))
    events: list[Any] = []
    session.subscribe(events.append)

    def wait(seconds: float) -> None:
        for _ in range(round(seconds / 0.02)):
            clock.advance(0.02)
            session.run_once()

    session.connect()
    wait(0.1)
    session.labels = RunLabels("run 7", "an operator", "dish B")
    inverse_model = InverseModel(
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
    session.inverses.apply(NamedInverse(inverse_model, robot.name, "Prandtl-Ishlinskii, zn.json"))
    wait(0.2)
    regulation = AxisRegulation(robot, "thx", ControllerGains(integral=5.0), 1000.0)
    session.loops.apply(NamedRegulation(regulation, "thx.toml, point 0"))
    sensor = SensorModel(low=thx.range[0], high=thx.range[1], gain_error=0.01)
    calibration = AppliedCalibration("2026-03-04 01234567", sensor, thx.range)
    session.corrections.set_calibration("thx", calibration)
    wait(0.2)
    time_s = 0.001 * np.arange(60)
    curve = 0.5 - 0.5 * np.cos(2.0 * np.pi * time_s / time_s[-1])
    signals = {
        (name, Tap.CMD): sum(axis.range) / 2.0 + 0.01 * axis.span * curve
        for name, axis in (("thx", thx), ("zn", zn))
    }
    metadata = {"trajectory": "tour"}
    session.play(Record.from_signals(time_s, signals, {"thx": "rad", "zn": "m"}, metadata))
    wait(4.0)
    session.close()
    (finished_event,) = (
        event for event in events if isinstance(event, PlaybackFinished) and event.shown
    )
    assert finished_event.record is not None
    return finished_event.record


@sample(RECORDING_SAMPLE)
def write_recording(path: Path) -> None:
    """Record a session with sticks, a tip, all kinds of events and all entries of the state."""
    _record(path)


@sample("data/recordings/2026-03-04_06-07-08-000000.arrows.part")
def write_interrupted_recording(path: Path) -> None:
    """Write a recording as it is after a crash."""
    _record(path.with_suffix(""), ended=False)


def _record(path: Path, *, ended: bool = True) -> None:
    from rotemina.app.motion.inputs import Intent, OperatorAction
    from rotemina.app.motion.recording import SessionRecorder, writer
    from rotemina.app.motion.session import MotionSession
    from rotemina.app.motion.state import (
        AlarmRaised,
        CommandRefused,
        FaultRaised,
        PlaybackFinished,
        RunLabels,
    )
    from rotemina.drivers.contract import VirtualClock
    from rotemina.drivers.simulator import Simulator

    clock = VirtualClock(7.0)
    settings = {"settle_s": 0.02, "sample_rate_hz": 100.0}
    driver = Simulator(load_robot("xyz"), settings, clock=clock)
    session = MotionSession(driver, local_time=lambda: START_TIME)
    session.labels = RunLabels("run 7", "an operator", "dish B")
    session.connect()
    session.run_once()
    with mock.patch.object(writer, "uuid4", return_value=mock.Mock(hex="00112233" * 4)):
        recorder = SessionRecorder(
            session,
            path,
            settings={"control.speed": 0.25},
            began=START_TIME.isoformat(timespec="seconds"),
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
            now_s, held_actions = clock(), frozenset({OperatorAction.DEAD_MAN})
            recorder.record_intent(Intent(now_s, {"x": 0.5}, held_actions, held_actions, STICK))
            recorder.record_values(f"input {STICK}", now_s, {"axis 1": 0.5, "button 1": 1.0})
            recorder.record_values("tip", now_s, {"x": 12.5, "y": -3.5, "quality": 0.75})
            recorder.record_note("a note")
        clock.advance(0.02)
        session.run_once()
    recorder._on_event(FaultRaised("the amplifier is off"))
    recorder._on_event(CommandRefused("the axis is not homed"))
    recorder._on_event(AlarmRaised("a reading is out of bounds"))
    recorder._on_event(PlaybackFinished(None, completed=True))
    _record_full_state(recorder, session)
    recorder.writer.run_once()
    if ended:
        recorder.close()
    else:
        recorder.writer._file.close()
    session.close()


def _record_full_state(recorder: Any, session: Any) -> None:
    """Record a state in which every stored entry differs from its initial value."""
    from rotemina.app.motion.state import StateChanged, StopRequest
    from rotemina.drivers.contract import DeviceState

    state = replace(
        session.snapshot(),
        activity=DeviceState.FAULT,
        progress=0.75,
        position_known=True,
        fault="the amplifier is off",
        lock_reason="the device reports a fault",
        unhomed=("x",),
        silent_s=1.5,
        stopping=True,
        stop=StopRequest("operator", "a hand in the way", START_TIME),
        latch_reason="the emergency stop was pressed",
        differences=("x: 1 instead of 2",),
        model_id="corrected-00112233",
        unsettled=("y",),
    )
    recorder._on_event(StateChanged(state))


@sample("data/records.sqlite3")
def write_library(path: Path) -> None:
    """Write the list of the records in the folder and of one elsewhere, with all entries."""
    from rotemina.app.motion.model import ModelInUse
    from rotemina.app.motion.playback import compare_with_model
    from rotemina.app.records import (
        LibraryEntry,
        RecordCatalogue,
        RecordKind,
        RecordStore,
        WorstGap,
    )
    from rotemina.drivers.simulator import Simulator
    from rotemina.sim.records import read_record

    robot, data = load_robot("rotemina"), path.parent
    for name in (PLAYBACK_SAMPLE, RECORDING_SAMPLE):
        (data.parent / name).parent.mkdir()
        shutil.copyfile(ensure_sample(name), data.parent / name)
        os.utime(data.parent / name, (START_TIME.timestamp(),) * 2)
    library = RecordCatalogue(data)
    library.refresh()
    playback = next(entry for entry in library.entries if entry.kind is RecordKind.PLAYBACK)
    record = read_record(playback.path, robot=robot)
    run = compare_with_model(ModelInUse.make_nominal(Simulator(robot)), "tour", record)
    library.set_gap(playback.path, run, robot)
    library.set_texts(playback.id, name="The first tour", note="the dish was warm")
    external_entry = LibraryEntry(
        path=RECORDS / "run 7.csv",
        kind=RecordKind.FILE,
        size=1234,
        stamp=1_772_600_767_000_000_000,
        digest="00112233445566778899aabbccddeeff",
        began=START_TIME,
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
    RecordStore(data).put([external_entry])


@sample("data/blind/RoTeMiNa-seed-7")
def write_blind_test(folder: Path) -> None:
    """Run two of three cases of a blind test, with a fixed diagnosis."""
    from rotemina.app.blind import CaseShard, resumable_run
    from rotemina.app.blind.cases import GeneratedCaseSource
    from rotemina.app.blind.classifier import load_or_train_classifier
    from rotemina.app.blind.diagnosis_process import BlindAnswer
    from rotemina.app.blind.naive_methods import CONTESTANTS
    from rotemina.sim.gap.output import as_json

    document = as_json(make_diagnosis())

    def answer(case: Any) -> BlindAnswer:
        predicted = gzip.decompress(case.measured.read_bytes())
        return BlindAnswer(document, "00112233" * 8, 12.5, predicted)

    run = resumable_run.ResumableBlindRun(folder, GeneratedCaseSource("rotemina", 3, 7))
    naive_answers = {name: {"verdict": "none", "causes": []} for name in CONTESTANTS}
    with mock.patch.object(resumable_run.secrets, "token_hex", lambda size: "5a" * size):
        for name in run.list_pending(CaseShard())[:2]:
            run.run_case(name, answer, lambda _: naive_answers)
    load_or_train_classifier(load_robot("rotemina"), folder / "classifier.npz", 3)


@sample("files/robot.toml")
def write_robot_file(path: Path) -> None:
    """Write a robot file with every kind of axis and every table."""
    from rotemina.sim.robot_files import write_robot

    write_robot(make_robot(), path)


def make_robot() -> Any:
    """Return a robot with every kind of axis and every table."""
    from rotemina.sim.robot import model, plate

    sensor = model.AxisSensor(kind="linear encoder", resolution=1e-8, noise_rms=2e-8)
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
    ring = plate.PlateCutout(
        kind="slot",
        count=6,
        start=0.125,
        inner_radius=0.008,
        outer_radius=0.014,
        width=0.25,
        twist=0.5,
    )
    holes = plate.PlateCutout(kind="hole", count=12, circle_radius=0.0158, radius=0.0005)
    return model.Robot(
        name="Everything",
        axes=axes,
        stages={"coarse": ("table",), "fine": ("tilt", "still")},
        couplings=(model.AxisCoupling(matrix="M", axes=("table", "tilt"), value=1e-4),),
        pin_length=0.05,
        piezo_lever_arm=0.011,
        reference=model.ReferenceSensor(noise_rms=model.ReferenceNoise(linear=1e-9, angular=2e-9)),
        tool=model.RobotTool(approach_angle=0.75),
        microscope=model.RobotMicroscope(
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
            hub=plate.PlateHub(mass=0.125, inertia=2e-5, product=2e-7),
            pin=plate.PlatePin(
                length=0.06,
                diameter=0.004,
                youngs_modulus=2.1e11,
                poissons_ratio=0.3,
                density=7800.0,
                yield_stress=8e8,
            ),
            joint=plate.PinJoint(friction=0.2, clamp_force=900.0, arm=0.003),
        ),
        effects=(
            model.AxisEffect(axis="table", id="cross_coupling", from_axis="tilt"),
            model.AxisEffect(
                axis="tilt",
                id="hysteresis",
                formulation="bouc_wen",
                parameters={"width": 1.1e-4},
                enabled=False,
            ),
        ),
    )


@sample("files/effects.toml")
def write_effects(path: Path) -> None:
    """Write a robot file with every formulation of every effect, with all parameters."""
    from rotemina.sim.effects import AttachedEffect, is_built_in, list_effect_ids, load_effect
    from rotemina.sim.errors import EffectError
    from rotemina.sim.robot import AxisEffect
    from rotemina.sim.robot_files import write_robot

    rotemina = load_robot("rotemina")
    robot = replace(
        rotemina,
        name="All effects",
        axes={**rotemina.axes, **load_robot("emps").axes},
        couplings=rotemina.couplings,
    )

    def attach_effect(effect: str, formulation: str) -> AxisEffect:
        for axis, source in (
            (axis, source) for source in (None, "x") for axis in reversed(robot.axes)
        ):
            axis_effect = AxisEffect(
                axis=axis, id=effect, formulation=formulation, from_axis=source
            )
            try:
                return replace(
                    axis_effect,
                    parameters=AttachedEffect.of(robot, axis_effect).values,
                    enabled=False,
                )
            except EffectError:
                continue
        raise AssertionError(f"{effect} {formulation}: no axis")

    effects = tuple(
        attach_effect(name, formulation.name)
        for name in filter(is_built_in, list_effect_ids())
        for formulation in load_effect(name).formulations
    )
    write_robot(replace(robot, effects=effects), path)


@sample("files/twin.toml")
def write_twin(path: Path) -> None:
    """Write a model that was corrected by a diagnosis."""
    from rotemina.sim.gap.output import digital_twin

    result = make_diagnosis()
    digital_twin.write_twin(digital_twin.make_twin_text(result.robot, result.fitted), path)


@sample("files/record.csv")
def write_whole_record(path: Path) -> None:
    """Write a record with all taps and a controller, and with its own reference noise."""
    from rotemina.sim.records import REFERENCE_NOISE_KEY, write_record

    time_s = 0.001 * np.arange(8)
    signals = {
        ("q", tap): 0.01 * (number + 1) * np.sin(100.0 * time_s) for number, tap in enumerate(Tap)
    }
    metadata = {
        "mode": "closed_loop",
        "history": "periodic",
        "period_samples": "4",
        f"{REFERENCE_NOISE_KEY} q": "1e-09",
        "my key": "my value",
    }
    record = Record.from_signals(time_s, signals, {"q": "m"}, metadata)
    write_record(record, path, units={"q": "um"})


@sample("files/exported.csv")
def write_export(path: Path) -> None:
    """Export the recording."""
    from rotemina.app.motion.recording import Recording
    from rotemina.app.motion.recording.exporting import export_record

    export_record(Recording.open(ensure_sample(RECORDING_SAMPLE)), path)


@sample("files/inverse.json")
def write_inverse(path: Path) -> None:
    """Write inverses after a very short training."""
    from rotemina.sim.compensate import (
        InverseProvenance,
        InverseSource,
        TrainingSamples,
        anfis,
        train,
        write_trained,
    )

    rng = np.random.default_rng(0)
    phase = np.linspace(0.0, 40.0, 3000)
    command = 65e-6 * (0.5 - 0.4 * np.linspace(1.0, 0.2, 3000) * np.cos(phase))
    delayed_command = np.concatenate([np.zeros(2), command[:-2]])
    measured = 0.9 * command + 0.02 * delayed_command + 1e-9 * rng.standard_normal(3000)
    samples = TrainingSamples("run 7.csv", "zn", "m", 1e-3, command, measured)
    settings = anfis.AnfisSettings(memberships=3, plays=(0.05,), epochs=2, patience=2)
    provenance = InverseProvenance(
        robot="RoTeMiNa",
        trained_on=[InverseSource(name="run 7.csv", sha256="00112233" * 8, rows=3000)],
        held_out=[InverseSource(name="run 8.csv", sha256="44556677" * 8, rows=100)],
        seed=3,
        versions={"rotemina": "0.1.0"},
    )
    trained = train(load_robot("rotemina"), [samples], settings=settings)
    write_trained(path, replace(trained, remarks=("the record is short",)), provenance)


@sample("files/tuning.toml")
def write_tuning(path: Path) -> None:
    """Write a Pareto front of two points."""
    from rotemina.sim.tuning import save_tuning

    save_tuning(make_tuning(), path)


def make_tuning() -> Any:
    """Return a Pareto front of two points."""
    from rotemina.sim.feedback import ControllerGains, NotchFilter
    from rotemina.sim.feedback.gains import AntiWindup
    from rotemina.sim.tuning import FrontPoint, SecondObjective, TuningResult
    from rotemina.sim.tuning.performance_figures import TuningFigures
    from rotemina.sim.tuning.tuning_result import TuningProvenance

    gains = ControllerGains(
        proportional=0.07,
        integral=1100.0,
        double_integral=300e3,
        derivative=1.7e-4,
        derivative_filter_s=4e-5,
        low_pass_hz=2000.0,
        notch=NotchFilter(420.0, 0.8, 0.03),
        anti_windup=AntiWindup.CONDITIONAL,
        tracking_s=2e-3,
    )
    figures = TuningFigures(
        tracking_rms=0.002,
        settling_s=0.03,
        overshoot=0.01,
        absolute_error=1e-7,
        effort=2.5,
        peak_sensitivity=1.4,
        limited=0.125,
    )
    source = TuningProvenance(
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
    points = (
        FrontPoint(gains=gains, figures=figures),
        FrontPoint(gains=ControllerGains(), figures=figures),
    )
    return TuningResult(
        axis="zn",
        rate_hz=5000.0,
        delay=2,
        recommended=0,
        chosen=1,
        provenance=source,
        points=points,
    )


@sample("files/diagnosis_calibration.json")
def write_diagnosis_calibration(path: Path) -> None:
    """Copy the program's calibration, which ``gap blind --calibrate`` has written."""
    from importlib import resources

    from rotemina.sim.gap.compare.calibration import SHIPPED

    package, name = SHIPPED
    path.write_bytes(resources.files(package).joinpath(name).read_bytes())


@sample("files/cells.csv")
def write_cells(path: Path) -> None:
    """Export a list with a cell of each outcome."""
    from rotemina.app.motion.penetration import CellList, CellOutcome
    from rotemina.app.motion.penetration.cell_list import ListedCell
    from rotemina.app.settings import write_text

    robot = load_robot("rotemina")
    cells = CellList()
    position = {name: sum(axis.range) / 2.0 for name, axis in robot.axes.items()}
    cells.cells = tuple(
        ListedCell(number, position, outcome, 4.5e-5, START_TIME.isoformat(), "a reason")
        for number, outcome in enumerate(CellOutcome, start=1)
    )
    write_text(path, cells.to_csv(robot))


def make_picture(number: int = 0) -> Any:
    """Return a small picture of 16 bits."""
    from rotemina.drivers.cameras import CameraFrame, SensorRegion

    pixels = (np.arange(48, dtype=np.uint16).reshape(6, 8) + number) * 50
    return CameraFrame(
        pixels, 7.5 + number, number, 12, SensorRegion(1, 2, 8, 6), 0.02, 0, {"focus_m": 0.25}
    )


def make_snapshot_metadata() -> Any:
    """Return metadata of a picture with all entries."""
    from rotemina.app.cameras import SnapshotMetadata

    return SnapshotMetadata(
        taken=START_TIME.isoformat(),
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
    """Save a picture with the camera's own numbers."""
    from rotemina.app.cameras import write_tiff

    write_tiff(path, make_picture(), make_snapshot_metadata())


@sample("files/snapshot.png")
def write_shown_picture(path: Path) -> None:
    """Save a picture as shown on the screen."""
    from rotemina.app.cameras import write_png

    write_png(
        path,
        (make_picture().pixels // 10).astype(np.uint8),
        make_picture(),
        make_snapshot_metadata(),
    )


@sample("files/stack.tif")
def write_focus_stack(path: Path) -> None:
    """Save a stack of two pictures."""
    from rotemina.app.cameras import StackPage, write_stack

    pages = [
        StackPage(0.01 + 1e-6 * n, make_picture(n), {"z": 0.01}, {"z": 0.0101}) for n in range(2)
    ]
    write_stack(path, pages, "z", make_snapshot_metadata())


@sample("files/film.tif")
def write_film(path: Path) -> None:
    """Save a film of two pictures."""
    from rotemina.app.cameras.video_file import VideoFile

    video = VideoFile(path, {"camera": "simulated:1", "objective": "20x"}, 3.25e-7)
    for number in range(2):
        video.append(make_picture(number))
    video.close()


def make_diagnosis() -> Any:
    """Return a diagnosis with all entries: three axes with different verdicts."""
    from rotemina.sim.effects import EffectStage
    from rotemina.sim.gap.location import GapPortion, LocatedGap, OperatingRegime
    from rotemina.sim.gap.result import diagnosis as gap
    from rotemina.sim.messages import message
    from rotemina.sim.robot import AxisEffect

    def make_place(axis: str, floor: float) -> LocatedGap:
        return LocatedGap(
            axis=axis,
            tap=Tap.MEAS,
            stage=EffectStage.ACTUATOR,
            gap_rms=10.0 * floor,
            noise_floor=floor,
            excess=99.0,
            excess_interval=(80.0, 120.0),
            by_regime={OperatingRegime.REVERSAL: GapPortion(0.8, (0.7, 0.9), 198.0)},
            by_band={(0.5, 4.0): GapPortion(0.9, (0.8, 1.0))},
        )

    width = gap.FittedParameter("width", 1.2e-4, "rad", (1.1e-4, 1.3e-4), "high")
    cause = gap.GapCause(
        axis="thx",
        effect="hysteresis",
        formulation="prandtl_ishlinskii",
        stage=EffectStage.ACTUATOR,
        tap=Tap.MEAS,
        from_axis=None,
        probability=0.91,
        ambiguous_with=("creep",),
        gap_before=3.2e-5,
        gap_after=7.6e-7,
        closed=0.98,
        closed_interval=(0.97, 0.99),
        parameters=(width, gap.FittedParameter("shape", 4.0, "", None)),
        derived=(gap.DerivedFigure("stiffness", 2.5, (2.0, 3.0), "N/m"),),
        weight=0.75,
    )
    shrinkage = gap.GapShrinkage(
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
    experiment = gap.SuggestedExperiment(
        axis="thx",
        splits=("hysteresis", "creep"),
        why=message("gap", "A step and a long rest: creep goes on, hysteresis does not."),
        time_s=time_s,
        commands={"thx": command},
        predictions={"hysteresis": command, "creep": command},
    )
    thx = gap.AxisDiagnosis(
        axis="thx",
        verdict=gap.GapVerdict.PARTLY,
        places=(make_place("thx", 4e-7),),
        causes=(cause,),
        shrinkage=(shrinkage,),
        ranking=(
            gap.RankedCandidate("hysteresis", "prandtl_ishlinskii", None, 0.91, 1.2, (1.1, 1.3)),
        ),
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
        suspected=(gap.SuspectedEffect("creep", None, 0.25, in_model=False),),
        remainder=gap.GapRemainder(1e-6, 0.03, (("time", 0.5),)),
        offsets={Tap.MEAS: gap.ModelOffset(1e-7, 1e-9), Tap.REF: None},
    )
    y = gap.AxisDiagnosis("y", gap.GapVerdict.NONE, (make_place("y", 2e-8),))
    zn = gap.AxisDiagnosis("zn", gap.GapVerdict.INSUFFICIENT, ())
    robot = load_robot("rotemina")
    axes = {"thx": thx, "y": y, "zn": zn}
    failed = gap.FailedStep("zn", ("delay",), "Singular matrix")
    return gap.Diagnosis(robot, axes, experiments=(experiment,), seed=3, failed=(failed,))


@output("gap.json")
def gap_document() -> Any:
    """Return the output of ``gap diagnose --json``, which the program also reads."""
    from rotemina.sim.gap.output import ExperimentFiles, as_json

    files = ExperimentFiles("gap_experiment_1.csv", {"creep": "gap_experiment_1_creep.csv"})
    return as_json(make_diagnosis(), [files])


@output("check.json")
def check_document() -> Any:
    """Return the output of ``gap check --json`` for visible and hidden effects."""
    from rotemina.app.cli.gap.gap_check import make_check_document
    from rotemina.sim.gap.experiment import AxisVisibility, EffectVisibility
    from rotemina.sim.gap.experiment.safe_tests import SafeTest
    from rotemina.sim.messages import message

    test = SafeTest(message("gap", "staircase"), _make_measured_record(0.0))
    effects = (
        EffectVisibility("hysteresis", None, 76.0),
        EffectVisibility("creep", None, 0.4, test, 5.0),
        EffectVisibility("cross_coupling", "x", 0.1),
    )
    return make_check_document([AxisVisibility("zn", effects, ("sensor_noise",))])


@output("comparison.json")
def comparison_document() -> Any:
    """Return the output of an offscreen run and of ``compare --json``."""
    from rotemina.sim.comparison import compare

    return compare(
        load_robot("rotemina"), _make_measured_record(0.01), fit=("gain", "offset")
    ).as_json()


@output("comparison_of_runs.json")
def comparison_of_runs_document() -> Any:
    """Return the output of ``compare --with --json``."""
    from rotemina.sim.comparison import compare_runs

    return compare_runs(
        load_robot("rotemina"), _make_measured_record(0.01), _make_measured_record(0.02)
    ).as_json()


def _make_measured_record(error: float) -> Record:
    """Return a record of all axes, whose readings have a gain error."""
    robot = load_robot("rotemina")
    time_s = 0.001 * np.arange(50)
    curve = 0.5 - 0.5 * np.cos(2.0 * np.pi * time_s / time_s[-1])
    signals = {}
    for name, axis in robot.axes.items():
        move = 0.01 * axis.span * curve
        signals[name, Tap.CMD] = sum(axis.range) / 2.0 + move
        signals[name, Tap.MEAS] = sum(axis.range) / 2.0 + (1.0 + error) * move
    units = {name: robot.unit(name) or "m" for name in robot.axes}
    return Record.from_signals(time_s, signals, units)


@output("bench.json")
def bench_document() -> Any:
    """Return the output of ``gap bench --json`` for a diagnosed machine and one not run."""
    from argparse import Namespace

    from rotemina.app.bench import bench_run
    from rotemina.app.bench.machine import BenchMachine, KnownCauses
    from rotemina.app.bench.residual import ModelResidual
    from rotemina.app.bench.result import BenchResult, NamedCause

    truth = KnownCauses(causes=(("hysteresis",),), optional_effects=("creep",), to_beat=2e-6)
    machine = BenchMachine("table", Path("robot.toml"), (), (), truth)
    cause = NamedCause("x", "backlash", 0.9, ("friction",))
    before, after = ModelResidual(1e-3, 1e-2, 1e-5), ModelResidual(2e-5, 1e-2, 1e-5)
    diagnosed = BenchResult(machine, "A table", "explained", (cause,), before, after, 12.5, "m")
    results = {
        "table": diagnosed,
        "other": BenchResult(replace(machine, name="other"), not_run="a reason"),
    }
    with (
        TemporaryDirectory() as folder,
        mock.patch.object(
            bench_run, "find_machines", return_value=[result.machine for result in results.values()]
        ),
        mock.patch.object(bench_run, "diagnose_machine", lambda machine, *_: results[machine.name]),
    ):
        out = Path(folder) / "out.json"
        with redirect_stdout(StringIO()):
            bench_run.run_bench(
                Namespace(folders=[], jobs=1, longest=1.0, json=str(out), report=None, against=None)
            )
        return json.loads(out.read_text("utf-8"))


@output("blind.json")
def blind_document() -> Any:
    """Return the output of ``gap blind --json``, which the program also reads."""
    with TemporaryDirectory() as folder:
        test, out = Path(folder) / "test", Path(folder) / "out.json"
        shutil.copytree(ensure_sample("data/blind/RoTeMiNa-seed-7"), test)
        arguments = ["gap", "blind", "--cases", "3", "--seed", "7", "--score"]
        _capture_output([*arguments, "--folder", str(test), "--json", str(out)])
        return json.loads(out.read_text("utf-8"))


@output("calibration.json")
def calibration_document() -> Any:
    """Return the output of ``calibrate --json``."""
    from rotemina.app.calibration import to_json
    from rotemina.sim.calibration import (
        PositioningFigures,
        SensorCalibration,
        SensorFigureEstimate,
        SensorModel,
    )

    iso = PositioningFigures(*(1e-8 * number for number in range(1, 9)))
    empty = np.zeros(1)
    calibration = SensorCalibration(
        axis="zn",
        unit="m",
        model=SensorModel(low=0.0, high=6.5e-5),
        travel=(1e-6, 6.4e-5),
        figures=(
            SensorFigureEstimate("gain error", 0.0125, 1e-4, "1"),
            SensorFigureEstimate("noise", 4e-10, np.nan, "m"),
        ),
        runs=3,
        before_rms=1e-7,
        after_rms=2e-9,
        position=empty,
        before=empty,
        after=empty,
        reading_before=iso,
        reading_after=iso,
        reached=iso,
        notes=("the laser drifted",),
    )
    return to_json(calibration)


@output("calibrations.json")
def calibrations_document() -> Any:
    """Return the output of ``calibrate list --json``, without its folder."""
    folder = ensure_sample("config/calibrations").parent
    printed_text = _capture_output(["calibrate", "list", "--folder", str(folder), "--json"])
    document = json.loads(printed_text)
    for row in document["calibrations"]:
        row["file"] = Path(row["file"]).name
    return document


@output("shown_calibration.json")
def shown_calibration_document() -> Any:
    """Return the output of ``calibrate show --json``."""
    (file,) = (ensure_sample("config/calibrations") / "RoTeMiNa").glob("zn--*.toml")
    return json.loads(_capture_output(["calibrate", "show", str(file), "--json"]))


@output("inverses.json")
def inverses_document() -> Any:
    """Return the output of ``compensate train --json`` and ``compensate check --json``."""
    from rotemina.app.cli.control.compensate_table import make_document
    from rotemina.sim.compensate import read_trained

    trained, _ = read_trained(ensure_sample("files/inverse.json"))
    return make_document(trained.models[trained.recommended_kind], trained.residuals, trained)


@output("tuning.json")
def tuning_document() -> Any:
    """Return the output of ``tune --json``."""
    from rotemina.sim.tuning import load_tuning, to_document

    return to_document(load_tuning(ensure_sample("files/tuning.toml")))


@output("doctor.json")
def doctor_document() -> Any:
    """Return the output of ``doctor --json`` with one finding."""
    from rotemina.app import system
    from rotemina.app.system.machine_check import CheckFinding

    finding = CheckFinding("serial ports", system.FindingState.BROKEN, "none", "plug in")
    # Commands import the name from the folder, which keeps what it has loaded once.
    with mock.patch.object(system, "run_checks", return_value=iter([finding])):
        return json.loads(_capture_output(["doctor", "--json"]))


def _capture_output(arguments: list[str]) -> str:
    from rotemina.app.cli.main import main

    printed = StringIO()
    with redirect_stdout(printed):
        main(arguments)
    return printed.getvalue()


def ensure_sample(name: str) -> Path:
    """Return the path of a sample that another one needs; make it if it is missing."""
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
        # A temporary folder, so that an error leaves no partial sample.
        with TemporaryDirectory() as folder:
            draft = Path(folder) / name
            draft.parent.mkdir(parents=True)
            MAKERS[name](draft)
            path.parent.mkdir(parents=True, exist_ok=True)
            shutil.move(draft, path)
        print(f"{name}: written")


if __name__ == "__main__":
    main(sys.argv[1:])
