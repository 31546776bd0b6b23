"""Settings of drivers as people write them."""

import pytest

from rotemina.app.driver_settings import assigned, keep, kept, typed
from rotemina.drivers.settings import SettingError
from rotemina.drivers.simulator.driver import Simulator


@pytest.mark.parametrize(
    ("default", "text", "value"),
    [
        ("", " socket://host:1 ", "socket://host:1"),
        (True, "no", False),
        (False, "TRUE", True),
        (0, "-12", -12),
        (0.5, "1e-3", 1e-3),
        (0.5, "2", 2.0),
    ],
)
def test_a_text_is_read_in_the_type_of_the_default(default, text, value):
    told = typed("name", default, text)
    assert told == value
    assert type(told) is type(default)


@pytest.mark.parametrize(
    ("default", "text"),
    [(0, "1.5"), (0, "1_0"), (0, ""), (0.5, "0,5"), (0.5, "nan"), (0.5, "٢"), (True, "perhaps")],
)
def test_what_is_of_another_type_is_refused_with_the_text(default, text):
    with pytest.raises(SettingError, match="setting name"):
        typed("name", default, text)


def test_assignments():
    given = assigned(Simulator, ["seed=3", "start_homed = false", "settle_s=0.1"])
    assert given == {"seed": 3, "start_homed": False, "settle_s": 0.1}


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("seed", "name=value"),
        ("=3", "name=value"),
        ("colour=red", "no setting 'colour'; available: sample_rate_hz"),
        ("seed=many", "not an integer"),
    ],
)
def test_a_bad_assignment_says_what_is_wrong(text, told):
    with pytest.raises(SettingError, match=told):
        assigned(Simulator, [text])


def test_settings_are_kept_by_driver(settings):
    assert kept(settings, Simulator) == dict(Simulator.default_settings)
    keep(settings, Simulator, {"seed": 9, "start_homed": False})
    assert kept(settings, Simulator)["seed"] == 9
    assert kept(settings, Simulator)["start_homed"] is False
    settings.set("driver.simulator.seed", "spoilt")
    assert kept(settings, Simulator)["seed"] == 0
