"""The cameras of all sources: finds them, and creates them from their identity."""

import logging
import time
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Self

from rotemina.drivers.cameras.camera import Camera, CameraIdentity, Wait
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.contract import CameraRefusedError, Clock, make_sources
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.messages import message

_LOG = logging.getLogger(__name__)

CAMERA_GROUP = "rotemina.cameras"


class CameraHub:
    """Access to the cameras of all sources.

    It has no thread. A call may wait some milliseconds for the sources.

    Parameters
    ----------
    sources : mapping of str to CameraSource
        By the name of the entry point, or by a name that the program chooses.
    broken : mapping of str to str
        Why a source could not be loaded, by its name.
    """

    def __init__(
        self,
        sources: Mapping[str, CameraSource],
        broken: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self.sources = MappingProxyType(dict(sources))
        self._broken = dict(broken)
        self._search_problems: dict[str, str] = {}
        self._logged_errors: dict[str, str] = {}

    @classmethod
    def from_plugins(
        cls,
        program_sources: Mapping[str, CameraSource] = MappingProxyType({}),
        *,
        clock: Clock = time.monotonic,
        wait: Wait = time.sleep,
    ) -> Self:
        """Create a hub of all installed sources and the program's own sources."""
        return cls(
            *make_sources(CAMERA_GROUP, CameraSource, program_sources, clock=clock, wait=wait)
        )

    @property
    def problems(self) -> Mapping[str, str]:
        """Problems by the name of the source, as of the latest :meth:`find_cameras`."""
        return MappingProxyType({**self._broken, **self._search_problems})

    def find_cameras(self) -> tuple[CameraIdentity, ...]:
        """Return the available cameras; a source that fails is reported in :attr:`problems`."""
        cameras: dict[str, CameraIdentity] = {}
        search_problems: dict[str, str] = {}
        for name, source in self.sources.items():
            try:
                for identity in source.devices():
                    cameras.setdefault(identity.key, identity)
                problem = source.problem
            # A plugin may raise any exception; the cameras of other sources must still be found.
            except Exception as error:
                self._log(name, error)
                problem = message(
                    "engine",
                    "it cannot search for cameras; see the log for the cause. Update or remove "
                    "this plugin",
                )
            if problem is not None:
                search_problems[name] = problem
        self._search_problems = search_problems
        return tuple(cameras.values())

    def _log(self, name: str, error: Exception) -> None:
        """Log why a source failed, unless it failed for the same reason in the last search."""
        if self._logged_errors.get(name) != repr(error):
            self._logged_errors[name] = repr(error)
            _LOG.warning("the search for cameras of %s failed", name, exc_info=error)

    def make_camera(self, identity: CameraIdentity) -> Camera:
        """Return a closed camera with this identity.

        Raises
        ------
        CameraRefusedError
            If its source is not installed, or cannot be used.
        """
        source = self.sources.get(identity.source)
        if source is None:
            installed = ", ".join(self.sources)
            raise CameraRefusedError(
                "{name}: there is no camera source {source}; installed: {known}",
                name=identity.name,
                source=repr(identity.source),
                known=installed,
            )
        return source.camera(identity)

    def camera_at_address(self, source: str, address: str) -> Camera:
        """Return a closed camera at an address of a source.

        Raises
        ------
        CameraRefusedError
            If there is no such source, or the address is not valid.
        """
        if source not in self.sources:
            available = ", ".join(self.sources)
            raise CameraRefusedError(
                "there is no camera source {source}; available: {known}",
                source=repr(source),
                known=available,
            )
        return self.make_camera(self.sources[source].parse_address(address))

    # Former names, which work for one more release.
    addressed = FormerMember("camera_at_address")
    camera = FormerMember("make_camera")
    installed = FormerMember("from_plugins")
    look = FormerMember("find_cameras")


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        CAMERAS="CAMERA_GROUP",
    )
