"""The text of an error is the message that it was raised with."""

import importlib
import sys

import pytest

from rotemina.drivers.contract import ConnectionLostError, InputLostError, LimitError
from rotemina.drivers.inputs import device
from rotemina.sim.errors import InputError, describe_exception
from rotemina.sim.messages import AxisName, message


def test_the_text_of_an_error_is_the_message_itself():
    text = message("engine", "axis {axis} moves").fill(axis=AxisName("zn"))
    for error_class in (InputError, LimitError, ConnectionLostError):
        assert str(error_class(text)) is text
    assert str(InputError("plain")) == "plain"
    assert str(ConnectionLostError(5, "gone")) == "[Errno 5] gone"


def test_an_error_without_a_text_is_named_by_its_class():
    assert str(InputError()) == str(InputError("")) == "InputError"
    assert describe_exception(ConnectionLostError()) == "ConnectionLostError"


@pytest.mark.parametrize(
    ("module", "name"),
    [
        ("rotemina.drivers.cameras.errors", "CameraReadError"),
        ("rotemina.drivers.errors", "LimitError"),
        ("rotemina.drivers.settings", "SettingError"),
        ("rotemina.sim.effects.errors", "EffectError"),
        ("rotemina.sim.gap.errors", "GapError"),
    ],
)
def test_an_error_can_be_imported_from_its_former_module_with_a_warning(monkeypatch, module, name):
    monkeypatch.delitem(sys.modules, module, raising=False)
    with pytest.warns(DeprecationWarning, match="until the next release"):
        assert issubclass(getattr(importlib.import_module(module), name), Exception)


def test_an_error_that_its_former_module_does_not_raise_is_imported_with_a_warning():
    with pytest.warns(DeprecationWarning, match="is now rotemina.drivers.contract.errors"):
        assert device.InputLostError is InputLostError


@pytest.mark.parametrize(
    ("module", "name"),
    [
        ("rotemina.sim.errors", "InputError"),
        ("rotemina.sim.records.record", "RecordError"),
        ("rotemina.sim.trajectory.axis_limits", "OutOfLimitsError"),
    ],
)
def test_an_error_can_be_imported_from_the_module_that_raises_it(module, name):
    assert issubclass(getattr(importlib.import_module(module), name), Exception)


def test_fields_without_a_template_are_refused():
    with pytest.raises(TypeError, match="InputError has fields without a template: \\['axis'\\]"):
        InputError(message("engine", "a message that is complete"), axis="x")
