"""The controller's recurrence, its limits and its start."""

import numpy as np
import pytest
from scipy.signal import lfilter

from rotemina.sim.errors import FeedbackError
from rotemina.sim.feedback import ControllerGains, FeedForward, NotchFilter, SampledController
from rotemina.sim.feedback.controller import NO_LIMITS, compute_response
from rotemina.sim.feedback.filters import design_low_pass, design_notch
from rotemina.sim.feedback.gains import AntiWindup, OutputLimits
from rotemina.sim.feedback.stability import compute_controller_matrices

SAMPLE_S = 2e-4
FULL = ControllerGains(
    proportional=0.3,
    integral=700.0,
    derivative=1e-4,
    derivative_filter_s=5e-5,
    low_pass_hz=1500.0,
    notch=NotchFilter(420.0, 0.8, 0.03),
)


def run_controller(controller, reference, measured):
    return np.array([controller.step(r, y) for r, y in zip(reference, measured, strict=True)])


def start_controller(gains, limits=NO_LIMITS):
    controller = SampledController(gains, SAMPLE_S, limits)
    controller.start(0.0)
    return controller


def test_the_output_is_that_of_its_transfer_function():
    measured = np.random.default_rng(1).standard_normal(500)
    error = -measured
    for biquad in (
        design_notch(420.0, 0.8, 0.03, 1 / SAMPLE_S),
        design_low_pass(1500.0, 1 / SAMPLE_S),
    ):
        error = lfilter(biquad[:3], [1.0, *biquad[3:]], error)
    pole = np.exp(-SAMPLE_S / 5e-5)
    expected = (
        0.3 * error
        + lfilter([700.0 * SAMPLE_S], [1.0, -1.0], error)
        + lfilter(1e-4 * (1 - pole) / SAMPLE_S * np.array([1.0, -1.0]), [1.0, -pole], error)
    )
    outputs = run_controller(start_controller(FULL), np.zeros(500), measured)
    np.testing.assert_allclose(outputs, expected, atol=1e-12)


def test_the_frequency_response_is_that_of_the_recurrence():
    z = np.exp(2j * np.pi * np.array([0.1, 30.0, 420.0, 2000.0]) * SAMPLE_S)
    a, b, c, d = compute_controller_matrices(FULL, SAMPLE_S)
    expected = [c @ np.linalg.solve(point * np.eye(len(a)) - a, b) + d for point in z]
    np.testing.assert_allclose(compute_response(FULL, SAMPLE_S, z), expected, rtol=1e-9)


def test_a_controller_takes_over_without_a_jump():
    controller = SampledController(FULL, SAMPLE_S)
    controller.start(2.0, output=2.5)
    assert controller.step(2.0, 2.0) == 2.5
    assert controller.integral == 0.5


@pytest.mark.parametrize("anti_windup", list(AntiWindup))
def test_the_integral_does_not_wind_up_at_a_limit(anti_windup):
    gains = ControllerGains(integral=100.0, anti_windup=anti_windup, tracking_s=1e-3)
    controller = start_controller(gains, OutputLimits(-1.0, 1.0))
    run_controller(controller, np.zeros(1000), np.full(1000, -10.0))
    assert controller.is_limited
    outputs = run_controller(controller, np.zeros(8), np.full(8, 10.0))
    # With windup it would be at 200 and take 1000 samples to return.
    assert outputs[-1] < 0.5
    assert not controller.is_limited


def test_the_output_stays_within_its_limits_and_its_rate():
    controller = start_controller(
        ControllerGains(proportional=5.0), OutputLimits(-1.0, 2.0, rate=1000.0)
    )
    outputs = run_controller(controller, np.r_[np.full(30, 10.0), np.full(30, -10.0)], np.zeros(60))
    assert outputs.max() == 2.0
    assert outputs.min() == -1.0
    assert np.abs(np.diff(outputs)).max() <= 1000.0 * SAMPLE_S * (1 + 1e-12)


def test_values_that_are_not_finite_are_refused_and_change_no_state():
    disturbed, undisturbed = start_controller(FULL), start_controller(FULL)
    for reference, measured in ((np.nan, 0.0), (0.0, np.inf)):
        with pytest.raises(FeedbackError, match="both must be finite"):
            disturbed.step(reference, measured)
    assert disturbed.step(1.0, 0.2) == undisturbed.step(1.0, 0.2)


@pytest.mark.parametrize(
    ("gains", "message"),
    [
        ({"integral": -1.0}, "integral -1: must be finite, at least 0"),
        ({"proportional": np.nan}, "proportional nan"),
        ({"tracking_s": 0.0}, "tracking_s 0 s: must be finite, more than 0"),
        ({"low_pass_hz": 0.0}, "low_pass_hz 0 Hz"),
    ],
)
def test_invalid_gains_are_refused(gains, message):
    with pytest.raises(FeedbackError, match=message):
        ControllerGains(**gains)


def test_limits_and_filters_that_do_not_fit_are_refused():
    with pytest.raises(FeedbackError, match="low must be less than high"):
        OutputLimits(1.0, 1.0)
    with pytest.raises(FeedbackError, match="rate 0 per s"):
        OutputLimits(0.0, 1.0, 0.0)
    with pytest.raises(FeedbackError, match="notch at 3000 Hz"):
        SampledController(ControllerGains(notch=NotchFilter(3000.0)), SAMPLE_S)
    with pytest.raises(FeedbackError, match="depth 2"):
        NotchFilter(420.0, 0.7, 2.0)
    with pytest.raises(FeedbackError, match="interval 0 s"):
        SampledController(FULL, 0.0)


class InverseWithMemory:
    """An inverse with memory: twice the desired position plus half of the previous one."""

    def __init__(self):
        self.last = 0.0

    def reset(self):
        self.last = 0.0

    def step(self, desired):
        self.last, previous = desired, self.last
        return 2.0 * desired + 0.5 * previous

    def run(self, desired):
        return np.array([self.step(float(value)) for value in desired])


def test_feed_forward_by_sample_equals_that_of_an_array():
    reference = np.random.default_rng(2).standard_normal(200)
    whole = FeedForward((9.0, -12.0, 4.0), InverseWithMemory()).run(reference)
    single = FeedForward((9.0, -12.0, 4.0), InverseWithMemory())
    single.start(float(reference[0]))
    assert [single.step(float(value)) for value in reference] == list(whole)
