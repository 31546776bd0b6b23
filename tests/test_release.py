"""The wheel as released: built from the source archive, and tested without the source."""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import venv
import zipfile
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))


pytestmark = [
    pytest.mark.slow,
    # All tests share one wheel.
    pytest.mark.xdist_group("release"),
    pytest.mark.skipif(find_spec("build") is None, reason="build comes with the extra 'test'"),
]


@pytest.fixture(scope="module")
def archives(tmp_path_factory):
    """Source archive, built without a network, and the wheel built from it."""
    generated = shutil.ignore_patterns(".*", "build", "dist", "*.egg-info", "__pycache__")
    folder = tmp_path_factory.mktemp("release")
    source = shutil.copytree(ROOT, folder / "source", ignore=generated)
    subprocess.run(
        [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(source)],
        check=True, capture_output=True,
    )  # fmt: skip
    shutil.rmtree(source)
    return folder


@pytest.fixture(scope="module")
def command(archives):
    """``rotemina`` from the wheel, in an environment that uses all other packages of this one."""
    environment = archives / "environment"
    venv.create(environment)
    bin_folder = environment / ("Scripts" if sys.platform == "win32" else "bin")
    python = shutil.which("python", path=bin_folder)
    (wheel,) = archives.glob("*.whl")
    subprocess.run(
        [
            sys.executable, "-m", "pip", "--python", python, "install",
            "--quiet", "--no-index", "--no-deps", str(wheel),
        ],
        check=True,
    )  # fmt: skip
    installed = next(environment.rglob("rotemina/app")).parents[1]
    # Further .pth files in a path from a .pth are ignored, so the editable install is not found.
    (installed / "borrowed.pth").write_text(sysconfig.get_path("purelib") + "\n", "utf-8")
    return shutil.which("rotemina", path=bin_folder)


def test_the_source_archive_contains_the_sources_of_a_wheel(archives):
    (archive,) = archives.glob("*.tar.gz")
    with tarfile.open(archive) as file:
        names = {name.partition("/")[2] for name in file.getnames()}
    assert {"pyproject.toml", "README.md", "LICENSE", "resources/robots/rotemina.toml"} <= names


def test_the_wheel_contains_every_layer_and_every_page_with_its_pictures(archives):
    (wheel,) = archives.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    layers = {name.split("/")[1] for name in names if name.startswith("rotemina/")}
    assert layers == set(PYPROJECT["tool"]["setuptools"]["package-dir"].values())
    files = {name.removeprefix("rotemina/docs/") for name in names}
    pages = sorted((ROOT / "docs").glob("*.md")) + sorted((ROOT / "docs" / "decisions").glob("*"))
    assert {str(page.relative_to(ROOT / "docs")) for page in pages} <= files
    pictures = {
        name for page in pages for name in re.findall(r"!\[[^]]*]\(([^)]*)", page.read_text())
    }
    assert pictures <= files
    assert len(pictures) > 2


def test_the_wheel_runs_from_another_folder(command, tmp_path):
    def run(*arguments):
        environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
        environment.pop("PYTHONPATH", None)
        process = subprocess.run(
            [command, *arguments], cwd=tmp_path, env=environment,
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert process.returncode == 0, process.stdout + process.stderr
        return process.stdout

    assert run("--version").strip() == f"rotemina {PYPROJECT['project']['version']}"
    checks = {check["name"]: check for check in json.loads(run("doctor", "--json"))}
    assert {"dependencies", "Qt platform", "rendering", "clock"} < set(checks)
    assert str(Path(command).parent) in checks["Python"]["seen"]
    run("excite", "sine", "--axes", "thx", "-o", "sine.csv")
    run("simulate", "sine.csv", "-o", "answer.csv")
    assert (tmp_path / "answer.csv").stat().st_size > 1000
    assert "hysteresis" in run("effect", "list")
