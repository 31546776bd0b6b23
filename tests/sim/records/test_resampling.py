import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import RecordError
from rotemina.sim.records import Record, Tap, find_max_speeds, resample
from rotemina.sim.records.resampling import Method

UNEVEN_S = np.array([2.0, 2.1, 2.5, 2.6, 3.4, 3.5, 4.0])


def make_record(
    time_s: np.ndarray, *signals: np.ndarray, metadata: dict[str, str] | None = None
) -> Record:
    taps = [Tap.CMD, Tap.MEAS]
    columns = {("q", tap): signal for tap, signal in zip(taps, signals, strict=False)}
    return Record.from_signals(time_s, columns, {"q": "m"}, metadata)


@pytest.mark.parametrize(
    ("method", "degree"), [("hold", 0), ("linear", 0), ("linear", 1), ("cubic", 2), ("cubic", 3)]
)
def test_each_method_reproduces_polynomials_of_its_degree_exactly(
    method: Method, degree: int
) -> None:
    curve = np.polynomial.Polynomial([0.3, -2.0, 1.5, 0.7][: degree + 1])
    resampled = resample(make_record(UNEVEN_S, curve(UNEVEN_S)), 37.0, method)
    expected = curve(resampled.time_s)
    assert np.allclose(resampled.signal("q", Tap.CMD), expected, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(("method", "order"), [("hold", 1), ("linear", 2), ("cubic", 4)])
def test_each_method_converges_with_its_order(method: Method, order: int) -> None:
    errors = []
    for rows in (41, 81):
        time_s = np.linspace(0.0, 1.0, rows)
        resampled = resample(make_record(time_s, np.sin(5 * time_s)), 997.0, method)
        errors.append(np.abs(resampled.signal("q", Tap.CMD) - np.sin(5 * resampled.time_s)).max())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.35)


def test_a_command_is_held_between_rows() -> None:
    record = make_record(np.array([0.0, 0.25, 1.0]), np.array([1.0, 2.0, 3.0]))
    resampled = resample(record, 10.0)
    assert resampled.signal("q", Tap.CMD).tolist() == [1.0] * 3 + [2.0] * 7 + [3.0]


@pytest.mark.parametrize("method", ["hold", "linear", "cubic"])
@given(start_s=st.floats(-1e3, 1e3), rate_hz=st.sampled_from([3.0, 100.0, 1000.0, 6400.0]))
def test_resampling_at_the_rate_of_the_record_changes_nothing(
    method: Method, start_s: float, rate_hz: float
) -> None:
    # Times are rounded as in a file, so a row may lie a little after its grid point.
    time_s = np.round(start_s + np.arange(50) / rate_hz, 10)
    signal = np.random.default_rng(1).normal(size=50)
    resampled = resample(make_record(time_s, signal), rate_hz, method)
    assert len(resampled.time_s) == 50
    assert resampled.time_s[-1] <= time_s[-1]
    tolerance = 0.0 if method == "hold" else 1e-4
    assert np.abs(resampled.signal("q", Tap.CMD) - signal).max() <= tolerance


@given(
    rate_hz=st.floats(0.1, 500.0),
    steps_s=st.lists(st.floats(1e-3, 0.5), min_size=1, max_size=20),
    start_s=st.floats(-100, 100),
)
def test_the_grid_lies_within_the_record(
    rate_hz: float, steps_s: list[float], start_s: float
) -> None:
    time_s = start_s + np.cumsum([0.0, *steps_s])
    resampled = resample(make_record(time_s, time_s), rate_hz)
    grid_s = resampled.time_s
    assert grid_s[0] == time_s[0]
    assert grid_s[-1] <= time_s[-1]
    assert time_s[-1] - grid_s[-1] < 1 / rate_hz
    assert np.allclose(np.diff(grid_s), 1 / rate_hz, rtol=1e-5, atol=1e-11)


@pytest.mark.parametrize(
    ("method", "rows"), [("hold", 1), ("linear", 1), ("cubic", 1), ("cubic", 2), ("cubic", 3)]
)
def test_short_records_are_resampled(method: Method, rows: int) -> None:
    time_s = np.arange(rows) * 0.5
    resampled = resample(make_record(time_s, time_s, 2 * time_s), 2.0, method)
    assert resampled.time_s.tolist() == time_s.tolist()
    assert np.allclose(resampled.signal("q", Tap.MEAS), 2 * time_s)
    assert resampled.units == {"q": "m"}


@pytest.mark.parametrize("method", ["hold", "linear", "cubic"])
def test_a_grid_with_one_point_is_the_first_row(method: Method) -> None:
    resampled = resample(make_record(UNEVEN_S, UNEVEN_S**2), 0.1, method)
    assert resampled.time_s.tolist() == [2.0]
    assert resampled.values.tolist() == [[4.0]]


def test_metadata_are_kept_except_the_period() -> None:
    metadata = {"mode": "open_loop", "history": "periodic", "period_samples": "5"}
    record = make_record(np.arange(5.0), np.arange(5.0), metadata=metadata)
    assert resample(record, 2.0).metadata == {"mode": "open_loop", "history": "unknown"}
    record_with_note = make_record(np.arange(5.0), np.arange(5.0), metadata={"note": "n"})
    assert resample(record_with_note, 2.0).metadata == {"note": "n"}


@pytest.mark.parametrize("rate_hz", [0.0, -1.0, float("nan"), float("inf")])
def test_a_rate_that_is_not_positive_is_refused(rate_hz: float) -> None:
    with pytest.raises(RecordError, match=r"resampling: rate .* use a positive number"):
        resample(make_record(UNEVEN_S, UNEVEN_S), rate_hz)


def test_a_grid_that_fills_the_memory_is_refused() -> None:
    with pytest.raises(RecordError, match=r"2e\+12 rows at 1e\+12 Hz exceed 500000000 values"):
        resample(make_record(UNEVEN_S, UNEVEN_S), 1e12)


def test_an_unknown_method_is_refused() -> None:
    with pytest.raises(RecordError, match="unknown method 'nearest'; use one of hold linear cubic"):
        resample(make_record(UNEVEN_S, UNEVEN_S), 1.0, "nearest")  # type: ignore[arg-type]


def test_maximum_speeds_before_and_after_resampling() -> None:
    signals = {
        ("x", Tap.CMD): np.array([0.0, 1.0, -2.0]),
        ("x", Tap.MEAS): np.array([0.0, 9.0, 0.0]),
        ("y", Tap.CMD): np.array([1.0, 1.0, 1.0]),
    }
    record = Record.from_signals(np.array([0.0, 0.5, 1.0]), signals, {"x": "m", "y": "rad"})
    assert find_max_speeds(record) == {"x": 6.0, "y": 0.0}
    # A held step takes one row of the finer grid.
    assert find_max_speeds(resample(record, 10.0))["x"] == pytest.approx(30.0)
    assert find_max_speeds(resample(record, 10.0, "linear"))["x"] == pytest.approx(6.0)
    single = Record.from_signals(np.zeros(1), {("x", Tap.CMD): np.ones(1)}, {"x": "m"})
    assert find_max_speeds(single) == {"x": 0.0}
