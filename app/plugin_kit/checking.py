"""Check of an installed plugin of any kind: its import, then the checks of its kind."""

import time
from collections.abc import Iterator
from importlib.metadata import EntryPoint

from rotemina.app.plugin_kit.camera_check import check_cameras
from rotemina.app.plugin_kit.input_check import check_inputs
from rotemina.app.plugin_kit.plugin_kinds import InstalledPlugin, PluginKind, load_installed_plugins
from rotemina.drivers.conformance import CheckVerdict, DriverCheckResult, make_bench, run_checks
from rotemina.sim.plugin_points import find_import_fault
from rotemina.sim.robot import Robot
from rotemina.sim.simulation import check_effect

_LOADING_REQUIREMENT = "be importable, and be written for this version of the interface"


def check_plugin(kind: PluginKind, point: EntryPoint, robot: Robot) -> Iterator[DriverCheckResult]:
    """Check a plugin; it is imported again even if the result of an earlier import is stored.

    For the driver of a real device, only checks without motion run.

    Parameters
    ----------
    kind : PluginKind
    point : EntryPoint
    robot : Robot
        The robot that a driver is checked with.
    """
    find_import_fault(point, again=True)
    plugin = next(
        candidate
        for candidate in load_installed_plugins(kind)
        if candidate.name == point.name and candidate.value == point.value
    )
    if plugin.loaded is None:
        yield DriverCheckResult(
            "loading", _LOADING_REQUIREMENT, CheckVerdict.FAILED, plugin.refusal
        )
        return
    yield DriverCheckResult("loading", _LOADING_REQUIREMENT, CheckVerdict.PASSED)
    yield from _run_kind_checks(plugin, robot)


def _run_kind_checks(plugin: InstalledPlugin, robot: Robot) -> Iterator[DriverCheckResult]:
    match plugin.kind:
        case PluginKind.DRIVER:
            bench = make_bench(plugin.loaded, robot)
            yield from run_checks(bench, may_move=plugin.loaded.virtual_time)
        case PluginKind.EFFECT:
            yield from _run_effect_checks(plugin.name)
        case PluginKind.PANEL:
            # Qt is imported only here, because the other kinds work without its libraries.
            from rotemina.app.plugin_kit.panel_check import check_panel

            yield from check_panel(plugin.loaded)
        case PluginKind.CAMERA:
            yield from check_cameras(plugin.loaded, clock=time.monotonic, wait=time.sleep)
        case PluginKind.INPUT:
            yield from check_inputs(plugin.loaded, clock=time.monotonic, wait=time.sleep)


def _run_effect_checks(effect_id: str) -> Iterator[DriverCheckResult]:
    """Run the checks of an effect, and yield one result per check, which covers all axes."""
    checks = check_effect(effect_id, clock=time.perf_counter).checks
    for name in dict.fromkeys(check.name for check in checks):
        same_checks = [check for check in checks if check.name == name]
        failed_checks = [check for check in same_checks if check.passed is False]
        if failed_checks:
            first = failed_checks[0]
            location = " ".join(part for part in (first.formulation, first.place) if part)
            note = f"{len(failed_checks)} of {len(same_checks)}; {location}: {first.note}"
            yield DriverCheckResult(name, name, CheckVerdict.FAILED, note)
        elif any(check.passed for check in same_checks):
            yield DriverCheckResult(name, name, CheckVerdict.PASSED)
        else:
            yield DriverCheckResult(name, name, CheckVerdict.SKIPPED, same_checks[0].note)
