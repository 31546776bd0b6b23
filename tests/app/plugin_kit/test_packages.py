"""New packages, and the example, are installed and pass their own tests, offline."""

import os
import shutil
import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from rotemina.app.plugin_kit.plugin_kinds import Kind
from rotemina.app.plugin_kit.writing import new_plugin

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "docs" / "examples" / "rotemina-distance"

pytestmark = pytest.mark.slow


@pytest.fixture
def run(tmp_path):
    """Run a module of Python's where packages can be installed into a folder of their own."""
    site = tmp_path / "site"
    environment = {
        **os.environ,
        "PYTHONPATH": str(site),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
        "QT_QPA_PLATFORM": "offscreen",
    }

    def run(*arguments, cwd=tmp_path):
        command = [sys.executable, "-m", *map(str, arguments)]
        done = subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
        return done.stdout

    def install(package):
        source = shutil.copytree(package, tmp_path / "build" / package.name)
        offline = "--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check"
        run("pip", "install", *offline, "--target", site, source)

    run.install = install
    return run


@pytest.mark.parametrize("kind", Kind)
def test_a_new_package_works_at_once(run, tmp_path, kind):
    package = new_plugin(kind, "glass_stage", tmp_path)
    run.install(package)
    assert " passed" in run("pytest", "-q", "-p", "no:cacheprovider", cwd=package)
    (line,) = [
        line
        for line in run("rotemina.app.cli.main", "plugin", "list", kind).splitlines()
        if "glass_stage" in line
    ]
    version = str(kind.api_version)
    shown = [kind, "glass_stage", "rotemina-glass-stage", "0.1.0", version, "of", version, "loaded"]
    assert line.split() == shown
    assert "ok      loading" in run("rotemina.app.cli.main", "plugin", "check", "glass_stage")


def test_new_packages_are_typed_strictly(run, tmp_path):
    pytest.importorskip("mypy")
    layers = tmp_path / "types" / "rotemina"
    layers.mkdir(parents=True)
    for layer in ("app", "drivers", "plugins", "resources", "sim"):
        (layers / layer).symlink_to(ROOT / layer)
    sources = []
    for kind in Kind:
        package = new_plugin(kind, f"glass_{kind}", tmp_path)
        sources.append(package / "src" / f"rotemina_glass_{kind}" / f"{kind}.py")
    settings = tmp_path / "mypy.ini"
    settings.write_text(
        "[mypy]\nstrict = True\nnamespace_packages = True\nexplicit_package_bases = True\n"
        f"mypy_path = {':'.join(str(one.parents[1]) for one in sources)}:{layers.parent}\n"
        "plugins = pydantic.mypy\n"
        "[mypy-rotemina.*]\nfollow_imports = silent\n"
    )
    run("mypy", "--config-file", settings, "--cache-dir", tmp_path / "mypy", *sources)


def test_the_example_is_installed_and_works(run):
    run.install(EXAMPLE)
    assert " passed" in run("pytest", "-q", "-p", "no:cacheprovider", EXAMPLE / "tests")
    assert "FAILED" not in run("rotemina.app.cli.main", "plugin", "check", "distance")
    assert not list(entry_points(group=Kind.PANEL.group, name="distance"))  # not here, only there
