"""The controller's recurrence, its limits and its beginnings."""

import numpy as np
import pytest
from scipy.signal import lfilter

from rotemina.sim.feedback.controller import NO_LIMITS, Controller, response
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.feed_forward import FeedForward
from rotemina.sim.feedback.filters import low_pass, notch
from rotemina.sim.feedback.gains import AntiWindup, Gains, Notch, OutputLimits
from rotemina.sim.feedback.stability import controller_matrices

H = 2e-4
FULL = Gains(
    proportional=0.3,
    integral=700.0,
    derivative=1e-4,
    derivative_filter_s=5e-5,
    low_pass_hz=1500.0,
    notch=Notch(420.0, 0.8, 0.03),
)


def outputs(controller, reference, measured):
    return np.array([controller.step(r, y) for r, y in zip(reference, measured, strict=True)])


def started(gains, limits=NO_LIMITS):
    controller = Controller(gains, H, limits)
    controller.start(0.0)
    return controller


def test_the_output_is_that_of_its_transfer_function():
    measured = np.random.default_rng(1).standard_normal(500)
    error = -measured
    for biquad in (notch(420.0, 0.8, 0.03, 1 / H), low_pass(1500.0, 1 / H)):
        error = lfilter(biquad[:3], [1.0, *biquad[3:]], error)
    pole = np.exp(-H / 5e-5)
    expected = (
        0.3 * error
        + lfilter([700.0 * H], [1.0, -1.0], error)
        + lfilter(1e-4 * (1 - pole) / H * np.array([1.0, -1.0]), [1.0, -pole], error)
    )
    found = outputs(started(FULL), np.zeros(500), measured)
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_the_frequency_response_is_that_of_the_recurrence():
    z = np.exp(2j * np.pi * np.array([0.1, 30.0, 420.0, 2000.0]) * H)
    a, b, c, d = controller_matrices(FULL, H)
    expected = [c @ np.linalg.solve(one * np.eye(len(a)) - a, b) + d for one in z]
    np.testing.assert_allclose(response(FULL, H, z), expected, rtol=1e-9)


def test_a_controller_takes_over_without_a_jump():
    controller = Controller(FULL, H)
    controller.start(2.0, output=2.5)
    assert controller.step(2.0, 2.0) == 2.5
    assert controller.integral == 0.5


@pytest.mark.parametrize("way", list(AntiWindup))
def test_the_integral_does_not_wind_up_at_a_limit(way):
    gains = Gains(integral=100.0, anti_windup=way, tracking_s=1e-3)
    controller = started(gains, OutputLimits(-1.0, 1.0))
    outputs(controller, np.zeros(1000), np.full(1000, -10.0))
    assert controller.limited
    back = outputs(controller, np.zeros(8), np.full(8, 10.0))
    # Wound up it would stand at 200 and take 1000 samples to come back.
    assert back[-1] < 0.5
    assert not controller.limited


def test_the_output_keeps_its_limits_and_its_rate():
    controller = started(Gains(proportional=5.0), OutputLimits(-1.0, 2.0, rate=1000.0))
    found = outputs(controller, np.r_[np.full(30, 10.0), np.full(30, -10.0)], np.zeros(60))
    assert found.max() == 2.0
    assert found.min() == -1.0
    assert np.abs(np.diff(found)).max() <= 1000.0 * H * (1 + 1e-12)


def test_what_is_not_finite_is_refused_and_leaves_no_trace():
    one, other = started(FULL), started(FULL)
    for reference, measured in ((np.nan, 0.0), (0.0, np.inf)):
        with pytest.raises(FeedbackError, match="both must be finite"):
            one.step(reference, measured)
    assert one.step(1.0, 0.2) == other.step(1.0, 0.2)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"integral": -1.0}, "integral -1: must be finite, at least 0"),
        ({"proportional": np.nan}, "proportional nan"),
        ({"tracking_s": 0.0}, "tracking_s 0 s: must be finite, more than 0"),
        ({"low_pass_hz": 0.0}, "low_pass_hz 0 Hz"),
    ],
)
def test_gains_that_are_none_are_refused(given, message):
    with pytest.raises(FeedbackError, match=message):
        Gains(**given)


def test_limits_and_filters_that_do_not_fit_are_refused():
    with pytest.raises(FeedbackError, match="low must be less than high"):
        OutputLimits(1.0, 1.0)
    with pytest.raises(FeedbackError, match="rate 0 per s"):
        OutputLimits(0.0, 1.0, 0.0)
    with pytest.raises(FeedbackError, match="notch at 3000 Hz"):
        Controller(Gains(notch=Notch(3000.0)), H)
    with pytest.raises(FeedbackError, match="depth 2"):
        Notch(420.0, 0.7, 2.0)
    with pytest.raises(FeedbackError, match="interval 0 s"):
        Controller(FULL, 0.0)


class Doubled:
    """An inverse with a memory: twice what is wanted, and half of what was before."""

    def __init__(self):
        self.last = 0.0

    def reset(self):
        self.last = 0.0

    def step(self, desired):
        self.last, before = desired, self.last
        return 2.0 * desired + 0.5 * before

    def run(self, desired):
        return np.array([self.step(float(one)) for one in desired])


def test_feed_forward_is_the_same_at_once_and_by_the_sample():
    reference = np.random.default_rng(2).standard_normal(200)
    whole = FeedForward((9.0, -12.0, 4.0), Doubled()).run(reference)
    single = FeedForward((9.0, -12.0, 4.0), Doubled())
    single.start(float(reference[0]))
    assert [single.step(float(one)) for one in reference] == list(whole)
