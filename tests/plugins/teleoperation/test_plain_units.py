"""Scales and felt dynamics in words."""

from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance
from rotemina.plugins.teleoperation.plain_units import (
    felt_text,
    position_text,
    rate_text,
    tilt_text,
)


def test_scales_are_told_in_plain_units():
    assert position_text(2e-5, "m", "tip", 1e-2) == "1 mm of stick = 2 µm of tip"
    assert position_text(1e-4, "rad", "thx", 1e-2) == "1 mm of stick = 10 µrad of thx"
    assert rate_text(5e-4, "m") == "full deflection = 500 µm/s"
    glide = VirtualImpedance.gliding(5e-4, 0.3).felt
    assert felt_text(glide, "m") == "full deflection: 500 µm/s, time constant 0.3 s"
    spring = VirtualImpedance.sprung(1e-3, 1.5, 0.5).felt
    assert felt_text(spring, "m", 0.1) == (
        "full deflection: 100 µm, 1.5 Hz, damping ratio 0.5, time constant 0.212 s"
    )


def test_a_tilt_is_told_in_both_units():
    assert tilt_text(1.16355e-3) == "240 arcsec (1.16 mrad)"
