"""Files that appear completely or not at all."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from os import PathLike, fspath
from pathlib import Path
from typing import BinaryIO
from uuid import uuid4

from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import message


class FileWriteError(InputError):
    """A file that cannot be written."""


@contextmanager
def replaced(path: str | PathLike[str]) -> Iterator[BinaryIO]:
    """Open a file that takes the place of ``path`` when it is complete, and only then.

    Raises
    ------
    FileWriteError
        If the place is a folder, or nothing can be written there.
    """
    name = fspath(path)
    place = Path(os.path.realpath(name))
    draft = place.with_name(f".{place.name[:40]}.{uuid4().hex}.part")
    try:
        if place.is_dir():
            raise FileWriteError(
                message("engine", "{name} is a folder; name a file in it").fill(name=name)
            )
        if place.exists() and not place.is_file():
            raise FileWriteError(
                message("engine", "{name} is a device, not a file; name a file").fill(name=name)
            )
        with draft.open("xb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        draft.replace(place)
    except OSError as error:
        raise FileWriteError(
            message(
                "engine",
                "{name} cannot be written ({reason}); choose another folder, or free disk space",
            ).fill(name=name, reason=reason_of(error))
        ) from error
    finally:
        with suppress(OSError):  # such as a folder in its way that is a file
            draft.unlink()
