"""Files that users have on their disks are read with what is in them; see ``tests/samples``."""

import ast
import dataclasses
import gzip
import importlib
import importlib.util
import json
import re
import shutil
import sqlite3
import tomllib
from collections import Counter
from collections.abc import Mapping
from contextlib import closing
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path

import cv2
import numpy as np
import pytest

from rotemina.app import driver_settings
from rotemina.app.blind.cases import GeneratedCases
from rotemina.app.blind.classifier import classifier_for
from rotemina.app.blind.naive_methods import CONTESTANTS
from rotemina.app.blind.resumable_run import BlindRun, finished
from rotemina.app.blind.shard import Shard
from rotemina.app.calibration.health_book import HealthBook
from rotemina.app.calibration.store import CalibrationStore
from rotemina.app.microscope.calibration_file import load as load_microscope
from rotemina.app.microscope.camera_memory import CameraMemory
from rotemina.app.microscope.microscope import FOLDER as MICROSCOPE
from rotemina.app.motion.compared_run import compared
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.motion.operation import PENETRATION, SCALES, Operation
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.run_log import RunLog, Verdict
from rotemina.app.motion.penetration.status import Phase
from rotemina.app.motion.recording.exporting import record_of
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import recover, unfinished
from rotemina.app.motion.recording.replay import Replay
from rotemina.app.motion.saved_positions import HOME, LOAD, WORK, SavedPositions
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection
from rotemina.app.motion.teleoperation.axis_calibration import CalibrationFolder
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.modes import Modes
from rotemina.app.motion.teleoperation.profile import (
    OperatorRole,
    SilencePolicy,
    listed_profiles,
)
from rotemina.app.motion.teleoperation.scales import Scale, Scales
from rotemina.app.motion.teleoperation.teleoperation_loop import DIRECT
from rotemina.app.range_settings import kept_ranges
from rotemina.app.recorded_events import Severity, timeline_events
from rotemina.app.records.database import RecordStore
from rotemina.app.records.entry import Kind
from rotemina.app.records.library import Library, read
from rotemina.app.settings import Settings
from rotemina.app.toml_file import Format
from rotemina.drivers.cameras.frame import Region
from rotemina.drivers.cameras.sequence import ImageSequences
from rotemina.drivers.cameras.settings import PixelType, Trigger
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.drivers.registry import driver_named
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.plugins.gap.blind_figures import BlindResult
from rotemina.sim.compensate.file import read_trained
from rotemina.sim.effects.registry import effect_ids, effect_named, is_built_in
from rotemina.sim.errors import InputError
from rotemina.sim.feedback.gains import AntiWindup, Gains
from rotemina.sim.gap.compare.calibration import calibration_in
from rotemina.sim.gap.diagnosis import Offset
from rotemina.sim.gap.diagnosis import Verdict as Found
from rotemina.sim.gap.output.document_reader import read_document
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import CascadeController
from rotemina.sim.tuning.objectives import SecondObjective
from rotemina.sim.tuning.tuning_result import load_tuning

ROOT = Path(__file__).parents[1]
SAMPLES = Path(__file__).parent / "samples"
CONFIG, FILES, OUTPUTS = SAMPLES / "config", SAMPLES / "files", SAMPLES / "outputs"
ROBOT = load_robot("rotemina")
BEGAN = datetime(2026, 3, 4, 5, 6, 7, tzinfo=UTC)
STICK = InputIdentity("hid:046d:c215:0001", "a stick", "hid")
LABELS = ("run 7", "an operator", "dish B")
BLIND = "blind/RoTeMiNa-seed-7"
STATES = {  # of the docks that show, by layout: at the left, at the right, at the bottom
    "My Operate": (
        ("control",),
        (),  # folded away
        ("trajectory", "comparison", "penetration", "recorder", "view3d"),
    ),
    "My Tune": (
        ("control",),
        ("connection",),
        ("identification", "calibration", "effects", "trajectory", "comparison"),
    ),
    "My Diagnose": (
        (),
        (),
        ("gap", "comparison", "trajectory", "effects", "faults", "recorder"),
    ),
    "My Set up": (
        ("control",),
        ("connection", "inputs", "teleoperation"),
        ("calibration", "plate", "faults"),
    ),
    "Faults & more": (
        ("control",),
        ("connection",),
        ("identification", "calibration", "trajectory", "comparison"),
    ),
}


def load_maker():
    """Import the script that has made the samples."""
    spec = importlib.util.spec_from_file_location("make_samples", SAMPLES / "make_samples.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


MAKER = load_maker()


@pytest.fixture
def config(tmp_path):
    """A user's folder of preferences, which may be written."""
    return Path(shutil.copytree(CONFIG, tmp_path / "config"))


@pytest.fixture
def data(tmp_path):
    """A user's folder of data, which may be written."""
    return Path(shutil.copytree(SAMPLES / "data", tmp_path / "data"))


@pytest.fixture
def settings(config):
    return Settings(config / "settings.json")


# --- preferences ----------------------------------------------------------------------------------


def test_preferences_of_the_machine(settings):
    assert not settings.fault
    ranges = kept_ranges(settings, load_robot(FILES / "robot.toml"))
    assert ranges == {"table": (0.01, 0.04), "tilt": (1e-4, 9e-4)}
    used = CameraMemory(settings).last
    assert (used.identity.key, used.identity.source) == ("sequence:/records/cells", "sequence")
    assert used.by_address
    kept = used.settings
    assert (kept.exposure_s, kept.gain, kept.rate_hz) == (0.02, 3.5, 12.5)
    assert kept.region == Region(8, 16, 640, 480)
    assert (kept.pixel_type, kept.trigger) == (PixelType.MONO16, Trigger.SOFTWARE)
    assert not kept.repeat


@pytest.mark.parametrize(
    ("driver", "values"),
    [
        ("gcode", ("ttyUSB7", 115_201, "CBAZYX", 0.135, 60.125, True)),
        ("mc68hc11", ("ttyUSB7", "ttyUSB7", 125_001, 0.375, 0.375, 0.1325)),
        ("simulator", (500.125, 1, 0.375, 0.375, False)),
    ],
)
def test_settings_of_drivers(settings, driver, values):
    assert tuple(driver_settings.kept(settings, driver_named(driver)).values()) == values


def test_preferences_of_the_window(settings, qtbot):
    from PySide6.QtWidgets import QWidget

    from rotemina.app.shell.language import chosen
    from rotemina.app.shell.layouts import KeptLayouts
    from rotemina.app.shell.recent_files import RecentFiles
    from rotemina.plugins.microscope.overlays import Layer

    parent = QWidget()
    qtbot.addWidget(parent)
    uses = dict.fromkeys(("trajectory", "record"), ("", print))
    listed = RecentFiles(settings, uses, parent).listed
    assert [(kind, path.name) for kind, path in listed] == [
        ("trajectory", "tour.csv"),
        ("record", "run 7.csv.gz"),
    ]
    assert chosen(settings) == "de"
    assert set(KeptLayouts(settings).names()) == set(STATES)
    layers = {key for key in settings.values if key.startswith("microscope.layer.")}
    assert layers == {f"microscope.layer.{layer.name.lower()}" for layer in Layer}


@pytest.mark.parametrize("name", STATES)
def test_docks_stand_where_they_were_left(settings, qtbot, name):
    from PySide6.QtCore import Qt
    from PySide6.QtWidgets import QDockWidget, QMainWindow

    from rotemina.app.shell.layouts import VERSION, KeptLayouts

    window = QMainWindow()
    qtbot.addWidget(window)
    docks = {point.name: QDockWidget() for point in entry_points(group="rotemina.panels")}
    for panel, dock in docks.items():
        dock.setObjectName(f"dock-{panel}")
        window.addDockWidget(Qt.DockWidgetArea.LeftDockWidgetArea, dock)
        dock.hide()  # those of the centre have none
    assert window.restoreState(KeptLayouts(settings).state(name), VERSION)
    assert places(window, docks) == tuple(map(set, STATES[name]))
    assert docks["faults"].isFloating() == (name == "Faults & more")


def places(window, docks):
    """Return which docks show at the left, at the right and at the bottom."""
    from PySide6.QtCore import Qt

    area = Qt.DockWidgetArea
    areas = (area.LeftDockWidgetArea, area.RightDockWidgetArea, area.BottomDockWidgetArea)
    shown = {name: dock for name, dock in docks.items() if not dock.isHidden()}
    return tuple(
        {n for n, d in shown.items() if not d.isFloating() and window.dockWidgetArea(d) == each}
        for each in areas
    )


@pytest.mark.slow
@pytest.mark.every_panel
def test_a_window_looks_and_works_as_it_was_left(settings, make_robot_window, tmp_path):
    from rotemina.plugins.microscope.picture_section import LayerSection

    settings.set("window.language", "en")  # other tests of this process speak it
    shutil.copytree(SAMPLES / "data", tmp_path, dirs_exist_ok=True)
    window = make_robot_window()
    bench, panels = window.workbench, window.panels
    assert places(window, window.docks) == tuple(map(set, STATES["Faults & more"]))
    for name, state in STATES.items():
        window.arrangement.use_kept(name)
        assert places(window, window.docks) == tuple(map(set, state)), name
    assert bench.theme.name == "light"
    assert window.arrangement.text_scale == 1.15
    labels = bench.library.labels
    assert (labels.run, labels.operator, labels.sample) == LABELS
    assert len(window.recent_files.listed) == 2
    window.first_steps.offer()
    assert window.first_steps.isHidden()  # it was closed
    assert panels["control"].head.speed.share == 0.25
    boxes = window.findChild(LayerSection).boxes
    shown = {layer.name for layer, box in boxes.items() if box.isChecked()}
    assert shown == {"CROSSHAIR"}
    assert panels["inputs"]  # a panel that was not shown yet is made when it is asked for
    assert bench.operation.devices.profile.name == "Two sticks"
    assert not bench.operation.problems


# --- a user's folder ------------------------------------------------------------------------------


def test_an_operation_finds_all_files_of_its_user(config, data):
    session = MotionSession(Simulator(ROBOT))
    operation = Operation(session, config, data)
    try:
        assert operation.problems == []
        assert set(session.corrections.names) == {"zn"}
        assert [one.path.stem for one in operation.devices.profiles] == ["Two sticks"]
        assert operation.penetration_parameters.axis == "z"
        assert len(operation.penetration_log.read()[0]) == 4
        assert operation.teleoperator.scales.modes
        assert len(list(operation.recordings.glob("*.arrows"))) == 1
    finally:
        operation.close()
        session.close()


def test_a_profile(config):
    (listed,) = listed_profiles(config / "profiles")
    assert listed.problem is None
    assert listed.profile.name == "Two sticks"
    first, second = listed.profile.devices
    assert (first.key, first.seat, first.when_silent) == (
        STICK.key,
        OperatorRole.TRAINER,
        SilencePolicy.STOP,
    )
    assert (second.seat, second.when_silent) == (OperatorRole.TRAINEE, SilencePolicy.CONTINUE)
    assert [(one.control, one.drives, one.inverted) for one in first.axes] == [
        ("axis 1", "x", False),
        ("axis 2", "zn", True),
    ]
    *buttons, beyond = first.actions
    assert {one.action for one in buttons} == set(Action)
    assert (beyond.control, beyond.action, beyond.at, beyond.hysteresis) == (
        "axis 3",
        Action.FINE,
        -0.6,
        0.2,
    )


def test_the_calibration_of_a_stick(config):
    found = CalibrationFolder(config / "calibrations").read(STICK).axis("axis 1")
    assert (found.low, found.centre, found.high) == (-0.9, 0.02, 0.95)
    assert (found.dead_zone, found.expo, found.inverted) == (0.03, 0.4, True)
    assert found.travel_m == 0.03


def test_calibrations_of_sensors(config):
    stored, problems = CalibrationStore(config, ROBOT).listed()
    assert problems == ()
    by_axis = {one.calibration.axis: one for one in stored}
    assert {axis: one.on for axis, one in by_axis.items()} == {"x": False, "zn": True}
    zn, x = by_axis["zn"].calibration, by_axis["x"].calibration
    # Records name it by its digest.
    assert zn.name == "2026-03-04T05:06:07+00:00 aab6493f"
    assert (zn.before_rms, zn.after_rms, zn.runs, zn.notes) == (
        1e-7,
        2e-9,
        3,
        ("the laser drifted",),
    )
    model = zn.applied.model
    assert (model.gain_error, model.bend, model.weights) == (0.0125, (2e-8, -1e-8), (0.01, 0.02))
    assert (model.lag, model.lag_s) == ("first_order", 1e-4)
    assert x.sensor.model.lag == "delay"
    assert x.sensor.harmonics == (1e-8, 2e-8, 3e-9, 4e-9)
    assert [(one.value, one.half_width) for one in zn.figures] == [(0.0125, 1e-4), (4e-10, None)]
    assert (zn.sources[0].name, zn.sources[0].digest) == ("run 7.csv.gz", "0123456789abcdef")
    assert zn.iso_reached.figures.accuracy == 1e-7
    assert zn.iso_reading_before.figures.mean_reversal == -2e-8


def test_health_cards(config):
    first, second = HealthBook(config, ROBOT.name).cards("zn")
    assert (first.date[:10], first.record) == ("2026-03-04", "run 4.csv")
    assert second.figures[0] == ("static gain", 0.97, 0.002, "1")


def test_the_calibration_of_a_microscope(config):
    found = load_microscope(config / MICROSCOPE, "opencv:0", "20x/0.4")
    assert found.view.holds(np.array([639.0, 479.0]))
    assert found.stage("micro").map.matrix.tolist() == [[3.1e6, 1.5e3], [-1.6e3, 3.2e6]]
    assert found.stage("micro").map.covariance[1, 2] == 6.0
    assert found.stage("nano").pixel_of(np.array([0.01, 0.02, 0.0])).tolist() == [321.5, 241.25]
    assert (found.focus.axis, found.focus.sharpest) == ("z", 0.0125)


def test_saved_positions(config):
    positions = SavedPositions(config, ROBOT)
    positions.read()
    assert set(positions.kept) == {HOME, LOAD, WORK, "dish B, cell 3"}
    assert positions.kept[LOAD]["x"] == 0.01375


def test_scales_of_every_mode(config):
    operation = Operation(MotionSession(Simulator(ROBOT)), config, config)
    scales, modes = operation.teleoperator.scales, Modes(ROBOT)
    operation.close()
    middle = {name: sum(axis.range) / 2.0 for name, axis in ROBOT.axes.items()}
    scale = Scale(
        way=2e-4,
        speed=3e-4,
        time_constant_s=0.5,
        spring_hz=1.5,
        damping_ratio=0.75,
        contact_gain=0.25,
    )
    for mode in modes.names:
        for coordinate in modes.begin(mode, middle).coordinates.values():
            assert scales.of(mode, coordinate) == scale
    assert set(scales.modes) == {*modes.names, DIRECT}


def test_parameters_of_a_penetration(config):
    found = PenetrationParameters.load(config / "penetration.toml")
    assert found == MAKER.penetration_parameters()
    assert (found.direction, found.shape, found.shaping) == ("up", "table", "inverse")


# --- a user's data --------------------------------------------------------------------------------


def test_runs_of_penetrations(data):
    runs, problems = RunLog(data / "penetrations.jsonl").read()
    assert problems == ()
    assert {run.verdict for run in runs} == set(Verdict)
    assert {name for name, _ in runs[0].phases} == set(Phase)
    assert (runs[0].run, runs[0].operator, runs[0].sample) == LABELS
    assert runs[0].thrust.depth == 4.9e-5
    assert runs[0].contact_height == 0.0125
    assert runs[0].gave_way is True
    assert runs[1].thrust is None
    # A panel offers to use them again.
    assert PenetrationParameters(**runs[0].parameters) == MAKER.penetration_parameters()


def test_a_playback_with_all_its_metadata(data):
    record = read_record(data / "played/2026-03-04_05-06-07-000000_tour.csv.gz", robot=ROBOT)
    assert record.axes == ("thx", "zn")
    assert len(record.time_s) == 60
    assert record.signal("zn", Tap.U)[0] == 62.263157894736835
    assert record.history == "unknown"
    about = record.metadata
    assert about["trajectory"] == "tour"
    assert about["calibration thx"] == "2026-03-04 01234567"
    assert about["noted"] == "contact of zn"
    assert {"began", "robot", "robot_sha256", "driver", "model", "effects"} <= set(about)
    assert (about["run"], about["operator"], about["sample"]) == LABELS
    run = compared(ModelInUse.nominal_of(Simulator(ROBOT)), "tour", record)
    assert set(run.gaps) >= {("thx", Tap.MEAS), ("zn", Tap.MEAS)}


def test_a_recording(data):
    (path,) = (data / "recordings").glob("*.arrows")
    check_recording(Recording.open(path))


def test_an_interrupted_recording(data):
    (path,) = unfinished(data / "recordings")
    check_recording(Recording.open(recover(path)))


def check_recording(recording):
    robot = load_robot("xyz")
    assert recording.robot.name == robot.name
    assert dict(recording.units) == {"x": "m", "y": "m", "z": "m"}
    assert tuple(recording.metadata[key] for key in ("run", "operator", "sample")) == LABELS
    assert json.loads(recording.metadata["settings"]) == {"control.speed": 0.25}
    assert recording.count == 30
    samples = recording.samples()
    assert np.ptp(samples.command, axis=0).tolist() == pytest.approx([1e-5, 0.0, 0.0])
    assert set(recording.channels) == {"clock", f"input {STICK.key}", "intent", "tip"}
    assert recording.channel("tip")["quality"].tolist() == [0.75]
    assert record_of(recording).has("x", Tap.MEAS)
    told = timeline_events(recording.events(), recording.began_s)
    words = Counter(one.word for one in told if one.weight is not Severity.DETAIL)
    assert words["Fault"] == words["Refused"] == words["Stop"] == words["Note"] == 1
    replay = Replay(recording)
    replay.seek(recording.ended_s)
    state = replay.snapshot()
    assert (state.connection, state.activity) == (Connection.CONNECTED, DeviceState.FAULT)
    assert (state.fault, state.latched) == (
        "the amplifier is off",
        "the emergency stop was pressed",
    )
    assert (state.unhomed, state.differences, state.unsettled) == (
        ("x",),
        ("x: 1 instead of 2",),
        ("y",),
    )
    assert (state.progress, state.silent_s, state.stopping) == (0.75, 1.5, True)
    assert state.model_id == "corrected-00112233"
    assert state.measured["x"] == pytest.approx(0.02501, abs=1e-6)


def test_the_library_of_records(data):
    library = Library(data)
    library.refresh()
    by_kind = {one.kind: one for one in library.entries if one.name}
    assert set(by_kind) == set(Kind)
    playback, elsewhere = by_kind[Kind.PLAYBACK], by_kind[Kind.FILE]
    assert (playback.name, playback.note) == ("The first tour", "the dish was warm")
    assert (playback.missing, playback.changed) == (False, False)
    assert playback.gap.axis == "zn"
    assert read(playback, ROBOT).axes == ("thx", "zn")
    assert elsewhere.missing
    assert (elsewhere.began, elsewhere.duration_s) == (BEGAN, 12.5)
    assert (elsewhere.run, elsewhere.operator, elsewhere.sample) == LABELS
    assert (elsewhere.gap.axis, elsewhere.gap.rms, elsewhere.gap.unit) == ("zn", 1.5e-7, "m")
    assert (elsewhere.robot, elsewhere.machine) == ("RoTeMiNa", "0123456789abcdef")
    assert (elsewhere.problem, elsewhere.changed) == ("its time stands still", True)
    assert by_kind[Kind.RECORDING].events == 10


def test_a_blind_test_goes_on_where_it_was(data):
    run = BlindRun(data / BLIND, GeneratedCases("rotemina", 3, 7))
    assert run.pending(Shard()) == ["case_0002"]
    key, outcomes = finished(data / BLIND)
    assert key == {"seed": 7, "robot": "rotemina"}
    assert [one.verdict for one in outcomes] == ["insufficient_excitation"] * 2
    assert outcomes[1].truth == [("y", "microstep_error", None)]
    assert outcomes[1].named == [("thx", "hysteresis", None)]
    assert outcomes[1].closure == 1.0
    assert outcomes[1].has_remainder
    for name in CONTESTANTS:
        assert len(run.outcomes_of(name)) == 2
    known = classifier_for(ROBOT, data / BLIND / "classifier.npz")
    assert len(known.names) == len(known.known)


def test_the_score_of_a_blind_test():
    result = BlindResult.read(OUTPUTS / "blind.json")
    assert (result.done, result.asked) == (2, 3)
    told = "insufficient_excitation"
    assert result.counts == {("microstep_error", told): 1, ("none", told): 1}
    assert any(row.cells[2].startswith("100") for row in result.rows)


# --- files of the user's choice -------------------------------------------------------------------


def test_a_robot_file():
    robot = load_robot(FILES / "robot.toml")
    table, tilt, push, still = (robot.axes[name] for name in ("table", "tilt", "push", "still"))
    assert (table.kind, tilt.kind, push.kind) == ("stepper", "piezo", "force")
    assert (table.max_speed, table.max_acceleration, table.following) == (0.01, 0.2, 1e-3)
    assert (table.steps_per_rev, table.microsteps_per_step, table.pitch) == (200, 16, 1e-3)
    assert table.sensor.noise_floor == pytest.approx(np.hypot(2e-8, 1e-8 / np.sqrt(12.0)))
    assert (tilt.natural_frequency_hz, tilt.damping_ratio, tilt.gain) == (300.0, 0.03, 8.95e-6)
    assert push.controller == CascadeController(
        kind="cascade", kp=100.0, kv=200.0, limit=9.0, velocity="backward", delay_s=1e-3
    )
    assert still.static
    assert robot.stages == {"coarse": ("table",), "fine": ("tilt", "still")}
    (coupling,) = robot.couplings
    assert (coupling.matrix, coupling.axes, coupling.value) == ("M", ("table", "tilt"), 1e-4)
    assert robot.reference.noise_rms.of("rad") == 2e-9
    assert (robot.keep_out.floor, robot.keep_out.radius) == (0.001, 0.02)
    assert robot.plate.cutout[0].twist == 0.5
    assert robot.plate.pin.diameter == 0.004
    coupled, loop = robot.effects
    assert (coupled.id, coupled.from_axis, coupled.enabled) == ("cross_coupling", "tilt", True)
    assert (loop.id, loop.formulation, loop.enabled) == ("hysteresis", "bouc_wen", False)
    assert loop.parameters == {"width": 1.1e-4}


def test_every_formulation_of_every_effect():
    robot = load_robot(FILES / "effects.toml")
    kept = {(one.id, one.formulation): set(one.parameters) for one in robot.effects}
    known = {
        (name, one.name): {parameter.name for parameter in one.parameters}
        for name in filter(is_built_in, effect_ids())
        for one in effect_named(name).formulations
    }
    assert kept == known


def test_a_corrected_robot():
    robot = load_robot(FILES / "twin.toml")
    assert {one.id for one in robot.effects} == {"hysteresis", "cross_coupling"}
    assert robot.axes == ROBOT.axes


def test_a_diagnosis():
    found = read_document(OUTPUTS / "gap.json")
    assert found.verdict is Found.INSUFFICIENT
    assert dict(found.axes) == {
        "thx": Found.PARTLY,
        "y": Found.NONE,
        "zn": Found.INSUFFICIENT,
    }
    assert found.robot == ROBOT
    loop, coupled = found.effects
    assert (loop.axis, loop.id, loop.formulation) == ("thx", "hysteresis", "prandtl_ishlinskii")
    assert loop.parameters == {"width": 1.2e-4, "shape": 4.0}
    assert coupled.from_axis == "zn"
    assert found.offsets == {"thx": {Tap.MEAS: Offset(1e-7, 1e-9)}}


def test_a_record_of_every_tap():
    record = read_record(FILES / "record.csv")
    assert [channel.tap for channel in record.columns] == list(Tap)
    assert (record.closed_loop, record.history, record.period_samples) == (True, "periodic", 4)
    assert record.reference_noise("q") == 1e-9
    assert record.metadata["my key"] == "my value"
    assert record.signal("q", Tap.CMD)[1] == pytest.approx(0.01 * np.sin(0.1), rel=1e-15)
    exported = read_record(FILES / "exported.csv")
    assert exported.metadata["recording_id"] == "00112233" * 4
    assert len(exported.time_s) == 30


def test_inverses():
    trained, provenance = read_trained(FILES / "inverse.json")
    assert set(trained.models) == {
        "anfis",
        "modified_prandtl_ishlinskii",
        "prandtl_ishlinskii",
        "linear",
    }
    assert (trained.chosen, trained.remarks) == ("linear", ("the record is short",))
    assert provenance.trained_on[0].name == "run 7.csv"
    assert (provenance.seed, provenance.held_out[0].rows) == (3, 100)
    assert trained.residuals["linear"].share == pytest.approx(0.0001954, rel=1e-3)
    assert len(trained.models["anfis"].premises.plays) == 2


def test_tuned_gains():
    tuning = load_tuning(FILES / "tuning.toml")
    assert (tuning.axis, tuning.rate_hz, tuning.delay) == ("zn", 5000.0, 2)
    assert (tuning.recommended, tuning.chosen, tuning.best.gains) == (0, 1, Gains())
    gains = tuning.points[0].gains
    assert (gains.proportional, gains.integral, gains.derivative) == (0.07, 1100.0, 1.7e-4)
    assert gains.anti_windup is AntiWindup.CONDITIONAL
    assert gains.notch.frequency_hz == 420.0
    assert tuning.points[0].figures.settling_s == 0.03
    assert tuning.provenance.against is SecondObjective.SETTLING
    assert not tuning.provenance.whole


def test_the_calibration_of_a_diagnosis():
    found = calibration_in(json.loads((FILES / "diagnosis_calibration.json").read_text("utf-8")))
    assert 0.0 < found.probability(0.9, 0) < 1.0
    assert found.exponent == pytest.approx(0.0, abs=2.0)


@pytest.mark.parametrize("name", ["snapshot.tif", "snapshot.png", "stack.tif", "film.tif"])
def test_pictures_can_be_shown_again(name):
    source = ImageSequences()
    camera = source.camera(source.addressed(str(FILES / name)))
    camera.open()
    try:
        assert (camera.description.width, camera.description.height) == (8, 6)
        assert camera.description.pixel_types[0] is (
            PixelType.MONO8 if name.endswith("png") else PixelType.MONO16
        )
    finally:
        camera.close()
    pages = cv2.imcount(str(FILES / name), cv2.IMREAD_UNCHANGED)
    assert pages == (2 if name in ("stack.tif", "film.tif") else 1)


# --- what scripts of others read ------------------------------------------------------------------


def shape_of(value, path=""):
    """Yield the keys of a document, and words among its values, each with the keys before."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield f"{path}.{key}"
            yield from shape_of(inner, f"{path}.{key}")
    elif isinstance(value, list):
        for inner in value:
            yield from shape_of(inner, f"{path}[]")
    elif isinstance(value, str) and re.fullmatch("[a-z_]+", value):
        yield f"{path} = {value}"


@pytest.mark.parametrize("name", MAKER.OUTPUTS)
def test_documents_for_others_have_the_keys_and_words_that_they_had(name):
    kept = json.loads((OUTPUTS / name).read_text("utf-8"))
    now = json.loads(json.dumps(MAKER.OUTPUTS[name]()))
    assert set(shape_of(now)) == set(shape_of(kept))
    assert set(shape_of(kept))


def test_a_table_of_cells_has_the_columns_and_words_that_it_had(tmp_path):
    MAKER.MAKERS["files/cells.csv"](tmp_path / "cells.csv")
    assert (tmp_path / "cells.csv").read_text() == (FILES / "cells.csv").read_text()


@pytest.mark.parametrize("name", ["snapshot.tif", "stack.tif", "film.tif"])
def test_pictures_tell_what_they_told(name, tmp_path):
    import tifffile

    MAKER.MAKERS[f"files/{name}"](tmp_path / name)
    told = []
    for path in (tmp_path / name, FILES / name):
        with tifffile.TiffFile(path) as file:
            told.append([set(shape_of(json.loads(page.description))) for page in file.pages])
    assert told[0] == told[1]


# --- what is written today ------------------------------------------------------------------------


def lost_names(before, now):
    """Return the names that were written before and are not any more; new ones may be added."""
    if isinstance(before, set):
        return before - now
    each = (lost_names(names, now.get(file, set())) for file, names in before.items())
    return set().union(*each, before.keys() - now.keys())


def laid_out(path):
    """Return the names in a file, or in all files of a folder: of keys, columns and choices."""
    if path.is_dir():
        files = [each for each in sorted(path.rglob("*")) if each.is_file()]
        return {each.relative_to(path).as_posix(): laid_out(each) for each in files}
    match path.suffix:
        case ".toml":
            return set(shape_of(tomllib.loads(path.read_text("utf-8"))))
        case ".json":
            return set(shape_of(json.loads(path.read_text("utf-8"))))
        case ".jsonl":
            lines = path.read_text("utf-8").splitlines()
            return {each for line in lines for each in shape_of(json.loads(line))}
        case ".csv" | ".gz":
            data = path.read_bytes()
            lines = (gzip.decompress(data) if path.suffix == ".gz" else data).decode().splitlines()
            keys = {line.partition(":")[0] for line in lines if line.startswith("#")}
            return keys | {next(line for line in lines if not line.startswith("#"))}
        case ".arrows":
            return set(recording_shape(Recording.open(path)))
        case ".sqlite3":
            with closing(sqlite3.connect(path)) as base:
                facts = base.execute("SELECT facts FROM records ORDER BY id").fetchall()
            return {each for (one,) in facts for each in shape_of(json.loads(one))}
        case ".npz":
            with np.load(path) as arrays:
                return set(arrays)
    raise AssertionError(path)


def recording_shape(recording):
    yield from recording.metadata
    for channel in recording.channels:
        yield from (f"{channel}: {column}" for column in recording.channel(channel))
    for event in recording.events():
        yield from (f"{event.kind}{each}" for each in shape_of(json.loads(event.details)))


SLOWLY = (
    "files/inverse.json",
    MAKER.PLAYED,
    MAKER.RECORDED,
    "data/records.sqlite3",
    f"data/{BLIND}",
)
# A window writes the preferences, a crash leaves what is interrupted; pictures are looked at above.
ELSEWHERE = ("config/settings.json", "outputs/", "files/cells.csv", ".tif", ".png", ".part")
AT_ONCE = [
    name
    for name in MAKER.MAKERS
    if name not in SLOWLY and not any(part in name for part in ELSEWHERE)
]


@pytest.mark.parametrize(
    "name", [*AT_ONCE, *(pytest.param(name, marks=pytest.mark.slow) for name in SLOWLY)]
)
def test_what_is_written_today_is_laid_out_as_it_was(name, tmp_path):
    path = tmp_path / name
    path.parent.mkdir(parents=True)
    MAKER.MAKERS[name](path)
    assert lost_names(laid_out(SAMPLES / name), laid_out(path)) == set()


# --- nothing is left out --------------------------------------------------------------------------

#: Calls by which what is in memory becomes a file, or comes from one.
CONVERSIONS = {
    "Format",
    "TypeAdapter",
    "_Document.model_validate_json",
    "asdict",
    "csv.reader",
    "csv.writer",
    "fields",
    "json.dumps",
    "json.loads",
    "json_text",
    "np.load",
    "np.savez",
    "pa.ipc.open_stream",
    "pa.ipc.read_schema",
    "parse_json",
    "parse_toml",
    "pickle.load",
    "sqlite3.connect",
    "tomli_w.dumps",
    "tomllib.loads",
}
WORDS = re.compile(rf"({'|'.join(map(re.escape, CONVERSIONS))})\(|settings\.(get|set)\(")
#: By module what samples its files, or (in brackets) why there is none to sample.
SAMPLED = {
    "app/bench/bench_run.py": "outputs/bench.json",
    "app/bench/machine.py": "(truth.toml is written by people alone)",
    "app/bench/result.py": "outputs/bench.json",
    "app/blind/cases.py": "(labels are written by people alone)",
    "app/blind/classifier.py": f"data/{BLIND}",
    "app/blind/diagnosis_process.py": "outputs/gap.json",
    "app/blind/resumable_run.py": f"data/{BLIND}",
    "app/blind/self_test.py": "outputs/blind.json",
    "app/calibration/files.py": "config/calibrations",
    "app/calibration/health_book.py": "config/health",
    "app/calibration/store.py": "config/calibrations",
    "app/cameras/snapshot.py": "files/stack.tif",
    "app/cameras/video_file.py": "files/film.tif",
    "app/cli/calibrate.py": "outputs/calibrations.json",
    "app/cli/compare.py": "outputs/comparison.json",
    "app/cli/compensate_check.py": "outputs/inverses.json",
    "app/cli/compensate_train.py": "outputs/inverses.json",
    "app/cli/doctor.py": "outputs/doctor.json",
    "app/cli/excite.py": "(options of a command)",
    "app/cli/gap_diagnose.py": "outputs/gap.json",
    "app/cli/tune.py": "outputs/tuning.json",
    "app/files.py": "(every JSON file)",
    "app/microscope/calibration_file.py": "config/microscope",
    "app/microscope/camera_memory.py": "config/settings.json",
    "app/motion/model_in_use.py": "(the digest in a name)",
    "app/motion/penetration/attempt.py": "data/penetrations.jsonl",
    "app/motion/penetration/cell_list.py": "files/cells.csv",
    "app/motion/penetration/parameters.py": "config/penetration.toml",
    "app/motion/penetration/run_log.py": "data/penetrations.jsonl",
    "app/motion/penetration/sample_feed.py": "(arrays in memory)",
    "app/motion/recording/arrow_tables.py": MAKER.RECORDED,
    "app/motion/recording/recording_reader.py": MAKER.RECORDED,
    "app/motion/recording/recovery.py": MAKER.RECORDED,
    "app/motion/recording/replay.py": MAKER.RECORDED,
    "app/motion/recording/session_recorder.py": MAKER.RECORDED,
    "app/motion/recording/writer.py": MAKER.RECORDED,
    "app/motion/run_labels.py": MAKER.PLAYED,
    "app/motion/saved_positions.py": "config/positions",
    "app/motion/teleoperation/axis_calibration.py": "config/calibrations",
    "app/motion/teleoperation/profile.py": "config/profiles",
    "app/motion/teleoperation/scales.py": "config/scales.toml",
    "app/motion/teleoperation/virtual_impedance.py": "(names in a message)",
    "app/range_settings.py": "config/settings.json",
    "app/recorded_events.py": MAKER.RECORDED,
    "app/records/database.py": "data/records.sqlite3",
    "app/scene/handlers.py": "(to a browser)",
    "app/settings.py": "config/settings.json",
    "app/shell/layouts.py": "config/settings.json",
    "app/shell/offscreen_run.py": "outputs/comparison.json",
    "app/shell/panel_declarations.py": "config/settings.json",
    "app/shell/support_bundle.py": "(for people)",
    "app/toml_file.py": "(every TOML file)",
    "app/watchdog/heartbeat_sender.py": "(to a process of its own)",
    "app/watchdog/process.py": "(from the process that began it)",
    "drivers/inputs/script.py": "(scripts are written by people alone)",
    "drivers/mc68hc11/payload.py": "(messages to a board)",
    "plugins/gap/answer_exports.py": "outputs/gap.json",
    "plugins/gap/blind_figures.py": "outputs/blind.json",
    "plugins/gap/diagnosis_process.py": "(from a process of its own)",
    "plugins/identification/export.py": "(for people)",
    "plugins/inputs/calibration_progress.py": "config/calibrations",
    "plugins/penetration/panel.py": "data/penetrations.jsonl",
    "plugins/penetration/past_runs.py": "data/penetrations.jsonl",
    "plugins/teleoperation/scale_fields.py": "(bounds in memory)",
    "sim/blind/sealing.py": f"data/{BLIND}",
    "sim/comparison/comparison.py": "outputs/comparison.json",
    "sim/compensate/file.py": "files/inverse.json",
    "sim/compensate/judgement.py": "files/inverse.json",
    "sim/feedback/gains.py": "files/tuning.toml",
    "sim/gap/compare/calibration.py": "files/diagnosis_calibration.json",
    "sim/gap/output/digital_twin.py": "files/twin.toml",
    "sim/gap/output/document_reader.py": "outputs/gap.json",
    "sim/identification/paper_transfer_functions.py": "(a file of the program's own)",
    "sim/input_files.py": "(every TOML and JSON file)",
    "sim/plant/joint_loads.py": "(arrays in memory)",
    "sim/plugin_import.py": "(a cache: what it holds can be found out again)",
    "sim/robot/file.py": "files/robot.toml",
    "sim/robot/schema_errors.py": "(names in a message)",
    "sim/robot/writing.py": "files/robot.toml",
    "sim/simulation/check_catalogue.py": "(names in a message)",
    "sim/tuning/performance_figures.py": "files/tuning.toml",
    "sim/tuning/tuning_result.py": "files/tuning.toml",
}


@cache
def source(path):
    """Return a source of the program, whose path is that in the repository."""
    return ast.parse((ROOT / path).read_text("utf-8"))


@cache
def calls():
    """Return the calls in each source that may have to do with files, by name."""
    found = {}
    for layer in ("app", "drivers", "plugins", "sim"):
        for path in sorted((ROOT / layer).rglob("*.py")):
            if WORDS.search(path.read_text("utf-8")):
                name = path.relative_to(ROOT).as_posix()
                nodes = (one for one in ast.walk(source(name)) if isinstance(one, ast.Call))
                found[name] = [(name_of(one.func), one) for one in nodes]
    return found


def name_of(node):
    """Return a name with dots; nothing for another expression."""
    if isinstance(node, ast.Attribute):
        owner = name_of(node.value)
        return owner and f"{owner}.{node.attr}"
    return node.id if isinstance(node, ast.Name) else ""


def test_every_module_that_writes_or_reads_data_has_its_sample_named():
    found = {path for path, made in calls().items() if {name for name, _ in made} & CONVERSIONS}
    assert found - set(SAMPLED) == set(), "make a sample of their files, and name it in SAMPLED"
    assert set(SAMPLED) - found == set(), "take them out of SAMPLED"


def test_every_sample_is_there_and_named_for_a_module():
    named = {name for name in SAMPLED.values() if not name.startswith("(")}
    assert {name for name in named if not (SAMPLES / name).exists()} == set()
    made = tuple(SAMPLES / name for name in MAKER.MAKERS)
    files = (
        path for path in SAMPLES.rglob("*") if path.is_file() and path.suffix not in (".py", ".pyc")
    )
    assert [path for path in files if not any(path.is_relative_to(each) for each in made)] == []


def test_every_format_of_a_file_has_a_sample():
    texts = [path.read_text("utf-8") for path in SAMPLES.rglob("*.toml")]
    for path, made in calls().items():
        if "Format" in (name for name, _ in made):
            module = importlib.import_module(f"rotemina.{path[:-3].replace('/', '.')}")
            kinds = [one for one in vars(module).values() if isinstance(one, Format)]
            assert kinds
            assert all(any(can_parse(kind, text) for text in texts) for kind in kinds), path


def can_parse(kind, text):
    try:
        kind.parse(text, "sample")
    except InputError:
        return False
    return True


def values_kept(config, data):
    """Return all that readers make of the samples."""
    stored, _ = CalibrationStore(config, ROBOT).listed()
    return [
        CameraMemory(Settings(config / "settings.json")).last,
        listed_profiles(config / "profiles"),
        CalibrationFolder(config / "calibrations").read(STICK),
        [one.calibration for one in stored],
        load_microscope(config / MICROSCOPE, "opencv:0", "20x/0.4"),
        Scales.load(config / SCALES),
        PenetrationParameters.load(config / PENETRATION),
        RunLog(data / "penetrations.jsonl").read(),
        RecordStore(data).all(),
        load_robot(FILES / "robot.toml"),
        load_robot(FILES / "effects.toml"),
        read_trained(FILES / "inverse.json"),
        load_tuning(FILES / "tuning.toml"),
        read_document(OUTPUTS / "gap.json"),
    ]


#: Fields that can have one value only, or are no part of a file.
FIXED = {
    "CalibrationFile.version",
    "MicroscopeCalibration.version",
    "Tuning.format",
    "ListedProfile.problem",
    "Entry.missing",
}


def test_every_field_that_is_kept_has_a_value_of_its_own_in_a_sample(config, data):
    seen = {}
    pending = values_kept(config, data)
    while pending:
        value = pending.pop()
        if isinstance(value, Mapping):
            pending += value.values()
        elif isinstance(value, list | tuple):
            pending += value
        elif dataclasses.is_dataclass(value):
            for field in dataclasses.fields(value):
                inner, name = getattr(value, field.name), f"{owner_of(field, value)}.{field.name}"
                seen[name] = seen.get(name, False) or not is_default(field, inner)
                pending.append(inner)
    assert {name for name, told in seen.items() if not told} - FIXED == set()


def owner_of(field, value):
    """Return the class that declares a field."""
    owners = [
        one for one in type(value).mro() if field.name in vars(one).get("__annotations__", {})
    ]
    return owners[-1].__name__


def is_default(field, value):
    made = field.default_factory
    default = field.default if made is dataclasses.MISSING else made()
    if isinstance(value, np.ndarray) or isinstance(default, np.ndarray):
        return np.array_equal(value, default)
    return value == default


def patterns(node, path):
    """Return regular expressions of the texts that an expression may be."""
    tree = source(path)
    if isinstance(node, ast.Constant):
        return {re.escape(node.value)} if isinstance(node.value, str) else set()
    if isinstance(node, ast.JoinedStr):
        parts = (re.escape(p.value) if isinstance(p, ast.Constant) else ".+" for p in node.values)
        return {"".join(parts)}
    if isinstance(node, ast.Call):
        (function,) = (
            one
            for one in ast.walk(tree)
            if isinstance(one, ast.FunctionDef) and one.name == ast.unparse(node.func)
        )
        ends = (one.value for one in ast.walk(function) if isinstance(one, ast.Return))
        return set().union(*(patterns(one, path) for one in ends))
    if isinstance(node, ast.Attribute):
        _, module = imported(tree, ast.unparse(node.value))
        return bound_to(node.attr, module)
    if isinstance(node, ast.Tuple | ast.List):
        return set().union(*(patterns(one, path) for one in node.elts))
    if isinstance(node, ast.Dict):
        return set().union(*(patterns(one, path) for one in node.keys))
    if isinstance(node, ast.Name):
        return bound_to(node.id, path)
    return set()


def bound_to(name, path):
    """Return the same of a name, wherever in a module it is bound."""
    found = set()
    for node in ast.walk(source(path)):
        if isinstance(node, ast.Assign):
            for target in node.targets:
                if isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
                    for each, value in zip(target.elts, node.value.elts, strict=True):
                        found |= patterns(value, path) if ast.unparse(each) == name else set()
                elif ast.unparse(target) == name:
                    found |= patterns(node.value, path)
        elif isinstance(node, ast.For | ast.comprehension):
            first = node.target.elts[0] if isinstance(node.target, ast.Tuple) else node.target
            if ast.unparse(first) == name:
                over = node.iter
                if isinstance(over, ast.Call) and ast.unparse(over.func).endswith(".items"):
                    over = over.func.value
                found |= patterns(over, path)
    return found or bound_to(*imported(source(path), name))


def imported(tree, name):
    """Return the name that a name has where it comes from, and the path of that module."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            module = node.module.removeprefix("rotemina.")
            for alias in node.names:
                if (alias.asname or alias.name) == name:
                    places = (f"{module}.{alias.name}".replace(".", "/"), module.replace(".", "/"))
                    place = next(f"{one}.py" for one in places if (ROOT / f"{one}.py").exists())
                    return alias.name, place
    raise AssertionError(f"{name}: what key of the preferences is that?")


def test_every_preference_is_in_the_sample_and_every_one_there_is_still_read(settings):
    code = {}
    for path, made in calls().items():
        for name, call in made:
            owner, _, verb = name.rpartition(".")
            if verb in ("get", "set") and owner.rpartition(".")[2] in ("settings", "_settings"):
                found = patterns(call.args[0], path)
                assert found, f"{path}, line {call.lineno}: of which preference?"
                code |= dict.fromkeys(found, path)
    kept = settings.values
    lost = {key: path for key, path in code.items() if not any(re.fullmatch(key, k) for k in kept)}
    assert lost == {}, "add them to the sample of preferences"
    assert [key for key in kept if not any(re.fullmatch(pattern, key) for pattern in code)] == []


def test_every_setting_of_every_driver_is_in_the_sample(settings):
    for name in ("gcode", "mc68hc11", "simulator"):
        defaults = driver_named(name).default_settings
        kept = {key for key in settings.values if key.startswith(f"driver.{name}.")}
        assert kept == {f"driver.{name}.{key}" for key in defaults}


def test_samples_are_small_and_tell_nothing_of_the_machine_that_made_them():
    files = [
        path for path in SAMPLES.rglob("*") if path.is_file() and "__pycache__" not in path.parts
    ]
    assert sum(path.stat().st_size for path in files) < 300_000
    made = (path for path in files if path.suffix != ".py")
    assert [
        path for path in made if re.search(rb"/(home|root|tmp|work|Users)/", path.read_bytes())
    ] == []
