"""Prerequisites of the operating system for starting the program.

Qt aborts when a library of its platform is missing, so the libraries are looked for first. The
same file runs as a script before any environment exists (``python3 app/system_check.py``): it
needs the standard library only, and an old Python must still be able to read it.
"""

from __future__ import annotations

import argparse
import ctypes
import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Mapping, NamedTuple, Sequence  # noqa: UP035 - an old Python reads this too

OLDEST_PYTHON = (3, 11)
APT_GET = "apt-get -qq -o DPkg::Lock::Timeout=120"  # waits for the system's own updates


class Package(NamedTuple):
    """A Debian package, and what is missing without it."""

    name: str
    provides: str


# What `objdump -p` lists for PySide6-Essentials 6.8 to 6.12 beside what is in the wheel, the
# libraries that Python or apt themselves need left out. The first entry is for every platform.
LIBRARIES = {
    "offscreen": (
        Package("libdbus-1-3", "libdbus-1.so.3"),
        Package("libegl1", "libEGL.so.1"),
        Package("libfontconfig1", "libfontconfig.so.1"),
        Package("libfreetype6", "libfreetype.so.6"),
        Package("libgl1", "libGL.so.1"),
        Package("libglib2.0-0", "libgthread-2.0.so.0"),
        Package("libx11-6", "libX11.so.6"),
        Package("libxkbcommon0", "libxkbcommon.so.0"),
    ),
    "xcb": (
        Package("libx11-xcb1", "libX11-xcb.so.1"),
        Package("libxcb-cursor0", "libxcb-cursor.so.0"),
        Package("libxcb-glx0", "libxcb-glx.so.0"),
        Package("libxcb-icccm4", "libxcb-icccm.so.4"),
        Package("libxcb-image0", "libxcb-image.so.0"),
        Package("libxcb-keysyms1", "libxcb-keysyms.so.1"),
        Package("libxcb-randr0", "libxcb-randr.so.0"),
        Package("libxcb-render-util0", "libxcb-render-util.so.0"),
        Package("libxcb-render0", "libxcb-render.so.0"),
        Package("libxcb-shape0", "libxcb-shape.so.0"),
        Package("libxcb-shm0", "libxcb-shm.so.0"),
        Package("libxcb-sync1", "libxcb-sync.so.1"),
        Package("libxcb-util1", "libxcb-util.so.1"),
        Package("libxcb-xfixes0", "libxcb-xfixes.so.0"),
        Package("libxcb-xkb1", "libxcb-xkb.so.1"),
        Package("libxcb1", "libxcb.so.1"),
        Package("libxkbcommon-x11-0", "libxkbcommon-x11.so.0"),
    ),
    "wayland": (
        Package("libwayland-client0", "libwayland-client.so.0"),
        Package("libwayland-cursor0", "libwayland-cursor.so.0"),
        Package("libwayland-egl1", "libwayland-egl.so.1"),
    ),
}
FONT = Package("fonts-dejavu-core", "a font")
# A screen that nobody looks at, and a hand for it: some long tests use the window as it is.
SCREEN = (Package("xvfb", "Xvfb"), Package("xdotool", "xdotool"))
# What the hot paths of the boards' firmware are assembled by, to be counted.
ASSEMBLER = (Package("binutils-m68hc1x", "m68hc11-as"),)


def platform_in_use(environment: Mapping[str, str]) -> str:
    """Qt platform that a program started with this environment uses.

    Parameters
    ----------
    environment
        Such as ``os.environ``. Only Linux has a choice.

    Returns
    -------
    str
        The platform asked for by ``QT_QPA_PLATFORM``, else the one of the display, else
        ``"offscreen"``.
    """
    asked = environment.get("QT_QPA_PLATFORM", "")
    if asked:
        return asked.split(";")[0].split(":")[0]
    if environment.get("WAYLAND_DISPLAY"):
        return "wayland"
    return "xcb" if environment.get("DISPLAY") else "offscreen"


def missing_libraries(platform: str) -> list[Package]:
    """System packages without which Qt cannot start, or can show no text.

    Parameters
    ----------
    platform
        Qt platform: ``"xcb"``, ``"wayland"``; any other needs what ``"offscreen"`` needs.

    Returns
    -------
    list of Package
        Empty when nothing is missing, and on anything but Linux, where Qt brings everything.
    """
    if not sys.platform.startswith("linux"):
        return []
    needed = LIBRARIES["offscreen"]
    if platform != "offscreen":
        needed += LIBRARIES.get(platform, ())
    missing = [package for package in needed if not _loads(package.provides)]
    return missing if _has_font() else [*missing, FONT]


def missing_python_parts() -> list[Package]:
    """Package without which this Python makes no environment: Debian keeps it apart."""
    if sys.platform.startswith("linux") and not (find_spec("venv") and find_spec("ensurepip")):
        return [Package(_venv_package(), "venv")]
    return []


def missing_programs(programs: Sequence[Package]) -> list[Package]:
    """Return those packages whose program is missing; tests can do without."""
    if not sys.platform.startswith("linux"):
        return []
    return [package for package in programs if not shutil.which(package.provides)]


def install_command(packages: Sequence[Package]) -> str:
    """Command that a person types to install packages on Debian or Ubuntu."""
    update = "apt-get update"
    install = "apt-get install -y --no-install-recommends " + " ".join(p.name for p in packages)
    if os.geteuid() == 0:
        return update + " && " + install
    if shutil.which("sudo"):
        return "sudo " + update + " && sudo " + install
    return "su -c '" + update + " && " + install + "'"


def complaint(packages: Sequence[Package]) -> str:
    """One line that says what is missing and how to install it; empty when nothing is."""
    if not packages:
        return ""
    names = ", ".join(package.provides for package in packages)
    if shutil.which("apt-get"):
        return "Missing: " + names + ". Install with: " + install_command(packages)
    return "Missing: " + names + ". Install what provides them with your package manager."


def install(packages: Sequence[Package]) -> bool:
    """Install packages where that needs no password; return whether it worked."""
    root = _as_root()
    if root is None or not shutil.which("apt-get"):
        return False
    names = [package.name for package in packages]
    print("Installing system packages: " + " ".join(names), flush=True)
    # A repository that cannot be read need not be the one that has the packages.
    _run([*root, *APT_GET.split(), "update"])
    return _run([*root, *APT_GET.split(), "install", "-y", "--no-install-recommends", *names])


def main(arguments: Sequence[str] | None = None) -> int:
    """Check this machine, install what is missing if allowed, and return an exit code."""
    parser = argparse.ArgumentParser(description="Check what RoTeMiNa needs of the system.")
    parser.add_argument("--install", action="store_true", help="install what is missing")
    parser.add_argument("--screen", action="store_true", help="also what tests of the window use")
    parser.add_argument("--assembler", action="store_true", help="also that of the boards' chip")
    parser.add_argument("platform", nargs="?", default=platform_in_use(os.environ))
    options = parser.parse_args(arguments)

    if sys.version_info < OLDEST_PYTHON:
        return _fail(_old_python())
    needed = missing_python_parts() + missing_libraries(options.platform)
    wanted = list(dict.fromkeys(needed + missing_libraries("xcb")))
    programs = (*(SCREEN if options.screen else ()), *(ASSEMBLER if options.assembler else ()))
    extra = missing_programs(programs)
    if options.install and wanted + extra and install(wanted + extra):
        needed = missing_python_parts() + missing_libraries(options.platform)
        wanted = list(dict.fromkeys(needed + missing_libraries("xcb")))
    # Who has no display is not held up by the libraries that draw on one.
    return _fail(complaint(wanted)) if needed else 0


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _has_font() -> bool:
    """Ask fontconfig, as Qt does: ``FcFontSet`` starts with the number of fonts."""
    try:
        fontconfig = ctypes.CDLL("libfontconfig.so.1")
    except OSError:
        return True  # on Debian the library brings a font
    fontconfig.FcInitLoadConfigAndFonts.restype = ctypes.c_void_p
    fontconfig.FcConfigGetFonts.argtypes = (ctypes.c_void_p, ctypes.c_int)
    fontconfig.FcConfigGetFonts.restype = ctypes.POINTER(ctypes.c_int)
    system_fonts = fontconfig.FcConfigGetFonts(fontconfig.FcInitLoadConfigAndFonts(), 0)
    return bool(system_fonts) and system_fonts[0] > 0


def _venv_package() -> str:
    if Path(sys.executable).resolve() == Path("/usr/bin/python3").resolve():
        return "python3-venv"
    return "python{}.{}-venv".format(*sys.version_info)


def _as_root() -> list[str] | None:
    """Words that make the command after them run as root; None when that takes a password."""
    silent = ["env", "DEBIAN_FRONTEND=noninteractive"]
    if os.geteuid() == 0:
        return silent
    if shutil.which("sudo") and _run(["sudo", "-n", "true"], errors=subprocess.DEVNULL):
        return ["sudo", "-n", *silent]
    return None


def _run(command: Sequence[str], errors: int | None = None) -> bool:
    null = subprocess.DEVNULL
    done = subprocess.run(command, check=False, stdin=null, stdout=null, stderr=errors)
    return done.returncode == 0


def _old_python() -> str:
    found = "{}.{}".format(*sys.version_info)
    oldest = "{}.{}".format(*OLDEST_PYTHON)
    return (
        "RoTeMiNa needs Python >= " + oldest + "; " + sys.executable + " is " + found + "."
        " Name a newer one: make PYTHON=/path/to/python3"
    )


def _fail(line: str) -> int:
    print(line, file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
