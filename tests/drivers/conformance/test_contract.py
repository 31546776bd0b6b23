"""Every installed driver with virtual time passes the conformance suite."""

import pytest

from rotemina.drivers.conformance import CheckVerdict, find_checks, make_bench
from rotemina.drivers.contract import discover_drivers
from rotemina.sim.robot_files import load_robot

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


@pytest.mark.parametrize("robot", ["rotemina", "emps", "picma"])
@pytest.mark.parametrize("name", DRIVERS)
def test_the_driver_fulfils_the_contract(run_conformance_suite, name, robot):
    """On the shipped robot no check may be skipped for every driver without notice."""
    model = load_robot(robot)
    skipped = run_conformance_suite(lambda: make_bench(DRIVERS[name], model))
    if (name, robot) == ("simulator", "rotemina"):
        assert skipped == NEED_A_BENCH


def test_the_suite_homes_a_driver_whose_position_is_unknown():
    bench = make_bench(DRIVERS["simulator"], load_robot("rotemina"), {"start_homed": False})
    for check in find_checks(["opens-at-rest", "move-arrives", "homing"]):
        assert check.run(bench).verdict is CheckVerdict.PASSED
