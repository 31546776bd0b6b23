"""The models that run beside a device: the nominal one and the one in use."""

from typing import NamedTuple

import numpy as np

from rotemina.app.motion.bracketed_model import BracketedModel
from rotemina.app.motion.command_memory import CommandMemory
from rotemina.app.motion.live_model import LiveModel
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.drivers.driver import Driver
from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray


class ModelOutputs(NamedTuple):
    """Answers of the models to samples, each (n, axes), m or rad; NaN where not finite.

    Attributes
    ----------
    in_use
        The model in use: what is shown.
    nominal
        As the robot file describes the machine.
    cautious
        The model in use without what may have been a contact.
    doubt
        By how much ``in_use`` may be off, as the machine's past is unknown.
    """

    in_use: FloatArray
    nominal: FloatArray
    cautious: FloatArray
    doubt: FloatArray


class PreparedModel(NamedTuple):
    """A model with its runs, which have followed the earlier commands of the machine."""

    model: ModelInUse
    runs: tuple[BracketedModel, ...]  # the model's own, and the cautious one where it is another

    @classmethod
    def of(cls, model: ModelInUse, memory: CommandMemory) -> "PreparedModel":
        """Prepare a model; on any thread, and it may take a second.

        Raises
        ------
        EffectError
            If an effect cannot be used.
        """
        if not model.corrected:
            return cls(model, ())
        robots = [model.robot]
        if model.contact_like:
            robots.append(model.without_contact)
        made = cls(model, tuple(BracketedModel(robot, model.offsets) for robot in robots))
        made.catch_up(memory)
        return made

    def catch_up(self, memory: CommandMemory) -> None:
        """Follow the commands since then."""
        time_s, command = memory.history()
        for run in self.runs:
            later = time_s > run.time_s
            if later.any():
                run.answer(time_s[later], command[later])


class LiveModels:
    """Owned by the session's worker; ``model`` is replaced as a whole, for any thread."""

    def __init__(self, driver: Driver) -> None:
        self.model = ModelInUse.nominal_of(driver)
        self.memory = CommandMemory()
        self._nominal = LiveModel(driver.robot)
        self._runs: tuple[BracketedModel, ...] = ()

    @property
    def unsettled(self) -> tuple[str, ...]:
        """The axes whose history is insufficient for the model in use."""
        return self._runs[0].unsettled if self._runs else ()

    def prepare(self) -> None:
        """Compute once to load compiled code, so that no device has to wait for it."""
        self._nominal.prepare()

    def begin_anew(self) -> None:
        """Forget the past: a new connection has its own device time."""
        self.memory.clear()
        self.restart()

    def restart(self) -> None:
        """Rest again at the next command, with a past that is unknown."""
        self._nominal.restart()
        for run in self._runs:
            run.restart()

    def use(self, prepared: PreparedModel) -> None:
        """Answer by another model from the next sample on."""
        prepared.catch_up(self.memory)
        self.model, self._runs = prepared.model, prepared.runs

    def follow(self, samples: Samples) -> ModelOutputs:
        """Return the answers of the models to the next samples."""
        self.memory.add(samples)
        nominal = self._nominal.answer(samples.device_time_s, samples.command)
        if not self._runs:
            return ModelOutputs(nominal, nominal, nominal, np.zeros(nominal.shape))
        told = [run.answer(samples.device_time_s, samples.command) for run in self._runs]
        in_use, doubt = told[0]
        return ModelOutputs(in_use, nominal, told[-1][0], doubt)
