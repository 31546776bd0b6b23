"""Scales and perceived dynamics as texts with units."""

from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance
from rotemina.plugins.teleoperation.plain_units import (
    describe_dynamics,
    format_position_scale,
    format_rate_scale,
    format_tilt,
)


def test_scales_are_described_in_plain_units():
    assert format_position_scale(2e-5, "m", "tip", 1e-2) == "1 mm of stick = 2 µm of tip"
    assert format_position_scale(1e-4, "rad", "thx", 1e-2) == "1 mm of stick = 10 µrad of thx"
    assert format_rate_scale(5e-4, "m") == "full deflection = 500 µm/s"
    gliding = VirtualImpedance.make_gliding(5e-4, 0.3).perceived_dynamics
    assert describe_dynamics(gliding, "m") == "full deflection: 500 µm/s, time constant 0.3 s"
    sprung = VirtualImpedance.make_sprung(1e-3, 1.5, 0.5).perceived_dynamics
    assert describe_dynamics(sprung, "m", 0.1) == (
        "full deflection: 100 µm, 1.5 Hz, damping ratio 0.5, time constant 0.212 s"
    )


def test_a_tilt_is_written_in_both_units():
    assert format_tilt(1.16355e-3) == "240 arcsec (1.16 mrad)"
