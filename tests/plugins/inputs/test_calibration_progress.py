"""A calibration in steps, and by hand."""

import pytest

from rotemina.app.motion.teleoperation.axis_calibration import AxisCalibration, CalibrationError
from rotemina.plugins.inputs.calibration_progress import REST_S, Calibrating, Step, summary


@pytest.fixture
def stick(make_stick):
    return make_stick(axes=("X", "Y", "Brake", "Hat right"))


def measure(bench, stick, calibrating, wanted=("X", "Y"), moves=(), one_sided=()):
    view = bench.view(stick.key)
    calibrating.begin(wanted, one_sided, view.newest, bench.clock())
    hear(bench, calibrating, stick, REST_S)
    calibrating.sweep()
    for axis, raw in moves:
        stick.deflect(axis, raw)
        hear(bench, calibrating, stick, 0.05)


def hear(bench, calibrating, stick, seconds):
    for heard in bench.run(seconds):
        calibrating.receive(heard.readings.get(stick.key, ()))


def test_rest_and_ends_become_a_draft_that_is_not_yet_used(make_bench, stick):
    bench = make_bench(stick)
    calibrating = Calibrating(bench.view(stick.key))
    assert calibrating.measurable == ("X", "Y", "Brake")
    assert calibrating.one_sided == ("Brake",)
    moves = [("X", -0.8), ("X", 0.9), ("X", 0.0), ("Y", -1.0), ("Y", 1.0)]
    measure(bench, stick, calibrating, moves=moves)
    assert calibrating.step is Step.SWEEP
    assert calibrating.missing == {}
    assert calibrating.ranges["X"] == (-0.8, 0.9)
    calibrating.finish()
    assert calibrating.step is Step.EDIT
    assert calibrating.draft.axis("X").low == pytest.approx(-0.8, abs=0.02)
    assert calibrating.changed
    assert bench.view(stick.key).calibration == calibrating.kept
    bench.devices.calibrate(stick.key, calibrating.draft)
    assert bench.view(stick.key).calibration == calibrating.draft


def test_rest_takes_its_time(make_bench, stick):
    bench = make_bench(stick)
    calibrating = Calibrating(bench.view(stick.key))
    assert calibrating.rest_left_s(bench.clock()) == 0.0
    calibrating.begin(["X"], (), None, bench.clock())
    assert calibrating.rest_left_s(bench.clock()) == REST_S
    assert calibrating.rest_left_s(bench.clock() + 2 * REST_S) == 0.0


def test_what_was_said_before_the_rest_is_passed_over(make_bench, stick):
    bench = make_bench(stick)
    stick.deflect("X", 0.5)
    before = bench.run(0.05)
    stick.deflect("X", 0.0)
    view = bench.view(stick.key)
    calibrating = Calibrating(view)
    calibrating.begin(["X"], (), view.newest, bench.clock())
    for heard in before:  # a screen takes it up late
        calibrating.receive(heard.readings[stick.key])
    assert calibrating.ranges["X"] == (0.0, 0.0)


def test_a_bad_axis_stays_as_it_was_with_the_reason(make_bench, stick):
    bench = make_bench(stick)
    calibrating = Calibrating(bench.view(stick.key))
    measure(bench, stick, calibrating, moves=[("X", -1.0), ("X", 1.0), ("Y", 0.05)])
    assert "axis Y hardly moved" in calibrating.missing["Y"]
    calibrating.finish()
    assert list(calibrating.draft.axes) == ["X"]
    assert list(calibrating.problems) == ["Y"]
    calibrating.discard()
    assert not calibrating.changed
    assert calibrating.problems == {}


def test_one_that_was_cancelled_leaves_nothing(make_bench, stick):
    bench = make_bench(stick)
    calibrating = Calibrating(bench.view(stick.key))
    measure(bench, stick, calibrating, moves=[("X", -1.0), ("X", 1.0)])
    calibrating.cancel()
    assert (calibrating.step, calibrating.changed) == (Step.EDIT, False)
    assert calibrating.missing == calibrating.ranges == {}


def test_without_an_axis_there_is_nothing_to_measure(make_bench, stick):
    calibrating = Calibrating(make_bench(stick).view(stick.key))
    with pytest.raises(CalibrationError, match="no axis is chosen"):
        calibrating.begin((), (), None, 0.0)


def test_settings_are_changed_by_hand_and_forgotten(make_bench, stick):
    calibrating = Calibrating(make_bench(stick).view(stick.key))
    calibrating.change("X", expo=0.4, travel_m=0.02)
    calibrating.change("X", inverted=True)
    assert calibrating.draft.axis("X") == AxisCalibration(expo=0.4, travel_m=0.02, inverted=True)
    calibrating.forget("X")
    assert calibrating.draft == calibrating.kept


def test_settings_that_do_not_go_together_are_refused_in_words(make_bench, stick):
    calibrating = Calibrating(make_bench(stick).view(stick.key))
    calibrating.change("X", low=-0.3, high=0.3)
    with pytest.raises(CalibrationError, match=r"^axis X, its settings: from centre 0 to low -0.3"):
        calibrating.change("X", dead_zone=0.4)
    with pytest.raises(CalibrationError, match=r"^axis X, expo: .* less than or equal to 1"):
        calibrating.change("X", expo=2.0)
    assert calibrating.draft.axis("X").expo == 0.0


def test_where_an_axis_rests_is_said():
    assert summary(AxisCalibration()) == "-1.00 to +1.00, rests at +0.00"
    assert "rests at an end" in summary(AxisCalibration(low=-1.0, centre=-1.0))
