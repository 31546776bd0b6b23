"""An editable install hides what a wheel lacks: the packaging tables are held to the folders."""

import re
import shutil
import subprocess
import sys
import tomllib
import venv
from contextlib import suppress
from fnmatch import fnmatch
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from rotemina.sim.effects.formulation import Effect

ROOT = Path(__file__).parents[1]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
PROJECT = PYPROJECT["project"]
SETUPTOOLS = PYPROJECT["tool"]["setuptools"]
HELP = "rotemina.docs"
ENTRY_POINTS = {
    "console_scripts": PROJECT["scripts"],
    **PROJECT["entry-points"],
}


def shipped_files() -> list[tuple[str, Path]]:
    """Package name and path of every file in the layers' folders."""
    files = []
    for layer, folder in SETUPTOOLS["package-dir"].items():
        if layer == HELP:
            continue  # what the program carries of it is chosen
        for path in sorted((ROOT / folder).rglob("*")):
            inside = path.relative_to(ROOT / folder)
            if path.is_dir() or any(part.startswith((".", "__py")) for part in inside.parts):
                continue
            if path.suffix == ".ts":
                continue  # what languages are made from stays in the source
            files.append((".".join([layer, *inside.parent.parts]), path))
    return files


def test_packages_are_the_folders_that_hold_files():
    folders = {package for package, _ in shipped_files()}
    assert sorted(SETUPTOOLS["packages"]) == sorted({*folders, HELP})


def test_packages_import_by_their_own_init():
    folders = {path.parent for _, path in shipped_files()}
    assert [folder for folder in folders if not (folder / "__init__.py").is_file()] == []


def test_package_data_covers_every_file():
    patterns = SETUPTOOLS["package-data"]
    left_out = [
        str(path.relative_to(ROOT))
        for package, path in shipped_files()
        if path.suffix != ".py"
        and not any(
            fnmatch(path.name, pattern)
            for pattern in patterns.get("*", []) + patterns.get(package, [])
        )
    ]
    assert left_out == []


@pytest.mark.parametrize(
    ("group", "name", "value"),
    [(group, *item) for group, items in ENTRY_POINTS.items() for item in items.items()],
)
def test_entry_points_resolve(group, name, value):
    loaded = metadata.EntryPoint(name, value, group).load()
    if group == "rotemina.effects":
        assert isinstance(loaded, Effect)
        assert loaded.id == name
    else:
        assert callable(loaded)


def test_the_version_is_written_once():
    assert metadata.version("rotemina") == PROJECT["version"]
    sources = [path for _, path in shipped_files() if path.suffix == ".py"]
    assert [path.name for path in sources if "__version__ =" in path.read_text("utf-8")] == []


def test_nothing_is_installed_that_has_no_business_in_a_laboratory():
    """Tunnels to the internet, shells and message queues came by way of meshcat once."""
    wanted, seen = [*PROJECT["dependencies"]], set()
    while wanted:
        requirement = Requirement(wanted.pop())
        name = canonicalize_name(requirement.name)
        if name not in seen and (requirement.marker is None or requirement.marker.evaluate()):
            seen.add(name)
            with suppress(metadata.PackageNotFoundError):  # tells of an extra that is not asked for
                wanted += [one for one in metadata.requires(name) or () if "extra ==" not in one]
    assert len(seen) > 25
    assert not seen & {"meshcat", "pyngrok", "ngrok", "ipython", "pyzmq", "jedi"}


@pytest.mark.parametrize("file", sorted(ROOT.glob(".ci/constraints/*.txt")), ids=lambda f: f.name)
def test_tested_versions_name_every_package_and_no_host(file):
    lines = file.read_text("utf-8").splitlines()
    assert [line for line in lines if not re.fullmatch(r"[\w.-]+==[\w.+]+", line)] == []
    tested = {canonicalize_name(line.partition("==")[0]) for line in lines}
    extras = PROJECT["optional-dependencies"]
    kinds = [PROJECT["dependencies"], *(extras[name] for name in ("test", "lint", "bench", "docs"))]
    named = (Requirement(one) for kind in kinds for one in kind)
    wanted = {
        canonicalize_name(one.name)
        for one in named
        if one.marker is None or one.marker.evaluate({"python_version": file.stem})
    }
    assert wanted - tested <= {"setuptools"}  # which comes with Python and is not listed


@pytest.mark.slow
def test_pip_install_gives_the_command(tmp_path):
    generated = shutil.ignore_patterns(".*", "build", "dist", "*.egg-info", "__pycache__")
    source = shutil.copytree(ROOT, tmp_path / "source", ignore=generated)
    environment = tmp_path / "environment"
    venv.create(environment, with_pip=True)
    scripts = environment / ("Scripts" if sys.platform == "win32" else "bin")
    python = shutil.which("python", path=scripts)
    subprocess.run([python, "-m", "pip", "install", "--quiet", str(source)], check=True)
    shutil.rmtree(source)

    command = shutil.which("rotemina", path=scripts)
    answer = subprocess.run([command, "--help"], check=True, capture_output=True, text=True)
    assert "rotemina" in answer.stdout
    installed = {path.name for path in environment.rglob("rotemina/*")}
    assert installed >= set(SETUPTOOLS["package-dir"].values())
