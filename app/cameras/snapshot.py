"""Saves a picture or a z-stack with its metadata."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotemina.drivers.cameras import CameraFrame
from rotemina.sim.files import replace_file


@dataclass(frozen=True, slots=True)
class SnapshotMetadata:
    """Metadata of a picture.

    Attributes
    ----------
    taken : str
        Date and time, ISO 8601, for display. Computations use ``host_time_s`` of the frame.
    camera, objective : str
    gain : float or None
    pixel_m : float or None
        Size of a pixel in the specimen, m; None if it is not calibrated.
    command, measured : mapping axis -> float
        Joint positions, m or rad.
    recording : str
        Name of the session's recording in which the picture was taken; empty if there was none.
    """

    taken: str = ""
    camera: str = ""
    objective: str = ""
    gain: float | None = None
    pixel_m: float | None = None
    command: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    measured: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    recording: str = ""


def format_program_version() -> str:
    """Return the name and the version of the program."""
    return f"RoTeMiNa {version('rotemina')}"


def format_description(frame: CameraFrame, snapshot_metadata: SnapshotMetadata) -> str:
    """Return the metadata of a picture as plain ASCII JSON, as TIFF requires."""
    metadata = {
        "program": format_program_version(),
        "taken": snapshot_metadata.taken,
        "camera": snapshot_metadata.camera,
        "objective": snapshot_metadata.objective,
        "pixel_m": snapshot_metadata.pixel_m,
        "gain": snapshot_metadata.gain,
        **make_frame_metadata(frame),
        "region_px": [frame.region.left, frame.region.top, frame.region.width, frame.region.height],
        "command": dict(snapshot_metadata.command),
        "measured": dict(snapshot_metadata.measured),
        "recording": snapshot_metadata.recording,
        "camera_says": dict(frame.metadata),
    }
    return json.dumps(metadata, default=str)


def make_frame_metadata(frame: CameraFrame) -> dict[str, object]:
    """Return the metadata that change from one picture of a camera to the next."""
    return {
        "host_time_s": frame.host_time_s,
        "number": frame.number,
        "bits": frame.bits,
        "exposure_s": frame.exposure_s,
    }


def make_tiff_arguments(frame: CameraFrame, snapshot_metadata: SnapshotMetadata) -> dict[str, Any]:
    """Return the keyword arguments for tifffile, except the description."""
    pixels_per_cm = 0.01 / snapshot_metadata.pixel_m if snapshot_metadata.pixel_m else None
    return {
        "photometric": "rgb" if frame.is_colour else "minisblack",
        "metadata": None,
        "software": format_program_version(),
        "resolution": None if pixels_per_cm is None else (pixels_per_cm, pixels_per_cm),
        "resolutionunit": None if pixels_per_cm is None else "CENTIMETER",
    }


def write_tiff(path: Path, frame: CameraFrame, snapshot_metadata: SnapshotMetadata) -> None:
    """Write the unchanged pixel values of the camera, 8 or 16 bits, completely or not at all.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    # Imported here because the import takes 0.1 s, which would delay the start of the window.
    import tifffile

    with replace_file(path) as file:
        tifffile.imwrite(
            file,
            frame.pixels,
            description=format_description(frame, snapshot_metadata),
            **make_tiff_arguments(frame, snapshot_metadata),
        )


def write_png(
    path: Path,
    displayed_pixels: NDArray[np.uint8],
    frame: CameraFrame,
    snapshot_metadata: SnapshotMetadata,
) -> None:
    """Write a picture as displayed, completely or not at all.

    Parameters
    ----------
    path : Path
    displayed_pixels : (rows, columns) or (rows, columns, 3)
        The displayed picture, with contrast and colours.
    frame : CameraFrame
        The picture of the camera.
    snapshot_metadata : SnapshotMetadata

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    # Imported here because the import is slow.
    from PIL import Image, PngImagePlugin

    text = PngImagePlugin.PngInfo()
    text.add_text("Software", format_program_version())
    text.add_text("Description", format_description(frame, snapshot_metadata))
    scale = {"dpi": (0.0254 / snapshot_metadata.pixel_m,) * 2} if snapshot_metadata.pixel_m else {}
    with replace_file(path) as file:
        Image.fromarray(np.ascontiguousarray(displayed_pixels)).save(
            file, "PNG", pnginfo=text, **scale
        )


class StackPage(NamedTuple):
    """A picture of a stack.

    Attributes
    ----------
    focus_m : float
        Position of the focus.
    frame : CameraFrame
    command, measured : mapping axis -> float
        All axes, m or rad.
    """

    focus_m: float
    frame: CameraFrame
    command: Mapping[str, float]
    measured: Mapping[str, float]


def write_stack(
    path: Path, pages: Sequence[StackPage], axis: str, snapshot_metadata: SnapshotMetadata
) -> None:
    """Write one page with unchanged pixel values for each position, completely or not at all.

    The description of a page is the JSON of a snapshot with the additional keys ``focus_axis``,
    ``focus_m``, ``page`` and ``pages``.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    # Imported here because the import is slow.
    import tifffile

    with replace_file(path) as file, tifffile.TiffWriter(file) as writer:
        for page_number, page in enumerate(pages, 1):
            page_metadata = replace(snapshot_metadata, command=page.command, measured=page.measured)
            metadata = json.loads(format_description(page.frame, page_metadata))
            metadata |= {"focus_axis": axis, "focus_m": page.focus_m}
            metadata |= {"page": page_number, "pages": len(pages)}
            writer.write(
                page.frame.pixels,
                description=json.dumps(metadata),
                contiguous=False,
                **make_tiff_arguments(page.frame, snapshot_metadata),
            )
