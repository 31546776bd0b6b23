"""All sources of cameras together."""

import pytest

from rotemina.drivers.cameras.camera import CameraIdentity
from rotemina.drivers.cameras.errors import CameraRefusedError
from rotemina.drivers.cameras.hub import CameraHub
from rotemina.drivers.cameras.opencv import OpenCvSource
from rotemina.drivers.cameras.sequence import ImageSequences
from rotemina.drivers.cameras.source import CameraSource


class Broken(CameraSource):
    def devices(self):
        raise OSError("bus error")

    def camera(self, identity):
        raise AssertionError


def test_the_built_in_sources_are_installed():
    hub = CameraHub.installed({"own": ImageSequences()})
    assert {"own", "opencv", "sequence", "micromanager"} <= hub.sources.keys()


def test_a_bad_source_is_named_and_the_others_are_found(clock, caplog):
    usb = OpenCvSource(clock=clock, listed=lambda: {"0": "Cam"})
    hub = CameraHub({"bad": Broken(), "opencv": usb}, {"worse": "cannot be imported"})
    assert hub.look() == (CameraIdentity("opencv:0", "Cam", "opencv"),)
    assert "the log has the cause" in hub.problems["bad"]
    hub.look()
    assert [record.exc_info[1].args for record in caplog.records] == [("bus error",)]
    assert hub.problems["worse"] == "cannot be imported"


def test_a_camera_by_its_identity_and_by_its_address(clock, capture):
    hub = CameraHub({"opencv": OpenCvSource(clock=clock, capture=capture)})
    camera = hub.addressed("opencv", "1")
    assert camera.identity.key == "opencv:1"
    assert hub.camera(camera.identity).identity == camera.identity
    with pytest.raises(CameraRefusedError, match="available: opencv"):
        hub.addressed("gige", "1")
    with pytest.raises(CameraRefusedError, match="no source 'gige'"):
        hub.camera(CameraIdentity("gige:1", "Cam", "gige"))


def test_a_source_without_addresses():
    with pytest.raises(CameraRefusedError, match="choose a listed one"):
        Broken().addressed("x")
