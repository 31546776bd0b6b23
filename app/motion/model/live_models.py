"""The models that run in parallel with a device: the nominal one and the one in use."""

from typing import NamedTuple

import numpy as np

from rotemina.app.motion.model.bracketed_model import BracketedModel
from rotemina.app.motion.model.command_memory import CommandMemory
from rotemina.app.motion.model.live_model import LiveModel
from rotemina.app.motion.model.model_in_use import ModelInUse
from rotemina.drivers.contract import DeviceSamples, Driver
from rotemina.sim.arrays import FloatArray


class ModelOutputs(NamedTuple):
    """Outputs of the models for samples, each (n, axes), m or rad; NaN where not finite.

    Attributes
    ----------
    in_use
        Output of the model in use, which the window shows.
    nominal
        Output of the model that the robot file describes.
    without_contact_effects
        Output of the model in use without effects that may come from a contact during diagnosis.
    doubt
        Possible error of ``in_use`` due to the unknown past of the machine.
    """

    in_use: FloatArray
    nominal: FloatArray
    without_contact_effects: FloatArray
    doubt: FloatArray


class PreparedModel(NamedTuple):
    """A model and its runs, which have already followed the earlier commands of the machine."""

    model: ModelInUse
    # The run of the model, then the run without contact effects if the model has such effects.
    runs: tuple[BracketedModel, ...]

    @classmethod
    def of(cls, model: ModelInUse, memory: CommandMemory) -> "PreparedModel":
        """Prepare a model. This may take a second, and may be done on any thread.

        Raises
        ------
        EffectError
            If an effect cannot be used.
        """
        if not model.is_corrected:
            return cls(model, ())
        robots = [model.robot]
        if model.contact_like_effects:
            robots.append(model.without_contact)
        prepared = cls(model, tuple(BracketedModel(robot, model.offsets) for robot in robots))
        prepared.catch_up(memory)
        return prepared

    def catch_up(self, memory: CommandMemory) -> None:
        """Follow the commands that were added to the memory since the last call."""
        time_s, command = memory.read_history()
        for run in self.runs:
            is_later = time_s > run.time_s
            if is_later.any():
                run.predict(time_s[is_later], command[is_later])


class SessionModels:
    """The nominal model and the model in use, both owned by the session's worker.

    ``model`` is replaced as a whole, so any thread may read it.
    """

    def __init__(self, driver: Driver) -> None:
        self.model = ModelInUse.make_nominal(driver)
        self.memory = CommandMemory()
        self._nominal = LiveModel(driver.robot)
        self._runs: tuple[BracketedModel, ...] = ()

    @property
    def unsettled_axes(self) -> tuple[str, ...]:
        """The axes whose past is not known well enough for the model in use."""
        return self._runs[0].unsettled_axes if self._runs else ()

    def prepare(self) -> None:
        """Run the model once, so that no device has to wait while compiled code is loaded."""
        self._nominal.prepare()

    def begin_connection(self) -> None:
        """Forget the commands of the previous connection, which had its own device time."""
        self.memory.clear()
        self.restart()

    def restart(self) -> None:
        """Start again from rest at the next command, with an unknown past."""
        self._nominal.restart()
        for run in self._runs:
            run.restart()

    def use_model(self, prepared: PreparedModel) -> None:
        """Use another model from the next sample on."""
        prepared.catch_up(self.memory)
        self.model, self._runs = prepared.model, prepared.runs

    def follow(self, samples: DeviceSamples) -> ModelOutputs:
        """Return the outputs of the models for the next samples."""
        self.memory.add(samples)
        nominal = self._nominal.predict(samples.device_time_s, samples.command)
        if not self._runs:
            return ModelOutputs(nominal, nominal, nominal, np.zeros(nominal.shape))
        predictions = [run.predict(samples.device_time_s, samples.command) for run in self._runs]
        in_use, doubt = predictions[0]
        return ModelOutputs(in_use, nominal, predictions[-1][0], doubt)
