"""Check of an installed plugin of any kind: its import, its interface, then its own kit."""

import time
from collections.abc import Iterator
from importlib.metadata import EntryPoint

from rotemina.app.plugin_kit.camera_check import check_cameras
from rotemina.app.plugin_kit.input_check import check_inputs
from rotemina.app.plugin_kit.plugin_kinds import Kind, Plugin, installed_plugins
from rotemina.drivers.conformance.bench import bench_of
from rotemina.drivers.conformance.check import Result, Verdict
from rotemina.drivers.conformance.suite import run_checks
from rotemina.sim.plugin_import import import_fault
from rotemina.sim.robot.model import Robot
from rotemina.sim.simulation.effect_check import check_effect

_LOADED = "be imported, and be written for this version of the interface"


def check_plugin(kind: Kind, point: EntryPoint, robot: Robot) -> Iterator[Result]:
    """Check a plugin; its import is tried again, whatever came of it before.

    A device in real time is not moved: only what moves no axis is checked of its driver.

    Parameters
    ----------
    kind : Kind
    point : EntryPoint
    robot : Robot
        What a driver is to be.
    """
    import_fault(point, anew=True)
    plugin = next(
        one
        for one in installed_plugins(kind)
        if one.name == point.name and one.value == point.value
    )
    if plugin.loaded is None:
        yield Result("loading", _LOADED, Verdict.FAILED, plugin.refused)
        return
    yield Result("loading", _LOADED, Verdict.PASSED)
    yield from _checks(plugin, robot)


def _checks(plugin: Plugin, robot: Robot) -> Iterator[Result]:
    match plugin.kind:
        case Kind.DRIVER:
            bench = bench_of(plugin.loaded, robot)
            yield from run_checks(bench, may_move=plugin.loaded.virtual_time)
        case Kind.EFFECT:
            yield from _effect_results(plugin.name)
        case Kind.PANEL:
            # Qt is loaded only when it is wanted: the other kinds do without its libraries.
            from rotemina.app.plugin_kit.panel_check import check_panel

            yield from check_panel(plugin.loaded)
        case Kind.CAMERA:
            yield from check_cameras(plugin.loaded, clock=time.monotonic, wait=time.sleep)
        case Kind.INPUT:
            yield from check_inputs(plugin.loaded, clock=time.monotonic, wait=time.sleep)


def _effect_results(effect_id: str) -> Iterator[Result]:
    """Yield what the effects' own kit found, each thing once for all axes."""
    checks = check_effect(effect_id, clock=time.perf_counter).checks
    for name in dict.fromkeys(check.name for check in checks):
        these = [check for check in checks if check.name == name]
        failed = [check for check in these if check.passed is False]
        if failed:
            where = " ".join(part for part in (failed[0].formulation, failed[0].place) if part)
            note = f"{len(failed)} of {len(these)}; {where}: {failed[0].note}"
            yield Result(name, name, Verdict.FAILED, note)
        elif any(check.passed for check in these):
            yield Result(name, name, Verdict.PASSED)
        else:
            yield Result(name, name, Verdict.SKIPPED, these[0].note)
