"""Penetration parameters: strict bounds, messages in the operator's units, reading and writing."""

from contextlib import suppress

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration import PARAMETER_BOUNDS, PenetrationParameters


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"depth": 2e-4}, r"depth = 200 µm: must be 1 µm to 100 µm"),
        ({"approach_speed": 0.0}, r"approach_speed = 0 m/s: must be 100 nm/s to 200 µm/s"),
        ({"hold_s": float("nan")}, "hold_s = nan: must be a finite number"),
        ({"hold_s": True}, "hold_s = True"),
        ({"hold_s": "1"}, "hold_s = '1'"),
        ({"shape": "step"}, "shape = 'step': must be one of 's_curve', 'minimum_jerk', 'table'"),
        ({"shaping": 3}, "shaping = 3"),
        ({"direction": "left"}, "'down', 'up'"),
        ({"axis": ""}, "axis = ''"),
        ({"table": ((0.0, 0.0), (1.0, 1.0))}, "must be given if and only if"),
        ({"shape": "table"}, "must be given if and only if shape is 'table'"),
        ({"shape": "table", "table": [[0, 0], [2, 1]]}, "point 2, time = 2: must be 0 to 1"),
        ({"shape": "table", "table": [[0, 0], [1]]}, "point 2 = "),
        ({"shape": "table", "table": [[0, 0], [1, 0.5]]}, r"from \[0, 0\] to \[1, 1\]"),
        ({"shape": "table", "table": 5}, "at most 200 points"),
    ],
)
def test_invalid_values_are_refused_with_value_and_bound(values, message):
    with pytest.raises(PenetrationError, match=message):
        PenetrationParameters(**values)


@given(
    values=st.fixed_dictionaries(
        {}, optional={name: st.floats(b.minimum, b.maximum) for name, b in PARAMETER_BOUNDS.items()}
    ),
    shaping=st.sampled_from(["none", "zv", "zvd", "zvdd", "inverse"]),
    direction=st.sampled_from(["up", "down"]),
)
def test_a_file_reads_back_to_the_same_parameters(values, shaping, direction):
    parameters = PenetrationParameters(**values, shaping=shaping, direction=direction)
    assert PenetrationParameters.from_text(parameters.text()) == parameters


def test_a_file_on_disk_reads_back(tmp_path):
    path = tmp_path / "cell.toml"
    table = ((0.0, 0.0), (0.25, 0.1), (1.0, 1.0))
    parameters = PenetrationParameters(shape="table", table=table, axis='z"n\\')
    parameters.save(path)
    assert PenetrationParameters.load(path) == parameters


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("dept = 1e-5", r"cell\.toml: dept = 1e-05: unknown key; did you mean 'depth'"),
        ("zzz = 1", "known here: axis, direction"),
        ("depth = 1.0", r"cell\.toml: depth = 1 m: must be"),
        ("depth = [", "not valid TOML"),
    ],
)
def test_a_bad_file_is_refused_with_its_name_and_key(tmp_path, text, message):
    path = tmp_path / "cell.toml"
    path.write_text(text, "utf-8")
    with pytest.raises(PenetrationError, match=message):
        PenetrationParameters.load(path)


def test_a_file_that_is_no_text_is_refused(tmp_path):
    (tmp_path / "raw.toml").write_bytes(b"\xff\xfe")
    (tmp_path / "long.toml").write_bytes(b"#" * 200_000)
    for name, message in (("raw", "not UTF-8"), ("long", "larger"), ("none", "cannot be read")):
        with pytest.raises(PenetrationError, match=message):
            PenetrationParameters.load(tmp_path / f"{name}.toml")


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=50)
@given(data=st.text(max_size=200))
def test_any_text_is_read_or_refused(data):
    with suppress(PenetrationError):
        PenetrationParameters.from_text(data)
