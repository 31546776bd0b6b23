"""The contract, run over every installed driver that lives on a clock set by hand."""

import pytest

from rotemina.drivers.conformance.bench import bench_of
from rotemina.drivers.conformance.check import Verdict
from rotemina.drivers.conformance.suite import CHECKS
from rotemina.drivers.registry import discover_drivers
from rotemina.sim.robot.file import load_robot

ROBOTS = {name: load_robot(name) for name in ("rotemina", "emps", "fsm", "picma")}
DRIVERS = {n: found for n, found in discover_drivers().found.items() if found.virtual_time}

# What no clock-driven driver can be put to without a bench of its own: test_conformance has one.
NEED_A_BENCH = {
    "fault", "short-loss", "long-loss", "nothing-resumes", "blocked-port", "damaged-report",
    "slow-line", "paused-program",
}  # fmt: skip


def test_there_is_a_driver_to_test():
    assert "simulator" in DRIVERS
    assert discover_drivers().broken == {}


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.name)
@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("name", DRIVERS)
def test_the_contract_is_kept(name, robot, check):
    result = check.run(bench_of(DRIVERS[name], ROBOTS[robot]))
    if result.verdict is Verdict.SKIPPED:
        pytest.skip(result.note)
    assert result.verdict is Verdict.PASSED, f"{result.demand} {result.note}"


def test_the_shipped_robot_has_what_every_check_needs():
    """So that no check is skipped everywhere, which nobody would notice."""
    bench = bench_of(DRIVERS["simulator"], ROBOTS["rotemina"])
    skipped = {one.name for one in CHECKS if one.run(bench).verdict is Verdict.SKIPPED}
    assert skipped == NEED_A_BENCH


@pytest.mark.parametrize("name", DRIVERS)
def test_a_driver_that_does_not_know_its_position_is_homed_by_the_kit(name):
    if "start_homed" not in DRIVERS[name].default_settings:
        pytest.skip("it always knows its position")
    bench = bench_of(DRIVERS[name], ROBOTS["rotemina"], {"start_homed": False})
    wanted = {"opens-at-rest", "move-arrives", "homing"}
    for check in CHECKS:
        if check.name in wanted:
            assert check.run(bench).verdict is Verdict.PASSED
