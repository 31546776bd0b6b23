"""The conformance suite, run on the boards' driver with lines in memory to virtual boards."""

import pytest

from rotemina.drivers.conformance import DriverBench as ConformanceBench

pytestmark = pytest.mark.slow
# The driver can act only when it is read, the boards have no output for a tool, and the bench has
# no fault that can be cleared immediately.
IRRELEVANT_CHECKS = {"stop-when-called", "tool", "fault"}


def damage_once(port):
    """Change one byte of the next data from the boards."""

    def damage(data):
        if not data:
            return data
        port.to_host = lambda data: data
        middle = len(data) // 2
        return data[:middle] + bytes([data[middle] ^ 0x55]) + data[middle + 1 :]

    port.to_host = damage


def make_conformance_bench(bench, make_blockable_lines):
    lines = make_blockable_lines(bench._open_port, bench.clock)
    return ConformanceBench(
        make=lambda settings: bench.make(settings, lines.open_port),
        advance=bench.clock.advance,
        cut_link=lambda: bench.set_cut(True),
        restore_link=lambda: bench.set_cut(False),
        misreport=lambda: [damage_once(port) for port in bench.ports],
        delay_line=bench.delay,
        block_port=lambda: lines.set_blocked(True),
        unblock_port=lambda: lines.set_blocked(False),
        was_device_contacted=lambda: bool(lines.channels),
    )


@pytest.mark.parametrize("ports", [2, 1], ids=["two lines", "shared bus"])
def test_the_boards_fulfil_the_contract(
    robot, make_bench, make_blockable_lines, run_conformance_suite, ports
):
    skipped = run_conformance_suite(
        lambda: make_conformance_bench(make_bench(robot, ports=ports), make_blockable_lines)
    )
    assert skipped == IRRELEVANT_CHECKS
