"""The checks of ``rotemina doctor``: whether this computer can run the program.

:mod:`rotemina.app.system.system_check` checks the prerequisites of an installation, and this module
everything else. No check moves, opens or resets a board: for serial ports, only the permission is
checked.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from importlib import metadata
from pathlib import Path

from packaging.requirements import Requirement
from platformdirs import user_cache_path, user_config_path, user_data_path
from serial.tools.list_ports import comports

from rotemina.app.system import system_check
from rotemina.drivers.contract import DriverError
from rotemina.drivers.inputs import HidSource, InputSource
from rotemina.sim.messages import (
    Message,
    format_fixed,
    join_messages,
    message,
)
from rotemina.sim.units import format_quantity

# A session may write this much shortly after its start, for recordings and cached compiled code.
MIN_FREE_BYTES = 200e6
# Enough for hours of recording at 1 kHz.
AMPLE_FREE_BYTES = 5e9
# The loop of the session has a period of 1 ms, which the clock must resolve.
MAX_CLOCK_STEP_S = 1e-3
_QT_START_TIMEOUT_S = 60.0
# The platform is printed before OpenGL is used, because a broken graphics driver may crash there.
_QT_TEST_PROGRAM = """
from PySide6.QtGui import QGuiApplication, QOffscreenSurface, QOpenGLContext
application = QGuiApplication([])
print(application.platformName(), flush=True)
context, surface = QOpenGLContext(), QOffscreenSurface()
surface.create()
if context.create() and context.makeCurrent(surface):
    print(context.functions().glGetString(0x1F01))
"""
_SOFTWARE_RENDERERS = ("llvmpipe", "softpipe", "swiftshader", "software", "basic render")


class FindingState(StrEnum):
    """Severity of a finding.

    ``LIMITED``: the program runs, but one of its functions does not. ``BROKEN``: the program or its
    simulator does not run.
    """

    GOOD = "ok"
    LIMITED = "limited"
    BROKEN = "broken"


@dataclass(frozen=True, slots=True)
class CheckFinding:
    """Result of one check: its name, state and observation, and advice if something is wrong."""

    name: str
    state: FindingState
    seen: str
    advice: str = ""


def run_checks(environment: Mapping[str, str]) -> Iterator[CheckFinding]:
    """Run all checks, and yield the findings one after the other.

    Parameters
    ----------
    environment
        Environment variables, such as ``os.environ``; they determine the display.
    """
    platform = system_check.find_platform(environment)
    yield check_python()
    yield check_dependencies(metadata.requires("rotemina") or ())
    yield check_qt_libraries(platform)
    yield from check_qt(platform)
    yield check_serial_ports([port.device for port in comports()])
    yield check_joysticks(HidSource())
    folders = {
        "preferences": user_config_path("rotemina", appauthor=False),
        "recordings": user_data_path("rotemina", appauthor=False),
        "cache": user_cache_path("rotemina", appauthor=False),
    }
    yield check_folders(folders)
    yield check_free_disk(folders["recordings"])
    yield check_clock(time.monotonic)


def check_python() -> CheckFinding:
    """Compare the version of Python with the oldest supported one."""
    observation = f"{sys.version.split()[0]} ({sys.executable})"
    if sys.version_info < system_check.OLDEST_PYTHON:
        oldest = ".".join(map(str, system_check.OLDEST_PYTHON))
        advice = message("engine", "Install Python >= {version}.").fill(version=oldest)
        return CheckFinding("Python", FindingState.BROKEN, observation, advice)
    return CheckFinding("Python", FindingState.GOOD, observation)


def check_dependencies(requirements: Sequence[str]) -> CheckFinding:
    """Compare the installed packages with the requirements, except those of extras.

    Parameters
    ----------
    requirements
        In the format of ``importlib.metadata.requires``, such as ``"numpy>=2.0"``.
    """
    problems, required_count = [], 0
    for requirement in map(Requirement, requirements):
        if requirement.marker and not requirement.marker.evaluate({"extra": ""}):
            continue
        required_count += 1
        try:
            version = metadata.version(requirement.name)
        except metadata.PackageNotFoundError:
            version = "missing"
        if version == "missing" or not requirement.specifier.contains(version, prereleases=True):
            problem = message("engine", "{name} {found}, {needed} needed").fill(
                name=requirement.name, found=version, needed=str(requirement.specifier) or "any"
            )
            problems.append(problem)
    if problems:
        advice = message(
            "engine",
            "Install again: pip install --upgrade rotemina (in its folder: pip install .).",
        )
        return CheckFinding(
            "dependencies", FindingState.BROKEN, join_messages(problems, "; "), advice
        )
    observation = message("engine", "{count} packages, versions as required").fill(
        count=required_count
    )
    return CheckFinding("dependencies", FindingState.GOOD, observation)


def check_qt_libraries(platform: str) -> CheckFinding:
    """Look for the system libraries that Qt loads on a platform."""
    missing = system_check.find_missing_libraries(platform)
    if missing:
        names = ", ".join(package.provides for package in missing)
        observation = message("engine", "missing: {names}").fill(names=names)
        return CheckFinding(
            "Qt libraries", FindingState.BROKEN, observation, system_check.describe_missing(missing)
        )
    observation = message("engine", "all libraries of the platform {platform} found").fill(
        platform=repr(platform)
    )
    return CheckFinding("Qt libraries", FindingState.GOOD, observation)


def check_qt(platform: str, program: str = _QT_TEST_PROGRAM) -> Iterator[CheckFinding]:
    """Start Qt in a separate process, because Qt may abort, and report how it renders."""
    # The program itself also uses this platform when there is no display.
    is_offscreen = platform == "offscreen"
    try:
        process = subprocess.run(
            [sys.executable, "-c", program],
            capture_output=True, text=True, check=False, timeout=_QT_START_TIMEOUT_S,
            env={**os.environ, **({"QT_QPA_PLATFORM": platform} if is_offscreen else {})},
        )  # fmt: skip
        output, error_text = process.stdout.splitlines(), process.stderr.strip()
    except subprocess.TimeoutExpired:
        output = []
        error_text = message("engine", "no answer within {limit} s").fill(limit=_QT_START_TIMEOUT_S)
    if not output:
        reason = error_text or message("engine", "it ended without a message")
        if not isinstance(reason, Message):
            reason = reason.splitlines()[-1]
        advice = message(
            "engine",
            "Without a display: QT_QPA_PLATFORM=offscreen. Otherwise see the Qt libraries above; "
            "with QT_DEBUG_PLUGINS=1 Qt names the missing plugin.",
        )
        observation = message("engine", "Qt does not start on {platform}: {reason}").fill(
            platform=repr(platform), reason=reason
        )
        yield CheckFinding("Qt platform", FindingState.BROKEN, observation, advice)
        return
    if is_offscreen:
        advice = message("engine", "Commands work anyway. Start the window from a desktop.")
        observation = message("engine", "{platform}: no display for a window").fill(
            platform=output[0]
        )
        yield CheckFinding("Qt platform", FindingState.LIMITED, observation, advice)
    else:
        yield CheckFinding("Qt platform", FindingState.GOOD, output[0])
    yield _check_rendering(output[1] if len(output) > 1 else "")


def _check_rendering(renderer: str) -> CheckFinding:
    if renderer and not any(word in renderer.lower() for word in _SOFTWARE_RENDERERS):
        return CheckFinding("rendering", FindingState.GOOD, renderer)
    observation = message("engine", "software rendering ({renderer})").fill(
        renderer=renderer or message("engine", "no OpenGL")
    )
    advice = message(
        "engine", "Plots need no GPU; the 3-D view is slower. A graphics driver speeds it up."
    )
    return CheckFinding("rendering", FindingState.LIMITED, observation, advice)


def check_serial_ports(
    devices: Sequence[str], can_open: Callable[[str], bool] | None = None
) -> CheckFinding:
    """Check the permission for serial ports without opening them, which could reset a board."""
    if not devices:
        return CheckFinding("serial ports", FindingState.GOOD, message("engine", "none connected"))
    forbidden_ports = [device for device in devices if not (can_open or _can_open)(device)]
    if forbidden_ports:
        group = _find_group(forbidden_ports[0])
        advice = message("engine", "sudo usermod -aG {group} $USER, then log in again.").fill(
            group=group
        )
        observation = message("engine", "no permission for {names}").fill(
            names=", ".join(forbidden_ports)
        )
        return CheckFinding("serial ports", FindingState.LIMITED, observation, advice)
    return CheckFinding("serial ports", FindingState.GOOD, ", ".join(devices))


def _can_open(device: str) -> bool:
    # On Windows, ports are not files and need no permission.
    return os.name != "posix" or os.access(device, os.R_OK | os.W_OK)


def _find_group(device: str) -> str:
    try:
        return Path(device).group()
    except (OSError, KeyError, NotImplementedError):
        return "dialout"


def check_joysticks(source: InputSource) -> CheckFinding:
    """Open and close each connected joystick, without sending anything to it."""
    devices, problems = source.devices(), []
    for identity in devices:
        try:
            source.open(identity).close()
        except DriverError as error:
            problems.append(str(error))
    if source.problem:
        problems.append(source.problem)
    if problems:
        advice = message("engine", "See 'When a joystick is missing' in docs/inputs.md.")
        return CheckFinding("joysticks", FindingState.LIMITED, "; ".join(problems), advice)
    names = ", ".join(identity.name for identity in devices)
    return CheckFinding(
        "joysticks", FindingState.GOOD, names or message("engine", "none connected")
    )


def check_folders(folders: Mapping[str, Path]) -> CheckFinding:
    """Write a temporary file into each folder, or into its nearest existing parent."""
    problems = []
    for purpose, folder in folders.items():
        try:
            with tempfile.TemporaryFile(dir=_find_existing_folder(folder)):
                pass
        except OSError as error:
            problems.append(f"{folder} ({purpose}): {error.strerror}")
    if problems:
        advice = message(
            "engine",
            "Give the user permission to write there, or set HOME or XDG_*_HOME elsewhere.",
        )
        return CheckFinding("folders", FindingState.BROKEN, "; ".join(problems), advice)
    return CheckFinding("folders", FindingState.GOOD, ", ".join(map(str, folders.values())))


def check_free_disk(folder: Path) -> CheckFinding:
    """Compare the free space of the recordings folder with what recordings need."""
    free = shutil.disk_usage(_find_existing_folder(folder)).free
    observation = message("engine", "{free} GB free for {folder}").fill(
        free=format_fixed(free / 1e9, 1), folder=folder
    )
    if free < MIN_FREE_BYTES:
        advice = message("engine", "Free at least {least} MB.").fill(least=MIN_FREE_BYTES / 1e6)
        return CheckFinding("disk", FindingState.BROKEN, observation, advice)
    if free < AMPLE_FREE_BYTES:
        advice = message("engine", "An hour at 1 kHz takes 0.8 GB; {ample} GB are ample.").fill(
            ample=AMPLE_FREE_BYTES / 1e9
        )
        return CheckFinding("disk", FindingState.LIMITED, observation, advice)
    return CheckFinding("disk", FindingState.GOOD, observation)


def check_clock(now: Callable[[], float], *, max_calls: int = 1_000_000) -> CheckFinding:
    """Measure the smallest step of the clock that times samples and stops.

    ``now`` returns the time, s; it is called at most ``max_calls`` times.
    """
    steps: list[float] = []
    previous_s = now()
    for _ in range(max_calls):
        time_s = now()
        if time_s != previous_s:
            steps.append(time_s - previous_s)
            previous_s = time_s
        if len(steps) == 100:
            break
    min_step_s = min(steps, default=float("inf"))
    observation = message("engine", "the clock stands still")
    if steps:
        observation = message("engine", "steps of {step}").fill(
            step=format_quantity(min_step_s, "s", digits=3)
        )
    if min_step_s > MAX_CLOCK_STEP_S:
        advice = message(
            "engine", "Times are wrong by more than {bound} ms: use Python >= 3.13."
        ).fill(bound=MAX_CLOCK_STEP_S * 1e3)
        return CheckFinding("clock", FindingState.LIMITED, observation, advice)
    return CheckFinding("clock", FindingState.GOOD, observation)


def _find_existing_folder(folder: Path) -> Path:
    return next(path for path in (folder, *folder.parents) if path.is_dir())
