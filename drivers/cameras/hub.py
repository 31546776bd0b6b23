"""All available cameras of every source, each made by its key."""

import logging
import time
from collections.abc import Mapping
from types import MappingProxyType
from typing import Self

from rotemina.drivers.cameras.camera import Camera, CameraIdentity, Wait
from rotemina.drivers.cameras.errors import CameraRefusedError
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.clock import Clock
from rotemina.drivers.registry import make_sources
from rotemina.sim.messages import message

_LOG = logging.getLogger(__name__)

CAMERAS = "rotemina.cameras"


class CameraHub:
    """Asks all sources; may wait some ms for them, and has no thread.

    Parameters
    ----------
    sources : mapping of str to CameraSource
        By the name of their entry point, or one that the program gives.
    broken : mapping of str to str
        Sources that could not be loaded, and why.
    """

    def __init__(
        self,
        sources: Mapping[str, CameraSource],
        broken: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self.sources = MappingProxyType(dict(sources))
        self._broken = dict(broken)
        self._failed: dict[str, str] = {}
        self._logged: dict[str, str] = {}

    @classmethod
    def installed(
        cls,
        own: Mapping[str, CameraSource] = MappingProxyType({}),
        *,
        clock: Clock = time.monotonic,
        wait: Wait = time.sleep,
    ) -> Self:
        """Return a hub of all installed sources and those that the program makes itself."""
        return cls(*make_sources(CAMERAS, CameraSource, own, clock=clock, wait=wait))

    @property
    def problems(self) -> Mapping[str, str]:
        """Problems by source name, as of the latest :meth:`look`."""
        return MappingProxyType({**self._broken, **self._failed})

    def look(self) -> tuple[CameraIdentity, ...]:
        """Return the cameras that are there; a bad source is named and left out."""
        found: dict[str, CameraIdentity] = {}
        failed: dict[str, str] = {}
        for name, source in self.sources.items():
            try:
                for identity in source.devices():
                    found.setdefault(identity.key, identity)
                problem = source.problem
            except Exception as error:  # a plugin may raise anything; the others are to be found
                self._log(name, error)
                problem = message(
                    "engine",
                    "it cannot look for cameras; the log has the cause. Update or remove this "
                    "plugin",
                )
            if problem is not None:
                failed[name] = problem
        self._failed = failed
        return tuple(found.values())

    def _log(self, name: str, error: Exception) -> None:
        """Log why a source failed, unless it failed for the same reason at the last look."""
        if self._logged.get(name) != repr(error):
            self._logged[name] = repr(error)
            _LOG.warning("cameras of %s cannot be looked for", name, exc_info=error)

    def camera(self, identity: CameraIdentity) -> Camera:
        """Return a camera, not yet open.

        Raises
        ------
        CameraRefusedError
            If its source is not installed, or cannot be used.
        """
        source = self.sources.get(identity.source)
        if source is None:
            known = ", ".join(self.sources)
            raise CameraRefusedError(
                message(
                    "engine", "{name}: there is no source {source} of cameras; installed: {known}"
                ).fill(name=identity.name, source=repr(identity.source), known=known)
            )
        return source.camera(identity)

    def addressed(self, source: str, address: str) -> Camera:
        """Return the camera that an operator has named, not yet open; errors as above."""
        if source not in self.sources:
            known = ", ".join(self.sources)
            raise CameraRefusedError(
                message(
                    "engine", "there is no source {source} of cameras; available: {known}"
                ).fill(source=repr(source), known=known)
            )
        return self.camera(self.sources[source].addressed(address))
