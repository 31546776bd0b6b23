"""*Move it now*, for a row of the mapping."""

from rotemina.app.motion.teleoperation.moved_control import Kind
from rotemina.plugins.inputs.control_finding import BUTTON_WAIT_S, Finding


def look(bench, finding, seconds):
    """Let the loop run, and return what was found."""
    for heard in bench.run(seconds):
        finding.receive(heard)
    return finding.look(bench.clock())


def test_an_axis_of_a_device_that_was_silent_until_now(make_bench, make_stick):
    stick = make_stick()
    bench = make_bench(stick)
    finding = Finding(bench.view(stick.key), axis=True)
    assert finding.look(bench.clock()).message == "move the axis now"
    stick.deflect("Y", -0.9)
    found = look(bench, finding, 0.1)
    found = found.detected
    assert (found.control, found.kind, found.direction) == ("Y", Kind.AXIS, -1)


def test_a_button_goes_before_the_axis_that_moves_with_it(make_bench, make_stick):
    stick = make_stick()
    bench = make_bench(stick)
    finding = Finding(bench.view(stick.key), axis=False)
    stick.deflect("Z", 1.0)
    found = look(bench, finding, 0.1)
    assert found.detected is None  # a button may come
    stick.hold("2")
    found = look(bench, finding, 0.05)
    assert found.detected.control == "2"


def test_an_axis_alone_is_taken_a_moment_later(make_bench, make_stick):
    stick = make_stick()
    bench = make_bench(stick)
    finding = Finding(bench.view(stick.key), axis=False)
    assert finding.look(bench.clock()).message == "press the button, or move the axis, now"
    stick.deflect("Z", 1.0)
    found = look(bench, finding, 0.1)
    assert found.detected is None
    found = look(bench, finding, BUTTON_WAIT_S + 0.05)
    assert found.detected.control == "Z"


def test_two_at_once_are_named(make_bench, make_stick):
    stick = make_stick()
    bench = make_bench(stick)
    finding = Finding(bench.view(stick.key), axis=False)
    stick.hold("1")
    stick.hold("3")
    found = look(bench, finding, 0.05)
    assert found.detected is None
    assert "1 (stick) and 3 (stick) moved together" in found.message


def test_another_device_is_passed_over(make_bench, make_stick):
    stick, other = make_stick(), make_stick("other")
    bench = make_bench(stick, other)
    finding = Finding(bench.view(stick.key), axis=True)
    other.deflect("X", 1.0)
    found = look(bench, finding, 0.1)
    assert found.detected is None


def test_what_is_let_go_of_was_not_moved(make_bench, make_stick):
    stick = make_stick()
    stick.deflect("X", 1.0)
    bench = make_bench(stick)
    finding = Finding(bench.view(stick.key), axis=True)
    stick.deflect("X", 0.0)
    assert look(bench, finding, 0.1).detected is None
    bench.run(1.0)
    stick.deflect("X", 1.0)
    assert look(bench, finding, 0.1).detected.direction == 1


def test_what_was_moved_before_is_passed_over(make_bench, make_stick):
    stick = make_stick()
    bench = make_bench(stick)
    stick.deflect("X", 1.0)
    before = bench.run(0.1)
    stick.deflect("X", 0.0)
    finding = Finding(bench.view(stick.key), axis=True)
    for heard in before:  # a screen takes it up late
        finding.receive(heard)
    stick.deflect("Z", -1.0)
    assert look(bench, finding, 0.1).detected.control == "Z"
