"""The hub that combines all camera sources."""

import pytest

from rotemina.drivers.cameras import CameraHub, CameraIdentity, CameraSource
from rotemina.drivers.cameras.opencv import OpenCvSource
from rotemina.drivers.cameras.sequence import ImageSequenceSource
from rotemina.drivers.contract import CameraRefusedError


class BrokenSource(CameraSource):
    def devices(self):
        raise OSError("bus error")

    def camera(self, identity):
        raise AssertionError


def test_the_built_in_sources_are_installed():
    hub = CameraHub.from_plugins({"own": ImageSequenceSource()})
    assert {"own", "opencv", "sequence", "micromanager"} <= hub.sources.keys()


def test_a_broken_source_is_reported_and_the_others_still_work(clock, caplog):
    usb = OpenCvSource(clock=clock, list_cameras=lambda: {"0": "Cam"})
    hub = CameraHub({"bad": BrokenSource(), "opencv": usb}, {"worse": "cannot be imported"})
    assert hub.find_cameras() == (CameraIdentity("opencv:0", "Cam", "opencv"),)
    assert "see the log for the cause" in hub.problems["bad"]
    hub.find_cameras()
    assert [record.exc_info[1].args for record in caplog.records] == [("bus error",)]
    assert hub.problems["worse"] == "cannot be imported"


def test_a_camera_is_made_from_its_identity_or_its_address(clock, capture):
    hub = CameraHub({"opencv": OpenCvSource(clock=clock, capture=capture)})
    camera = hub.camera_at_address("opencv", "1")
    assert camera.identity.key == "opencv:1"
    assert hub.make_camera(camera.identity).identity == camera.identity
    with pytest.raises(CameraRefusedError, match="available: opencv"):
        hub.camera_at_address("gige", "1")
    with pytest.raises(CameraRefusedError, match="no camera source 'gige'"):
        hub.make_camera(CameraIdentity("gige:1", "Cam", "gige"))


def test_a_source_without_addresses_rejects_an_address():
    with pytest.raises(CameraRefusedError, match="choose a camera from the list"):
        BrokenSource().parse_address("x")
