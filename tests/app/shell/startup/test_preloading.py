"""Libraries are loaded before they are needed, and a broken one does not prevent the others."""

import subprocess
import sys

import pytest

from rotemina.app.shell.startup.preloading import preload

# Import the modules in random order while they are being preloaded on another thread.
CONCURRENT_IMPORTS = """
import importlib, random, sys, time
from importlib.metadata import entry_points
from rotemina.app.shell.startup import window_run
from rotemina.app.shell.startup.preloading import LATE_MODULES, preload
points = entry_points(group="rotemina.panels")
modules = [point.module for point in points if point.module.startswith("rotemina.")]
thread = preload((*LATE_MODULES, *modules))
chance = random.Random(int(sys.argv[1]))
time.sleep(chance.uniform(0.0, 0.5))
for name in chance.sample((*LATE_MODULES, *modules), len(LATE_MODULES) + len(modules)):
    importlib.import_module(name)
thread.join(60.0)
assert len(modules) > 15 and not thread.is_alive()
"""


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_two_threads_can_load_the_same_module_at_once(seed):
    command = [sys.executable, "-c", CONCURRENT_IMPORTS, str(seed)]
    result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert (result.returncode, result.stderr) == (0, "")


def test_modules_are_loaded_on_another_thread(tmp_path, monkeypatch):
    (tmp_path / "loaded_ahead.py").write_text(
        "import threading\nTHREAD = threading.current_thread().name\n"
    )
    (tmp_path / "broken_ahead.py").write_text("raise SystemError('no')\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr("gc.freeze", lambda: None)
    preload(["no_such_library_at_all", "broken_ahead", "loaded_ahead"]).join(30.0)
    assert sys.modules.pop("loaded_ahead").THREAD == "preloading"
