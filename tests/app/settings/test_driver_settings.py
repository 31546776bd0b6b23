"""Driver settings as written by users."""

import pytest

from rotemina.app.settings import load_settings, parse_assignments, parse_setting, store_settings
from rotemina.drivers.contract import DriverSettingError
from rotemina.drivers.simulator import Simulator


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
    parsed = parse_setting("name", default, text)
    assert parsed == value
    assert type(parsed) is type(default)


@pytest.mark.parametrize(
    ("default", "text"),
    [(0, "1.5"), (0, "1_0"), (0, ""), (0.5, "0,5"), (0.5, "nan"), (0.5, "٢"), (True, "perhaps")],
)
def test_a_text_of_another_type_is_refused(default, text):
    with pytest.raises(DriverSettingError, match="setting name"):
        parse_setting("name", default, text)


def test_assignments_are_parsed():
    settings = parse_assignments(Simulator, ["seed=3", "start_homed = false", "settle_s=0.1"])
    assert settings == {"seed": 3, "start_homed": False, "settle_s": 0.1}


@pytest.mark.parametrize(
    ("text", "error_text"),
    [
        ("seed", "name=value"),
        ("=3", "name=value"),
        ("colour=red", "no setting 'colour'; available: sample_rate_hz"),
        ("seed=many", "not an integer"),
    ],
)
def test_an_invalid_assignment_is_explained(text, error_text):
    with pytest.raises(DriverSettingError, match=error_text):
        parse_assignments(Simulator, [text])


def test_settings_are_stored_per_driver(settings):
    assert load_settings(settings, Simulator) == dict(Simulator.default_settings)
    store_settings(settings, Simulator, {"seed": 9, "start_homed": False})
    assert load_settings(settings, Simulator)["seed"] == 9
    assert load_settings(settings, Simulator)["start_homed"] is False
    settings.set("driver.simulator.seed", "spoilt")
    assert load_settings(settings, Simulator)["seed"] == 0
