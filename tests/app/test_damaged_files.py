"""Damaged files: every reader either reads one or refuses it with an error of the program."""

import gzip
import json
import random
from io import BytesIO

import cv2
import numpy as np
import pytest

from rotemina.app.bench.machine import find_machines
from rotemina.app.blind.cases import FolderCaseSource
from rotemina.app.blind.classifier import load_or_train_classifier
from rotemina.app.calibration import CALIBRATION_FORMAT as SENSOR_FILES, HealthBook
from rotemina.app.cli.main import main
from rotemina.app.microscope.calibration_file import load_calibration, make_calibration_path
from rotemina.app.motion.inputs.axis_calibration import InputCalibrationFolder
from rotemina.app.motion.inputs.profile import load_profile
from rotemina.app.motion.penetration import (
    PenetrationParameters,
    PenetrationRun,
    PenetrationVerdict,
    RunLog,
)
from rotemina.app.motion.recording import Recording, recover_recording
from rotemina.app.motion.recording.writer import RecordingWriter
from rotemina.app.motion.session import SavedPositions
from rotemina.app.motion.session.saved_positions import POSITIONS_FOLDER
from rotemina.app.motion.teleoperation import ModeScales
from rotemina.app.records import make_timeline_events
from rotemina.app.settings import UserSettings
from rotemina.drivers.cameras.sequence import ImageSequenceSource
from rotemina.drivers.contract import CameraLostError, DeviceSamples, VirtualClock
from rotemina.drivers.inputs import InputIdentity
from rotemina.drivers.inputs.script import InputScript
from rotemina.plugins.gap.blind.blind_figures import BlindResult
from rotemina.sim.compensate import (
    InverseProvenance,
    TrainingSamples,
    anfis,
    read_trained,
    train,
    write_trained,
)
from rotemina.sim.errors import InputError
from rotemina.sim.gap.output import read_document
from rotemina.sim.plugin_points.trial_import import _read_results
from rotemina.sim.records import read_record
from rotemina.sim.robot_files import load_robot, read_robot_file
from rotemina.sim.tuning import load_tuning

#: Mutations of each kind of file.
MUTATIONS = 2000
ROBOT = load_robot("rotemina")

RECORD = "# mode: open_loop\nt [s],x.cmd [um],x.meas [um]\n" + "".join(
    f"{0.001 * row:.3f},{row},{row + 0.5}\n" for row in range(40)
)
PROFILE = """name = "Two sticks"
[[devices]]
key = "046d:c215"
seat = "trainer"
[[devices.axes]]
control = "axis 1"
drives = "x"
"""
POSITIONS = """robot = "RoTeMiNa"
[positions.home]
x = 0.0
y = 0.0
z = 0.0
thx = 0.0
thy = 0.0
zn = 1e-5
"""
BLIND_RESULT = {
    "figures": {"top1": {"value": 0.9, "interval": [0.8, 0.95], "n": 40}},
    "confusion": [{"truth": "creep", "named": "creep", "number": 3}],
    "done": 40,
    "asked": 50,
}
DIAGNOSIS = {
    "format": "rotemina-diagnosis 1",
    "verdict": "explained",
    "axes": {"zn": "explained"},
    "model": {
        "robot": read_robot_file("rotemina"),
        "effects": [{"axis": "zn", "effect": "creep", "parameters": {"rate": 0.02}}],
    },
}
TRUTH = 'causes = [["hysteresis", "creep"]]\nalso = ["friction"]\ntap = "meas"\nto_beat = 0.5\n'
LABELS = {
    "case": {
        "verdict": "explained",
        "effects": [{"axis": "zn", "effect": "creep"}],
        "floors": 3.0,
    }
}
SENSOR_CALIBRATION = """robot = "RoTeMiNa"
axis = "zn"
unit = "m"
date = "2024-01-01T10:00:00+00:00"
travel = [0.0, 65e-6]
runs = 3
before_rms = 1e-7
after_rms = 1e-9
notes = ["warm"]
[sensor]
low = 0.0
high = 65e-6
offset = 1e-8
gain_error = 0.01
bend = [1e-9, 2e-9]
lag = "delay"
lag_s = 1e-4
[[figures]]
name = "gain_error"
value = 0.01
half_width = 0.001
unit = "1"
[[sources]]
name = "a.csv"
digest = "0123456789abcdef"
"""
MICROSCOPE_CALIBRATION = """camera = "simulated:1"
objective = "20x"
[view]
left = 0
top = 0
width = 1300
height = 1030
[micro]
date = "2024-01-01T10:00:00+00:00"
matrix = [[3e6, 1e3], [-1e3, 3e6]]
covariance = [[1.0, 0, 0, 0], [0, 1.0, 0, 0], [0, 0, 1.0, 0], [0, 0, 0, 1.0]]
tip_m = [0.0, 0.0, 0.01]
tip_px = [650.0, 515.0]
residual_px = 0.1
"""
JOYSTICK_CALIBRATION = """device = "046d:c215"
[axes."axis 1"]
low = -0.9
centre = 0.0
high = 0.95
dead_zone = 0.02
expo = 0.3
"""
JOYSTICK = InputIdentity("046d:c215", "stick", "somebody")
HEALTH_CARD = {
    "version": 1,
    "date": "2024-01-01",
    "record": "a.csv",
    "figures": [["a", 1.0, 0.1, "m"]],
}
PENETRATION_RUN = PenetrationRun(
    started="2024-01-01T10:00:00+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters={"axis": "zn"},
    verdict=PenetrationVerdict.DONE,
    reason="",
    phases=(("approach", 0.0),),
)


def make_recordings(folder):
    """Return the bytes of a recording while it runs and after it has ended."""
    times = map(float, range(1000))
    writer = RecordingWriter(
        folder / "made.arrows",
        {"x": "m"},
        {"robot": "r", "robot_file": read_robot_file("rotemina")},
        clock=lambda: next(times),
    )
    values = np.arange(300.0)[:, None]
    samples = DeviceSamples(values[:, 0], values, values, values, np.arange(300))
    writer.start_connection()
    writer.add(samples, values, 1.0)
    writer.add_event("log", "said", {"level": "WARNING"})
    writer.add_row("stick", 1.0, {"x": 1.0})
    writer.run_once()
    running = writer.path.with_name("made.arrows.part").read_bytes()
    writer.close()
    return running, (folder / "made.arrows").read_bytes()


def make_tuning(folder):
    path = folder / "made.toml"
    options = ["--generations", "6", "--population", "12", "--jobs", "1"]
    assert main(["tune", "--axis", "zn", *options, "-o", str(path)]) == 0
    return path.read_bytes()


def make_inverse(folder):
    """Return a small inverse model as ``compensate train`` writes it."""
    rng = np.random.default_rng(0)
    phase = np.linspace(0.0, 40.0, 3000)
    command = 65e-6 * (0.5 - 0.4 * np.linspace(1.0, 0.2, 3000) * np.cos(phase))
    measured = 0.9 * command + 1e-9 * rng.standard_normal(3000)
    samples = TrainingSamples("made", "zn", "m", 1e-3, command, measured)
    settings = anfis.AnfisSettings(memberships=3, plays=(), epochs=2, patience=2)
    provenance = InverseProvenance(
        robot="RoTeMiNa", trained_on=[], held_out=[], seed=None, versions={}
    )
    write_trained(folder / "made.json", train(ROBOT, [samples], settings=settings), provenance)
    return (folder / "made.json").read_bytes()


def make_classifier(_):
    file = BytesIO()
    np.savez(file, rows=np.arange(12.0).reshape(3, 4), names=np.array(["a", "b", "c"]))
    return file.getvalue()


def read_recording(path):
    recording = Recording.open(path)
    make_timeline_events(recording.read_events(), recording.began_s)
    list(recording.read_pieces())
    for name in recording.channels:
        recording.read_channel(name)
    assert recording.robot


def read_unfinished(path):
    merged = recover_recording(path)
    try:
        read_recording(merged)
    finally:
        merged.unlink()


def read_sequence(path):
    clock = VirtualClock()
    # A picture that cannot be read is tried again for a second.
    source = ImageSequenceSource(clock=clock, wait=lambda _seconds: clock.advance(1.0))
    camera = source.camera(source.parse_address(str(path)))
    try:
        camera.open()
    finally:
        camera.close()


def read_positions(path):
    positions = SavedPositions(path.parent, ROBOT)
    positions.path.parent.mkdir(exist_ok=True)
    path.rename(positions.path)
    assert POSITIONS_FOLDER in str(positions.path)
    positions.read()


def read_cards(path):
    book = HealthBook(path.parent, "r")
    book.make_path("x").parent.mkdir(exist_ok=True)
    path.rename(book.make_path("x"))
    book.read_cards("x")


def read_truth(path):
    for name in ("robot.toml", "train_1.csv"):
        text = read_robot_file("rotemina") if name == "robot.toml" else RECORD
        (path.parent / name).write_text(text)
    find_machines([path.parent])


def read_labels(path):
    (path.parent / "case").mkdir(exist_ok=True)
    (path.parent / "case" / "train_1.csv").write_text(RECORD)
    cases = FolderCaseSource(path.parent, path, "rotemina")
    with cases.open_case("case", "salt") as case:
        cases.open_label("case", "salt", case.seal)


def read_joystick_calibration(path):
    folder = InputCalibrationFolder(path.parent)
    path.rename(folder.make_path(JOYSTICK))
    folder.read(JOYSTICK)


def read_microscope_calibration(path):
    path.rename(make_calibration_path(path.parent, "simulated:1", "20x"))
    calibration = load_calibration(path.parent, "simulated:1", "20x")
    calibration.get_stage("micro").predict_pixel(np.zeros(3))


def read_settings(path):
    settings = UserSettings(path)
    for key, default in (("a", 1.0), ("b", "text"), ("c", False)):
        settings.get(key, default)


def encode_picture(kind):
    pixels = np.arange(48 * 64, dtype=np.uint16).reshape(48, 64)
    return cv2.imencode(kind, pixels)[1].tobytes()


READERS = {
    "robot.toml": (read_robot_file("rotemina"), load_robot),
    "record.csv": (RECORD, read_record),
    "record.csv.gz": (gzip.compress(RECORD.encode(), mtime=0), read_record),
    "script.csv": ("time_s,axis x,button a,plugged\n0,0.5,1,1\n1,-0.5,0,0\n", InputScript.load),
    "profile.toml": (PROFILE, load_profile),
    "positions.toml": (POSITIONS, read_positions),
    "scales.toml": ("[modes.joints.x]\nway = 1e-4\nspeed = 1e-3\n", ModeScales.load),
    "penetration.toml": (PenetrationParameters().text(), PenetrationParameters.load),
    "runs.jsonl": (PENETRATION_RUN.to_json() + "\n", lambda path: RunLog(path).read()),
    "cards.jsonl": (json.dumps(HEALTH_CARD) + "\n", read_cards),
    "inverse.json": (make_inverse, read_trained),
    "sensor.toml": (SENSOR_CALIBRATION, lambda path: SENSOR_FILES.load(path).applied_calibration),
    "pictures.toml": (MICROSCOPE_CALIBRATION, read_microscope_calibration),
    "stick.toml": (JOYSTICK_CALIBRATION, read_joystick_calibration),
    "truth.toml": (TRUTH, read_truth),
    "labels.json": (json.dumps(LABELS), read_labels),
    "classifier.npz": (make_classifier, lambda path: load_or_train_classifier(ROBOT, path)),
    "tuning.toml": (make_tuning, load_tuning),
    "diagnosis.json": (json.dumps(DIAGNOSIS), lambda path: read_document(path).corrected),
    "blind.json": (json.dumps(BLIND_RESULT), BlindResult.read),
    "imports.json": (json.dumps({"a:b 0": "it fails"}), _read_results),
    "settings.json": (json.dumps({"a": 1.5, "b": "c", "c": True}), read_settings),
    "picture.png": (encode_picture(".png"), read_sequence),
    "picture.tiff": (encode_picture(".tiff"), read_sequence),
    "run.arrows": (lambda folder: make_recordings(folder)[1], read_recording),
    "run.arrows.part": (lambda folder: make_recordings(folder)[0], read_unfinished),
}


def mutate(data, rng):
    """Apply one to four mutations: flip bits, cut, drop, repeat, or insert awkward bytes."""
    damaged = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        position = rng.randrange(len(damaged) + 1)
        length = rng.choice((1, 1, 4, 30))
        kind = rng.randrange(5)
        if kind == 0 and position < len(damaged):
            damaged[position] ^= 1 << rng.randrange(8)
        elif kind == 1:
            del damaged[position:]
        elif kind == 2:
            del damaged[position : position + length]
        elif kind == 3:
            damaged[position:position] = damaged[position : position + length] * rng.choice(
                (1, 2, 500)
            )
        else:
            damaged[position : position + length] = rng.choice(AWKWARD_BYTES)
    return bytes(damaged)


AWKWARD_BYTES = (
    b"\0", b"\xff\xff\xff\xff", b"nan", b"inf", b"-1", b"1e999", b"9" * 400, b"[[[", b"{}", b'"',
    b"\r", b"\n", b"null", b"true", b"[]", b"\\ud800", b"=", b".", b",", b"-0", b"''", b"\xc2",
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", READERS)
def test_a_damaged_file_is_read_or_refused(name, tmp_path, capfd):
    source, read = READERS[name]
    data = source(tmp_path) if callable(source) else source
    data = data.encode() if isinstance(data, str) else data
    rng = random.Random(name)  # noqa: S311 (nothing secret)
    path = tmp_path / name
    read_once(path, data, read)
    for number in range(MUTATIONS):
        damaged = mutate(data, rng)
        try:
            read_once(path, damaged, read)
        except (InputError, CameraLostError):
            pass
        except Exception as error:
            (tmp_path / "damaged").write_bytes(damaged)
            raise AssertionError(f"{name}, mutation {number}: {error!r}") from error
    assert "RuntimeWarning" not in capfd.readouterr().err


def read_once(path, data, read):
    path.write_bytes(data)
    read(path)
