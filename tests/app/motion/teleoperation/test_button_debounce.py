import pytest

from rotemina.app.motion.teleoperation.button_debounce import Button, Threshold


def presses(button, conversation):
    """Return when a button counted as pressed, and as held at the end."""
    return [time_s for time_s, down in conversation if button.feed(time_s, down)], button.held


def test_a_press_counts_at_once_and_its_bounces_do_not():
    bouncing = [(0.0, False), (1.0, True), (1.002, False), (1.004, True), (1.03, True)]
    assert presses(Button(), bouncing) == ([1.0], True)


def test_a_bouncing_release_is_no_press():
    released = [(0.0, False), (1.0, True), (2.0, False), (2.003, True), (2.006, False)]
    button = Button()
    assert presses(button, released) == ([1.0], False)
    assert not button.step(3.0)


def test_a_short_press_is_let_go_of_when_its_bounces_are_over():
    button = Button()
    assert presses(button, [(0.0, False), (1.0, True), (1.01, False)]) == ([1.0], True)
    assert not button.step(1.03)
    assert not button.held


def test_a_button_that_is_down_from_the_first_moment_does_nothing():
    button = Button()
    button.step(0.0)  # before it has said anything
    assert presses(button, [(0.1, True), (1.0, True)]) == ([], False)
    assert presses(button, [(2.0, False), (3.0, True)]) == ([3.0], True)


def test_but_a_stop_does():
    assert presses(Button(at_once=True), [(0.0, True), (1.0, True)]) == ([0.0], True)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_threshold_has_hysteresis(sign):
    threshold = Threshold(sign * 0.5, 0.1)
    way = [0.0, 0.49, 0.5, 0.45, 0.41, 0.4, 0.49, 1.0, -1.0]
    beyond = [threshold.feed(sign * deflection) for deflection in way]
    assert beyond == [False, False, True, True, True, False, False, True, False]
