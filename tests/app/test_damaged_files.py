"""Files as bad disks and bad hands make them: each is read or refused in words, by every reader."""

import gzip
import json
import random
from io import BytesIO

import cv2
import numpy as np
import pytest

from rotemina.app.bench.machine import machines
from rotemina.app.blind.cases import FolderCases
from rotemina.app.blind.classifier import classifier_for
from rotemina.app.calibration.files import FORMAT as SENSOR_FILES
from rotemina.app.calibration.health_book import HealthBook
from rotemina.app.cli.main import main
from rotemina.app.microscope.calibration_file import file_of, load
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.run_log import PenetrationRun, RunLog, Verdict
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import recover
from rotemina.app.motion.recording.writer import RecordingWriter
from rotemina.app.motion.saved_positions import FOLDER, SavedPositions
from rotemina.app.motion.teleoperation.axis_calibration import CalibrationFolder
from rotemina.app.motion.teleoperation.profile import load_profile
from rotemina.app.motion.teleoperation.scales import Scales
from rotemina.app.recorded_events import timeline_events
from rotemina.app.settings import Settings
from rotemina.drivers.cameras.errors import CameraLostError
from rotemina.drivers.cameras.sequence import ImageSequences
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.drivers.inputs.script import Script
from rotemina.drivers.samples import Samples
from rotemina.plugins.gap.blind_figures import BlindResult
from rotemina.sim.compensate import anfis
from rotemina.sim.compensate.file import Provenance, read_trained, write_trained
from rotemina.sim.compensate.samples import Samples as Compared
from rotemina.sim.compensate.training import train
from rotemina.sim.errors import InputError
from rotemina.sim.gap.output.document_reader import read_document
from rotemina.sim.plugin_import import _kept
from rotemina.sim.records.reading import read_record
from rotemina.sim.robot.file import load_robot, robot_file_text
from rotemina.sim.tuning.tuning_result import load_tuning

MUTATIONS = 2000  # of each kind of file
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
BLIND = {
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
        "robot": robot_file_text("rotemina"),
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
SENSOR = """robot = "RoTeMiNa"
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
PICTURES = """camera = "simulated:1"
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
STICK = """device = "046d:c215"
[axes."axis 1"]
low = -0.9
centre = 0.0
high = 0.95
dead_zone = 0.02
expo = 0.3
"""
DEVICE = InputIdentity("046d:c215", "stick", "somebody")
CARD = {"version": 1, "date": "2024-01-01", "record": "a.csv", "figures": [["a", 1.0, 0.1, "m"]]}
RUN = PenetrationRun(
    started="2024-01-01T10:00:00+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters={"axis": "zn"},
    verdict=Verdict.DONE,
    reason="",
    phases=(("approach", 0.0),),
)


def recorded(folder):
    """What a recording is while it runs, and when it has ended."""
    times = map(float, range(1000))
    writer = RecordingWriter(
        folder / "made.arrows",
        {"x": "m"},
        {"robot": "r", "robot_file": robot_file_text("rotemina")},
        clock=lambda: next(times),
    )
    values = np.arange(300.0)[:, None]
    samples = Samples(values[:, 0], values, values, values, np.arange(300))
    writer.connected()
    writer.add(samples, values, 1.0)
    writer.event("log", "said", {"level": "WARNING"})
    writer.record("stick", 1.0, {"x": 1.0})
    writer.run_once()
    running = writer.path.with_name("made.arrows.part").read_bytes()
    writer.close()
    return running, (folder / "made.arrows").read_bytes()


def tuned(folder):
    out = folder / "made.toml"
    short = ["--generations", "6", "--population", "12", "--jobs", "1"]
    assert main(["tune", "--axis", "zn", *short, "-o", str(out)]) == 0
    return out.read_bytes()


def trained(folder):
    """An inverse that is computed in an instant, as ``compensate train`` writes it."""
    rng = np.random.default_rng(0)
    turns = np.linspace(0.0, 40.0, 3000)
    command = 65e-6 * (0.5 - 0.4 * np.linspace(1.0, 0.2, 3000) * np.cos(turns))
    measured = 0.9 * command + 1e-9 * rng.standard_normal(3000)
    samples = Compared("made", "zn", "m", 1e-3, command, measured)
    settings = anfis.Settings(memberships=3, plays=(), epochs=2, patience=2)
    about = Provenance(robot="RoTeMiNa", trained_on=[], held_out=[], seed=None, versions={})
    write_trained(folder / "made.json", train(ROBOT, [samples], settings=settings), about)
    return (folder / "made.json").read_bytes()


def classified(_):
    file = BytesIO()
    np.savez(file, rows=np.arange(12.0).reshape(3, 4), names=np.array(["a", "b", "c"]))
    return file.getvalue()


def read_recording(path):
    recording = Recording.open(path)
    timeline_events(recording.events(), recording.began_s)
    list(recording.pieces())
    for name in recording.channels:
        recording.channel(name)
    assert recording.robot


def read_unfinished(path):
    merged = recover(path)
    try:
        read_recording(merged)
    finally:
        merged.unlink()


def read_sequence(path):
    source = ImageSequences()
    camera = source.camera(source.addressed(str(path)))
    try:
        camera.open()
    finally:
        camera.close()


def read_positions(path):
    positions = SavedPositions(path.parent, ROBOT)
    positions.path.parent.mkdir(exist_ok=True)
    path.rename(positions.path)
    assert FOLDER in str(positions.path)
    positions.read()


def read_cards(path):
    book = HealthBook(path.parent, "r")
    book.path("x").parent.mkdir(exist_ok=True)
    path.rename(book.path("x"))
    book.cards("x")


def read_truth(path):
    for name in ("robot.toml", "train_1.csv"):
        text = robot_file_text("rotemina") if name == "robot.toml" else RECORD
        (path.parent / name).write_text(text)
    machines([path.parent])


def read_labels(path):
    (path.parent / "case").mkdir(exist_ok=True)
    (path.parent / "case" / "train_1.csv").write_text(RECORD)
    cases = FolderCases(path.parent, path, "rotemina")
    with cases.sealed("case", "salt") as case:
        cases.label("case", "salt", case.seal)


def read_stick(path):
    folder = CalibrationFolder(path.parent)
    path.rename(folder.path(DEVICE))
    folder.read(DEVICE)


def read_pictures(path):
    path.rename(file_of(path.parent, "simulated:1", "20x"))
    found = load(path.parent, "simulated:1", "20x")
    found.stage("micro").pixel_of(np.zeros(3))


def read_settings(path):
    settings = Settings(path)
    for key, default in (("a", 1.0), ("b", "text"), ("c", False)):
        settings.get(key, default)


def picture(kind):
    pixels = np.arange(48 * 64, dtype=np.uint16).reshape(48, 64)
    return cv2.imencode(kind, pixels)[1].tobytes()


READERS = {
    "robot.toml": (robot_file_text("rotemina"), load_robot),
    "record.csv": (RECORD, read_record),
    "record.csv.gz": (gzip.compress(RECORD.encode(), mtime=0), read_record),
    "script.csv": ("time_s,axis x,button a,plugged\n0,0.5,1,1\n1,-0.5,0,0\n", Script.load),
    "profile.toml": (PROFILE, load_profile),
    "positions.toml": (POSITIONS, read_positions),
    "scales.toml": ("[modes.joints.x]\nway = 1e-4\nspeed = 1e-3\n", Scales.load),
    "penetration.toml": (PenetrationParameters().text(), PenetrationParameters.load),
    "runs.jsonl": (RUN.line() + "\n", lambda path: RunLog(path).read()),
    "cards.jsonl": (json.dumps(CARD) + "\n", read_cards),
    "inverse.json": (trained, read_trained),
    "sensor.toml": (SENSOR, lambda path: SENSOR_FILES.load(path).applied),
    "pictures.toml": (PICTURES, read_pictures),
    "stick.toml": (STICK, read_stick),
    "truth.toml": (TRUTH, read_truth),
    "labels.json": (json.dumps(LABELS), read_labels),
    "classifier.npz": (classified, lambda path: classifier_for(ROBOT, path)),
    "tuning.toml": (tuned, load_tuning),
    "diagnosis.json": (json.dumps(DIAGNOSIS), lambda path: read_document(path).corrected),
    "blind.json": (json.dumps(BLIND), BlindResult.read),
    "imports.json": (json.dumps({"a:b 0": "it fails"}), _kept),
    "settings.json": (json.dumps({"a": 1.5, "b": "c", "c": True}), read_settings),
    "picture.png": (picture(".png"), read_sequence),
    "picture.tiff": (picture(".tiff"), read_sequence),
    "run.arrows": (lambda folder: recorded(folder)[1], read_recording),
    "run.arrows.part": (lambda folder: recorded(folder)[0], read_unfinished),
}


def mutated(data, rng):
    """Flip bits, cut, repeat, drop or put in what parsers stumble over, once to four times."""
    found = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(found) + 1)
        length = rng.choice((1, 1, 4, 30))
        way = rng.randrange(5)
        if way == 0 and at < len(found):
            found[at] ^= 1 << rng.randrange(8)
        elif way == 1:
            del found[at:]
        elif way == 2:
            del found[at : at + length]
        elif way == 3:
            found[at:at] = found[at : at + length] * rng.choice((1, 2, 500))
        else:
            found[at : at + length] = rng.choice(SPITE)
    return bytes(found)


SPITE = (
    b"\0", b"\xff\xff\xff\xff", b"nan", b"inf", b"-1", b"1e999", b"9" * 400, b"[[[", b"{}", b'"',
    b"\r", b"\n", b"null", b"true", b"[]", b"\\ud800", b"=", b".", b",", b"-0", b"''", b"\xc2",
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", READERS)
def test_a_damaged_file_is_read_or_refused(name, tmp_path, capfd):
    made, read = READERS[name]
    data = made(tmp_path) if callable(made) else made
    data = data.encode() if isinstance(data, str) else data
    rng = random.Random(name)  # noqa: S311 (nothing secret)
    path = tmp_path / name
    read_once(path, data, read)
    for number in range(MUTATIONS):
        damaged = mutated(data, rng)
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
