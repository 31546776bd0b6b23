"""Files of users are read with all their contents; see ``tests/samples``."""

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
from dataclasses import replace
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path

import cv2
import numpy as np
import pytest

from rotemina.app.blind import CaseShard
from rotemina.app.blind.cases import GeneratedCaseSource
from rotemina.app.blind.classifier import load_or_train_classifier
from rotemina.app.blind.naive_methods import CONTESTANTS
from rotemina.app.blind.resumable_run import ResumableBlindRun, read_finished_run
from rotemina.app.calibration import CalibrationStore, HealthBook
from rotemina.app.microscope.calibration_file import load_calibration as load_microscope
from rotemina.app.microscope.camera_memory import CameraMemory
from rotemina.app.microscope.microscope import CALIBRATION_FOLDER as MICROSCOPE
from rotemina.app.motion.inputs import OperatorAction
from rotemina.app.motion.inputs.axis_calibration import InputCalibrationFolder
from rotemina.app.motion.inputs.profile import list_profiles
from rotemina.app.motion.model import ModelInUse
from rotemina.app.motion.penetration import (
    PenetrationParameters,
    PenetrationPhase,
    PenetrationVerdict,
    RunLog,
)
from rotemina.app.motion.playback import compare_with_model
from rotemina.app.motion.recording import (
    Recording,
    Replay,
    find_unfinished,
    make_record,
    recover_recording,
)
from rotemina.app.motion.session import (
    HOME,
    LOAD,
    WORK,
    MotionSession,
    SavedPositions,
    load_ranges,
)
from rotemina.app.motion.state import ConnectionState
from rotemina.app.motion.teleoperation import CoordinateScale, ModeScales
from rotemina.app.motion.teleoperation.modes import SteeringModes
from rotemina.app.motion.teleoperation.teleoperation_loop import DIRECT_MODE
from rotemina.app.operation import OperatorControl
from rotemina.app.operation.operation import PENETRATION_FILE, SCALES_FILE
from rotemina.app.records import (
    EventSeverity,
    RecordCatalogue,
    RecordKind,
    RecordStore,
    make_timeline_events,
    read_entry,
)
from rotemina.app.settings import TomlFormat, UserSettings, driver_settings
from rotemina.drivers.cameras import CameraTrigger, PixelType, SensorRegion
from rotemina.drivers.cameras.sequence import ImageSequenceSource
from rotemina.drivers.contract import DeviceState, find_driver
from rotemina.drivers.inputs import InputIdentity
from rotemina.drivers.simulator import Simulator
from rotemina.plugins.gap.blind.blind_figures import BlindResult
from rotemina.sim.compensate import read_trained
from rotemina.sim.effects import (
    is_built_in,
    list_effect_ids,
    load_effect,
)
from rotemina.sim.errors import InputError
from rotemina.sim.feedback import ControllerGains
from rotemina.sim.gap.compare.calibration import calibration_in
from rotemina.sim.gap.output import read_document
from rotemina.sim.gap.result import GapVerdict, ModelOffset
from rotemina.sim.records import Tap, read_record
from rotemina.sim.robot_files import load_robot
from rotemina.sim.tuning import load_tuning

ROOT = Path(__file__).parents[1]
SAMPLES = Path(__file__).parent / "samples"
CONFIG, FILES, OUTPUTS = SAMPLES / "config", SAMPLES / "files", SAMPLES / "outputs"
ROBOT = load_robot("rotemina")
START_TIME = datetime(2026, 3, 4, 5, 6, 7, tzinfo=UTC)
STICK = InputIdentity("hid:046d:c215:0001", "a stick", "hid")
LABELS = ("run 7", "an operator", "dish B")
BLIND = "blind/RoTeMiNa-seed-7"
# For each layout, the visible docks at the left, at the right and at the bottom.
VISIBLE_DOCKS = {
    "My Operate": (
        ("control",),
        # The panels at the right are folded away.
        (),
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


def load_sample_script():
    """Import the script that made the samples."""
    spec = importlib.util.spec_from_file_location("make_samples", SAMPLES / "make_samples.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


SAMPLE_SCRIPT = load_sample_script()


@pytest.fixture
def config(tmp_path):
    """A writable copy of a user's folder of preferences."""
    return Path(shutil.copytree(CONFIG, tmp_path / "config"))


@pytest.fixture
def data(tmp_path):
    """A writable copy of a user's folder of data."""
    return Path(shutil.copytree(SAMPLES / "data", tmp_path / "data"))


@pytest.fixture
def settings(config):
    return UserSettings(config / "settings.json")


def test_preferences_of_the_machine(settings):
    assert not settings.load_error
    ranges = load_ranges(settings, load_robot(FILES / "robot.toml"))
    assert ranges == {"table": (0.01, 0.04), "tilt": (1e-4, 9e-4)}
    camera = CameraMemory(settings).last_camera
    assert (camera.identity.key, camera.identity.source) == ("sequence:/records/cells", "sequence")
    assert camera.by_address
    camera_settings = camera.settings
    assert (camera_settings.exposure_s, camera_settings.gain, camera_settings.rate_hz) == (
        0.02,
        3.5,
        12.5,
    )
    assert camera_settings.region == SensorRegion(8, 16, 640, 480)
    assert (camera_settings.pixel_type, camera_settings.trigger) == (
        PixelType.MONO16,
        CameraTrigger.SOFTWARE,
    )
    assert not camera_settings.repeat


@pytest.mark.parametrize(
    ("driver", "values"),
    [
        ("gcode", ("ttyUSB7", 115_201, "CBAZYX", 0.135, 60.125, True)),
        ("mc68hc11", ("ttyUSB7", "ttyUSB7", 125_001, 0.375, 0.375, 0.1325)),
        ("simulator", (500.125, 1, 0.375, 0.375, False)),
    ],
)
def test_settings_of_drivers(settings, driver, values):
    assert tuple(driver_settings.load_settings(settings, find_driver(driver)).values()) == values


def test_preferences_of_the_window(settings, qtbot):
    from PySide6.QtWidgets import QWidget

    from rotemina.app.language.language import determine_language
    from rotemina.app.shell.records import RecentFilesMenu
    from rotemina.app.shell.window.layouts import SavedLayouts
    from rotemina.plugins.microscope.overlays import OverlayLayer

    parent = QWidget()
    qtbot.addWidget(parent)
    actions = dict.fromkeys(("trajectory", "record"), ("", print))
    recent_files = RecentFilesMenu(settings, actions, parent).entries
    assert [(kind, path.name) for kind, path in recent_files] == [
        ("trajectory", "tour.csv"),
        ("record", "run 7.csv.gz"),
    ]
    assert determine_language(settings) == "de"
    assert set(SavedLayouts(settings).list_names()) == set(VISIBLE_DOCKS)
    layers = {key for key in settings.values if key.startswith("microscope.layer.")}
    assert layers == {f"microscope.layer.{layer.name.lower()}" for layer in OverlayLayer}


def test_docks_are_restored_where_they_were_left(settings, qtbot):
    from PySide6.QtCore import Qt
    from PySide6.QtWidgets import QDockWidget, QMainWindow

    from rotemina.app.shell.window.layouts import STATE_VERSION, SavedLayouts

    window = QMainWindow()
    qtbot.addWidget(window)
    docks = {point.name: QDockWidget() for point in entry_points(group="rotemina.panels")}
    for panel, dock in docks.items():
        dock.setObjectName(f"dock-{panel}")
        window.addDockWidget(Qt.DockWidgetArea.LeftDockWidgetArea, dock)
        # Panels in the centre have no dock.
        dock.hide()
    for name, visible in VISIBLE_DOCKS.items():
        assert window.restoreState(SavedLayouts(settings).read_state(name), STATE_VERSION)
        assert find_visible_docks(window, docks) == tuple(map(set, visible)), name
        assert docks["faults"].isFloating() == (name == "Faults & more")


def find_visible_docks(window, docks):
    """Return the visible docks at the left, at the right and at the bottom."""
    from PySide6.QtCore import Qt

    area = Qt.DockWidgetArea
    areas = (area.LeftDockWidgetArea, area.RightDockWidgetArea, area.BottomDockWidgetArea)
    visible = {name: dock for name, dock in docks.items() if not dock.isHidden()}
    return tuple(
        {n for n, d in visible.items() if not d.isFloating() and window.dockWidgetArea(d) == side}
        for side in areas
    )


@pytest.mark.slow
@pytest.mark.every_panel
def test_a_window_looks_and_works_as_it_was_left(settings, make_robot_window, tmp_path):
    from rotemina.plugins.microscope.picture_section import LayerSection

    # Other tests of this process expect English.
    settings.set("window.language", "en")
    shutil.copytree(SAMPLES / "data", tmp_path, dirs_exist_ok=True)
    window = make_robot_window()
    bench, panels = window.workbench, window.panels
    assert find_visible_docks(window, window.docks) == tuple(
        map(set, VISIBLE_DOCKS["Faults & more"])
    )
    window.arrangement.use_saved_layout("My Diagnose")
    assert find_visible_docks(window, window.docks) == tuple(map(set, VISIBLE_DOCKS["My Diagnose"]))
    assert bench.theme.name == "light"
    assert window.arrangement.text_scale == 1.15
    labels = bench.library.labels
    assert (labels.run, labels.operator, labels.sample) == LABELS
    assert len(window.recent_files.entries) == 2
    window.first_steps.offer()
    # The user has closed it.
    assert window.first_steps.isHidden()
    assert panels["control"].overview.speed.fraction == 0.25
    boxes = window.findChild(LayerSection).boxes
    visible_layers = {layer.name for layer, box in boxes.items() if box.isChecked()}
    assert visible_layers == {"CROSSHAIR"}
    # This makes the panel, which was not shown yet.
    assert panels["inputs"]
    assert bench.operation.devices.profile.name == "Two sticks"
    assert not bench.operation.problems


def test_an_operator_control_loads_all_files_of_its_user(config, data):
    session = MotionSession(Simulator(ROBOT))
    operation = OperatorControl(session, config, data)
    try:
        assert operation.problems == []
        assert set(session.corrections.names) == {"zn"}
        assert [profile.path.stem for profile in operation.devices.profiles] == ["Two sticks"]
        assert operation.penetration_parameters.axis == "z"
        assert len(operation.penetration_log.read()[0]) == 4
        assert operation.teleoperator.scales.modes
        assert len(list(operation.recordings.glob("*.arrows"))) == 1
    finally:
        operation.close()
        session.close()


def test_a_profile(config):
    (listed,) = list_profiles(config / "profiles")
    assert listed.problem is None
    assert listed.profile == SAMPLE_SCRIPT.make_profile()
    actions = {mapping.action for mapping in listed.profile.devices[0].actions}
    assert actions == set(OperatorAction)


def test_the_calibration_of_a_stick(config):
    calibration = InputCalibrationFolder(config / "calibrations").read(STICK)
    assert calibration == SAMPLE_SCRIPT.make_stick_calibration()


def test_calibrations_of_sensors(config):
    stored, problems = CalibrationStore(config, ROBOT).list_calibrations()
    assert problems == ()
    by_axis = {entry.calibration.axis: entry for entry in stored}
    assert {axis: entry.on for axis, entry in by_axis.items()} == {"x": False, "zn": True}
    calibrations = {axis: entry.calibration for axis, entry in by_axis.items()}
    assert calibrations == SAMPLE_SCRIPT.make_sensor_calibrations()
    zn = calibrations["zn"]
    # Records refer to it by its digest.
    assert zn.name == "2026-03-04T05:06:07+00:00 aab6493f"
    model = zn.applied_calibration.model
    assert (model.gain_error, model.bend, model.weights) == (0.0125, (2e-8, -1e-8), (0.01, 0.02))
    assert (model.lag, model.lag_s) == ("first_order", 1e-4)
    assert zn.iso_reached.positioning.accuracy == 1e-7


def test_health_cards(config):
    first, second = HealthBook(config, ROBOT.name).read_cards("zn")
    assert (first.date[:10], first.record) == ("2026-03-04", "run 4.csv")
    assert second.figures[0] == ("static gain", 0.97, 0.002, "1")


def test_the_calibration_of_a_microscope(config):
    calibration = load_microscope(config / MICROSCOPE, "opencv:0", "20x/0.4")
    assert calibration == SAMPLE_SCRIPT.make_microscope_calibration()
    assert calibration.view.contains(np.array([639.0, 479.0]))
    assert calibration.get_stage("micro").map.covariance[1, 2] == 6.0
    assert calibration.get_stage("nano").predict_pixel(np.array([0.01, 0.02, 0.0])).tolist() == [
        321.5,
        241.25,
    ]


def test_saved_positions(config):
    positions = SavedPositions(config, ROBOT)
    positions.read()
    assert set(positions.positions) == {HOME, LOAD, WORK, "dish B, cell 3"}
    assert positions.positions[LOAD]["x"] == 0.01375


def test_scales_of_every_mode(config):
    operation = OperatorControl(MotionSession(Simulator(ROBOT)), config, config)
    scales, modes = operation.teleoperator.scales, SteeringModes(ROBOT)
    operation.close()
    middle = {name: sum(axis.range) / 2.0 for name, axis in ROBOT.axes.items()}
    scale = CoordinateScale(
        way=2e-4,
        speed=3e-4,
        time_constant_s=0.5,
        spring_hz=1.5,
        damping_ratio=0.75,
        contact_gain=0.25,
    )
    for mode in modes.names:
        for coordinate in modes.begin_mode(mode, middle).coordinates.values():
            assert scales.find_scale(mode, coordinate) == scale
    assert set(scales.modes) == {*modes.names, DIRECT_MODE}


def test_parameters_of_a_penetration(config):
    parameters = PenetrationParameters.load(config / "penetration.toml")
    assert parameters == SAMPLE_SCRIPT.make_penetration_parameters()


def test_runs_of_penetrations(data):
    runs, problems = RunLog(data / "penetrations.jsonl").read()
    assert problems == ()
    made = SAMPLE_SCRIPT.make_penetrations()
    assert [replace(run, parameters={}) for run in runs] == [
        replace(run, parameters={}) for run in made
    ]
    assert {run.verdict for run in runs} == set(PenetrationVerdict)
    assert {name for name, _ in runs[0].phases} == set(PenetrationPhase)
    # A panel offers these parameters for another run.
    assert (
        PenetrationParameters(**runs[0].parameters) == SAMPLE_SCRIPT.make_penetration_parameters()
    )


def test_a_playback_with_all_its_metadata(data):
    record = read_record(data / "played/2026-03-04_05-06-07-000000_tour.csv.gz", robot=ROBOT)
    assert record.axes == ("thx", "zn")
    assert len(record.time_s) == 60
    assert record.signal("zn", Tap.U)[0] == 62.263157894736835
    assert record.history == "unknown"
    metadata = record.metadata
    assert metadata["trajectory"] == "tour"
    assert metadata["calibration thx"] == "2026-03-04 01234567"
    assert metadata["noted"] == "contact of zn"
    assert {"began", "robot", "robot_sha256", "driver", "model", "effects"} <= set(metadata)
    assert (metadata["run"], metadata["operator"], metadata["sample"]) == LABELS
    run = compare_with_model(ModelInUse.make_nominal(Simulator(ROBOT)), "tour", record)
    assert set(run.gaps) >= {("thx", Tap.MEAS), ("zn", Tap.MEAS)}


def test_a_recording(data):
    (path,) = (data / "recordings").glob("*.arrows")
    check_recording(Recording.open(path))


def test_an_interrupted_recording(data):
    (path,) = find_unfinished(data / "recordings")
    check_recording(Recording.open(recover_recording(path)))


def check_recording(recording):
    robot = load_robot("xyz")
    assert recording.robot.name == robot.name
    assert dict(recording.units) == {"x": "m", "y": "m", "z": "m"}
    assert tuple(recording.metadata[key] for key in ("run", "operator", "sample")) == LABELS
    assert json.loads(recording.metadata["settings"]) == {"control.speed": 0.25}
    assert recording.count == 30
    samples = recording.read_samples()
    assert np.ptp(samples.command, axis=0).tolist() == pytest.approx([1e-5, 0.0, 0.0])
    assert set(recording.channels) == {"clock", f"input {STICK.key}", "intent", "tip"}
    assert recording.read_channel("tip")["quality"].tolist() == [0.75]
    assert make_record(recording).has("x", Tap.MEAS)
    events = make_timeline_events(recording.read_events(), recording.began_s)
    words = Counter(event.word for event in events if event.severity is not EventSeverity.DETAIL)
    assert words["Fault"] == words["Refused"] == words["Stop"] == words["Note"] == 1
    replay = Replay(recording)
    replay.seek(recording.ended_s)
    state = replay.snapshot()
    assert (state.connection, state.activity) == (ConnectionState.CONNECTED, DeviceState.FAULT)
    assert (state.fault, state.latch_reason) == (
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
    library = RecordCatalogue(data)
    library.refresh()
    by_kind = {entry.kind: entry for entry in library.entries if entry.name}
    assert set(by_kind) == set(RecordKind)
    playback, elsewhere = by_kind[RecordKind.PLAYBACK], by_kind[RecordKind.FILE]
    assert (playback.name, playback.note) == ("The first tour", "the dish was warm")
    assert (playback.missing, playback.changed) == (False, False)
    assert playback.gap.axis == "zn"
    assert read_entry(playback, ROBOT).axes == ("thx", "zn")
    assert elsewhere.missing
    assert (elsewhere.began, elsewhere.duration_s) == (START_TIME, 12.5)
    assert (elsewhere.run, elsewhere.operator, elsewhere.sample) == LABELS
    assert (elsewhere.gap.axis, elsewhere.gap.rms, elsewhere.gap.unit) == ("zn", 1.5e-7, "m")
    assert (elsewhere.robot, elsewhere.machine) == ("RoTeMiNa", "0123456789abcdef")
    assert (elsewhere.problem, elsewhere.changed) == ("its time stands still", True)
    assert by_kind[RecordKind.RECORDING].events == 10


def test_a_blind_test_continues_where_it_stopped(data):
    run = ResumableBlindRun(data / BLIND, GeneratedCaseSource("rotemina", 3, 7))
    assert run.list_pending(CaseShard()) == ["case_0002"]
    key, outcomes = read_finished_run(data / BLIND)
    assert key == {"seed": 7, "robot": "rotemina"}
    assert [outcome.verdict for outcome in outcomes] == ["insufficient_excitation"] * 2
    assert outcomes[1].true_causes == [("y", "microstep_error", None)]
    assert outcomes[1].named_causes == [("thx", "hysteresis", None)]
    assert outcomes[1].closure == 1.0
    assert outcomes[1].has_remainder
    for name in CONTESTANTS:
        assert len(run.read_outcomes_of(name)) == 2
    classifier = load_or_train_classifier(ROBOT, data / BLIND / "classifier.npz")
    assert len(classifier.names) == len(classifier.known_features)


def test_the_score_of_a_blind_test():
    result = BlindResult.read(OUTPUTS / "blind.json")
    assert (result.done, result.total) == (2, 3)
    verdict = "insufficient_excitation"
    assert result.counts == {("microstep_error", verdict): 1, ("none", verdict): 1}
    assert any(row.cells[2].startswith("100") for row in result.rows)


def test_a_robot_file():
    robot = load_robot(FILES / "robot.toml")
    assert robot == SAMPLE_SCRIPT.make_robot()
    table, tilt = robot.axes["table"], robot.axes["tilt"]
    assert table.following_limit == 1e-3
    assert table.sensor.noise_floor == pytest.approx(np.hypot(2e-8, 1e-8 / np.sqrt(12.0)))
    assert (tilt.natural_frequency_hz, tilt.damping_ratio, tilt.gain) == (300.0, 0.03, 8.95e-6)
    assert robot.reference.noise_rms.of("rad") == 2e-9


def test_every_formulation_of_every_effect():
    robot = load_robot(FILES / "effects.toml")
    stored_parameters = {
        (effect.id, effect.formulation): set(effect.parameters) for effect in robot.effects
    }
    known_parameters = {
        (name, formulation.name): {parameter.name for parameter in formulation.parameters}
        for name in filter(is_built_in, list_effect_ids())
        for formulation in load_effect(name).formulations
    }
    assert stored_parameters == known_parameters


def test_a_corrected_robot():
    robot = load_robot(FILES / "twin.toml")
    assert {effect.id for effect in robot.effects} == {"hysteresis", "cross_coupling"}
    assert robot.axes == ROBOT.axes


def test_a_diagnosis():
    document = read_document(OUTPUTS / "gap.json")
    assert document.verdict is GapVerdict.INSUFFICIENT
    assert dict(document.axes) == {
        "thx": GapVerdict.PARTLY,
        "y": GapVerdict.NONE,
        "zn": GapVerdict.INSUFFICIENT,
    }
    assert document.robot == ROBOT
    loop, coupled = document.effects
    assert (loop.axis, loop.id, loop.formulation) == ("thx", "hysteresis", "prandtl_ishlinskii")
    assert loop.parameters == {"width": 1.2e-4, "shape": 4.0}
    assert coupled.from_axis == "zn"
    assert document.offsets == {"thx": {Tap.MEAS: ModelOffset(1e-7, 1e-9)}}


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
    assert (trained.recommended_kind, trained.remarks) == ("linear", ("the record is short",))
    assert provenance.trained_on[0].name == "run 7.csv"
    assert (provenance.seed, provenance.held_out[0].rows) == (3, 100)
    assert trained.residuals["linear"].share == pytest.approx(0.0001954, rel=1e-3)
    assert len(trained.models["anfis"].premises.plays) == 2


def test_tuned_gains():
    tuning = load_tuning(FILES / "tuning.toml")
    assert tuning == SAMPLE_SCRIPT.make_tuning()
    assert tuning.chosen_point.gains == ControllerGains()
    assert not tuning.provenance.is_complete


def test_the_calibration_of_a_diagnosis():
    calibration = calibration_in(
        json.loads((FILES / "diagnosis_calibration.json").read_text("utf-8"))
    )
    assert 0.0 < calibration.probability(0.9, 0) < 1.0
    assert calibration.exponent == pytest.approx(0.0, abs=2.0)


@pytest.mark.parametrize("name", ["snapshot.tif", "snapshot.png", "stack.tif", "film.tif"])
def test_pictures_can_be_shown_again(name):
    source = ImageSequenceSource()
    camera = source.camera(source.parse_address(str(FILES / name)))
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


def list_document_paths(value, path=""):
    """Yield the paths of the keys of a document, and those values that are words."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield f"{path}.{key}"
            yield from list_document_paths(item, f"{path}.{key}")
    elif isinstance(value, list):
        for item in value:
            yield from list_document_paths(item, f"{path}[]")
    elif isinstance(value, str) and re.fullmatch("[a-z_]+", value):
        yield f"{path} = {value}"


@pytest.mark.parametrize("name", SAMPLE_SCRIPT.OUTPUTS)
def test_documents_for_other_programs_keep_their_keys_and_words(name):
    sample = json.loads((OUTPUTS / name).read_text("utf-8"))
    new_document = json.loads(json.dumps(SAMPLE_SCRIPT.OUTPUTS[name]()))
    assert set(list_document_paths(new_document)) == set(list_document_paths(sample))
    assert set(list_document_paths(sample))


def test_a_table_of_cells_keeps_its_columns_and_words(tmp_path):
    SAMPLE_SCRIPT.MAKERS["files/cells.csv"](tmp_path / "cells.csv")
    assert (tmp_path / "cells.csv").read_text() == (FILES / "cells.csv").read_text()


@pytest.mark.parametrize("name", ["snapshot.tif", "stack.tif", "film.tif"])
def test_pictures_keep_their_metadata(name, tmp_path):
    import tifffile

    SAMPLE_SCRIPT.MAKERS[f"files/{name}"](tmp_path / name)
    metadata = []
    for path in (tmp_path / name, FILES / name):
        with tifffile.TiffFile(path) as file:
            metadata.append(
                [set(list_document_paths(json.loads(page.description))) for page in file.pages]
            )
    assert metadata[0] == metadata[1]


def find_missing_names(before, after):
    """Return the names that are no longer written. New names may be added."""
    if isinstance(before, set):
        return before - after
    missing = (find_missing_names(names, after.get(file, set())) for file, names in before.items())
    return set().union(*missing, before.keys() - after.keys())


def list_names(path):
    """Return the names of keys, columns and choices in a file, or in all files of a folder."""
    if path.is_dir():
        files = [file for file in sorted(path.rglob("*")) if file.is_file()]
        return {file.relative_to(path).as_posix(): list_names(file) for file in files}
    match path.suffix:
        case ".toml":
            return set(list_document_paths(tomllib.loads(path.read_text("utf-8"))))
        case ".json":
            return set(list_document_paths(json.loads(path.read_text("utf-8"))))
        case ".jsonl":
            lines = path.read_text("utf-8").splitlines()
            return {name for line in lines for name in list_document_paths(json.loads(line))}
        case ".csv" | ".gz":
            data = path.read_bytes()
            lines = (gzip.decompress(data) if path.suffix == ".gz" else data).decode().splitlines()
            keys = {line.partition(":")[0] for line in lines if line.startswith("#")}
            return keys | {next(line for line in lines if not line.startswith("#"))}
        case ".arrows":
            return set(list_recording_names(Recording.open(path)))
        case ".sqlite3":
            with closing(sqlite3.connect(path)) as database:
                rows = database.execute("SELECT facts FROM records ORDER BY id").fetchall()
            return {name for (facts,) in rows for name in list_document_paths(json.loads(facts))}
        case ".npz":
            with np.load(path) as arrays:
                return set(arrays)
    raise AssertionError(path)


def list_recording_names(recording):
    yield from recording.metadata
    for channel in recording.channels:
        yield from (f"{channel}: {column}" for column in recording.read_channel(channel))
    for event in recording.read_events():
        yield from (
            f"{event.kind}{name}" for name in list_document_paths(json.loads(event.details))
        )


SLOW_SAMPLES = (
    "files/inverse.json",
    SAMPLE_SCRIPT.PLAYBACK_SAMPLE,
    SAMPLE_SCRIPT.RECORDING_SAMPLE,
    "data/records.sqlite3",
    f"data/{BLIND}",
)
# A crash leaves interrupted files. Other tests check pictures.
OTHERWISE_TESTED = ("outputs/", "files/cells.csv", ".tif", ".png", ".part")
QUICK_SAMPLES = [
    name
    for name in SAMPLE_SCRIPT.MAKERS
    if name not in SLOW_SAMPLES and not any(part in name for part in OTHERWISE_TESTED)
]


@pytest.mark.parametrize(
    "name", [*QUICK_SAMPLES, *(pytest.param(name, marks=pytest.mark.slow) for name in SLOW_SAMPLES)]
)
def test_written_files_keep_all_names_of_the_samples(name, tmp_path):
    path = tmp_path / name
    path.parent.mkdir(parents=True)
    SAMPLE_SCRIPT.MAKERS[name](path)
    assert find_missing_names(list_names(SAMPLES / name), list_names(path)) == set()


#: Calls that convert between objects in memory and files.
CONVERSIONS = {
    "TomlFormat",
    "TypeAdapter",
    "_Document.model_validate_json",
    "asdict",
    "csv.reader",
    "csv.writer",
    "fields",
    "json.dumps",
    "json.loads",
    "format_json",
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
CONVERSION_CALL = re.compile(rf"({'|'.join(map(re.escape, CONVERSIONS))})\(|settings\.(get|set)\(")
#: The sample of the files of each module, or (in brackets) why it needs none.
SAMPLES_OF_MODULES = {
    "app/bench/bench_run.py": "outputs/bench.json",
    "app/bench/machine.py": "(only people write truth.toml)",
    "app/bench/result.py": "outputs/bench.json",
    "app/blind/cases.py": "(only people write labels)",
    "app/blind/classifier.py": f"data/{BLIND}",
    "app/blind/diagnosis_process.py": "outputs/gap.json",
    "app/blind/resumable_run.py": f"data/{BLIND}",
    "app/blind/self_test.py": "outputs/blind.json",
    "app/calibration/files.py": "config/calibrations",
    "app/calibration/health_book.py": "config/health",
    "app/calibration/store.py": "config/calibrations",
    "app/cameras/snapshot.py": "files/stack.tif",
    "app/cameras/video_file.py": "files/film.tif",
    "app/cli/gap/gap_check.py": "outputs/check.json",
    "app/cli/machine/calibrate.py": "outputs/calibrations.json",
    "app/cli/records/compare.py": "outputs/comparison.json",
    "app/cli/control/compensate_check.py": "outputs/inverses.json",
    "app/cli/control/compensate_train.py": "outputs/inverses.json",
    "app/cli/machine/doctor.py": "outputs/doctor.json",
    "app/cli/records/excite.py": "(options of a command)",
    "app/cli/gap/gap_diagnose.py": "outputs/gap.json",
    "app/cli/control/tune.py": "outputs/tuning.json",
    "app/settings/files.py": "(every JSON file)",
    "app/microscope/calibration_file.py": "config/microscope",
    "app/microscope/camera_memory.py": "config/settings.json",
    "app/motion/model/model_in_use.py": "(the digest in a name)",
    "app/motion/penetration/attempt.py": "data/penetrations.jsonl",
    "app/motion/penetration/cell_list.py": "files/cells.csv",
    "app/motion/penetration/parameters.py": "config/penetration.toml",
    "app/motion/penetration/run_log.py": "data/penetrations.jsonl",
    "app/motion/penetration/sample_feed.py": "(arrays in memory)",
    "app/motion/recording/arrow_tables.py": SAMPLE_SCRIPT.RECORDING_SAMPLE,
    "app/motion/recording/recording_reader.py": SAMPLE_SCRIPT.RECORDING_SAMPLE,
    "app/motion/recording/recovery.py": SAMPLE_SCRIPT.RECORDING_SAMPLE,
    "app/motion/recording/replay.py": SAMPLE_SCRIPT.RECORDING_SAMPLE,
    "app/motion/recording/session_recorder.py": SAMPLE_SCRIPT.RECORDING_SAMPLE,
    "app/motion/recording/writer.py": SAMPLE_SCRIPT.RECORDING_SAMPLE,
    "app/motion/state/playback_notes.py": SAMPLE_SCRIPT.PLAYBACK_SAMPLE,
    "app/motion/session/saved_positions.py": "config/positions",
    "app/motion/inputs/axis_calibration.py": "config/calibrations",
    "app/motion/inputs/profile.py": "config/profiles",
    "app/motion/teleoperation/scales.py": "config/scales.toml",
    "app/motion/teleoperation/virtual_impedance.py": "(names in a message)",
    "app/motion/session/range_settings.py": "config/settings.json",
    "app/records/recorded_events.py": SAMPLE_SCRIPT.RECORDING_SAMPLE,
    "app/records/database.py": "data/records.sqlite3",
    "app/scene/handlers.py": "(to a browser)",
    "app/settings/settings.py": "config/settings.json",
    "app/shell/window/layouts.py": "config/settings.json",
    "app/shell/startup/offscreen_run.py": "outputs/comparison.json",
    "app/shell/panels/panel_declarations.py": "config/settings.json",
    "app/shell/support/support_bundle.py": "(for people)",
    "app/settings/toml_file.py": "(every TOML file)",
    "app/watchdog/heartbeat_sender.py": "(to a separate process)",
    "app/watchdog/process.py": "(from the process that started it)",
    "drivers/inputs/script.py": "(only people write scripts)",
    "drivers/mc68hc11/protocol/payload.py": "(messages to a board)",
    "plugins/gap/answer/answer_exports.py": "outputs/gap.json",
    "plugins/gap/blind/blind_figures.py": "outputs/blind.json",
    "plugins/gap/diagnosing/diagnosis_process.py": "(from a separate process)",
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
    "sim/identification/paper_transfer_functions.py": "(a file that belongs to the program)",
    "sim/files/input_files.py": "(every TOML and JSON file)",
    "sim/plant/joint_loads.py": "(arrays in memory)",
    "sim/plugin_points/trial_import.py": "(a cache: its contents can be determined again)",
    "sim/robot_files/reading.py": "files/robot.toml",
    "sim/robot_files/schema_errors.py": "(names in a message)",
    "sim/robot_files/writing.py": "files/robot.toml",
    "sim/simulation/check_catalogue.py": "(names in a message)",
    "sim/tuning/performance_figures.py": "files/tuning.toml",
    "sim/tuning/tuning_result.py": "files/tuning.toml",
}


@cache
def parse_source(path):
    """Return the syntax tree of a module, given its path in the repository."""
    return ast.parse((ROOT / path).read_text("utf-8"))


@cache
def find_calls():
    """Return the calls, with their names, of each module that may convert files."""
    calls = {}
    for layer in ("app", "drivers", "plugins", "sim"):
        for path in sorted((ROOT / layer).rglob("*.py")):
            if CONVERSION_CALL.search(path.read_text("utf-8")):
                name = path.relative_to(ROOT).as_posix()
                nodes = (
                    node for node in ast.walk(parse_source(name)) if isinstance(node, ast.Call)
                )
                calls[name] = [(find_dotted_name(node.func), node) for node in nodes]
    return calls


def find_dotted_name(node):
    """Return a name with dots, or an empty text for another expression."""
    if isinstance(node, ast.Attribute):
        owner = find_dotted_name(node.value)
        return owner and f"{owner}.{node.attr}"
    return node.id if isinstance(node, ast.Name) else ""


def test_every_module_that_writes_or_reads_data_has_a_sample():
    modules = {
        path for path, calls in find_calls().items() if {name for name, _ in calls} & CONVERSIONS
    }
    assert modules - set(SAMPLES_OF_MODULES) == set(), (
        "make a sample of their files, and add it to SAMPLES_OF_MODULES"
    )
    assert set(SAMPLES_OF_MODULES) - modules == set(), "remove them from SAMPLES_OF_MODULES"


def test_every_sample_exists_and_belongs_to_a_module():
    names = {name for name in SAMPLES_OF_MODULES.values() if not name.startswith("(")}
    assert {name for name in names if not (SAMPLES / name).exists()} == set()
    sample_paths = (CONFIG / "settings.json", *(SAMPLES / name for name in SAMPLE_SCRIPT.MAKERS))
    files = (
        path for path in SAMPLES.rglob("*") if path.is_file() and path.suffix not in (".py", ".pyc")
    )
    assert [
        path for path in files if not any(path.is_relative_to(sample) for sample in sample_paths)
    ] == []


def test_every_format_of_a_file_has_a_sample():
    texts = [path.read_text("utf-8") for path in SAMPLES.rglob("*.toml")]
    for path, calls in find_calls().items():
        if "TomlFormat" in (name for name, _ in calls):
            module = importlib.import_module(f"rotemina.{path[:-3].replace('/', '.')}")
            formats = [value for value in vars(module).values() if isinstance(value, TomlFormat)]
            assert formats
            assert all(
                any(can_parse(file_format, text) for text in texts) for file_format in formats
            ), path


def can_parse(file_format, text):
    try:
        file_format.parse(text, "sample")
    except InputError:
        return False
    return True


def read_all_samples(config, data):
    """Return the objects that are read from the samples."""
    stored, _ = CalibrationStore(config, ROBOT).list_calibrations()
    return [
        CameraMemory(UserSettings(config / "settings.json")).last_camera,
        list_profiles(config / "profiles"),
        InputCalibrationFolder(config / "calibrations").read(STICK),
        [entry.calibration for entry in stored],
        load_microscope(config / MICROSCOPE, "opencv:0", "20x/0.4"),
        ModeScales.load(config / SCALES_FILE),
        PenetrationParameters.load(config / PENETRATION_FILE),
        RunLog(data / "penetrations.jsonl").read(),
        RecordStore(data).read_all(),
        load_robot(FILES / "robot.toml"),
        load_robot(FILES / "effects.toml"),
        read_trained(FILES / "inverse.json"),
        load_tuning(FILES / "tuning.toml"),
        read_document(OUTPUTS / "gap.json"),
    ]


#: Fields that can have only one value, or are not part of a file.
FIXED_FIELDS = {
    "CalibrationFile.version",
    "MicroscopeCalibration.version",
    "TuningResult.format",
    "ListedProfile.problem",
    "LibraryEntry.missing",
}


def test_every_stored_field_differs_from_its_default_in_some_sample(config, data):
    has_other_value = {}
    pending = read_all_samples(config, data)
    while pending:
        value = pending.pop()
        if isinstance(value, Mapping):
            pending += value.values()
        elif isinstance(value, list | tuple):
            pending += value
        elif dataclasses.is_dataclass(value):
            for field in dataclasses.fields(value):
                field_value, name = (
                    getattr(value, field.name),
                    f"{find_owner(field, value)}.{field.name}",
                )
                has_other_value[name] = has_other_value.get(name, False) or not is_default(
                    field, field_value
                )
                pending.append(field_value)
    assert {
        name for name, differs in has_other_value.items() if not differs
    } - FIXED_FIELDS == set()


def find_owner(field, value):
    """Return the class that declares a field."""
    owners = [
        base for base in type(value).mro() if field.name in vars(base).get("__annotations__", {})
    ]
    return owners[-1].__name__


def is_default(field, value):
    factory = field.default_factory
    default = field.default if factory is dataclasses.MISSING else factory()
    if isinstance(value, np.ndarray) or isinstance(default, np.ndarray):
        return np.array_equal(value, default)
    return value == default


def find_patterns(node, path):
    """Return regular expressions that match the possible texts of an expression."""
    tree = parse_source(path)
    if isinstance(node, ast.Constant):
        return {re.escape(node.value)} if isinstance(node.value, str) else set()
    if isinstance(node, ast.JoinedStr):
        parts = (re.escape(p.value) if isinstance(p, ast.Constant) else ".+" for p in node.values)
        return {"".join(parts)}
    if isinstance(node, ast.Call):
        (function,) = (
            item
            for item in ast.walk(tree)
            if isinstance(item, ast.FunctionDef) and item.name == ast.unparse(node.func)
        )
        return_values = (item.value for item in ast.walk(function) if isinstance(item, ast.Return))
        return set().union(*(find_patterns(item, path) for item in return_values))
    if isinstance(node, ast.Attribute):
        _, module = find_import(tree, ast.unparse(node.value))
        return find_bound_patterns(node.attr, module)
    if isinstance(node, ast.Tuple | ast.List):
        return set().union(*(find_patterns(item, path) for item in node.elts))
    if isinstance(node, ast.Dict):
        return set().union(*(find_patterns(item, path) for item in node.keys))
    if isinstance(node, ast.Name):
        return find_bound_patterns(node.id, path)
    return set()


def find_bound_patterns(name, path):
    """Return the patterns of all values that a module binds to a name."""
    patterns = set()
    for node in ast.walk(parse_source(path)):
        if isinstance(node, ast.Assign):
            for target in node.targets:
                if isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
                    for element, value in zip(target.elts, node.value.elts, strict=True):
                        patterns |= (
                            find_patterns(value, path) if ast.unparse(element) == name else set()
                        )
                elif ast.unparse(target) == name:
                    patterns |= find_patterns(node.value, path)
        elif isinstance(node, ast.For | ast.comprehension):
            first = node.target.elts[0] if isinstance(node.target, ast.Tuple) else node.target
            if ast.unparse(first) == name:
                iterable = node.iter
                if isinstance(iterable, ast.Call) and ast.unparse(iterable.func).endswith(".items"):
                    iterable = iterable.func.value
                patterns |= find_patterns(iterable, path)
    return patterns or find_bound_patterns(*find_import(parse_source(path), name))


def find_import(tree, name):
    """Return the original name of an imported name, and the path of its module."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            module = node.module.removeprefix("rotemina.")
            for alias in node.names:
                if (alias.asname or alias.name) == name:
                    candidates = (
                        f"{module}.{alias.name}".replace(".", "/"),
                        module.replace(".", "/"),
                        find_exporting_module(module.replace(".", "/"), alias.name),
                    )
                    module_path = next(
                        f"{candidate}.py"
                        for candidate in candidates
                        if (ROOT / f"{candidate}.py").exists()
                    )
                    return alias.name, module_path
    raise AssertionError(f"{name}: unknown key of the preferences")


def find_exporting_module(folder, name):
    """Return the module from which a folder exports a name, or "" if it does not export it."""
    stub = ROOT / folder / "__init__.pyi"
    for node in ast.parse(stub.read_text("utf-8")).body if stub.exists() else ():
        if isinstance(node, ast.ImportFrom) and name in {alias.name for alias in node.names}:
            module = node.module.replace(".", "/") if node.module else name
            return f"{folder}/{module}"
    return ""


def test_the_sample_has_every_preference_and_no_unused_one(settings):
    paths_by_pattern = {}
    for path, calls in find_calls().items():
        for name, call in calls:
            owner, _, verb = name.rpartition(".")
            if verb in ("get", "set") and owner.rpartition(".")[2] in ("settings", "_settings"):
                patterns = find_patterns(call.args[0], path)
                assert patterns, f"{path}, line {call.lineno}: no key of a preference found"
                paths_by_pattern |= dict.fromkeys(patterns, path)
    stored = settings.values
    missing = {
        key: path
        for key, path in paths_by_pattern.items()
        if not any(re.fullmatch(key, stored_key) for stored_key in stored)
    }
    assert missing == {}, "add them to the sample of preferences"
    assert [
        key for key in stored if not any(re.fullmatch(pattern, key) for pattern in paths_by_pattern)
    ] == []


def test_every_setting_of_every_driver_is_in_the_sample(settings):
    for name in ("gcode", "mc68hc11", "simulator"):
        defaults = find_driver(name).default_settings
        stored_keys = {key for key in settings.values if key.startswith(f"driver.{name}.")}
        assert stored_keys == {f"driver.{name}.{key}" for key in defaults}


def test_samples_are_small_and_contain_no_paths_of_a_machine():
    files = [
        path for path in SAMPLES.rglob("*") if path.is_file() and "__pycache__" not in path.parts
    ]
    assert sum(path.stat().st_size for path in files) < 300_000
    sample_files = (path for path in files if path.suffix != ".py")
    assert [
        path
        for path in sample_files
        if re.search(rb"/(home|root|tmp|work|Users)/", path.read_bytes())
    ] == []
