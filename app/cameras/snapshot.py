"""A picture, or a z-stack of them, saved with its data."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotemina.drivers.cameras.frame import Frame
from rotemina.sim.whole_files import replaced


@dataclass(frozen=True, slots=True)
class Circumstances:
    """The circumstances of a picture.

    Attributes
    ----------
    taken : str
        Date and time, ISO 8601, for people; ``host_time_s`` of the frame is what is computed with.
    camera, objective : str
    gain : float or None
    pixel_m : float or None
        Size of a pixel in the specimen, m; None: not calibrated.
    command, measured : mapping axis -> float
        Joint positions, m or rad.
    recording : str
        The recording of the session that it belongs to; empty: none.
    """

    taken: str = ""
    camera: str = ""
    objective: str = ""
    gain: float | None = None
    pixel_m: float | None = None
    command: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    measured: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    recording: str = ""


def program() -> str:
    """Return name and version of the program."""
    return f"RoTeMiNa {version('rotemina')}"


def description(frame: Frame, about: Circumstances) -> str:
    """Return the data of a picture as plain ASCII JSON, as TIFF demands."""
    facts = {
        "program": program(),
        "taken": about.taken,
        "camera": about.camera,
        "objective": about.objective,
        "pixel_m": about.pixel_m,
        "gain": about.gain,
        **frame_facts(frame),
        "region_px": [frame.region.left, frame.region.top, frame.region.width, frame.region.height],
        "command": dict(about.command),
        "measured": dict(about.measured),
        "recording": about.recording,
        "camera_says": dict(frame.metadata),
    }
    return json.dumps(facts, default=str)


def frame_facts(frame: Frame) -> dict[str, object]:
    """Return what differs from picture to picture of one camera."""
    return {
        "host_time_s": frame.host_time_s,
        "number": frame.number,
        "bits": frame.bits,
        "exposure_s": frame.exposure_s,
    }


def tiff_tags(frame: Frame, about: Circumstances) -> dict[str, Any]:
    """Return what tifffile is told of a picture beside its description."""
    per_cm = 0.01 / about.pixel_m if about.pixel_m else None
    return {
        "photometric": "rgb" if frame.colour else "minisblack",
        "metadata": None,
        "software": program(),
        "resolution": None if per_cm is None else (per_cm, per_cm),
        "resolutionunit": None if per_cm is None else "CENTIMETER",
    }


def write_tiff(path: Path, frame: Frame, about: Circumstances) -> None:
    """Write the camera's own numbers, 8 or 16 bits, completely or not at all.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    import tifffile  # takes a tenth of a second, for which no start of the window waits

    with replaced(path) as file:
        tifffile.imwrite(
            file, frame.pixels, description=description(frame, about), **tiff_tags(frame, about)
        )


def write_png(path: Path, shown: NDArray[np.uint8], frame: Frame, about: Circumstances) -> None:
    """Write a picture as displayed, completely or not at all.

    Parameters
    ----------
    path : Path
    shown : (rows, columns) or (rows, columns, 3)
        With contrast and colours.
    frame : Frame
        What it was made of.
    about : Circumstances

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    from PIL import Image, PngImagePlugin  # as slow

    text = PngImagePlugin.PngInfo()
    text.add_text("Software", program())
    text.add_text("Description", description(frame, about))
    scale = {"dpi": (0.0254 / about.pixel_m,) * 2} if about.pixel_m else {}
    with replaced(path) as file:
        Image.fromarray(np.ascontiguousarray(shown)).save(file, "PNG", pnginfo=text, **scale)


class Page(NamedTuple):
    """A picture, the place of the focus, m, and all axes as commanded and measured, m and rad."""

    place: float
    frame: Frame
    command: Mapping[str, float]
    measured: Mapping[str, float]


def write_stack(path: Path, pages: Sequence[Page], axis: str, about: Circumstances) -> None:
    """Write the camera's own numbers, a page for each place, completely or not at all.

    A page's description is JSON as that of a snapshot, with ``focus_axis``, ``focus_m``, ``page``
    and ``pages``.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    import tifffile  # as slow

    with replaced(path) as file, tifffile.TiffWriter(file) as writer:
        for number, page in enumerate(pages, 1):
            own = replace(about, command=page.command, measured=page.measured)
            facts = json.loads(description(page.frame, own))
            facts |= {"focus_axis": axis, "focus_m": page.place}
            facts |= {"page": number, "pages": len(pages)}
            writer.write(
                page.frame.pixels,
                description=json.dumps(facts),
                contiguous=False,
                **tiff_tags(page.frame, about),
            )
