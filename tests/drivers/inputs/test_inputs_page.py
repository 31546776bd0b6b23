"""The examples on the page about input devices work, and it names the right file."""

import re
from pathlib import Path

import pytest

from rotemina.drivers.contract import InputLostError, StateError
from rotemina.drivers.inputs import InputChanges, InputHub, InputSource, hid_library as hidapi
from rotemina.drivers.inputs.script import InputScript

PAGE = (Path(__file__).parents[3] / "docs" / "inputs.md").read_text("utf-8")


def find_code_block(language):
    (text,) = re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)
    return text


@pytest.fixture
def page_names(tmp_path):
    """Return the names that the page's Python example defines."""
    names = {}
    exec(find_code_block("python"), names)  # noqa: S102 - the page's own code
    names["FILE"] = tmp_path / "knobs.txt"
    return names


def test_the_example_source_works(page_names, clock):
    file = page_names["FILE"]
    hub = InputHub({"knobs": page_names["Knobs"](clock=clock)})
    assert issubclass(page_names["Knobs"], InputSource)
    assert hub.poll() == InputChanges()
    file.write_text("1 1 1\n")
    assert hub.poll().added == (page_names["KNOBS"],)
    device = hub.open("knobs:1")
    assert device.read() == ()
    with file.open("a") as appended_file:
        appended_file.write("0.5 -0.25 1\n0 0 0\n")
    readings = device.read()
    assert [reading.axes for reading in readings] == [(0.5, -0.25), (0.0, 0.0)]
    assert [reading.buttons for reading in readings] == [(True,), (False,)]
    assert readings[0].host_time_s == clock()
    file.unlink()
    with pytest.raises(InputLostError):
        device.read()
    hub.note_loss("knobs:1")
    assert hub.poll() == InputChanges(removed=(page_names["KNOBS"],))
    device.close()
    device.close()
    with pytest.raises(StateError):
        device.read()
    assert hub.problems == {}


def test_the_example_script_plays(tmp_path):
    path = tmp_path / "script.csv"
    path.write_text(find_code_block("csv"), "utf-8")
    script = InputScript.load(path)
    assert script.axes == ("x", "y")
    assert [moment.plugged for moment in script.moments] == [True, True, False, True]


def test_the_page_and_the_message_name_the_same_rules_file():
    (name,) = re.findall(r"/etc/udev/rules\.d/[\w.-]+", hidapi._PERMISSION_HINT)
    assert f"`{name}`" in PAGE
