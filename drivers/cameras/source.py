"""The base class of camera sources, which are plugins (``rotemina.cameras``)."""

import time
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

from rotemina.drivers.cameras.camera import Camera, CameraIdentity, Wait
from rotemina.drivers.contract import CameraRefusedError, Clock
from rotemina.sim.compatibility import FormerMember, adopt_former_methods
from rotemina.sim.plugin_points import API_VERSIONS


class CameraSource(ABC):
    """Base class of sources, which find cameras of one kind.

    The entry points of ``rotemina.cameras`` are subclasses.

    Parameters
    ----------
    clock, wait : callable
        See :class:`Camera`. The class of an entry point is called with only these arguments.
    """

    #: The version of this interface for which the class was written.
    api_version: ClassVar[int] = API_VERSIONS["rotemina.cameras"]
    #: Name of this kind of camera for display.
    name: ClassVar[str] = "camera"

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        adopt_former_methods(cls)

    #: Kind of address that the operator can enter for a camera that is not listed; may be empty.
    address_hint: ClassVar[str] = ""

    def __init__(self, *, clock: Clock = time.monotonic, wait: Wait = time.sleep) -> None:
        self.clock = clock
        self.wait = wait

    @property
    def problem(self) -> str | None:
        """A message for the operator that says why no cameras are found; None if there is none."""
        return None

    @abstractmethod
    def devices(self) -> Sequence[CameraIdentity]:
        """Return the available cameras, if any; must return within a few milliseconds."""

    def parse_address(self, address: str) -> CameraIdentity:
        """Return the identity of the camera at an address that the operator entered.

        Only opening the camera shows whether it exists.

        Raises
        ------
        CameraRefusedError
            If the address is not valid for this source.
        """
        raise CameraRefusedError(
            "{name}: {address}: choose a camera from the list",
            name=self.name,
            address=repr(address),
        )

    @abstractmethod
    def camera(self, identity: CameraIdentity) -> Camera:
        """Return a closed camera with this identity."""

    # Former names, which work for one more release.
    addressed = FormerMember("parse_address")
