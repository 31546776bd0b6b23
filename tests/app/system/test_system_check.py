"""The system check names missing packages in one line and installs only where permitted."""

import ast
import os
import shutil
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from rotemina.app.system import system_check
from rotemina.app.system.system_check import FONT_PACKAGE, LIBRARY_PACKAGES, DebianPackage

EGL = DebianPackage("libegl1", "libEGL.so.1")
CURSOR = DebianPackage("libxcb-cursor0", "libxcb-cursor.so.0")

linux_only = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="only Linux keeps Qt's libraries outside the wheel"
)


@pytest.fixture
def missing_libraries(monkeypatch):
    """Names of libraries that cannot be loaded; all others can."""
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
    """A Debian system in a folder: ``apt-get`` logs its calls, and the user is not root."""
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


def read_calls(folder: Path) -> list[str]:
    call_log = folder / "called"
    return call_log.read_text().splitlines() if call_log.exists() else []


def become_root(monkeypatch):
    monkeypatch.setattr(system_check.os, "geteuid", lambda: 0)


@pytest.mark.parametrize(
    ("environment", "platform"),
    [
        ({}, "offscreen"),
        ({"DISPLAY": ":0"}, "xcb"),
        ({"DISPLAY": ":0", "WAYLAND_DISPLAY": "wayland-0"}, "wayland"),
        ({"DISPLAY": ":0", "QT_QPA_PLATFORM": "vnc:size=800x600"}, "vnc"),
        ({"QT_QPA_PLATFORM": "wayland;xcb"}, "wayland"),
    ],
)
def test_the_platform_is_the_requested_one_or_that_of_the_display(environment, platform):
    assert system_check.find_platform(environment) == platform


def test_only_libraries_of_the_platform_and_fonts_are_reported_missing(
    missing_libraries, monkeypatch
):
    assert system_check.find_missing_libraries("xcb") == []
    assert system_check.describe_missing([]) == ""
    missing_libraries.update({EGL.provides, CURSOR.provides})
    assert system_check.find_missing_libraries("offscreen") == [EGL]
    assert system_check.find_missing_libraries("vnc") == [EGL]
    assert system_check.find_missing_libraries("xcb") == [EGL, CURSOR]
    monkeypatch.setattr(system_check, "_has_font", lambda: False)
    assert system_check.find_missing_libraries("offscreen") == [EGL, FONT_PACKAGE]


def test_other_systems_need_no_packages(missing_libraries, monkeypatch):
    missing_libraries.add(EGL.provides)
    monkeypatch.setattr(system_check.sys, "platform", "win32")
    assert system_check.find_missing_libraries("windows") == []
    assert system_check.find_missing_python_parts() == []


@linux_only
def test_fontconfig_counts_the_fonts(tmp_path, monkeypatch):
    settings = tmp_path / "fonts.conf"
    settings.write_text(
        f"<fontconfig><dir>{tmp_path}</dir><cachedir>{tmp_path}</cachedir></fontconfig>"
    )
    command = [
        sys.executable,
        "-c",
        "from rotemina.app.system.system_check import _has_font; print(_has_font())",
    ]
    without_fonts = {**os.environ, "FONTCONFIG_FILE": str(settings)}
    assert subprocess.check_output(command, text=True).strip() == "True"
    assert subprocess.check_output(command, text=True, env=without_fonts).strip() == "False"


@linux_only
@pytest.mark.parametrize("modules", [{"venv"}, {"ensurepip"}])
def test_a_python_without_venv_is_reported(modules, monkeypatch):
    monkeypatch.setattr(system_check, "find_spec", lambda name: None if name in modules else name)
    (package,) = system_check.find_missing_python_parts()
    assert package.name.startswith("python3")
    assert package.name.endswith("-venv")


@linux_only
def test_the_install_command_fits_the_user(machine, monkeypatch):
    install = "apt-get install -y --no-install-recommends libegl1 libxcb-cursor0"
    command = system_check.make_install_command([EGL, CURSOR])
    assert command == f"su -c 'apt-get update && {install}'"
    add_tool(machine, "sudo", "exit 1")
    command = system_check.make_install_command([EGL, CURSOR])
    assert command == f"sudo apt-get update && sudo {install}"
    become_root(monkeypatch)
    assert system_check.make_install_command([EGL, CURSOR]) == f"apt-get update && {install}"


@linux_only
def test_missing_libraries_are_described_in_one_line(machine):
    line = system_check.describe_missing([EGL, CURSOR])
    assert line.startswith("Missing: libEGL.so.1, libxcb-cursor.so.0. Install with: su -c")
    assert "\n" not in line
    (machine / "apt-get").unlink()
    assert system_check.describe_missing([EGL]) == (
        "Missing: libEGL.so.1. Install packages that provide them with your package manager."
    )


@linux_only
@pytest.mark.parametrize("is_root", [True, False])
def test_root_and_sudo_without_a_password_install_without_a_question(machine, monkeypatch, is_root):
    if is_root:
        become_root(monkeypatch)
    else:
        add_tool(machine, "sudo", '[ "$1" = -n ] && shift && { [ "$1" = true ] || exec "$@"; }')
    assert system_check.install([EGL, CURSOR])
    update, install = read_calls(machine)
    assert update.endswith(" update")
    assert install.endswith("install -y --no-install-recommends libegl1 libxcb-cursor0")
    assert update.startswith("noninteractive ")
    assert install.startswith("noninteractive ")


@linux_only
@pytest.mark.parametrize("sudo", [None, "exit 1"])
def test_nothing_is_installed_if_a_password_is_needed(machine, sudo):
    if sudo:
        add_tool(machine, "sudo", sudo)
    assert not system_check.install([EGL])
    assert read_calls(machine) == []


@linux_only
def test_a_failed_installation_is_reported(machine, missing_libraries, monkeypatch, capfd):
    become_root(monkeypatch)
    add_tool(machine, "apt-get", "exit 100")
    missing_libraries.add(EGL.provides)
    assert system_check.main(["--install", "offscreen"]) == 1
    errors = capfd.readouterr().err
    assert errors.count("\n") == 1
    assert "apt-get install -y --no-install-recommends libegl1" in errors


@linux_only
def test_libraries_are_checked_again_after_the_installation(missing_libraries, monkeypatch, capfd):
    missing_libraries.update({EGL.provides, CURSOR.provides})
    monkeypatch.setattr(system_check, "install", lambda packages: missing_libraries.clear() or True)
    assert system_check.main(["--install", "xcb"]) == 0
    assert capfd.readouterr().err == ""


@linux_only
def test_display_libraries_are_required_only_with_a_display(machine, missing_libraries, capfd):
    missing_libraries.add(CURSOR.provides)
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
def test_the_table_has_every_library_that_this_qt_needs(platform, files):
    import PySide6

    site = Path(PySide6.__file__).parents[1]
    roots = [path for pattern in files for path in site.glob(pattern) if is_used(path)]
    assert roots
    known = {
        package.provides for name in ("offscreen", platform) for package in LIBRARY_PACKAGES[name]
    }
    assert find_external_libraries(roots, site) - known - ALWAYS_PRESENT == set()


# Present in every Debian with Python and apt; one package provides both glib libraries.
ALWAYS_PRESENT = {
    *("ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1", "libc.so.6", "libdl.so.2", "libm.so.6"),
    *("libgcc_s.so.1", "libpthread.so.0", "librt.so.1", "libstdc++.so.6", "libz.so.1"),
    *("libzstd.so.1", "libglib-2.0.so.0"),
}
MODULES_IN_USE = {"Core", "Gui", "OpenGL", "OpenGLWidgets", "Svg", "SvgWidgets", "Test", "Widgets"}


def is_used(path: Path) -> bool:
    module = path.name.removeprefix("Qt").removesuffix(".abi3.so")
    return module in MODULES_IN_USE or path.parts[-3] == "plugins"


def find_external_libraries(roots: list[Path], site: Path) -> set[str]:
    """Return libraries outside the wheels that the roots need, directly or via the wheels."""
    bundled = {path.name: path for path in site.glob("*/**/*.so*")}
    external, open_files, visited = set(), list(roots), set()
    while open_files:
        path = open_files.pop()
        if path in visited:
            continue
        visited.add(path)
        for name in read_needed_libraries(path):
            if name in bundled:
                open_files.append(bundled[name])
            else:
                external.add(name)
    return external


def read_needed_libraries(path: Path) -> list[str]:
    """Return the ``DT_NEEDED`` entries of a 64-bit little-endian ELF file (System V ABI, ch. 5)."""
    content = path.read_bytes()
    assert content[:6] == b"\x7fELF\x02\x01"
    (table,) = struct.unpack_from("<Q", content, 32)
    size, count = struct.unpack_from("<HH", content, 54)
    headers = [struct.unpack_from("<IIQQQQ", content, table + i * size) for i in range(count)]

    def find_offset(address: int) -> int:
        return next(
            address - start + offset
            for segment_type, _, offset, start, _, length in headers
            if segment_type == 1 and start <= address < start + length
        )

    _, _, start, _, _, length = next(header for header in headers if header[0] == 2)
    dynamic = list(struct.iter_unpack("<qQ", content[start : start + length]))
    strings = find_offset(next(value for tag, value in dynamic if tag == 5))
    names = (strings + value for tag, value in dynamic if tag == 1)
    return [content[name : content.index(b"\0", name)].decode() for name in names]


def test_test_programs_are_installed_but_not_required(monkeypatch):
    installed = []
    monkeypatch.setattr(system_check.shutil, "which", lambda _: None)
    monkeypatch.setattr(system_check, "find_missing_libraries", lambda _: [])
    monkeypatch.setattr(system_check, "find_missing_python_parts", list)
    monkeypatch.setattr(system_check, "install", lambda packages: installed.append(packages))
    assert system_check.main(["--install", "--screen", "offscreen"]) == 0
    assert [package.name for package in installed[0]] == ["xvfb", "xdotool"]
    assert system_check.main(["--install", "--assembler", "offscreen"]) == 0
    assert [package.name for package in installed[1]] == ["binutils-m68hc1x"]
    assert system_check.main(["--install", "offscreen"]) == 0
    assert len(installed) == 2
