import pytest

from rotemina.app.motion.inputs.button_debounce import AxisThreshold, DebouncedButton


def feed_button(button, reports):
    """Return the times at which a button counted as pressed, and whether it is held at the end."""
    return [time_s for time_s, is_down in reports if button.feed(time_s, is_down)], button.is_held


def test_a_press_counts_at_once_and_its_bounces_do_not():
    bouncing = [(0.0, False), (1.0, True), (1.002, False), (1.004, True), (1.03, True)]
    assert feed_button(DebouncedButton(), bouncing) == ([1.0], True)


def test_a_bouncing_release_is_no_press():
    released = [(0.0, False), (1.0, True), (2.0, False), (2.003, True), (2.006, False)]
    button = DebouncedButton()
    assert feed_button(button, released) == ([1.0], False)
    assert not button.step(3.0)


def test_a_short_press_ends_when_its_bounces_are_over():
    button = DebouncedButton()
    assert feed_button(button, [(0.0, False), (1.0, True), (1.01, False)]) == ([1.0], True)
    assert not button.step(1.03)
    assert not button.is_held


def test_a_button_that_is_down_from_the_start_does_nothing():
    button = DebouncedButton()
    button.step(0.0)  # before its first report
    assert feed_button(button, [(0.1, True), (1.0, True)]) == ([], False)
    assert feed_button(button, [(2.0, False), (3.0, True)]) == ([3.0], True)


def test_a_stop_that_is_down_from_the_start_counts():
    assert feed_button(DebouncedButton(counts_from_start=True), [(0.0, True), (1.0, True)]) == (
        [0.0],
        True,
    )


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_threshold_has_hysteresis(sign):
    threshold = AxisThreshold(sign * 0.5, 0.1)
    deflections = [0.0, 0.49, 0.5, 0.45, 0.41, 0.4, 0.49, 1.0, -1.0]
    is_beyond = [threshold.feed(sign * deflection) for deflection in deflections]
    assert is_beyond == [False, False, True, True, True, False, False, True, False]
