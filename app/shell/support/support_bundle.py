"""The support bundle: all that support needs to know, in one archive without personal names."""

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

from rotemina.app.language import translate
from rotemina.app.motion.state import SessionState
from rotemina.app.settings import format_json
from rotemina.app.shell.support.anonymiser import TextAnonymiser
from rotemina.app.shell.support.message_log import LogMessage
from rotemina.drivers.contract import MachineKind
from rotemina.sim.files import replace_file
from rotemina.sim.plugin_points import API_VERSIONS
from rotemina.sim.records import Record, write_record

_LIBRARIES = (
    "rotemina",
    "numpy",
    "scipy",
    "numba",
    "pyarrow",
    "PySide6-Essentials",
    "pyqtgraph",
    "pyserial",
    "opencv-python-headless",
)
ReportShare = Callable[[float], None]


@dataclass(frozen=True, slots=True)
class BundleFile:
    """One file of the bundle, as it is written."""

    name: str
    about: str
    text: str


def gather_files(
    messages: Iterable[LogMessage],
    preferences: Mapping[str, object],
    state: SessionState,
    driver: str,
    robot: str,
    record: Record | None,
    anonymiser: TextAnonymiser,
    lateness: Mapping[str, float] = MappingProxyType({}),
    report: ReportShare = lambda _: None,
    *,
    machine_kind: str = MachineKind.REAL,
) -> tuple[BundleFile, ...]:
    """Return the anonymised files of a bundle; a large record takes a while.

    ``report`` is called with the finished share, and may raise to cancel.
    """
    report(0.0)
    log = "\n".join(message.line for message in messages)
    files = [
        BundleFile(
            "log.txt", translate("shell", "Messages of the program since its start"), f"{log}\n"
        ),
        BundleFile(
            "settings.json",
            translate("shell", "Display preferences, and driver settings"),
            _to_json(preferences),
        ),
        BundleFile(
            "versions.json",
            translate("shell", "Versions of the program, its libraries and plugins"),
            _to_json(list_versions()),
        ),
        BundleFile(
            "machine.json",
            translate("shell", "Robot, driver and state of the connection"),
            _to_json(_describe_machine(state, driver, robot, machine_kind)),
        ),
        BundleFile(
            "window.json",
            translate("shell", "Delays of the window; the log names their causes"),
            _to_json(lateness),
        ),
    ]
    report(0.2)
    if record is not None:
        files.append(
            BundleFile(
                "record.csv",
                translate("shell", "The last record: commands and readings"),
                _to_csv(record),
            )
        )
    report(0.6)
    anonymised_files = []
    for number, file in enumerate(files, 1):
        anonymised_files.append(BundleFile(file.name, file.about, anonymiser.anonymise(file.text)))
        report(0.6 + 0.4 * number / len(files))
    return tuple(anonymised_files)


def write_bundle(
    path: Path, items: Sequence[BundleFile], report: ReportShare = lambda _: None
) -> None:
    """Write the files as a zip archive, completely or not at all.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    sizes = [len(item.text) + 1 for item in items]
    with replace_file(path) as file, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for number, item in enumerate(items):
            report(sum(sizes[:number]) / sum(sizes))
            archive.writestr(item.name, item.text.encode("utf-8"))
    report(1.0)


def list_versions() -> dict[str, object]:
    """Return the versions of the program's parts, without the name of the computer."""
    return {
        "python": sys.version.split()[0],
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "libraries": {
            name: version_text for name in _LIBRARIES if (version_text := _find_version(name))
        },
        "plugins": {
            group: {
                point.name: f"{point.value} ({_describe_distribution(point)})"
                for point in metadata.entry_points(group=group)
            }
            for group in API_VERSIONS
        },
    }


def _find_version(name: str) -> str | None:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return None


def _describe_distribution(point: metadata.EntryPoint) -> str:
    return f"{point.dist.name} {point.dist.version}" if point.dist else "of no package"


def _describe_machine(state: SessionState, driver: str, robot: str, kind: str) -> dict[str, object]:
    return {
        "robot": robot,
        "driver": driver,
        "machine_kind": str(kind),
        "phase": str(state.phase),
        "activity": str(state.activity),
        "fault": state.fault,
        "locked": state.lock_reason,
        "latched": state.latch_reason,
        "differences": list(state.differences),
        "age_s": state.age_s,
        "stop_latency_s": state.stop_latency_s,
    }


def _to_csv(record: Record) -> str:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "record.csv"
        write_record(record, path)
        return path.read_text("utf-8")


def _to_json(value: Mapping[str, object]) -> str:
    return format_json(json.loads(json.dumps(dict(value), default=str))) + "\n"
