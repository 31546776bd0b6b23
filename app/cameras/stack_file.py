"""A z-stack as a multi-page TIFF, with the data of each page."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from rotemina.app.cameras.snapshot import Circumstances, description, tiff_tags
from rotemina.drivers.cameras.frame import Frame
from rotemina.sim.whole_files import replaced


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
    import tifffile  # takes a tenth of a second, for which no start of the window waits

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
