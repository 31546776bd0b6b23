"""The checks of ``rotemina doctor``: whether this computer can run the program.

:mod:`rotemina.app.system_check` is what must be there before an installation; this is the rest.
Nothing here moves, opens or resets a board: of serial ports only the permission is examined.
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

from rotemina.app import system_check
from rotemina.drivers.errors import DriverError
from rotemina.drivers.inputs.device import InputSource
from rotemina.drivers.inputs.hid.hid_discovery import HidSource
from rotemina.sim.messages import Message, joined, message
from rotemina.sim.quantities import amount, fixed

LEAST_FREE_BYTES = 200e6  # what a session may need at once: recorder, cached code
AMPLE_FREE_BYTES = 5e9  # hours of recording at 1 kHz
COARSEST_CLOCK_S = 1e-3  # the session's loop has 1 ms
_QT_STARTS_IN_S = 60.0
# The platform is said before OpenGL is tried, which a broken graphics driver may not survive.
_TRY_QT = """
from PySide6.QtGui import QGuiApplication, QOffscreenSurface, QOpenGLContext
application = QGuiApplication([])
print(application.platformName(), flush=True)
context, surface = QOpenGLContext(), QOffscreenSurface()
surface.create()
if context.create() and context.makeCurrent(surface):
    print(context.functions().glGetString(0x1F01))
"""
_SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "software", "basic render")


class State(StrEnum):
    """How a finding is to be taken."""

    GOOD = "ok"
    LIMITED = "limited"  # the program runs, something that it could do does not
    BROKEN = "broken"  # the program or its simulator does not run


@dataclass(frozen=True, slots=True)
class Finding:
    """A finding: subject, observation, and advice if something is wrong."""

    name: str
    state: State
    seen: str
    advice: str = ""


def examine(environment: Mapping[str, str]) -> Iterator[Finding]:
    """Run all checks, and yield one finding after the other.

    Parameters
    ----------
    environment
        Such as ``os.environ``: it tells the display.
    """
    platform = system_check.platform_in_use(environment)
    yield python()
    yield dependencies(metadata.requires("rotemina") or ())
    yield qt_libraries(platform)
    yield from qt(platform)
    yield serial_ports([port.device for port in comports()])
    yield joysticks(HidSource())
    folders = {
        "preferences": user_config_path("rotemina", appauthor=False),
        "recordings": user_data_path("rotemina", appauthor=False),
        "cache": user_cache_path("rotemina", appauthor=False),
    }
    yield writable(folders)
    yield free_disk(folders["recordings"])
    yield clock(time.monotonic)


def python() -> Finding:
    """Compare the Python in use with the oldest that will do."""
    seen = f"{sys.version.split()[0]} ({sys.executable})"
    if sys.version_info < system_check.OLDEST_PYTHON:
        oldest = ".".join(map(str, system_check.OLDEST_PYTHON))
        advice = message("engine", "Install Python >= {version}.").fill(version=oldest)
        return Finding("Python", State.BROKEN, seen, advice)
    return Finding("Python", State.GOOD, seen)


def dependencies(requirements: Sequence[str]) -> Finding:
    """Compare installed packages with what is required, extras left out.

    Parameters
    ----------
    requirements
        As ``importlib.metadata.requires`` tells them, such as ``"numpy>=2.0"``.
    """
    wrong, count = [], 0
    for required in map(Requirement, requirements):
        if required.marker and not required.marker.evaluate({"extra": ""}):
            continue
        count += 1
        try:
            found = metadata.version(required.name)
        except metadata.PackageNotFoundError:
            found = "missing"
        if found == "missing" or not required.specifier.contains(found, prereleases=True):
            said = message("engine", "{name} {found}, {needed} needed").fill(
                name=required.name, found=found, needed=str(required.specifier) or "any"
            )
            wrong.append(said)
    if wrong:
        advice = message(
            "engine",
            "Install again: pip install --upgrade rotemina (in its folder: pip install .).",
        )
        return Finding("dependencies", State.BROKEN, joined(wrong, "; "), advice)
    seen = message("engine", "{count} packages, versions as required").fill(count=count)
    return Finding("dependencies", State.GOOD, seen)


def qt_libraries(platform: str) -> Finding:
    """Look for the system's libraries that Qt loads on a platform."""
    missing = system_check.missing_libraries(platform)
    if missing:
        names = ", ".join(package.provides for package in missing)
        seen = message("engine", "missing: {names}").fill(names=names)
        return Finding("Qt libraries", State.BROKEN, seen, system_check.complaint(missing))
    seen = message("engine", "all for the platform {platform}").fill(platform=repr(platform))
    return Finding("Qt libraries", State.GOOD, seen)


def qt(platform: str, program: str = _TRY_QT) -> Iterator[Finding]:
    """Start Qt in a separate process, because it may abort; report how it renders."""
    windowless = platform == "offscreen"  # as the program itself does without a display
    try:
        done = subprocess.run(
            [sys.executable, "-c", program],
            capture_output=True, text=True, check=False, timeout=_QT_STARTS_IN_S,
            env={**os.environ, **({"QT_QPA_PLATFORM": platform} if windowless else {})},
        )  # fmt: skip
        said, fault = done.stdout.splitlines(), done.stderr.strip()
    except subprocess.TimeoutExpired:
        said = []
        fault = message("engine", "no answer within {limit} s").fill(limit=_QT_STARTS_IN_S)
    if not said:
        reason = fault or message("engine", "it ended without a message")
        if not isinstance(reason, Message):
            reason = reason.splitlines()[-1]
        advice = message(
            "engine",
            "Without a display: QT_QPA_PLATFORM=offscreen. Otherwise see the Qt libraries above; "
            "with QT_DEBUG_PLUGINS=1 Qt names the missing plugin.",
        )
        seen = message("engine", "Qt does not start on {platform}: {reason}").fill(
            platform=repr(platform), reason=reason
        )
        yield Finding("Qt platform", State.BROKEN, seen, advice)
        return
    if windowless:
        advice = message("engine", "Commands work anyway. Start the window from a desktop.")
        seen = message("engine", "{platform}: no display for a window").fill(platform=said[0])
        yield Finding("Qt platform", State.LIMITED, seen, advice)
    else:
        yield Finding("Qt platform", State.GOOD, said[0])
    yield _rendering(said[1] if len(said) > 1 else "")


def _rendering(renderer: str) -> Finding:
    if renderer and not any(word in renderer.lower() for word in _SOFTWARE):
        return Finding("rendering", State.GOOD, renderer)
    seen = message("engine", "by software ({renderer})").fill(
        renderer=renderer or message("engine", "no OpenGL")
    )
    advice = message(
        "engine", "Plots need no GPU; the 3-D view is slower. A graphics driver speeds it up."
    )
    return Finding("rendering", State.LIMITED, seen, advice)


def serial_ports(devices: Sequence[str], may: Callable[[str], bool] | None = None) -> Finding:
    """Ask whether serial ports may be opened, without doing so: that could reset a board."""
    if not devices:
        return Finding("serial ports", State.GOOD, message("engine", "none connected"))
    refused = [device for device in devices if not (may or _may_open)(device)]
    if refused:
        group = _group_of(refused[0])
        advice = message("engine", "sudo usermod -aG {group} $USER, then log in again.").fill(
            group=group
        )
        seen = message("engine", "no permission for {names}").fill(names=", ".join(refused))
        return Finding("serial ports", State.LIMITED, seen, advice)
    return Finding("serial ports", State.GOOD, ", ".join(devices))


def _may_open(device: str) -> bool:
    # Windows knows no such permission, and ports there are no files.
    return os.name != "posix" or os.access(device, os.R_OK | os.W_OK)


def _group_of(device: str) -> str:
    try:
        return Path(device).group()
    except (OSError, KeyError, NotImplementedError):
        return "dialout"


def joysticks(source: InputSource) -> Finding:
    """Open and close each joystick that is plugged in; nothing is sent to it."""
    devices, refused = source.devices(), []
    for identity in devices:
        try:
            source.open(identity).close()
        except DriverError as error:
            refused.append(str(error))
    if source.problem:
        refused.append(source.problem)
    if refused:
        advice = message("engine", "See 'When a joystick is missing' in docs/inputs.md.")
        return Finding("joysticks", State.LIMITED, "; ".join(refused), advice)
    names = ", ".join(identity.name for identity in devices)
    return Finding("joysticks", State.GOOD, names or message("engine", "none connected"))


def writable(folders: Mapping[str, Path]) -> Finding:
    """Write a file into each folder, or into the nearest one above it that is there."""
    refused = []
    for what, folder in folders.items():
        try:
            with tempfile.TemporaryFile(dir=_present(folder)):
                pass
        except OSError as error:
            refused.append(f"{folder} ({what}): {error.strerror}")
    if refused:
        advice = message(
            "engine",
            "Give the user permission to write there, or set HOME or XDG_*_HOME elsewhere.",
        )
        return Finding("folders", State.BROKEN, "; ".join(refused), advice)
    return Finding("folders", State.GOOD, ", ".join(map(str, folders.values())))


def free_disk(folder: Path) -> Finding:
    """Return how much can be recorded where recordings go."""
    free = shutil.disk_usage(_present(folder)).free
    seen = message("engine", "{free} GB free for {folder}").fill(
        free=fixed(free / 1e9, 1), folder=folder
    )
    if free < LEAST_FREE_BYTES:
        advice = message("engine", "Free at least {least} MB.").fill(least=LEAST_FREE_BYTES / 1e6)
        return Finding("disk", State.BROKEN, seen, advice)
    if free < AMPLE_FREE_BYTES:
        advice = message("engine", "An hour at 1 kHz takes 0.8 GB; {ample} GB are ample.").fill(
            ample=AMPLE_FREE_BYTES / 1e9
        )
        return Finding("disk", State.LIMITED, seen, advice)
    return Finding("disk", State.GOOD, seen)


def clock(now: Callable[[], float], *, most: int = 1_000_000) -> Finding:
    """Measure the smallest step of the clock that times samples and stops, s."""
    steps: list[float] = []
    last = now()
    for _ in range(most):
        present = now()
        if present != last:
            steps.append(present - last)
            last = present
        if len(steps) == 100:
            break
    step = min(steps, default=float("inf"))
    seen = message("engine", "the clock stands still")
    if steps:
        seen = message("engine", "steps of {step}").fill(step=amount(step, "s", digits=3))
    if step > COARSEST_CLOCK_S:
        advice = message(
            "engine", "Times are wrong by more than {bound} ms: use Python >= 3.13."
        ).fill(bound=COARSEST_CLOCK_S * 1e3)
        return Finding("clock", State.LIMITED, seen, advice)
    return Finding("clock", State.GOOD, seen)


def _present(folder: Path) -> Path:
    return next(one for one in (folder, *folder.parents) if one.is_dir())
