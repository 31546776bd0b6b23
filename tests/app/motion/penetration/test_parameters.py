"""Penetration parameters: strict bounds, messages in the operator's units, reading and writing."""

import pytest
from hypothesis import given, settings, strategies as st

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration import PARAMETER_BOUNDS, PenetrationParameters


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"depth": 2e-4}, r"depth = 200 µm: must be 1 µm to 100 µm"),
        ({"approach_speed": 0.0}, r"approach_speed = 0 m/s: must be 100 nm/s to 200 µm/s"),
        ({"hold_s": float("nan")}, "hold_s = nan: must be a finite number"),
        ({"hold_s": True}, "hold_s = True"),
        ({"shape": "step"}, "shape = 'step': must be one of 's_curve', 'minimum_jerk', 'table'"),
        ({"shaping": 3}, "shaping = 3"),
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


@settings(max_examples=30)
@given(
    values=st.fixed_dictionaries(
        {}, optional={name: st.floats(b.minimum, b.maximum) for name, b in PARAMETER_BOUNDS.items()}
    ),
    shaping=st.sampled_from(["none", "zv", "zvd", "zvdd", "inverse"]),
    direction=st.sampled_from(["up", "down"]),
    shape=st.sampled_from(
        [{}, {"shape": "table", "table": ((0.0, 0.0), (0.25, 0.1), (1.0, 1.0)), "axis": 'z"n\\'}]
    ),
)
def test_a_file_reads_back_to_the_same_parameters(
    tmp_path_factory, values, shaping, direction, shape
):
    parameters = PenetrationParameters(**values, **shape, shaping=shaping, direction=direction)
    path = tmp_path_factory.mktemp("parameters") / "cell.toml"
    parameters.save(path)
    assert PenetrationParameters.load(path) == parameters


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"dept = 1e-5", r"cell\.toml: dept = 1e-05: unknown key; did you mean 'depth'"),
        (b"zzz = 1", "known here: axis, direction"),
        (b"depth = 1.0", r"cell\.toml: depth = 1 m: must be"),
        (b"#" * 200_000, "larger"),
        (None, "cannot be read"),
    ],
)
def test_a_bad_file_is_refused_with_its_name_and_key(tmp_path, content, message):
    path = tmp_path / "cell.toml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(PenetrationError, match=message):
        PenetrationParameters.load(path)
