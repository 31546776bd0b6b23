"""The page about input devices: its examples work, and what it names is there."""

import re
from pathlib import Path

import pytest

from rotemina.drivers.errors import StateError
from rotemina.drivers.inputs.device import InputLostError, InputSource
from rotemina.drivers.inputs.hid import hidapi
from rotemina.drivers.inputs.hub import Changes, InputHub
from rotemina.drivers.inputs.script import Script

PAGE = (Path(__file__).parents[3] / "docs" / "inputs.md").read_text("utf-8")


def block(language):
    (text,) = re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)
    return text


@pytest.fixture
def page(tmp_path):
    names = {}
    exec(block("python"), names)  # noqa: S102 - the page's own code
    names["FILE"] = tmp_path / "knobs.txt"
    return names


def test_the_example_source_works(page, clock):
    file = page["FILE"]
    hub = InputHub({"knobs": page["Knobs"](clock=clock)})
    assert issubclass(page["Knobs"], InputSource)
    assert hub.poll() == Changes()
    file.write_text("1 1 1\n")
    assert hub.poll().arrived == (page["KNOBS"],)
    device = hub.open("knobs:1")
    assert device.read() == ()
    with file.open("a") as end:
        end.write("0.5 -0.25 1\n0 0 0\n")
    readings = device.read()
    assert [reading.axes for reading in readings] == [(0.5, -0.25), (0.0, 0.0)]
    assert [reading.buttons for reading in readings] == [(True,), (False,)]
    assert readings[0].host_time_s == clock()
    file.unlink()
    with pytest.raises(InputLostError):
        device.read()
    hub.lost("knobs:1")
    assert hub.poll() == Changes(left=(page["KNOBS"],))
    device.close()
    device.close()
    with pytest.raises(StateError):
        device.read()
    assert hub.problems == {}


def test_the_example_script_plays(tmp_path):
    path = tmp_path / "script.csv"
    path.write_text(block("csv"), "utf-8")
    script = Script.load(path)
    assert script.axes == ("x", "y")
    assert [moment.plugged for moment in script.moments] == [True, True, False, True]


def test_the_rules_file_is_the_one_that_the_message_names():
    (name,) = re.findall(r"/etc/udev/rules\.d/[\w.-]+", hidapi._PERMISSION)
    assert f"`{name}`" in PAGE
