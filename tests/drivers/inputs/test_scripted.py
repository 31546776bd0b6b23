"""A script plays on the clock, from a list or a file. Errors in a file name the place."""

import pytest

from rotemina.drivers.contract import InputLostError, LimitError, ScriptError
from rotemina.drivers.inputs import RumbleDevice
from rotemina.drivers.inputs.script import InputScript, ScriptMoment
from rotemina.drivers.inputs.scripted import ScriptedSource

SCRIPT_TEXT = """\
time_s, axis x, axis y, button start, plugged
0, 0, 0, 0, 1
0.5, 1, -0.25, 0, 1

1.0, 1, 0, 1, 1
2.0, 0, 0, 0, 0
3.0, 0, 0.5, 0, 1
"""


@pytest.fixture
def write_script(tmp_path):
    path = tmp_path / "script.csv"

    def write(text):
        path.write_text(text, "utf-8")
        return path

    return write


@pytest.fixture
def source(write_script, clock):
    return ScriptedSource(InputScript.load(write_script(SCRIPT_TEXT)), clock=clock)


def test_a_file_is_read(write_script):
    script = InputScript.load(write_script(SCRIPT_TEXT))
    assert (script.axes, script.buttons) == (("x", "y"), ("start",))
    assert script.moments[1:3] == (
        ScriptMoment(0.5, (1.0, -0.25), (False,)),
        ScriptMoment(1.0, (1.0, 0.0), (True,)),
    )
    assert [moment.plugged for moment in script.moments] == [True, True, True, False, True]


def test_a_file_from_a_spreadsheet_is_read(tmp_path):
    path = tmp_path / "script.csv"
    path.write_bytes("time_s,axis θx\r\n0,1\r\n".encode("utf-8-sig"))
    assert InputScript.load(path).axes == ("θx",)


def test_a_script_plays_on_the_clock(source, clock):
    start_s = clock()
    device = source.open(source.identity)
    assert [reading.axes for reading in device.read()] == [(0.0, 0.0)]
    clock.advance(0.4)
    assert device.read() == ()
    clock.advance(0.7)
    readings = device.read()
    assert [reading.host_time_s - start_s for reading in readings] == [0.5, 1.0]
    assert [reading.buttons for reading in readings] == [(False,), (True,)]


def test_a_script_can_unplug_and_plug_in_the_device(source, clock):
    device = source.open(source.identity)
    clock.advance(2.5)
    assert source.devices() == ()
    with pytest.raises(InputLostError, match="by its script"):
        device.read()
    with pytest.raises(InputLostError, match="not plugged in"):
        source.open(source.identity)
    clock.advance(1.5)
    # The device that was opened before the unplugging stays lost.
    with pytest.raises(InputLostError):
        device.read()
    (reading,) = source.open(source.identity).read()
    assert reading.axes == (0.0, 0.5)
    # A reading is never older than the opening.
    assert reading.host_time_s == clock()


def test_a_short_unplugging_is_not_missed(source, clock):
    device = source.open(source.identity)
    clock.advance(3.5)
    with pytest.raises(InputLostError):
        device.read()


def test_a_script_can_be_restarted(source, clock):
    clock.advance(2.5)
    source.start()
    assert source.open(source.identity).read()[0].axes == (0.0, 0.0)


def test_rumble_calls_are_recorded(source, clock):
    device = source.open(source.identity)
    assert isinstance(device, RumbleDevice)
    device.rumble(0.5)
    clock.advance(1.0)
    device.rumble(0)
    assert device.rumble_calls == [(clock() - 1.0, 0.5), (clock(), 0)]
    for strength in (-0.1, 1.5, float("nan")):
        with pytest.raises(LimitError, match="must be 0 to 1"):
            device.rumble(strength)


def test_a_bad_file_is_refused_with_the_place_of_the_error(write_script):
    for text, reason in {
        "": "line 1: column 'time_s' is missing",
        "axis x\n1\n": "line 1: column 'time_s' is missing",
        "time_s,x\n0,1\n": "line 1: unknown column 'x'",
        "time_s,axis x,axis x\n": "line 1: column 'axis x' appears twice",
        "time_s,axis x\n0,1\n1\n": "line 3: 1 values: must be 2",
        "time_s,axis x\n0,1\n1,far\n": "line 3, column 'axis x': 'far' is not a number",
        "time_s,button a\n0,0.5\n": "line 2, column 'button a': 0.5: must be 0 or 1",
        "time_s,plugged\n0,2\n": "line 2, column 'plugged': 2: must be 0 or 1",
        "time_s,axis x\n0,1\n0,1\n": "moment 2: time 0 s: must be later .* \\(0 s\\)",
        "time_s,axis x\nnan,1\n": "moment 1: time nan s",
        "time_s,axis x\n0,1.5\n": "moment 1: x at 1.5: must be -1 to 1",
        "time_s,axis x\n0,nan\n": "moment 1: x at nan: must be -1 to 1",
    }.items():
        with pytest.raises(ScriptError, match=f"script.csv.*{reason}"):
            InputScript.load(write_script(text))


def test_a_missing_or_binary_file_is_refused(write_script, tmp_path):
    with pytest.raises(ScriptError, match="cannot be read"):
        InputScript.load(tmp_path / "nowhere.csv")
    (tmp_path / "script.csv").write_bytes(b"time_s\n\xff\n")
    with pytest.raises(ScriptError, match=r"not UTF-8 text \(byte 7\)"):
        InputScript.load(tmp_path / "script.csv")


def test_moments_with_a_wrong_number_of_controls_are_refused():
    with pytest.raises(ScriptError, match="1 axes and 0 buttons: must be 2 and 0"):
        InputScript(("x", "y"), (), (ScriptMoment(0.0, (1.0,)),))
