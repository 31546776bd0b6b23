"""Lines with late answers, as over a radio or a network, are slow but never count as silent."""

import logging

import pytest

from rotemina.drivers.contract import DeviceState, DriverError, LimitError

IDLE, FAULT = DeviceState.IDLE, DeviceState.FAULT


def make_slow_bench(make_bench, robot, ports, round_trip_s, **settings):
    bench = make_bench(robot, ports=ports, settings=settings)
    bench.delay(0.5 * round_trip_s)
    return bench


@pytest.mark.parametrize(
    ("ports", "round_trip_s", "settings"),
    [(2, 0.06, {}), (2, 0.6, {"watchdog_s": 2.0}), (1, 0.12, {})],
)
def test_a_board_with_late_answers_moves_and_never_counts_as_silent(
    robot, make_bench, caplog, ports, round_trip_s, settings
):
    bench = make_slow_bench(make_bench, robot, ports, round_trip_s, **settings)
    bench.driver.open()
    assert ("a stop takes half as long" in caplog.text) == (round_trip_s > 0.1)
    bench.driver.move_to({"x": 0.0277})
    silent_s = 0.0
    for _ in range(30):
        bench.run(0.05)
        silent_s = max(silent_s, bench.driver.status().silent_s)
    assert silent_s == 0.0
    bench.run_until(IDLE, FAULT)
    samples = bench.run(1.0)
    assert bench.driver.status().fault is None
    assert samples.command[-1, 0] == pytest.approx(0.0277, abs=1e-15)
    assert bench.driver.link_quality().repeated == 0
    bench.driver.close()


@pytest.mark.parametrize(
    ("ports", "match"),
    [(2, "set watchdog_s to 0.91 or more"), (1, "a separate line for each board")],
)
def test_a_line_that_is_too_slow_is_refused_with_its_round_trip_time(
    robot, make_bench, ports, match
):
    bench = make_slow_bench(make_bench, robot, ports, 0.3)
    with pytest.raises(DriverError, match=r"answers, but takes 30\d.* ms: .*" + match):
        bench.driver.open()
    assert all(port.is_closed for port in bench.ports)


@pytest.mark.parametrize(
    ("ports", "round_trip_s", "limit"), [(2, 0.08, "70 ms"), (1, 0.02, "20 ms")]
)
def test_a_trajectory_is_refused_on_a_line_that_is_too_slow_for_it(
    robot, make_bench, ports, round_trip_s, limit
):
    bench = make_slow_bench(make_bench, robot, ports, round_trip_s)
    bench.driver.open()
    with pytest.raises(LimitError, match=f"an answer within {limit}"):
        bench.driver.play(bench.make_wave(400))
    bench.run(0.5)
    assert bench.driver.status().state is IDLE
    bench.driver.close()


@pytest.mark.parametrize(("ports", "round_trip_s"), [(2, 0.06), (1, 0.012)])
def test_an_accepted_trajectory_is_played_to_its_end(
    robot, make_bench, caplog, ports, round_trip_s
):
    caplog.set_level(logging.WARNING)
    bench = make_slow_bench(make_bench, robot, ports, round_trip_s)
    bench.driver.open()
    bench.driver.play(bench.make_wave(200))
    bench.run_until(IDLE, FAULT)
    status = bench.driver.status()
    assert (status.state, status.progress) == (IDLE, 1.0)
    bench.driver.close()
