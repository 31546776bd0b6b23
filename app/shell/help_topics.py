"""Which page explains a message: a table by where its error, event or log record comes from."""

from collections.abc import Callable, Hashable
from typing import NamedTuple

from PySide6.QtCore import QObject

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.language import error_message, spoken
from rotemina.app.shell.notice_identity import repeat_key

_LIMITS = "motion.md#limits"
_FAULTS = "faults.md#what-a-message-means"
Until = Callable[[SessionState], bool]

#: Module, or class in it -> page. The longest name counts, and a class before those it is made of.
PAGES = {
    "rotemina.app.bench": "gap-diagnosis.md",
    "rotemina.app.blind": "blind-test.md",
    "rotemina.app.calibration": "calibration.md",
    "rotemina.app.calibration.health_book": "calibration.md#health-card",
    "rotemina.app.cameras": "cameras.md#what-can-be-wrong",
    "rotemina.app.driver_settings": "connection.md#device",
    "rotemina.app.microscope": "microscope.md#in-the-window",
    "rotemina.app.motion": "motion.md",
    "rotemina.app.motion.mailbox": "motion.md#states",
    "rotemina.app.motion.penetration": "penetration.md",
    "rotemina.app.motion.playback": "motion.md#playing-by-hand",
    "rotemina.app.motion.recording": "recording.md",
    "rotemina.app.motion.saved_positions": "control.md#the-file-of-positions",
    "rotemina.app.motion.state.Alarmed": _LIMITS,
    "rotemina.app.motion.state.CommandRefused": _LIMITS,
    "rotemina.app.motion.state.Faulted": _FAULTS,
    "rotemina.app.motion.teleoperation": "teleoperation.md",
    "rotemina.app.motion.teleoperation.axis_calibration": "input-mapping.md#calibration-files",
    "rotemina.app.motion.teleoperation.profile": "input-mapping.md#profiles-by-hand",
    "rotemina.app.plugin_kit": "plugins.md",
    "rotemina.app.records": "recording.md#the-library",
    "rotemina.app.scene": "view3d.md",
    "rotemina.app.shell": "window.md",
    "rotemina.app.shell.panel_host": "plugins.md#what-a-bad-plugin-can-do",
    "rotemina.app.shell.operator_requests": "connection.md#device",
    "rotemina.drivers": "drivers.md",
    "rotemina.drivers.cameras": "cameras.md#what-can-be-wrong",
    "rotemina.drivers.errors": _FAULTS,
    "rotemina.drivers.errors.ConnectionLostError": "connection.md#device",
    "rotemina.drivers.errors.DriverTimeoutError": "connection.md#device",
    "rotemina.drivers.errors.LimitError": _LIMITS,
    "rotemina.drivers.errors.ProtocolError": "protocol.md",
    "rotemina.drivers.errors.StateError": "connection.md#state",
    "rotemina.drivers.gcode": "drivers.md#a-driver-for-other-electronics",
    "rotemina.drivers.inputs": "inputs.md#when-a-joystick-is-missing",
    "rotemina.drivers.inputs.script": "inputs.md#scripts",
    "rotemina.drivers.mc68hc11": "protocol.md",
    "rotemina.drivers.registry": "plugins.md#what-a-bad-plugin-can-do",
    "rotemina.drivers.settings": "connection.md#device",
    "rotemina.drivers.virtual_board": "faults.md#faults-on-purpose",
    "rotemina.sim.blind": "blind-test.md",
    "rotemina.sim.calibration": "calibration.md#refused",
    "rotemina.sim.comparison": "comparison.md",
    "rotemina.sim.compensate": "compensation.md",
    "rotemina.sim.effects": "effects.md",
    "rotemina.sim.excitation": "excitations.md#limits",
    "rotemina.sim.feedback": "tuning.md",
    "rotemina.sim.gap": "gap-diagnosis.md#refusals-and-cautions",
    "rotemina.sim.identification": "identification.md",
    "rotemina.sim.kinematics": "kinematics.md",
    "rotemina.sim.microscope": "microscope.md#the-simulated-microscope",
    "rotemina.sim.modes": "kinematics.md#modes",
    "rotemina.sim.plant": "simulation.md",
    "rotemina.sim.plate": "plate.md",
    "rotemina.sim.plugin_points": "plugins.md#what-a-bad-plugin-can-do",
    "rotemina.sim.records": "file-formats.md#records-and-trajectories",
    "rotemina.sim.robot": "file-formats.md#robot-files",
    "rotemina.sim.shaping": "excitations.md",
    "rotemina.sim.simulation": "simulation.md",
    "rotemina.sim.trajectory": "trajectory.md",
    "rotemina.sim.trajectory.axis_limits.OutOfLimitsError": _LIMITS,
    "rotemina.sim.tuning": "tuning.md",
    "rotemina.sim.units": "file-formats.md#records-and-trajectories",
    "rotemina.sim.vision": "vision.md#limits",
    "rotemina.sim.whole_files": "file-formats.md#export",
}


class Remedy(NamedTuple):
    """What mends a message's cause: the words of a button, and what it does."""

    words: str
    do: Callable[[], object]


class Explained(str):
    """A message with what its notice needs to know.

    Attributes
    ----------
    page : str
        The page that explains it, "" where none does.
    remedy : Remedy or None
    subject : hashable or None
        The request that it is about: it is settled when that is done.
    until : callable or None
        Returns whether it is settled, by the state of the session.
    is_refusal : bool
        Whether nothing has happened but that a request was not taken.
    key : hashable
        What it has in common with its repeats.
    """

    __slots__ = ("is_refusal", "key", "page", "remedy", "subject", "until")
    page: str
    remedy: Remedy | None
    subject: Hashable | None
    until: Until | None
    is_refusal: bool
    key: Hashable

    def __new__(
        cls,
        text: str,
        page: str = "",
        remedy: Remedy | None = None,
        *,
        subject: Hashable | None = None,
        until: Until | None = None,
        is_refusal: bool = False,
    ) -> "Explained":
        """Return a message in the language of the window; one that is explained stays so."""
        made = super().__new__(cls, spoken(text))
        known = text if isinstance(text, Explained) else None
        made.page = (known.page if known else "") or page
        made.remedy = remedy or (known.remedy if known else None)
        made.subject = subject if subject is not None or known is None else known.subject
        made.until = until or (known.until if known else None)
        made.is_refusal = is_refusal or (known is not None and known.is_refusal)
        made.key = known.key if known else repeat_key(text)
        return made


def explained(error: BaseException, *, refused: Hashable | None = None) -> Explained:
    """Return what an error says, in the language of the window, with the page on such errors.

    ``refused`` is the request that was not taken, if it is a refusal.
    """
    return Explained(
        error_message(error), page_for(error), subject=refused, is_refusal=refused is not None
    )


def page_of(text: str) -> str:
    """Return the page that a message knows."""
    return text.page if isinstance(text, Explained) else ""


def page_for(about: object) -> str:
    """Return the page on an error, an event or a widget in a panel; a text is the page itself."""
    if isinstance(about, str):
        return about
    if isinstance(about, QObject) and (page := page_at(about)):
        return page
    for kind in type(about).__mro__:
        if page := page_by_name(f"{kind.__module__}.{kind.__qualname__}"):
            return page
    return ""


def page_at(part: QObject | None) -> str:
    """Return the page of the panel that a widget is in, "" where there is none."""
    while part is not None:
        page = getattr(part, "help_page", "")  # panels know this module, not it them
        if page and isinstance(page, str):
            return page
        part = part.parent()
    return ""


def page_by_name(name: str) -> str:
    """Return the page on a module or what is in it, "" where there is none."""
    while name:
        if name in PAGES:
            return PAGES[name]
        name = name.rpartition(".")[0]
    return ""
