"""An import that hangs or ends the process is detected once in another process and cached."""

import subprocess
from importlib.metadata import EntryPoint, entry_points

import pytest

from rotemina.sim.plugin_points import find_import_fault, trial_import as plugin_import

GROUP = "rotemina.effects"


@pytest.fixture
def cache_file(tmp_path):
    return tmp_path / "cache" / "plugin_imports.json"


@pytest.fixture
def install_plugin(tmp_path, monkeypatch):
    """Return a function that installs ``tried_plugin`` with a text and returns its entry point."""
    site = tmp_path / "site"
    metadata_dir = site / "tried_plugin-1.0.dist-info"
    metadata_dir.mkdir(parents=True)
    (metadata_dir / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: tried-plugin\nVersion: 1.0\n"
    )
    (metadata_dir / "entry_points.txt").write_text(f"[{GROUP}]\ntried = tried_plugin:THING\n")

    def install(text):
        (site / "tried_plugin.py").write_text(text)
        monkeypatch.syspath_prepend(str(site))
        (point,) = entry_points(group=GROUP, name="tried")
        return point

    return install


@pytest.fixture
def forbid_process(monkeypatch):
    """Return a function that makes each later attempt to start a process fail."""

    def forbid():
        def run(*_, **__):
            raise AssertionError("it was tried again")

        monkeypatch.setattr(subprocess, "run", run)

    return forbid


def test_an_import_that_succeeds_is_allowed_and_not_repeated(
    install_plugin, cache_file, forbid_process
):
    point = install_plugin("THING = 1")
    assert find_import_fault(point, cache_file=cache_file) is None
    forbid_process()
    assert find_import_fault(point, cache_file=cache_file) is None


def test_an_import_that_hangs_is_refused_and_not_repeated(
    install_plugin, cache_file, forbid_process
):
    point = install_plugin("import threading; threading.Event().wait()")
    assert "did not end within 0.5 s" in find_import_fault(
        point, limit_s=0.5, cache_file=cache_file
    )
    forbid_process()
    assert "did not end within 0.5 s" in find_import_fault(point, cache_file=cache_file)


def test_an_import_that_ends_the_process_is_refused(install_plugin, cache_file):
    point = install_plugin("import os; os._exit(0)")
    assert "ends the whole process (status 0)" in find_import_fault(point, cache_file=cache_file)


@pytest.mark.parametrize("text", ["raise SystemExit(3)", "not Python"])
def test_an_import_that_raises_is_no_fault(install_plugin, cache_file, text):
    assert find_import_fault(install_plugin(text), cache_file=cache_file) is None


def test_a_thread_started_by_the_import_is_no_fault(install_plugin, cache_file):
    text = "import threading; threading.Thread(target=threading.Event().wait).start()"
    assert find_import_fault(install_plugin(text), cache_file=cache_file) is None


def test_a_changed_file_is_imported_again(install_plugin, cache_file):
    faulty = install_plugin("import os; os._exit(0)")
    assert find_import_fault(faulty, cache_file=cache_file) is not None
    assert find_import_fault(install_plugin("THING = 'repaired'"), cache_file=cache_file) is None
    assert cache_file.read_text().count("tried_plugin:THING") == 1


def test_an_import_is_repeated_on_request(install_plugin, cache_file, forbid_process):
    point = install_plugin("THING = 1")
    assert find_import_fault(point, cache_file=cache_file) is None
    forbid_process()
    with pytest.raises(AssertionError, match="tried again"):
        find_import_fault(point, cache_file=cache_file, again=True)


@pytest.mark.parametrize("content", ["", "[1]", '{"a": 1}'])
def test_a_damaged_cache_is_ignored(install_plugin, cache_file, content):
    cache_file.parent.mkdir()
    cache_file.write_text(content)
    point = install_plugin("import os; os._exit(0)")
    assert find_import_fault(point, cache_file=cache_file) is not None


def test_a_cache_that_cannot_be_written_is_ignored(install_plugin, tmp_path):
    (tmp_path / "file").write_text("")
    point = install_plugin("THING = 1")
    assert find_import_fault(point, cache_file=tmp_path / "file" / "cache") is None


def test_built_in_plugins_and_those_without_package_are_not_tried(monkeypatch, cache_file):
    monkeypatch.setattr(plugin_import, "_try_import", lambda *_: "tried")
    built_in = next(point for point in entry_points(group=GROUP) if point.name == "delay")
    for point in (built_in, EntryPoint("own", "no_such_module:X", GROUP)):
        assert find_import_fault(point, cache_file=cache_file) is None
