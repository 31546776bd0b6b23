"""Errors of the model layer; a user can cause most of them by a file or a request."""

from typing import ClassVar

from rotemina.sim.messages import Field, Message, SystemText


class MessageError(Exception):
    """An error whose text is a message: ``raise LimitError("{axis}: not above {limit}", …)``.

    Parameters
    ----------
    *arguments : object
        The text: a template, marked for translation by standing here as a literal; or a message
        that is complete already, or a text that is shown unchanged (``PlainText``, ``SystemText``).
    **fields : Field
        The values of the template's fields.

    Attributes
    ----------
    context : str
        Context of the templates in the translation catalogue. A class sets it for its errors.
    """

    context: ClassVar[str] = "engine"

    def __init__(self, *arguments: object, **fields: Field) -> None:
        # An error that is also an OSError may have two arguments: a number and a text.
        if len(arguments) == 1 and arguments[0] and type(arguments[0]) is str:
            arguments = (Message(self.context, arguments[0], tuple(fields.items())),)
        elif fields:
            raise TypeError(f"{type(self).__name__} has fields without a template: {list(fields)}")
        super().__init__(*arguments)

    def __str__(self) -> str:
        """Return the text itself, since a copy would lose the template and the fields.

        An error without a text is shown by the name of its class.
        """
        text = self.args[0] if len(self.args) == 1 else None
        return (text if isinstance(text, str) else super().__str__()) or type(self).__name__


class InputError(MessageError, ValueError):
    """A file or request that cannot be used.

    The message says what is wrong and where, the value, the bound and what to do. The command line
    prints it and exits with status 2. The window shows it as a notice.
    """


def describe_exception(error: BaseException) -> str:
    """Return the text of an error for use in a message; text of the system is marked as such."""
    if isinstance(error, MessageError):
        return str(error)
    return SystemText(getattr(error, "strerror", None) or str(error) or type(error).__name__)


class SealError(InputError):
    """A label that differs from the sealed one."""


class SensorCalibrationError(InputError):
    """A calibration that cannot be made, read or used."""


class CompensationError(InputError):
    """A record, a file or a request that does not suit an inverse."""


class ConvergenceError(CompensationError):
    """A training that did not converge; the previous result is kept."""


class EffectError(InputError):
    """Raised if an effect cannot act on its axis, or a parameter is out of bounds."""


class BrokenEffectError(EffectError):
    """Raised if the code of an effect fails.

    Its step function does not compile, or the numbers that it needs cannot be computed from the
    parameters.
    """


class ExcitationRequestError(InputError):
    """An excitation with invalid parameters, or one that exceeds limits of the machine."""


class FeedbackError(InputError):
    """Gains, limits or a loop that cannot be used."""


class LostLoopError(FeedbackError):
    """A loop whose sensor or actuator does not respond."""


class UnstableError(FeedbackError):
    """Gains with which the loop would be unstable, or closer to instability than allowed."""


class FileWriteError(InputError):
    """A file that cannot be written."""


class GapError(InputError):
    """Records and a robot that cannot be diagnosed together."""

    context = "gap"


class IdentificationError(InputError):
    """Signals or settings from which no model can be identified."""


class TimeGridError(IdentificationError):
    """The record is not sampled at equal intervals."""


class TooShortError(IdentificationError):
    """The record has too few samples, segments, periods or experiments."""


class InsufficientExcitationError(IdentificationError):
    """The input is constant, or does not excite enough to determine the result."""


class IdentificationSettingError(IdentificationError):
    """An order, delay, factor or band is out of range."""


class ModelFileError(InputError):
    """A file of published models that cannot be read."""


class ChainError(InputError):
    """A robot whose axes do not form the hybrid chain."""


class SceneError(InputError):
    """A microscope, a pin or a cell that cannot be drawn."""


class StateSpaceError(InputError):
    """State-space matrices that cannot be computed."""


class PlantError(InputError):
    """Error for a robot and commands that cannot be simulated together."""


class PlateError(InputError):
    """A plate, mesh or load that is not valid."""


class PluginError(InputError):
    """A plugin that cannot be used."""


class RecordError(InputError):
    """A record or trajectory that cannot be read, written or used."""


class RobotFileError(InputError):
    """Error for a robot file that cannot be read or does not describe a possible machine."""


class ShapingError(InputError):
    """A profile, shaper or fit that cannot be made.

    The message names the quantity, its value and its bound.
    """


class OutOfLimitsError(InputError):
    """A target or trajectory outside the limits of the machine."""


class TrajectoryError(InputError):
    """A trajectory that does not fit the robot, regardless of its limits."""


class TuningError(InputError):
    """A search, a point or a file of a tuning that is not valid."""


class UnitError(InputError):
    """A unit that does not exist or belongs to the wrong quantity."""


class VisionError(InputError):
    """An image or a set of images that does not show the requested object."""


class RegistrationError(VisionError):
    """A shift between two images that cannot be determined."""


class StageCalibrationError(VisionError):
    """Moves and image shifts that give no reliable calibration."""
