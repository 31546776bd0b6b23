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

PROGRAM = "rotemina.app.cli.main"

# On one worker, so that the new packages are installed only once.
pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("plugin packages")]


class PackageSite:
    """A separate folder for installed packages."""

    def __init__(self, folder):
        self._folder, self._site = folder, folder / "site"
        self._environment = {
            **os.environ,
            "PYTHONPATH": str(self._site),
            "XDG_CACHE_HOME": str(folder / "cache"),
            "QT_QPA_PLATFORM": "offscreen",
        }

    def run(self, *arguments, cwd=None):
        """Run a Python module with the installed packages, and return what it prints."""
        process = subprocess.run(
            [sys.executable, "-m", *map(str, arguments)],
            cwd=cwd or self._folder,
            env=self._environment,
            capture_output=True,
            text=True,
        )
        assert process.returncode == 0, f"{process.stdout}\n{process.stderr}"
        return process.stdout

    def run_tests(self, folder, *options):
        """Run the tests of a package in its folder, and return what is printed."""
        output = self.run("pytest", "-q", "-p", "no:cacheprovider", *options, cwd=folder)
        assert " passed" in output
        return output

    def install(self, *packages):
        """Install packages without a network."""
        sources = [shutil.copytree(path, self._folder / "build" / path.name) for path in packages]
        offline = "--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check"
        self.run("pip", "install", *offline, "--target", self._site, *sources)


@pytest.fixture(scope="module")
def new_site(tmp_path_factory):
    return PackageSite(tmp_path_factory.mktemp("new"))


@pytest.fixture(scope="module")
def new_packages(new_site, tmp_path_factory):
    """A new package of each kind, all installed."""
    folder = tmp_path_factory.mktemp("packages")
    packages = {kind: write_plugin(kind, f"glass_{kind}", folder) for kind in PluginKind}
    new_site.install(*packages.values())
    return packages


@pytest.mark.parametrize("kind", PluginKind)
def test_new_package_works_without_changes(kind, new_site, new_packages):
    new_site.run_tests(new_packages[kind])
    assert "ok      loading" in new_site.run(PROGRAM, "plugin", "check", f"glass_{kind}")


@pytest.mark.usefixtures("new_packages")
def test_new_packages_are_listed(new_site):
    lines = new_site.run(PROGRAM, "plugin", "list").splitlines()
    for kind in PluginKind:
        (line,) = [line for line in lines if f"glass_{kind}" in line]
        version = str(kind.api_version)
        names = [kind, f"glass_{kind}", f"rotemina-glass-{kind}"]
        assert line.split() == [*names, "0.1.0", version, "of", version, "loaded"]


def test_new_packages_pass_strict_type_checks(new_site, new_packages, tmp_path):
    pytest.importorskip("mypy")
    layers = tmp_path / "types" / "rotemina"
    layers.mkdir(parents=True)
    for layer in ("app", "drivers", "plugins", "resources", "sim"):
        (layers / layer).symlink_to(ROOT / layer)
    sources = [
        package / "src" / f"rotemina_glass_{kind}" / f"{kind}.py"
        for kind, package in new_packages.items()
    ]
    settings = tmp_path / "mypy.ini"
    settings.write_text(
        "[mypy]\nstrict = True\nnamespace_packages = True\nexplicit_package_bases = True\n"
        f"mypy_path = {':'.join(str(source.parents[1]) for source in sources)}:{layers.parent}\n"
        "plugins = pydantic.mypy\n"
        "[mypy-rotemina.*]\nfollow_imports = silent\n"
    )
    new_site.run("mypy", "--config-file", settings, "--cache-dir", tmp_path / "mypy", *sources)


def test_example_can_be_installed_and_works(tmp_path):
    site = PackageSite(tmp_path)
    site.install(EXAMPLE)
    site.run_tests(EXAMPLE)
    assert "FAILED" not in site.run(PROGRAM, "plugin", "check", "distance")
    # It is installed only in the separate folder, not in this environment.
    assert not list(entry_points(group=PluginKind.PANEL.group, name="distance"))


def test_plugin_of_the_last_release_works_and_is_warned_of_new_names(tmp_path):
    site = PackageSite(tmp_path)
    site.install(LAST_RELEASE)
    output = site.run_tests(LAST_RELEASE, "-W", "default::DeprecationWarning")
    assert "rotemina.app.panel.panel.Area is now rotemina.app.panel.panel.PanelArea" in output
    checks = site.run(PROGRAM, "plugin", "check", "distance")
    assert "FAILED" not in checks
    assert "rotemina.app.panel.panel.STALE_S is now rotemina.app.panel.panel.STALE_AGE_S" in checks
    assert "adapt the plugin and set api_version to 2" in checks
