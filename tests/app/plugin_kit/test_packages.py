"""New packages and the example can be installed offline and pass their own tests."""

import os
import shutil
import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from rotemina.app.plugin_kit import PluginKind, write_plugin

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "docs" / "examples" / "rotemina-distance"
# The example, written for the interface of the last release.
LAST_RELEASE = Path(__file__).with_name("last_release") / "rotemina-distance"

pytestmark = pytest.mark.slow


@pytest.fixture
def run(tmp_path):
    """Function that runs a Python module with a separate folder for installed packages."""
    site = tmp_path / "site"
    environment = {
        **os.environ,
        "PYTHONPATH": str(site),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
        "QT_QPA_PLATFORM": "offscreen",
    }

    def run(*arguments, cwd=tmp_path):
        command = [sys.executable, "-m", *map(str, arguments)]
        process = subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True)
        assert process.returncode == 0, f"{process.stdout}\n{process.stderr}"
        return process.stdout

    def install(package):
        source = shutil.copytree(package, tmp_path / "build" / package.name)
        offline = "--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check"
        run("pip", "install", *offline, "--target", site, source)

    run.install = install
    return run


@pytest.mark.parametrize("kind", PluginKind)
def test_new_package_works_without_changes(run, tmp_path, kind):
    package = write_plugin(kind, "glass_stage", tmp_path)
    run.install(package)
    assert " passed" in run("pytest", "-q", "-p", "no:cacheprovider", cwd=package)
    (line,) = [
        line
        for line in run("rotemina.app.cli.main", "plugin", "list", kind).splitlines()
        if "glass_stage" in line
    ]
    version = str(kind.api_version)
    expected = [
        kind,
        "glass_stage",
        "rotemina-glass-stage",
        "0.1.0",
        version,
        "of",
        version,
        "loaded",
    ]
    assert line.split() == expected
    assert "ok      loading" in run("rotemina.app.cli.main", "plugin", "check", "glass_stage")


def test_new_packages_pass_strict_type_checks(run, tmp_path):
    pytest.importorskip("mypy")
    layers = tmp_path / "types" / "rotemina"
    layers.mkdir(parents=True)
    for layer in ("app", "drivers", "plugins", "resources", "sim"):
        (layers / layer).symlink_to(ROOT / layer)
    sources = []
    for kind in PluginKind:
        package = write_plugin(kind, f"glass_{kind}", tmp_path)
        sources.append(package / "src" / f"rotemina_glass_{kind}" / f"{kind}.py")
    settings = tmp_path / "mypy.ini"
    settings.write_text(
        "[mypy]\nstrict = True\nnamespace_packages = True\nexplicit_package_bases = True\n"
        f"mypy_path = {':'.join(str(source.parents[1]) for source in sources)}:{layers.parent}\n"
        "plugins = pydantic.mypy\n"
        "[mypy-rotemina.*]\nfollow_imports = silent\n"
    )
    run("mypy", "--config-file", settings, "--cache-dir", tmp_path / "mypy", *sources)


def test_example_can_be_installed_and_works(run):
    run.install(EXAMPLE)
    assert " passed" in run("pytest", "-q", "-p", "no:cacheprovider", EXAMPLE / "tests")
    assert "FAILED" not in run("rotemina.app.cli.main", "plugin", "check", "distance")
    # It is installed only in the separate folder, not in this environment.
    assert not list(entry_points(group=PluginKind.PANEL.group, name="distance"))


def test_plugin_of_the_last_release_works_and_is_warned_of_new_names(run):
    run.install(LAST_RELEASE)
    allow_warnings = "-W", "default::DeprecationWarning"
    output = run("pytest", "-q", *allow_warnings, "-p", "no:cacheprovider", LAST_RELEASE / "tests")
    assert " passed" in output
    assert "rotemina.app.panel.panel.Area is now rotemina.app.panel.panel.PanelArea" in output
    checks = run("rotemina.app.cli.main", "plugin", "check", "distance")
    assert "FAILED" not in checks
    assert "rotemina.app.panel.panel.STALE_S is now rotemina.app.panel.panel.STALE_AGE_S" in checks
    assert "adapt the plugin and set api_version to 2" in checks
