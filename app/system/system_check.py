"""Prerequisites of the operating system for starting the program.

Qt aborts if a library of its platform is missing, so the libraries are checked first. This file
also runs as a script before an environment exists (``python3 app/system/system_check.py``): it
needs only the standard library, and even an old Python must be able to parse it.
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
from typing import Mapping, NamedTuple, Sequence  # noqa: UP035 - an old Python must be able to parse this file

OLDEST_PYTHON = (3, 11)
# With this time-out, apt-get waits until automatic updates of the system have ended.
APT_GET = "apt-get -qq -o DPkg::Lock::Timeout=120"


class DebianPackage(NamedTuple):
    """A Debian package, and the library, program or module that it provides."""

    name: str
    provides: str


# The libraries that `objdump -p` lists for PySide6-Essentials 6.8 to 6.12, without those in the
# wheel and those that Python or apt need themselves. Every platform needs the first entry.
LIBRARY_PACKAGES = {
    "offscreen": (
        DebianPackage("libdbus-1-3", "libdbus-1.so.3"),
        DebianPackage("libegl1", "libEGL.so.1"),
        DebianPackage("libfontconfig1", "libfontconfig.so.1"),
        DebianPackage("libfreetype6", "libfreetype.so.6"),
        DebianPackage("libgl1", "libGL.so.1"),
        DebianPackage("libglib2.0-0", "libgthread-2.0.so.0"),
        DebianPackage("libx11-6", "libX11.so.6"),
        DebianPackage("libxkbcommon0", "libxkbcommon.so.0"),
    ),
    "xcb": (
        DebianPackage("libx11-xcb1", "libX11-xcb.so.1"),
        DebianPackage("libxcb-cursor0", "libxcb-cursor.so.0"),
        DebianPackage("libxcb-glx0", "libxcb-glx.so.0"),
        DebianPackage("libxcb-icccm4", "libxcb-icccm.so.4"),
        DebianPackage("libxcb-image0", "libxcb-image.so.0"),
        DebianPackage("libxcb-keysyms1", "libxcb-keysyms.so.1"),
        DebianPackage("libxcb-randr0", "libxcb-randr.so.0"),
        DebianPackage("libxcb-render-util0", "libxcb-render-util.so.0"),
        DebianPackage("libxcb-render0", "libxcb-render.so.0"),
        DebianPackage("libxcb-shape0", "libxcb-shape.so.0"),
        DebianPackage("libxcb-shm0", "libxcb-shm.so.0"),
        DebianPackage("libxcb-sync1", "libxcb-sync.so.1"),
        DebianPackage("libxcb-util1", "libxcb-util.so.1"),
        DebianPackage("libxcb-xfixes0", "libxcb-xfixes.so.0"),
        DebianPackage("libxcb-xkb1", "libxcb-xkb.so.1"),
        DebianPackage("libxcb1", "libxcb.so.1"),
        DebianPackage("libxkbcommon-x11-0", "libxkbcommon-x11.so.0"),
    ),
    "wayland": (
        DebianPackage("libwayland-client0", "libwayland-client.so.0"),
        DebianPackage("libwayland-cursor0", "libwayland-cursor.so.0"),
        DebianPackage("libwayland-egl1", "libwayland-egl.so.1"),
    ),
}
FONT_PACKAGE = DebianPackage("fonts-dejavu-core", "a font")
# A virtual display and a program that sends it input; some long tests operate the real window.
SCREEN_PACKAGES = (DebianPackage("xvfb", "Xvfb"), DebianPackage("xdotool", "xdotool"))
# The assembler for the critical paths of the boards' firmware, whose cycles are counted.
ASSEMBLER_PACKAGES = (DebianPackage("binutils-m68hc1x", "m68hc11-as"),)


def find_platform(environment: Mapping[str, str]) -> str:
    """Return the Qt platform of a program that is started with this environment.

    Parameters
    ----------
    environment
        Environment variables, such as ``os.environ``. Only Linux has several platforms.

    Returns
    -------
    str
        The platform that ``QT_QPA_PLATFORM`` names, else that of the display, else
        ``"offscreen"``.
    """
    requested = environment.get("QT_QPA_PLATFORM", "")
    if requested:
        return requested.split(";")[0].split(":")[0]
    if environment.get("WAYLAND_DISPLAY"):
        return "wayland"
    return "xcb" if environment.get("DISPLAY") else "offscreen"


def find_missing_libraries(platform: str) -> list[DebianPackage]:
    """Return the missing system packages that Qt needs to start and to show text.

    Parameters
    ----------
    platform
        Qt platform: ``"xcb"`` or ``"wayland"``. Any other platform needs the same packages as
        ``"offscreen"``.

    Returns
    -------
    list of DebianPackage
        Always empty on systems other than Linux, where the Qt wheel contains everything.
    """
    if not sys.platform.startswith("linux"):
        return []
    needed = LIBRARY_PACKAGES["offscreen"]
    if platform != "offscreen":
        needed += LIBRARY_PACKAGES.get(platform, ())
    missing = [package for package in needed if not _can_load(package.provides)]
    return missing if _has_font() else [*missing, FONT_PACKAGE]


def find_missing_python_parts() -> list[DebianPackage]:
    """Return the package that Python needs to create environments, if it is missing.

    Debian does not install it with Python.
    """
    if sys.platform.startswith("linux") and not (find_spec("venv") and find_spec("ensurepip")):
        return [DebianPackage(_name_venv_package(), "venv")]
    return []


def find_missing_programs(programs: Sequence[DebianPackage]) -> list[DebianPackage]:
    """Return the packages whose program is missing; on systems other than Linux, none."""
    if not sys.platform.startswith("linux"):
        return []
    return [package for package in programs if not shutil.which(package.provides)]


def make_install_command(packages: Sequence[DebianPackage]) -> str:
    """Return the command that a user types to install packages on Debian or Ubuntu."""
    update = "apt-get update"
    install = "apt-get install -y --no-install-recommends " + " ".join(p.name for p in packages)
    if os.geteuid() == 0:
        return update + " && " + install
    if shutil.which("sudo"):
        return "sudo " + update + " && sudo " + install
    return "su -c '" + update + " && " + install + "'"


def describe_missing(packages: Sequence[DebianPackage]) -> str:
    """Return one line that says what is missing and how to install it, or ""."""
    if not packages:
        return ""
    names = ", ".join(package.provides for package in packages)
    if shutil.which("apt-get"):
        return "Missing: " + names + ". Install with: " + make_install_command(packages)
    return "Missing: " + names + ". Install packages that provide them with your package manager."


def install(packages: Sequence[DebianPackage]) -> bool:
    """Install packages if no password is needed; return whether it succeeded."""
    root = _make_root_prefix()
    if root is None or not shutil.which("apt-get"):
        return False
    names = [package.name for package in packages]
    print("Installing system packages: " + " ".join(names), flush=True)
    # An update that fails is ignored, because another repository may have the packages.
    _run([*root, *APT_GET.split(), "update"])
    return _run([*root, *APT_GET.split(), "install", "-y", "--no-install-recommends", *names])


def main(arguments: Sequence[str] | None = None) -> int:
    """Check this computer, install what is missing if requested, and return the exit status."""
    parser = argparse.ArgumentParser(description="Check the system packages that RoTeMiNa needs.")
    parser.add_argument("--install", action="store_true", help="install what is missing")
    parser.add_argument(
        "--screen", action="store_true", help="also check the programs for tests of the window"
    )
    parser.add_argument(
        "--assembler", action="store_true", help="also check the assembler for the boards' chip"
    )
    parser.add_argument("platform", nargs="?", default=find_platform(os.environ))
    options = parser.parse_args(arguments)

    if sys.version_info < OLDEST_PYTHON:
        return _fail(_describe_old_python())
    needed = find_missing_python_parts() + find_missing_libraries(options.platform)
    packages = list(dict.fromkeys(needed + find_missing_libraries("xcb")))
    programs = (
        *(SCREEN_PACKAGES if options.screen else ()),
        *(ASSEMBLER_PACKAGES if options.assembler else ()),
    )
    missing_programs = find_missing_programs(programs)
    missing = packages + missing_programs
    if options.install and missing and install(missing):
        needed = find_missing_python_parts() + find_missing_libraries(options.platform)
        packages = list(dict.fromkeys(needed + find_missing_libraries("xcb")))
    # Libraries for a display are not required on a computer without one.
    return _fail(describe_missing(packages)) if needed else 0


def _can_load(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _has_font() -> bool:
    """Ask fontconfig, as Qt does; the first field of its ``FcFontSet`` is the number of fonts."""
    try:
        fontconfig = ctypes.CDLL("libfontconfig.so.1")
    except OSError:
        # A missing fontconfig is reported separately, and on Debian its package installs a font.
        return True
    fontconfig.FcInitLoadConfigAndFonts.restype = ctypes.c_void_p
    fontconfig.FcConfigGetFonts.argtypes = (ctypes.c_void_p, ctypes.c_int)
    fontconfig.FcConfigGetFonts.restype = ctypes.POINTER(ctypes.c_int)
    system_fonts = fontconfig.FcConfigGetFonts(fontconfig.FcInitLoadConfigAndFonts(), 0)
    return bool(system_fonts) and system_fonts[0] > 0


def _name_venv_package() -> str:
    if Path(sys.executable).resolve() == Path("/usr/bin/python3").resolve():
        return "python3-venv"
    return "python{}.{}-venv".format(*sys.version_info)


def _make_root_prefix() -> list[str] | None:
    """Return the command prefix that runs a command as root; None if that needs a password."""
    noninteractive = ["env", "DEBIAN_FRONTEND=noninteractive"]
    if os.geteuid() == 0:
        return noninteractive
    if shutil.which("sudo") and _run(["sudo", "-n", "true"], stderr=subprocess.DEVNULL):
        return ["sudo", "-n", *noninteractive]
    return None


def _run(command: Sequence[str], stderr: int | None = None) -> bool:
    null = subprocess.DEVNULL
    process = subprocess.run(command, check=False, stdin=null, stdout=null, stderr=stderr)
    return process.returncode == 0


def _describe_old_python() -> str:
    version = "{}.{}".format(*sys.version_info)
    oldest = "{}.{}".format(*OLDEST_PYTHON)
    return (
        "RoTeMiNa needs Python >= " + oldest + "; " + sys.executable + " is " + version + "."
        " Name a newer one: make PYTHON=/path/to/python3"
    )


def _fail(line: str) -> int:
    print(line, file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
