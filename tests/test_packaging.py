"""The packaging tables agree with the folders, because an editable install hides missing files."""

import re
import tomllib
from contextlib import suppress
from fnmatch import fnmatch
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from rotemina.sim.effects import Effect

ROOT = Path(__file__).parents[1]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
PROJECT = PYPROJECT["project"]
SETUPTOOLS = PYPROJECT["tool"]["setuptools"]
HELP_PACKAGE = "rotemina.docs"
ENTRY_POINTS = {
    "console_scripts": PROJECT["scripts"],
    **PROJECT["entry-points"],
}


def list_shipped_files() -> list[tuple[str, Path]]:
    """Return the package name and path of every file in the folders of the layers."""
    files = []
    for layer, folder in SETUPTOOLS["package-dir"].items():
        if layer == HELP_PACKAGE:
            # Only selected pages are shipped.
            continue
        for path in sorted((ROOT / folder).rglob("*")):
            inside = path.relative_to(ROOT / folder)
            if path.is_dir() or any(part.startswith((".", "__py")) for part in inside.parts):
                continue
            if path.suffix == ".ts":
                # The sources of translations are not shipped.
                continue
            files.append((".".join([layer, *inside.parent.parts]), path))
    return files


def test_packages_are_the_folders_that_contain_files():
    folders = {package for package, _ in list_shipped_files()}
    assert sorted(SETUPTOOLS["packages"]) == sorted({*folders, HELP_PACKAGE})


def test_every_package_has_an_init():
    folders = {path.parent for _, path in list_shipped_files()}
    assert [folder for folder in folders if not (folder / "__init__.py").is_file()] == []


def test_package_data_covers_every_file():
    patterns = SETUPTOOLS["package-data"]
    missing = [
        str(path.relative_to(ROOT))
        for package, path in list_shipped_files()
        if path.suffix != ".py"
        and not any(
            fnmatch(path.name, pattern)
            for pattern in patterns.get("*", []) + patterns.get(package, [])
        )
    ]
    assert missing == []


@pytest.mark.parametrize("group", ENTRY_POINTS)
def test_entry_points_resolve(group):
    for name, value in ENTRY_POINTS[group].items():
        loaded = metadata.EntryPoint(name, value, group).load()
        if group == "rotemina.effects":
            assert isinstance(loaded, Effect)
            assert loaded.id == name
        else:
            assert callable(loaded)


def test_the_version_is_written_once():
    assert metadata.version("rotemina") == PROJECT["version"]
    sources = [path for _, path in list_shipped_files() if path.suffix == ".py"]
    assert [path.name for path in sources if "__version__ =" in path.read_text("utf-8")] == []


def find_required_packages(requirements):
    """Return the packages that an installation of requirements brings in."""
    pending, names = [("", requirement) for requirement in requirements], set()
    while pending:
        extra, text = pending.pop()
        requirement = Requirement(text)
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": extra}):
            continue
        for own_extra in ("", *requirement.extras):
            name = canonicalize_name(requirement.name)
            if (name, own_extra) not in names:
                names.add((name, own_extra))
                # A package of an extra may be missing.
                with suppress(metadata.PackageNotFoundError):
                    pending += [(own_extra, text) for text in metadata.requires(name) or ()]
    return {name for name, _ in names}


def test_no_unsuitable_package_is_installed():
    """Meshcat once brought in tunnels to the internet, shells and message queues."""
    names = find_required_packages(PROJECT["dependencies"])
    assert len(names) > 25
    assert not names & {"meshcat", "pyngrok", "ngrok", "ipython", "pyzmq", "jedi"}


def test_every_imported_package_is_a_dependency():
    texts = [path.read_text("utf-8") for _, path in list_shipped_files() if path.suffix == ".py"]
    pattern = re.compile(r"^\s*(?:from|import) (\w+)", re.MULTILINE)
    imported_names = {name for text in texts for name in pattern.findall(text)} - {"rotemina"}
    extras = PROJECT["optional-dependencies"]
    required_packages = find_required_packages(
        [*PROJECT["dependencies"], *extras["micromanager"], *extras["dask"]]
    )
    packages_of_modules = metadata.packages_distributions()
    third_party_names = imported_names & packages_of_modules.keys()
    assert len(third_party_names) > 20
    assert [
        name
        for name in sorted(third_party_names)
        if required_packages.isdisjoint(map(canonicalize_name, packages_of_modules[name]))
    ] == []


@pytest.mark.parametrize("file", sorted(ROOT.glob(".ci/constraints/*.txt")), ids=lambda f: f.name)
def test_constraints_name_every_package_and_no_host(file):
    lines = file.read_text("utf-8").splitlines()
    assert [line for line in lines if not re.fullmatch(r"[\w.-]+==[\w.+]+", line)] == []
    constrained = {canonicalize_name(line.partition("==")[0]) for line in lines}
    extras = PROJECT["optional-dependencies"]
    requirement_lists = [
        PROJECT["dependencies"],
        *(extras[name] for name in ("test", "lint", "bench", "docs")),
    ]
    requirements = (Requirement(text) for texts in requirement_lists for text in texts)
    needed = {
        canonicalize_name(requirement.name)
        for requirement in requirements
        if requirement.marker is None or requirement.marker.evaluate({"python_version": file.stem})
    }
    # Setuptools comes with Python and is not listed.
    assert needed - constrained <= {"setuptools"}


def test_the_citation_names_the_version():
    citation = (ROOT / "docs" / "CITATION.cff").read_text("utf-8")
    assert re.findall(r"^version: (.*)$", citation, re.MULTILINE) == [PROJECT["version"]]
    assert re.findall(r"^license: (.*)$", citation, re.MULTILINE) == [PROJECT["license"]]
