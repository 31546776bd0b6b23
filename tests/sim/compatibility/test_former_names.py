"""Former names of the plugin interface work with a warning that gives the current name."""

import sys
from types import ModuleType, SimpleNamespace
from typing import NamedTuple

import pytest

from rotemina.sim.compatibility import (
    FormerMember,
    adopt_former_methods,
    serve_former_names,
)


@pytest.fixture
def module(monkeypatch):
    """Module in which ``Homer`` is the former name of ``AxisHomer``."""
    module = ModuleType("former_example")
    module.AxisHomer = type("AxisHomer", (), {})
    module.__getattr__ = serve_former_names(
        "former_example", Homer="AxisHomer", Moved="collections.OrderedDict"
    )
    monkeypatch.setitem(sys.modules, "former_example", module)
    return module


class Stage:
    def __init__(self):
        self.position = 1.0
        self.motor = SimpleNamespace(speed=1.0)

    def read_position(self):
        return self.position

    reading = FormerMember("read_position")
    place = FormerMember("position")
    speed = FormerMember("motor.speed")


def test_importing_a_former_name_warns_at_the_import(module):
    with pytest.warns(
        DeprecationWarning, match="Homer is now former_example.AxisHomer"
    ) as warnings:
        from former_example import Homer
    assert Homer is module.AxisHomer
    assert [warning.filename for warning in warnings] == [__file__]


def test_a_name_that_moved_to_another_module_can_be_imported(module):
    with pytest.warns(DeprecationWarning, match="Moved is now collections.OrderedDict"):
        assert module.Moved.__module__ == "collections"


def test_an_unknown_name_is_an_attribute_error(module):
    with pytest.raises(AttributeError, match="'former_example' has no attribute 'Walker'"):
        _ = module.Walker


def test_calling_a_former_method_warns_at_the_call():
    with pytest.warns(DeprecationWarning, match="Stage.reading is now read_position") as warnings:
        assert Stage().reading() == 1.0
    assert [warning.filename for warning in warnings] == [__file__]


def test_former_fields_can_be_read_and_written_even_in_a_part():
    stage = Stage()
    for former, current in (("place", "position"), ("speed", "motor.speed")):
        with pytest.warns(DeprecationWarning, match=rf"Stage\.{former} is now {current}"):
            setattr(stage, former, 2.0)
        with pytest.warns(DeprecationWarning, match=rf"Stage\.{former} is now {current}"):
            assert getattr(stage, former) == 2.0
    assert stage.position == stage.motor.speed == 2.0


class Scale(NamedTuple):
    factor: float

    def format_value(self):
        return f"{self.factor:g}"

    text = FormerMember("format_value")


def test_a_named_tuple_can_have_former_names():
    with pytest.warns(DeprecationWarning, match="Scale.text is now format_value"):
        assert Scale(2.0).text() == "2"


class Device:
    def __init_subclass__(cls):
        adopt_former_methods(cls)

    def _move_to(self, target):
        raise NotImplementedError

    def move(self):
        return self._move_to(3.0)

    _go = FormerMember("_move_to")


def test_a_hook_with_its_former_name_is_called_by_the_current_one():
    with pytest.warns(DeprecationWarning, match="Stage._go is now _move_to"):

        class Stage(Device):
            def _go(self, target):
                return target

    assert Stage().move() == 3.0


def test_a_hook_with_both_names_is_not_changed():
    class Stage(Device):
        def _go(self, target):
            return -target

        def _move_to(self, target):
            return target

    assert Stage().move() == 3.0
