"""Lines on which every answer comes late, as over a radio or a network: slower, never silent."""

import logging

import numpy as np
import pytest

from rotemina.drivers.errors import DriverError, LimitError
from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Record, Tap

IDLE, FAULT = DeviceState.IDLE, DeviceState.FAULT


def slow_bench(joined_bench, robot, ports, round_trip_s, **settings):
    bench = joined_bench(robot, ports=ports, settings=settings)
    for port in bench.boards.lines:
        line = port._line
        line.to_board.delay_s = line.to_host.delay_s = 0.5 * round_trip_s
    return bench


def wave():
    time_s = np.arange(400) * 0.005
    signals = {("zn", Tap.CMD): 30e-6 + 1e-6 * np.sin(2 * np.pi * time_s)}
    return Record.from_signals(time_s, signals, {"zn": "m"})


@pytest.mark.parametrize(
    ("ports", "round_trip_s", "settings"),
    [
        (2, 0.06, {}),
        (2, 0.12, {}),
        (2, 0.3, {"watchdog_s": 1.0}),
        (2, 0.6, {"watchdog_s": 2.0}),
        (1, 0.06, {}),
        (1, 0.12, {}),
    ],
)
def test_a_board_that_answers_late_is_moved_and_never_called_silent(
    robot, joined_bench, caplog, ports, round_trip_s, settings
):
    bench = slow_bench(joined_bench, robot, ports, round_trip_s, **settings)
    bench.driver.open()
    assert ("a stop takes half as long" in caplog.text) == (round_trip_s > 0.1)
    bench.driver.move_to({"x": 0.0277})
    silent_s = 0.0
    for _ in range(60):
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
    ("ports", "match"), [(2, "set watchdog_s to 0.91 or more"), (1, "a line for each board")]
)
def test_a_line_that_is_too_slow_is_refused_with_its_round_trip(robot, joined_bench, ports, match):
    bench = slow_bench(joined_bench, robot, ports, 0.3)
    with pytest.raises(DriverError, match=r"answers, but after 30\d.* ms: .*" + match):
        bench.driver.open()
    assert all(port.closed for port in bench.ports)


@pytest.mark.parametrize(
    ("ports", "round_trip_s", "limit"), [(2, 0.08, "70 ms"), (1, 0.02, "20 ms")]
)
def test_a_trajectory_is_refused_where_its_set_points_would_come_too_late(
    robot, joined_bench, ports, round_trip_s, limit
):
    bench = slow_bench(joined_bench, robot, ports, round_trip_s)
    bench.driver.open()
    with pytest.raises(LimitError, match=f"must not take longer than {limit}"):
        bench.driver.play(wave())
    bench.run(0.5)
    assert bench.driver.status().state is IDLE
    bench.driver.close()


@pytest.mark.parametrize(("ports", "round_trip_s"), [(2, 0.06), (1, 0.012)])
def test_a_trajectory_is_played_to_its_end_where_it_is_accepted(
    robot, joined_bench, caplog, ports, round_trip_s
):
    caplog.set_level(logging.WARNING)
    bench = slow_bench(joined_bench, robot, ports, round_trip_s)
    bench.driver.open()
    bench.driver.play(wave())
    bench.run_until(IDLE, FAULT)
    status = bench.driver.status()
    assert (status.state, status.progress) == (IDLE, 1.0)
    bench.driver.close()
