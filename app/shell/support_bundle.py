"""The support bundle: what those who help must know, in one archive that names nobody."""

import json
import platform
import sys
import tempfile
import zipfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from types import MappingProxyType

from rotemina.app.files import json_text
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.anonymiser import Anonymiser
from rotemina.app.shell.language import translate
from rotemina.app.shell.message_log import Message
from rotemina.drivers.driver import MachineKind
from rotemina.sim.plugin_points import API_VERSIONS
from rotemina.sim.records.record import Record
from rotemina.sim.records.writing import write_record
from rotemina.sim.whole_files import replaced

_LIBRARIES = (
    "rotemina",
    "numpy",
    "scipy",
    "numba",
    "polars",
    "pyarrow",
    "PySide6-Essentials",
    "pyqtgraph",
    "pyserial",
    "opencv-python-headless",
)
Reached = Callable[[float], None]


@dataclass(frozen=True, slots=True)
class Item:
    """One file of the bundle, as it is written."""

    name: str
    about: str
    text: str


def gather(
    messages: Iterable[Message],
    preferences: Mapping[str, object],
    state: SessionState,
    driver: str,
    robot: str,
    record: Record | None,
    anonymiser: Anonymiser,
    lateness: Mapping[str, float] = MappingProxyType({}),
    reached: Reached = lambda _: None,
    *,
    machine_kind: str = MachineKind.REAL,
) -> tuple[Item, ...]:
    """Return what a bundle holds, anonymised; a large record takes a while.

    ``reached`` gets the share that is done, and may raise to end it.
    """
    reached(0.0)
    log = "\n".join(message.line for message in messages)
    items = [
        Item("log.txt", translate("shell", "Messages of the program since its start"), f"{log}\n"),
        Item(
            "settings.json",
            translate("shell", "Display preferences, and driver settings"),
            _json(preferences),
        ),
        Item(
            "versions.json",
            translate("shell", "Versions of the program, its libraries and plugins"),
            _json(versions()),
        ),
        Item(
            "machine.json",
            translate("shell", "Robot, driver and state of the connection"),
            _json(_machine(state, driver, robot, machine_kind)),
        ),
        Item(
            "window.json",
            translate("shell", "Delays of the window; the log names their causes"),
            _json(lateness),
        ),
    ]
    reached(0.2)
    if record is not None:
        items.append(
            Item(
                "record.csv",
                translate("shell", "The last record: commands and readings"),
                _csv(record),
            )
        )
    reached(0.6)
    anonymised = []
    for number, item in enumerate(items, 1):
        anonymised.append(Item(item.name, item.about, anonymiser.anonymise(item.text)))
        reached(0.6 + 0.4 * number / len(items))
    return tuple(anonymised)


def write_bundle(path: Path, items: Sequence[Item], reached: Reached = lambda _: None) -> None:
    """Write items as a zip archive, completely or not at all.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    sizes = [len(item.text) + 1 for item in items]
    with replaced(path) as file, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for number, item in enumerate(items):
            reached(sum(sizes[:number]) / sum(sizes))
            archive.writestr(item.name, item.text.encode("utf-8"))
    reached(1.0)


def versions() -> dict[str, object]:
    """Return the versions of all that the program is made of; the machine's name is not in it."""
    return {
        "python": sys.version.split()[0],
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "libraries": {name: found for name in _LIBRARIES if (found := _version(name))},
        "plugins": {
            group: {
                point.name: f"{point.value} ({_distribution(point)})"
                for point in metadata.entry_points(group=group)
            }
            for group in API_VERSIONS
        },
    }


def _version(name: str) -> str | None:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return None


def _distribution(point: metadata.EntryPoint) -> str:
    return f"{point.dist.name} {point.dist.version}" if point.dist else "of no package"


def _machine(state: SessionState, driver: str, robot: str, kind: str) -> dict[str, object]:
    return {
        "robot": robot,
        "driver": driver,
        "machine_kind": str(kind),
        "phase": str(state.phase),
        "activity": str(state.activity),
        "fault": state.fault,
        "locked": state.locked,
        "latched": state.latched,
        "differences": list(state.differences),
        "age_s": state.age_s,
        "stop_latency_s": state.stop_latency_s,
    }


def _csv(record: Record) -> str:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "record.csv"
        write_record(record, path)
        return path.read_text("utf-8")


def _json(value: Mapping[str, object]) -> str:
    return json_text(json.loads(json.dumps(dict(value), default=str))) + "\n"
