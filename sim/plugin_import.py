"""Whether a plugin can be imported at all, tried in a separate process.

An import that never ends cannot be broken off from within, and one that ends the process takes the
program with it. So a plugin of another package is first imported by a process beside this one,
which is ended after a time limit. What came of it is kept until the plugin's version or files
change: a usual start costs a look at its files, no process.

What this cannot see: an import that hangs only in the program itself or because of another package
that was changed meanwhile, and what the plugin does later. It is no sandbox: what a plugin does
while it is imported is done.
"""

import json
import os
import subprocess
import sys
from contextlib import suppress
from hashlib import sha256
from importlib.metadata import EntryPoint, version
from importlib.util import find_spec
from pathlib import Path

from platformdirs import user_cache_path

from rotemina.sim.errors import InputError
from rotemina.sim.input_files import parse_json, read_text
from rotemina.sim.whole_files import FileWriteError, replaced

#: How long an import may take, s: many times what one takes on a slow disk.
LIMIT_S = 30.0
_MOST_BYTES = 16_000_000
_SURVIVED = 42
#: What the import raises is left to the program, which imports it again and can tell it better.
#: Threads that the import has started must not keep this process alive.
_TRY = f"""
import os, sys
sys.path[:] = sys.argv[2:]
try:
    __import__(sys.argv[1])
except (Exception, SystemExit):
    pass
os._exit({_SURVIVED})
"""


def import_fault(
    point: EntryPoint,
    *,
    limit_s: float = LIMIT_S,
    kept_in: Path | None = None,
    anew: bool = False,
) -> str | None:
    """Return why the module of an entry point must not be imported; None if it may be.

    Our own modules and those that belong to no package are not tried; those that are imported
    already only ``again``.

    Parameters
    ----------
    point : EntryPoint
    limit_s : float
        How long the import may take.
    kept_in : Path, optional
        The file of what came of earlier tries; by default in the user's cache.
    again : bool
        Try again, whatever came of it before.
    """
    if point.value.startswith("rotemina.") or (not anew and point.module in sys.modules):
        return None
    if point.dist is None or not sys.executable:
        return None
    key = _key(point)
    if key is None:
        return None  # there is no such module: importing it says so
    file = kept_in or user_cache_path("rotemina", appauthor=False) / "plugin_imports.json"
    kept = _kept(file)
    if anew or key not in kept:
        kept[key] = _tried(point.module, limit_s)
        _keep(file, kept)
    return kept[key] or None


def _tried(module: str, limit_s: float) -> str:
    """Import a module in another process; return what is wrong with that, or nothing."""
    command = [sys.executable, "-c", _TRY, module, *sys.path]
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    try:
        ended = subprocess.run(
            command,
            timeout=limit_s,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return (
            f"its import did not end within {limit_s:g} s; `rotemina plugin check` tries it again"
        )
    if ended.returncode != _SURVIVED:
        return f"its import ends the whole process (status {ended.returncode})"
    return ""


def _key(point: EntryPoint) -> str | None:
    """Return what tells this state of a plugin from others; None if there is no such module."""
    assert point.dist is not None
    with suppress(ImportError, ValueError):
        spec = find_spec(point.module.partition(".")[0])
        if spec is not None:
            files = [Path(spec.origin)] if spec.origin not in (None, "built-in", "frozen") else []
            for folder in spec.submodule_search_locations or ():
                files += sorted(Path(folder).rglob("*.py"))
            about = [point.value, point.dist.name, point.dist.version, version("rotemina")]
            for file in files:
                with suppress(OSError):
                    about += [str(file), str(file.stat().st_mtime_ns), str(file.stat().st_size)]
            digest = sha256("\n".join([*about, sys.version]).encode()).hexdigest()
            return f"{point.value} {digest[:32]}"
    return None


def _kept(file: Path) -> dict[str, str]:
    """Return what came of earlier tries; a file that is missing or spoilt holds none."""
    try:
        found = parse_json(read_text(file, InputError, _MOST_BYTES), str(file), InputError)
    except InputError:
        return {}
    if not isinstance(found, dict):
        return {}
    return {key: fault for key, fault in found.items() if isinstance(fault, str)}


def _keep(file: Path, faults: dict[str, str]) -> None:
    """Write what came of tries, the latest of each plugin alone; without a cache we try again."""
    latest = {key.partition(" ")[0]: key for key in faults}
    text = json.dumps({key: faults[key] for key in latest.values()}, indent=1)
    with suppress(OSError, FileWriteError):
        file.parent.mkdir(parents=True, exist_ok=True)
        with replaced(file) as written:
            written.write(text.encode())
