"""An import that hangs or ends the process is found out elsewhere, once, and remembered."""

import subprocess
from importlib.metadata import EntryPoint, entry_points

import pytest

from rotemina.sim import plugin_import
from rotemina.sim.plugin_import import import_fault

GROUP = "rotemina.effects"


@pytest.fixture
def kept_in(tmp_path):
    return tmp_path / "cache" / "plugin_imports.json"


@pytest.fixture
def point_of(tmp_path, monkeypatch):
    """Install a package ``tried_plugin`` with this text, and return its entry point."""
    site = tmp_path / "site"
    about = site / "tried_plugin-1.0.dist-info"
    about.mkdir(parents=True)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: tried-plugin\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text(f"[{GROUP}]\ntried = tried_plugin:THING\n")

    def install(text):
        (site / "tried_plugin.py").write_text(text)
        monkeypatch.syspath_prepend(str(site))
        (point,) = entry_points(group=GROUP, name="tried")
        return point

    return install


@pytest.fixture
def no_process(monkeypatch):
    def forbid():
        def run(*_, **__):
            raise AssertionError("it was tried again")

        monkeypatch.setattr(subprocess, "run", run)

    return forbid


def test_an_import_that_ends_is_allowed_and_not_tried_again(point_of, kept_in, no_process):
    point = point_of("THING = 1")
    assert import_fault(point, kept_in=kept_in) is None
    no_process()
    assert import_fault(point, kept_in=kept_in) is None


def test_an_import_that_hangs_is_refused_and_not_tried_again(point_of, kept_in, no_process):
    point = point_of("import threading; threading.Event().wait()")
    assert "did not end within 0.5 s" in import_fault(point, limit_s=0.5, kept_in=kept_in)
    no_process()
    assert "did not end within 0.5 s" in import_fault(point, kept_in=kept_in)


def test_an_import_that_ends_the_process_is_refused(point_of, kept_in):
    point = point_of("import os; os._exit(0)")
    assert "ends the whole process (status 0)" in import_fault(point, kept_in=kept_in)


@pytest.mark.parametrize("text", ["raise RuntimeError", "raise SystemExit(3)", "not Python"])
def test_what_an_import_raises_is_left_to_the_program(point_of, kept_in, text):
    assert import_fault(point_of(text), kept_in=kept_in) is None


def test_a_thread_that_the_import_starts_does_not_count_as_hanging(point_of, kept_in):
    text = "import threading; threading.Thread(target=threading.Event().wait).start()"
    assert import_fault(point_of(text), kept_in=kept_in) is None


def test_a_changed_file_is_tried_again(point_of, kept_in):
    assert import_fault(point_of("import os; os._exit(0)"), kept_in=kept_in) is not None
    assert import_fault(point_of("THING = 'repaired'"), kept_in=kept_in) is None
    assert kept_in.read_text().count("tried_plugin:THING") == 1


def test_it_is_tried_anew_when_that_is_asked_for(point_of, kept_in, no_process):
    point = point_of("THING = 1")
    assert import_fault(point, kept_in=kept_in) is None
    no_process()
    with pytest.raises(AssertionError, match="tried again"):
        import_fault(point, kept_in=kept_in, anew=True)


@pytest.mark.parametrize("spoilt", ["", "[1]", '{"a": 1}', "\x00"])
def test_a_spoilt_cache_holds_nothing(point_of, kept_in, spoilt):
    kept_in.parent.mkdir()
    kept_in.write_text(spoilt)
    assert import_fault(point_of("import os; os._exit(0)"), kept_in=kept_in) is not None


def test_a_cache_that_cannot_be_written_does_no_harm(point_of, tmp_path):
    (tmp_path / "file").write_text("")
    assert import_fault(point_of("THING = 1"), kept_in=tmp_path / "file" / "cache") is None


def test_our_own_and_what_belongs_to_no_package_are_not_tried(monkeypatch, kept_in):
    monkeypatch.setattr(plugin_import, "_tried", lambda *_: "tried")
    ours = next(point for point in entry_points(group=GROUP) if point.name == "delay")
    for point in (ours, EntryPoint("own", "no_such_module:X", GROUP)):
        assert import_fault(point, kept_in=kept_in) is None
