"""The conformance suite, run on the G-code stage with an emulated controller."""

from rotemina.drivers.abilities import AxisHomer
from rotemina.drivers.conformance import CHECKS, DriverBench as ConformanceBench


def make_conformance_bench(bench, make_blockable_lines):
    lines = make_blockable_lines(bench._open_port, bench.clock)
    return ConformanceBench(
        make=lambda settings: bench.make(settings, lines.open_port),
        advance=bench.clock.advance,
        cut_link=lambda: bench.set_cut(True),
        restore_link=lambda: bench.set_cut(False),
        misreport=lambda: bench.alter_once(lambda data: data.replace(b".", b"", 1)),
        delay_line=bench.delay,
        block_port=lambda: lines.set_blocked(True),
        unblock_port=lambda: lines.set_blocked(False),
        cause_fault=lambda _: bench.stage.hit_limit(),
        was_device_contacted=lambda: bool(lines.channels),
    )


def test_the_stage_fulfils_the_contract(make_bench, make_blockable_lines, run_conformance_suite):
    skipped = run_conformance_suite(
        lambda: make_conformance_bench(make_bench(), make_blockable_lines)
    )
    # The driver can act only when it is read. Such a controller moves and homes its axes, and has
    # no further ability.
    assert skipped == {"stop-when-called"} | {
        check.name for check in CHECKS if check.needs not in (None, AxisHomer)
    }
