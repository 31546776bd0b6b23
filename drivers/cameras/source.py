"""Camera sources, which are plugins (``rotemina.cameras``)."""

import time
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

from rotemina.drivers.cameras.camera import Camera, CameraIdentity, Wait
from rotemina.drivers.cameras.errors import CameraRefusedError
from rotemina.drivers.clock import Clock
from rotemina.sim.messages import message
from rotemina.sim.plugin_points import API_VERSIONS


class CameraSource(ABC):
    """Finds cameras of one kind; what an entry point of ``rotemina.cameras`` names.

    Parameters
    ----------
    clock, wait : callable
        As of :class:`Camera`. An entry point's class is made with these alone.
    """

    #: The version of this interface that the class was written for.
    api_version: ClassVar[int] = API_VERSIONS["rotemina.cameras"]
    #: How screens call this kind of camera.
    name: ClassVar[str] = "camera"
    #: What can be typed to name a camera that no list shows; empty: nothing.
    address_hint: ClassVar[str] = ""

    def __init__(self, *, clock: Clock = time.monotonic, wait: Wait = time.sleep) -> None:
        self.clock = clock
        self.wait = wait

    @property
    def problem(self) -> str | None:
        """Why it can find nothing at the moment, in words for the operator; None if it can."""
        return None

    @abstractmethod
    def devices(self) -> Sequence[CameraIdentity]:
        """Return the available cameras; may take some ms, never raises for none."""

    def addressed(self, address: str) -> CameraIdentity:
        """Return which camera an operator means; whether it is there is found out by opening it.

        Raises
        ------
        CameraRefusedError
            If no camera can be named like this.
        """
        raise CameraRefusedError(
            message("engine", "{name}: {address}: choose a listed one").fill(
                name=self.name, address=repr(address)
            )
        )

    @abstractmethod
    def camera(self, identity: CameraIdentity) -> Camera:
        """Return the camera of an identity, not yet open."""
