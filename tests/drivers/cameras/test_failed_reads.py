"""Failed reads of every kind of camera.

One failed read is a lost picture. After one second of failed reads, the camera is lost.
"""

import numpy as np
import pytest
from tests.drivers.cameras.camera_benches import RAW_TEXT, Fault

from rotemina.drivers.cameras import CameraSettings, CameraTrigger
from rotemina.drivers.contract import (
    CameraLostError,
    CameraReadError,
    CameraRefusedError,
    StateError,
)

LONG_TIMEOUT_S, SHORT_TIMEOUT_S = 1.0, 0.1
ADVICE = r"open it again|convert it|truncated or missing"


def grab_until_lost(camera):
    for _ in range(40):
        camera.grab(SHORT_TIMEOUT_S)


def test_one_bad_picture_is_skipped_and_counted(bench, camera):
    first_frame = camera.grab(LONG_TIMEOUT_S)
    for count, fault in enumerate(Fault, 1):
        bench.tap.faults = [fault]
        frame = camera.grab(LONG_TIMEOUT_S)
        assert frame.lost - first_frame.lost == count, fault
        assert frame.number - first_frame.number == 2 * count, fault
        assert frame.pixels.shape == first_frame.pixels.shape
        assert frame.pixels.dtype == first_frame.pixels.dtype


def test_the_first_reads_may_fail(bench):
    bench.tap.faults = [Fault.FAILS, Fault.RAISES, Fault.EMPTY]
    bench.camera.open()
    frame = bench.camera.grab(LONG_TIMEOUT_S)
    assert (frame.lost, frame.number) == (3, 3)
    bench.camera.close()


@pytest.mark.parametrize("fault", [Fault.FAILS, Fault.RAISES, Fault.OTHER_SHAPE])
def test_a_second_without_good_pictures_loses_the_camera(bench, camera, clock, fault, caplog):
    camera.grab(LONG_TIMEOUT_S)
    bench.tap.forever = fault
    began_s = clock()
    with pytest.raises(CameraLostError, match=ADVICE) as lost:
        grab_until_lost(camera)
    assert 0.999 < clock() - began_s < 1.3
    assert RAW_TEXT not in str(lost.value)
    assert (RAW_TEXT in caplog.text) == (fault is Fault.RAISES)


def test_bad_pictures_for_less_than_a_second_do_not_lose_the_camera(bench, camera, clock):
    camera.grab(LONG_TIMEOUT_S)
    for fault in (Fault.FAILS, Fault.RAISES, Fault.EMPTY):
        bench.tap.forever, until_s = fault, clock() + 0.8
        while clock() < until_s:
            assert camera.grab(SHORT_TIMEOUT_S) is None
        bench.tap.forever = None
        assert camera.grab(LONG_TIMEOUT_S) is not None


@pytest.mark.parametrize("fault", [Fault.FAILS, Fault.EMPTY])
def test_a_camera_without_any_good_picture_is_lost(bench, clock, fault):
    bench.tap.forever = fault
    began_s = clock()
    with pytest.raises((CameraLostError, CameraRefusedError), match=rf"{ADVICE}|another file"):
        bench.camera.open(), grab_until_lost(bench.camera)
    assert 0.999 < clock() - began_s < 1.3
    bench.camera.close()
    with pytest.raises(StateError, match="is closed"):
        bench.camera.grab(0.0)


def test_a_trigger_gives_the_next_good_picture(bench, camera):
    if CameraTrigger.SOFTWARE not in camera.description.triggers:
        assert camera.grab(LONG_TIMEOUT_S) is not None
        return
    camera.configure(CameraSettings(trigger=CameraTrigger.SOFTWARE))
    bench.tap.faults = [Fault.FAILS, Fault.EMPTY]
    camera.trigger()
    assert camera.grab(LONG_TIMEOUT_S).lost == 2
    assert camera.grab(SHORT_TIMEOUT_S) is None


@pytest.mark.parametrize("bench", ["plugin_bench"], indirect=True, ids=str)
def test_one_long_read_without_a_picture_does_not_lose_the_camera(bench, camera, clock):
    camera._source.library = lambda: clock.advance(10.0)
    assert camera.grab(SHORT_TIMEOUT_S) is None
    camera._source.library = lambda: np.full((48, 64), 9, np.uint8)
    assert camera.grab(SHORT_TIMEOUT_S).lost == 1


@pytest.mark.parametrize("bench", ["plugin_bench"], indirect=True, ids=str)
def test_the_error_contains_the_message_of_the_last_failure(bench, camera):
    def library():
        raise CameraReadError("Plugin: the shutter is closed; open it")

    camera._source.library = library
    with pytest.raises(CameraLostError, match="the shutter is closed; open it"):
        grab_until_lost(camera)
