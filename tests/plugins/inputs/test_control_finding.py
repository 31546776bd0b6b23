"""Finding the control that the operator moves for a row of the mapping."""

from rotemina.app.motion.inputs import ControlKind, moved_control
from rotemina.plugins.inputs.control_finding import BUTTON_WAIT_S, ControlFinder
from rotemina.sim.messages import message


def run_and_find(bench, finder, seconds):
    """Run the loop, and return the search result."""
    for update in bench.run(seconds):
        finder.receive(update)
    return finder.find_control(bench.clock())


def test_an_axis_of_a_so_far_silent_device_is_found(make_bench, make_stick):
    stick = make_stick()
    bench = make_bench(stick)
    finder = ControlFinder(bench.view(stick.key), axis=True)
    assert finder.find_control(bench.clock()).message == "move the axis now"
    stick.deflect("Y", -0.9)
    moved = run_and_find(bench, finder, 0.1).moved_control
    assert (moved.control, moved.kind, moved.direction) == ("Y", ControlKind.AXIS, -1)


def test_a_button_takes_precedence_over_an_axis_which_counts_after_a_short_wait(
    make_bench, make_stick
):
    stick = make_stick()
    bench = make_bench(stick)
    finder = ControlFinder(bench.view(stick.key), axis=False)
    assert finder.find_control(bench.clock()).message == "press the button, or move the axis, now"
    stick.deflect("Z", 1.0)
    assert run_and_find(bench, finder, 0.1).moved_control is None  # a button may still be pressed
    stick.hold("2")
    assert run_and_find(bench, finder, 0.05).moved_control.control == "2"

    stick.release_all()
    bench.run(1.0)
    finder = ControlFinder(bench.view(stick.key), axis=False)
    stick.deflect("Z", 1.0)
    assert run_and_find(bench, finder, 0.1).moved_control is None
    assert run_and_find(bench, finder, BUTTON_WAIT_S + 0.05).moved_control.control == "Z"


def test_axes_moved_together_take_precedence_whatever_the_wording(
    make_bench, make_stick, monkeypatch
):
    def reword(context, template):
        return message(context, template.replace(" moved together; move only", ": only"))

    monkeypatch.setattr(moved_control, "message", reword)
    stick = make_stick()
    bench = make_bench(stick)
    finder = ControlFinder(bench.view(stick.key), axis=False)
    stick.deflect("X", 1.0)
    stick.deflect("Y", 1.0)
    result = run_and_find(bench, finder, 0.1)
    assert result.moved_control is None
    assert result.message == "X (stick) and Y (stick): only one"


def test_controls_of_other_devices_are_ignored(make_bench, make_stick):
    stick, other = make_stick(), make_stick("other")
    bench = make_bench(stick, other)
    finder = ControlFinder(bench.view(stick.key), axis=True)
    other.deflect("X", 1.0)
    result = run_and_find(bench, finder, 0.1)
    assert result.moved_control is None


def test_returning_to_rest_does_not_count_as_a_movement(make_bench, make_stick):
    stick = make_stick()
    stick.deflect("X", 1.0)
    bench = make_bench(stick)
    finder = ControlFinder(bench.view(stick.key), axis=True)
    stick.deflect("X", 0.0)
    assert run_and_find(bench, finder, 0.1).moved_control is None
    bench.run(1.0)
    stick.deflect("X", 1.0)
    assert run_and_find(bench, finder, 0.1).moved_control.direction == 1


def test_earlier_movements_are_ignored(make_bench, make_stick):
    stick = make_stick()
    bench = make_bench(stick)
    stick.deflect("X", 1.0)
    earlier_updates = bench.run(0.1)
    stick.deflect("X", 0.0)
    finder = ControlFinder(bench.view(stick.key), axis=True)
    for update in earlier_updates:  # the panel receives them late
        finder.receive(update)
    stick.deflect("Z", -1.0)
    assert run_and_find(bench, finder, 0.1).moved_control.control == "Z"
