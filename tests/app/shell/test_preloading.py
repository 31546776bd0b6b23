"""Libraries are loaded before they are needed, and a broken one keeps no other from it."""

import sys

from rotemina.app.shell.preloading import preload


def test_modules_are_loaded_on_another_thread(tmp_path, monkeypatch):
    (tmp_path / "loaded_ahead.py").write_text(
        "import threading\nTHREAD = threading.current_thread().name\n"
    )
    (tmp_path / "broken_ahead.py").write_text("raise SystemError('no')\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr("gc.freeze", lambda: None)
    preload(["no_such_library_at_all", "broken_ahead", "loaded_ahead"]).join(30.0)
    assert sys.modules.pop("loaded_ahead").THREAD == "preloading"
