"""Every installed driver with virtual time passes the conformance suite."""

import pytest

from rotemina.drivers.conformance import CHECKS, CheckVerdict, make_bench
from rotemina.drivers.contract import discover_drivers
from rotemina.sim.robot_files import load_robot

ROBOTS = {name: load_robot(name) for name in ("rotemina", "emps", "fsm", "picma")}
DRIVERS = {
    name: driver for name, driver in discover_drivers().plugins.items() if driver.virtual_time
}

# These checks need a special bench, as in test_conformance.
NEED_A_BENCH = {
    "fault", "short-loss", "long-loss", "nothing-resumes", "blocked-port", "damaged-report",
    "slow-line", "paused-program",
}  # fmt: skip


def test_the_simulator_is_installed_and_no_driver_has_a_problem():
    assert "simulator" in DRIVERS
    assert discover_drivers().problems == {}


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.name)
@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("name", DRIVERS)
def test_the_driver_fulfils_the_contract(name, robot, check):
    result = check.run(make_bench(DRIVERS[name], ROBOTS[robot]))
    if result.verdict is CheckVerdict.SKIPPED:
        pytest.skip(result.note)
    assert result.verdict is CheckVerdict.PASSED, f"{result.requirement} {result.note}"


def test_every_check_runs_on_the_shipped_robot_unless_it_needs_a_bench():
    """Otherwise a check could be skipped for every driver without notice."""
    bench = make_bench(DRIVERS["simulator"], ROBOTS["rotemina"])
    skipped = {check.name for check in CHECKS if check.run(bench).verdict is CheckVerdict.SKIPPED}
    assert skipped == NEED_A_BENCH


@pytest.mark.parametrize("name", DRIVERS)
def test_the_suite_homes_a_driver_whose_position_is_unknown(name):
    if "start_homed" not in DRIVERS[name].default_settings:
        pytest.skip("it always knows its position")
    bench = make_bench(DRIVERS[name], ROBOTS["rotemina"], {"start_homed": False})
    names = {"opens-at-rest", "move-arrives", "homing"}
    for check in CHECKS:
        if check.name in names:
            assert check.run(bench).verdict is CheckVerdict.PASSED
