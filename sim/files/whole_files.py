"""Atomic writing of files: a file appears completely or not at all."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from os import PathLike, fspath
from pathlib import Path
from typing import BinaryIO
from uuid import uuid4

from rotemina.sim.errors import FileWriteError, describe_exception


@contextmanager
def replace_file(path: str | PathLike[str]) -> Iterator[BinaryIO]:
    """Open a new file that replaces ``path`` when the context ends without an error.

    Raises
    ------
    FileWriteError
        If ``path`` is a folder or a device, or cannot be written.
    """
    name = fspath(path)
    target = Path(os.path.realpath(name))
    temporary_file = target.with_name(f".{target.name[:40]}.{uuid4().hex}.part")
    try:
        if target.is_dir():
            raise FileWriteError("{name} is a folder; name a file in it", name=name)
        if target.exists() and not target.is_file():
            raise FileWriteError("{name} is a device, not a file; name a file", name=name)
        with temporary_file.open("xb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        temporary_file.replace(target)
    except OSError as error:
        raise FileWriteError(
            "{name} cannot be written ({reason}); choose another folder, or free disk space",
            name=name,
            reason=describe_exception(error),
        ) from error
    finally:
        # Deleting fails if a parent of the path is a file, for example.
        with suppress(OSError):
            temporary_file.unlink()
