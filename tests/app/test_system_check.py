"""The system check names what is missing, in one line, and installs only where it may."""

import ast
import os
import shutil
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from rotemina.app import system_check
from rotemina.app.system_check import FONT, LIBRARIES, Package

EGL = Package("libegl1", "libEGL.so.1")
CURSOR = Package("libxcb-cursor0", "libxcb-cursor.so.0")

linux_only = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="only Linux keeps Qt's libraries outside the wheel"
)


@pytest.fixture
def absent(monkeypatch):
    """Libraries that cannot be loaded; every other one can."""
    names = set()

    def load(name):
        if name in names:
            raise OSError(name)

    monkeypatch.setattr(system_check.sys, "platform", "linux")
    monkeypatch.setattr(system_check.ctypes, "CDLL", load)
    monkeypatch.setattr(system_check, "_has_font", lambda: True)
    return names


@pytest.fixture
def machine(tmp_path, monkeypatch):
    """Debian in a folder: ``apt-get`` writes down how it was called; the user is not root."""
    for tool in ("env", "sh"):
        (tmp_path / tool).symlink_to(shutil.which(tool))
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("DEBIAN_FRONTEND", raising=False)
    monkeypatch.setattr(system_check.os, "geteuid", lambda: 1000)
    add_tool(tmp_path, "apt-get", f'echo "$DEBIAN_FRONTEND $*" >> "{tmp_path}/called"')
    return tmp_path


def add_tool(folder: Path, name: str, script: str) -> None:
    tool = folder / name
    tool.write_text(f"#!{folder}/sh\n{script}\n")
    tool.chmod(0o755)


def calls(folder: Path) -> list[str]:
    written = folder / "called"
    return written.read_text().splitlines() if written.exists() else []


def become_root(monkeypatch):
    monkeypatch.setattr(system_check.os, "geteuid", lambda: 0)


@pytest.mark.parametrize(
    ("environment", "platform"),
    [
        ({}, "offscreen"),
        ({"DISPLAY": ":0"}, "xcb"),
        ({"DISPLAY": ":0", "WAYLAND_DISPLAY": "wayland-0"}, "wayland"),
        ({"DISPLAY": ":0", "QT_QPA_PLATFORM": "offscreen"}, "offscreen"),
        ({"QT_QPA_PLATFORM": "wayland;xcb"}, "wayland"),
        ({"QT_QPA_PLATFORM": "vnc:size=800x600"}, "vnc"),
    ],
)
def test_platform_is_what_was_asked_for_else_the_display(environment, platform):
    assert system_check.platform_in_use(environment) == platform


def test_nothing_is_missing_when_every_library_loads(absent):
    assert system_check.missing_libraries("xcb") == []
    assert system_check.complaint([]) == ""


def test_only_the_libraries_of_the_platform_are_missed(absent):
    absent.update({EGL.provides, CURSOR.provides})
    assert system_check.missing_libraries("offscreen") == [EGL]
    assert system_check.missing_libraries("vnc") == [EGL]
    assert system_check.missing_libraries("xcb") == [EGL, CURSOR]


def test_a_font_is_missed(absent, monkeypatch):
    monkeypatch.setattr(system_check, "_has_font", lambda: False)
    assert system_check.missing_libraries("offscreen") == [FONT]


def test_other_systems_bring_qt_complete(absent, monkeypatch):
    absent.add(EGL.provides)
    monkeypatch.setattr(system_check.sys, "platform", "win32")
    assert system_check.missing_libraries("windows") == []
    assert system_check.missing_python_parts() == []


@linux_only
def test_fontconfig_counts_the_fonts(tmp_path, monkeypatch):
    settings = tmp_path / "fonts.conf"
    settings.write_text(
        f"<fontconfig><dir>{tmp_path}</dir><cachedir>{tmp_path}</cachedir></fontconfig>"
    )
    command = [
        sys.executable,
        "-c",
        "from rotemina.app.system_check import _has_font; print(_has_font())",
    ]
    without_fonts = {**os.environ, "FONTCONFIG_FILE": str(settings)}
    assert subprocess.check_output(command, text=True).strip() == "True"
    assert subprocess.check_output(command, text=True, env=without_fonts).strip() == "False"


@linux_only
@pytest.mark.parametrize("modules", [{"venv"}, {"ensurepip"}])
def test_a_python_without_environments_is_missed(modules, monkeypatch):
    monkeypatch.setattr(system_check, "find_spec", lambda name: None if name in modules else name)
    (package,) = system_check.missing_python_parts()
    assert package.name.startswith("python3")
    assert package.name.endswith("-venv")


@linux_only
def test_the_command_fits_who_types_it(machine, monkeypatch):
    install = "apt-get install -y --no-install-recommends libegl1 libxcb-cursor0"
    command = system_check.install_command([EGL, CURSOR])
    assert command == f"su -c 'apt-get update && {install}'"
    add_tool(machine, "sudo", "exit 1")
    command = system_check.install_command([EGL, CURSOR])
    assert command == f"sudo apt-get update && sudo {install}"
    become_root(monkeypatch)
    assert system_check.install_command([EGL, CURSOR]) == f"apt-get update && {install}"


@linux_only
def test_the_complaint_is_one_line(machine):
    line = system_check.complaint([EGL, CURSOR])
    assert line.startswith("Missing: libEGL.so.1, libxcb-cursor.so.0. Install with: su -c")
    assert "\n" not in line
    (machine / "apt-get").unlink()
    assert system_check.complaint([EGL]) == (
        "Missing: libEGL.so.1. Install what provides them with your package manager."
    )


@linux_only
def test_root_installs_without_a_question(machine, monkeypatch):
    become_root(monkeypatch)
    assert system_check.install([EGL, CURSOR])
    update, install = calls(machine)
    assert update.startswith("noninteractive ")
    assert update.endswith(" update")
    assert install.startswith("noninteractive ")
    assert install.endswith("install -y --no-install-recommends libegl1 libxcb-cursor0")


@linux_only
def test_sudo_installs_when_it_asks_no_password(machine):
    add_tool(machine, "sudo", '[ "$1" = -n ] && shift && { [ "$1" = true ] || exec "$@"; }')
    assert system_check.install([EGL])
    assert calls(machine)[-1].endswith("install -y --no-install-recommends libegl1")


@linux_only
@pytest.mark.parametrize("sudo", [None, "exit 1"])
def test_nothing_is_tried_where_a_password_is_needed(machine, sudo):
    if sudo:
        add_tool(machine, "sudo", sudo)
    assert not system_check.install([EGL])
    assert calls(machine) == []


@linux_only
def test_an_installation_that_fails_is_told(machine, absent, monkeypatch, capfd):
    become_root(monkeypatch)
    add_tool(machine, "apt-get", "exit 100")
    absent.add(EGL.provides)
    assert system_check.main(["--install", "offscreen"]) == 1
    errors = capfd.readouterr().err
    assert errors.count("\n") == 1
    assert "apt-get install -y --no-install-recommends libegl1" in errors


@linux_only
def test_what_was_installed_is_looked_for_again(absent, monkeypatch, capfd):
    absent.update({EGL.provides, CURSOR.provides})
    monkeypatch.setattr(system_check, "install", lambda packages: absent.clear() or True)
    assert system_check.main(["--install", "xcb"]) == 0
    assert capfd.readouterr().err == ""


@linux_only
def test_the_display_s_libraries_hold_up_only_who_has_a_display(machine, absent, capfd):
    absent.add(CURSOR.provides)
    assert system_check.main(["--install", "offscreen"]) == 0
    assert capfd.readouterr().err == ""
    assert system_check.main(["--install", "xcb"]) == 1
    assert "libxcb-cursor0" in capfd.readouterr().err


def test_an_old_python_is_named(monkeypatch, capfd):
    monkeypatch.setattr(system_check.sys, "version_info", (3, 9))
    assert system_check.main(["offscreen"]) == 1
    assert "needs Python >= 3.11" in capfd.readouterr().err


def test_an_old_python_can_read_the_script():
    tree = ast.parse(Path(system_check.__file__).read_text("utf-8"), feature_version=(3, 8))
    imported = {
        name
        for node in ast.walk(tree)
        for name in (
            [alias.name for alias in node.names]
            if isinstance(node, ast.Import)
            else [node.module]
            if isinstance(node, ast.ImportFrom)
            else []
        )
    }
    assert {name.split(".")[0] for name in imported} <= set(sys.stdlib_module_names) | {
        "__future__"
    }


@linux_only
@pytest.mark.parametrize(
    ("platform", "files"),
    [
        ("offscreen", ["PySide6/Qt*.abi3.so", "PySide6/Qt/plugins/platforms/libqoffscreen.so"]),
        (
            "xcb",
            [
                "PySide6/Qt/plugins/platforms/libqxcb.so",
                "PySide6/Qt/plugins/xcbglintegrations/*.so",
            ],
        ),
        (
            "wayland",
            [
                "PySide6/Qt/plugins/platforms/libqwayland*.so",
                "PySide6/Qt/plugins/wayland-graphics-integration-client/*.so",
                "PySide6/Qt/plugins/wayland-shell-integration/*.so",
            ],
        ),
    ],
)
def test_the_table_knows_every_library_that_this_qt_asks_for(platform, files):
    import PySide6

    site = Path(PySide6.__file__).parents[1]
    roots = [path for pattern in files for path in site.glob(pattern) if used(path)]
    assert roots
    known = {package.provides for name in ("offscreen", platform) for package in LIBRARIES[name]}
    assert outside(roots, site) - known - OF_PYTHON_OR_APT == set()


# What no Debian with Python and apt can lack; glib's two libraries come in one package.
OF_PYTHON_OR_APT = {
    *("ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1", "libc.so.6", "libdl.so.2", "libm.so.6"),
    *("libgcc_s.so.1", "libpthread.so.0", "librt.so.1", "libstdc++.so.6", "libz.so.1"),
    *("libzstd.so.1", "libglib-2.0.so.0"),
}
MODULES_IN_USE = {"Core", "Gui", "OpenGL", "OpenGLWidgets", "Svg", "SvgWidgets", "Test", "Widgets"}


def used(path: Path) -> bool:
    module = path.name.removeprefix("Qt").removesuffix(".abi3.so")
    return module in MODULES_IN_USE or path.parts[-3] == "plugins"


def outside(roots: list[Path], site: Path) -> set[str]:
    """Libraries outside the wheels that the roots and what they load from the wheels ask for."""
    inside = {path.name: path for path in site.glob("*/**/*.so*")}
    found, open_files, seen = set(), list(roots), set()
    while open_files:
        path = open_files.pop()
        if path in seen:
            continue
        seen.add(path)
        for name in needed(path):
            if name in inside:
                open_files.append(inside[name])
            else:
                found.add(name)
    return found


def needed(path: Path) -> list[str]:
    """``DT_NEEDED`` entries of a 64-bit little-endian ELF file (System V ABI, chapter 5)."""
    content = path.read_bytes()
    assert content[:6] == b"\x7fELF\x02\x01"
    (table,) = struct.unpack_from("<Q", content, 32)
    size, count = struct.unpack_from("<HH", content, 54)
    headers = [struct.unpack_from("<IIQQQQ", content, table + i * size) for i in range(count)]

    def offset_of(address: int) -> int:
        return next(
            address - start + offset
            for kind, _, offset, start, _, length in headers
            if kind == 1 and start <= address < start + length
        )

    _, _, start, _, _, length = next(header for header in headers if header[0] == 2)
    dynamic = list(struct.iter_unpack("<qQ", content[start : start + length]))
    strings = offset_of(next(value for tag, value in dynamic if tag == 5))
    names = (strings + value for tag, value in dynamic if tag == 1)
    return [content[name : content.index(b"\0", name)].decode() for name in names]


def test_programs_of_tests_are_asked_for_and_nobody_is_held_up_without(monkeypatch):
    asked = []
    monkeypatch.setattr(system_check.shutil, "which", lambda _: None)
    monkeypatch.setattr(system_check, "missing_libraries", lambda _: [])
    monkeypatch.setattr(system_check, "missing_python_parts", list)
    monkeypatch.setattr(system_check, "install", lambda packages: asked.append(packages))
    assert system_check.main(["--install", "--screen", "offscreen"]) == 0
    assert [package.name for package in asked[0]] == ["xvfb", "xdotool"]
    assert system_check.main(["--install", "--assembler", "offscreen"]) == 0
    assert [package.name for package in asked[1]] == ["binutils-m68hc1x"]
    assert system_check.main(["--install", "offscreen"]) == 0
    assert len(asked) == 2
