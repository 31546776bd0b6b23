"""Damaged files: every reader either reads one or refuses it with an error of the program.

The undamaged files are those of ``tests/samples``.
"""

import json
import random
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.bench.machine import find_machines
from rotemina.app.blind.cases import FolderCaseSource
from rotemina.app.blind.classifier import load_or_train_classifier
from rotemina.app.calibration import CALIBRATION_FORMAT as SENSOR_FILES, HealthBook
from rotemina.app.microscope.calibration_file import load_calibration, make_calibration_path
from rotemina.app.motion.inputs.axis_calibration import InputCalibrationFolder
from rotemina.app.motion.inputs.profile import load_profile
from rotemina.app.motion.penetration import PenetrationParameters, RunLog
from rotemina.app.motion.recording import Recording, recover_recording
from rotemina.app.motion.session import SavedPositions
from rotemina.app.motion.session.saved_positions import POSITIONS_FOLDER
from rotemina.app.motion.teleoperation import ModeScales
from rotemina.app.records import make_timeline_events
from rotemina.app.settings import UserSettings
from rotemina.drivers.cameras.sequence import ImageSequenceSource
from rotemina.drivers.contract import CameraLostError, VirtualClock
from rotemina.drivers.inputs import InputIdentity
from rotemina.drivers.inputs.script import InputScript
from rotemina.plugins.gap.blind.blind_figures import BlindResult
from rotemina.sim.compensate import read_trained
from rotemina.sim.errors import InputError
from rotemina.sim.gap.output import read_document
from rotemina.sim.plugin_points.trial_import import _read_results
from rotemina.sim.records import read_record
from rotemina.sim.robot_files import load_robot, read_robot_file
from rotemina.sim.tuning import load_tuning

#: Mutations of each kind of file.
MUTATIONS = 500
SAMPLES = Path(__file__).parents[1] / "samples"
CALIBRATIONS = "config/calibrations"
ROBOT = load_robot("rotemina")
JOYSTICK = InputIdentity("hid:046d:c215:0001", "a stick", "hid")
RECORD = "# mode: open_loop\nt [s],x.cmd [um],x.meas [um]\n0,0,0.5\n0.001,1,1.5\n"
#: Files that only people write, or that the program can make again.
TEXTS = {
    "script.csv": "time_s,axis x,button a,plugged\n0,0.5,1,1\n1,-0.5,0,0\n",
    "truth.toml": (
        'causes = [["hysteresis", "creep"]]\nalso = ["friction"]\ntap = "meas"\nto_beat = 0.5\n'
    ),
    "labels.json": json.dumps(
        {
            "case": {
                "verdict": "explained",
                "effects": [{"axis": "zn", "effect": "creep"}],
                "floors": 3.0,
            }
        }
    ),
    "imports.json": json.dumps({"a:b 0": "it fails"}),
}


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


def read_classifier(path):
    load_or_train_classifier(ROBOT, path)


def read_sensor_calibration(path):
    assert SENSOR_FILES.load(path).applied_calibration


def read_joystick_calibration(path):
    folder = InputCalibrationFolder(path.parent)
    path.rename(folder.make_path(JOYSTICK))
    folder.read(JOYSTICK)


def read_microscope_calibration(path):
    path.rename(make_calibration_path(path.parent, "opencv:0", "20x/0.4"))
    calibration = load_calibration(path.parent, "opencv:0", "20x/0.4")
    calibration.get_stage("micro").predict_pixel(np.zeros(3))


def read_settings(path):
    settings = UserSettings(path)
    for key in [*settings.values]:
        for default in (1.0, "text", False):
            settings.get(key, default)


READERS = {
    "files/robot.toml": load_robot,
    "files/record.csv": read_record,
    "data/played/2026-03-04_05-06-07-000000_tour.csv.gz": read_record,
    "config/profiles/Two sticks.toml": load_profile,
    "config/positions/RoTeMiNa.toml": read_positions,
    "config/scales.toml": ModeScales.load,
    "config/penetration.toml": PenetrationParameters.load,
    "data/penetrations.jsonl": lambda path: RunLog(path).read(),
    "config/health/RoTeMiNa--zn.jsonl": read_cards,
    "files/inverse.json": read_trained,
    f"{CALIBRATIONS}/RoTeMiNa/zn--2026-03-04T05-06-07+00-00.toml": read_sensor_calibration,
    f"{CALIBRATIONS}/hid_046d_c215_0001-fa0e56c6.toml": read_joystick_calibration,
    "config/microscope/opencv_0--20x_0.4.toml": read_microscope_calibration,
    "data/blind/RoTeMiNa-seed-7/classifier.npz": read_classifier,
    "files/tuning.toml": load_tuning,
    "outputs/gap.json": lambda path: read_document(path).corrected,
    "outputs/blind.json": BlindResult.read,
    "config/settings.json": read_settings,
    "files/snapshot.png": read_sequence,
    "files/stack.tif": read_sequence,
    "data/recordings/2026-03-04_05-06-07-000000_session.arrows": read_recording,
    "data/recordings/2026-03-04_06-07-08-000000.arrows.part": read_unfinished,
    "script.csv": InputScript.load,
    "truth.toml": read_truth,
    "labels.json": read_labels,
    "imports.json": _read_results,
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


@pytest.mark.parametrize("name", READERS)
def test_a_damaged_file_is_read_or_refused(name, tmp_path, capfd):
    read = READERS[name]
    data = TEXTS[name].encode() if name in TEXTS else (SAMPLES / name).read_bytes()
    rng = random.Random(name)  # noqa: S311 (nothing secret)
    path = tmp_path / Path(name).name
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
