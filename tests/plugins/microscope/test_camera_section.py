"""The form of the camera settings, with a fake microscope."""

from dataclasses import replace

from rotemina.drivers.cameras import (
    CameraIdentity,
    CameraSettings,
    CameraTrigger,
    PixelType,
)
from rotemina.plugins.microscope.camera_section import CameraSection, CameraSettingsSection


def get_selection(section):
    return section.pixel_type.currentData(), section.trigger.currentData()


def test_the_form_follows_the_camera_unless_the_operator_selects_another(qtbot, microscope, window):
    pixel_types = (PixelType.COLOUR, PixelType.MONO16, PixelType.MONO8)
    description = replace(microscope.status.feed.description, pixel_types=pixel_types)
    microscope.feed(description=description)
    section = CameraSettingsSection(window.workbench, microscope, None)
    qtbot.addWidget(section)

    def show(**changes):
        microscope.feed(**changes)
        section.refresh(microscope.status)
        return get_selection(section)

    # Without a requested type, the camera uses its first one.
    assert show() == (PixelType.COLOUR, CameraTrigger.FREE)
    settings = CameraSettings(pixel_type=PixelType.MONO16, trigger=CameraTrigger.SOFTWARE)
    assert show(settings=settings) == (PixelType.MONO16, CameraTrigger.SOFTWARE)
    assert show(settings=CameraSettings()) == (PixelType.COLOUR, CameraTrigger.FREE)
    section.pixel_type.select(PixelType.MONO8)
    section.trigger.select(CameraTrigger.SOFTWARE)
    show(description=None)
    # A reopened camera shows its own settings.
    assert show(description=description) == (PixelType.COLOUR, CameraTrigger.FREE)

    cameras = CameraSection(window.workbench, microscope)
    qtbot.addWidget(cameras)
    other_camera = CameraIdentity("fake:1", "Other", "fake")
    microscope.change(cameras=(*microscope.status.cameras, other_camera))
    cameras.refresh(microscope.status)
    assert cameras.choice.currentData() == "fake:0"
    cameras.choice.select("fake:1")
    cameras.refresh(microscope.status)
    assert cameras.choice.currentData() == "fake:1"
