"""The form of the camera settings, with a fake microscope."""

from dataclasses import replace

import pytest

from rotemina.drivers.cameras import (
    CameraIdentity,
    CameraSettings,
    CameraTrigger,
    PixelType,
)
from rotemina.plugins.microscope.camera_section import CameraSection, CameraSettingsSection


@pytest.fixture
def section(qtbot, microscope, window):
    microscope.feed(
        description=replace(
            microscope.status.feed.description,
            pixel_types=(PixelType.COLOUR, PixelType.MONO16, PixelType.MONO8),
        )
    )
    settings_section = CameraSettingsSection(window.workbench, microscope, None)
    qtbot.addWidget(settings_section)
    settings_section.refresh(microscope.status)
    return settings_section


def get_selection(section):
    return section.pixel_type.currentData(), section.trigger.currentData()


def test_settings_changed_elsewhere_are_shown(section, microscope):
    # Without a requested type, the camera uses its first one.
    assert get_selection(section) == (PixelType.COLOUR, CameraTrigger.FREE)
    settings = CameraSettings(pixel_type=PixelType.MONO16, trigger=CameraTrigger.SOFTWARE)
    microscope.feed(settings=settings)
    section.refresh(microscope.status)
    assert get_selection(section) == (PixelType.MONO16, CameraTrigger.SOFTWARE)
    microscope.feed(settings=CameraSettings())
    section.refresh(microscope.status)
    assert get_selection(section) == (PixelType.COLOUR, CameraTrigger.FREE)


def test_a_reopened_camera_shows_its_own_settings(section, microscope):
    description = microscope.status.feed.description
    section.pixel_type.select(PixelType.MONO8)
    section.trigger.select(CameraTrigger.SOFTWARE)
    microscope.feed(description=None)
    section.refresh(microscope.status)
    microscope.feed(description=description)
    section.refresh(microscope.status)
    assert get_selection(section) == (PixelType.COLOUR, CameraTrigger.FREE)


def test_the_operator_can_select_another_camera_than_the_open_one(qtbot, microscope, window):
    section = CameraSection(window.workbench, microscope)
    qtbot.addWidget(section)
    other_camera = CameraIdentity("fake:1", "Other", "fake")
    microscope.change(cameras=(*microscope.status.cameras, other_camera))
    section.refresh(microscope.status)
    assert section.choice.currentData() == "fake:0"
    section.choice.select("fake:1")
    section.refresh(microscope.status)
    assert section.choice.currentData() == "fake:1"
