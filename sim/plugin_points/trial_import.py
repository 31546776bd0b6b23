"""Trial import of plugins in a separate process.

An import that never ends cannot be interrupted from within, and an import that ends the process
would end the program. Therefore a plugin of another package is first imported in a second process,
which is killed after a time limit. The result is cached until the plugin's version or files change,
so a normal start only looks at the files and starts no process.

The trial does not detect an import that hangs only in the program itself, or because another
package has changed in the meantime. It says nothing about what the plugin does later. It is
not a sandbox: the side effects of the import do happen.
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

from rotemina.sim.errors import FileWriteError, InputError
from rotemina.sim.files import parse_json, read_text, replace_file

#: Time limit of an import, s: many times the duration on a slow disk.
IMPORT_TIMEOUT_S = 30.0
_MAX_CACHE_BYTES = 16_000_000
_IMPORT_RETURNED_STATUS = 42
#: The script ignores exceptions of the import, because the program imports the module again and
#: reports them better. ``os._exit`` is needed because threads of the module would keep the process
#: alive.
_IMPORT_SCRIPT = f"""
import os, sys
sys.path[:] = sys.argv[2:]
try:
    __import__(sys.argv[1])
except (Exception, SystemExit):
    pass
os._exit({_IMPORT_RETURNED_STATUS})
"""


def find_import_fault(
    point: EntryPoint,
    *,
    limit_s: float = IMPORT_TIMEOUT_S,
    cache_file: Path | None = None,
    again: bool = False,
) -> str | None:
    """Return the reason why the module of an entry point must not be imported, or None.

    Modules of this program and modules that belong to no package are not tried. Modules that are
    imported already are tried only with ``again``.

    Parameters
    ----------
    point : EntryPoint
    limit_s : float
        Time limit of the import.
    cache_file : Path, optional
        File with the results of earlier trials; by default in the user's cache folder.
    again : bool
        Try the import even if there is a cached result.
    """
    if point.value.startswith("rotemina.") or (not again and point.module in sys.modules):
        return None
    if point.dist is None or not sys.executable:
        return None
    key = _make_state_key(point)
    if key is None:
        # There is no such module. The program's own import reports that.
        return None
    file = cache_file or user_cache_path("rotemina", appauthor=False) / "plugin_imports.json"
    faults = _read_results(file)
    if again or key not in faults:
        faults[key] = _try_import(point.module, limit_s)
        _write_results(file, faults)
    return faults[key] or None


def _try_import(module: str, limit_s: float) -> str:
    """Import a module in another process; return what went wrong, or an empty text."""
    command = [sys.executable, "-c", _IMPORT_SCRIPT, module, *sys.path]
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    try:
        process = subprocess.run(
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
    if process.returncode != _IMPORT_RETURNED_STATUS:
        return f"its import ends the whole process (status {process.returncode})"
    return ""


def _make_state_key(point: EntryPoint) -> str | None:
    """Return a key that changes with the plugin's version and files; None without a module."""
    assert point.dist is not None
    with suppress(ImportError, ValueError):
        spec = find_spec(point.module.partition(".")[0])
        if spec is not None:
            files = [Path(spec.origin)] if spec.origin not in (None, "built-in", "frozen") else []
            for folder in spec.submodule_search_locations or ():
                files += sorted(Path(folder).rglob("*.py"))
            # A package without its PKG-INFO has neither name nor version.
            names = (point.dist.name, point.dist.version)
            state_items = [point.value, *map(str, names), version("rotemina")]
            for file in files:
                with suppress(OSError):
                    state_items += [
                        str(file),
                        str(file.stat().st_mtime_ns),
                        str(file.stat().st_size),
                    ]
            digest = sha256("\n".join([*state_items, sys.version]).encode()).hexdigest()
            return f"{point.value} {digest[:32]}"
    return None


def _read_results(file: Path) -> dict[str, str]:
    """Return the results of earlier trials; none if the file is missing or damaged."""
    try:
        faults = parse_json(read_text(file, InputError, _MAX_CACHE_BYTES), str(file), InputError)
    except InputError:
        return {}
    if not isinstance(faults, dict):
        return {}
    return {key: fault for key, fault in faults.items() if isinstance(fault, str)}


def _write_results(file: Path, faults: dict[str, str]) -> None:
    """Write the latest result of each plugin.

    Errors are ignored: without a cache, the next start repeats the trials.
    """
    latest = {key.partition(" ")[0]: key for key in faults}
    text = json.dumps({key: faults[key] for key in latest.values()}, indent=1)
    with suppress(OSError, FileWriteError):
        file.parent.mkdir(parents=True, exist_ok=True)
        with replace_file(file) as output:
            output.write(text.encode())
