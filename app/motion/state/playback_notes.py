"""Notes about a playback that are stored with its record, and the operator's labels."""

from dataclasses import dataclass, fields
from datetime import datetime
from typing import Self

from rotemina.app.motion.model import NOTED_KEY, ModelInUse
from rotemina.app.motion.state.recorder import PlaybackRecorder
from rotemina.app.motion.state.state import PlaybackFinished
from rotemina.drivers.abilities import EffectCarrier
from rotemina.drivers.contract import Driver

# Maximum number of characters of a label.
MAX_LABEL_LENGTH = 100


@dataclass(frozen=True, slots=True)
class RunLabels:
    """Texts in the metadata of every playback and recording. Empty texts are left out."""

    run: str = ""
    operator: str = ""
    sample: str = ""

    @classmethod
    def from_text(cls, run: str, operator: str, sample: str) -> Self:
        """Return labels from typed texts. Each becomes one line, as the metadata of files need."""
        return cls(to_one_line(run), to_one_line(operator), to_one_line(sample))

    @property
    def metadata(self) -> dict[str, str]:
        """The labels that are not empty, by their metadata key."""
        labels = {field.name: getattr(self, field.name) for field in fields(self)}
        return {key: text for key, text in labels.items() if text}


def to_one_line(text: str, max_length: int = MAX_LABEL_LENGTH) -> str:
    """Return a text as one line of at most ``max_length`` characters.

    Line ends and control characters become spaces. Spaces around the text are removed.
    """
    printable = "".join(character if character.isprintable() else " " for character in text)
    return " ".join(printable.split())[:max_length].strip()


class PlaybackNotes:
    """Metadata of playbacks, and the faults and contacts since the latest playback began."""

    def __init__(self) -> None:
        #: The operator's labels of all playbacks. Any thread may replace the whole object.
        self.labels = RunLabels()
        self._faults_and_contacts: list[str] = []
        self._is_shown = True

    def begin(self, *, shown: bool) -> None:
        """Forget earlier notes when a playback begins; see :class:`PlayCommand` for ``shown``."""
        self._faults_and_contacts.clear()
        self._is_shown = shown

    def add(self, *notes: str) -> None:
        """Note faults or contacts, since these may cause the effects found in this motion."""
        self._faults_and_contacts.extend(notes)

    def make_metadata(self, driver: Driver, model: ModelInUse) -> dict[str, str]:
        """Return the metadata of a playback that begins now."""
        effects = driver.effects_text if isinstance(driver, EffectCarrier) else ""
        return {
            "began": datetime.now().astimezone().isoformat(timespec="milliseconds"),
            "robot_sha256": model.machine.robot,
            "machine_kind": driver.machine_kind,
            **({"effects": effects} if effects else {}),
            **self.labels.metadata,
        }

    def finish(
        self, recorder: PlaybackRecorder, model: ModelInUse, *, completed: bool
    ) -> PlaybackFinished:
        """Return the event that ends a playback; its record contains the notes."""
        recorder.add_metadata("model", model.id)
        if self._faults_and_contacts:
            recorder.add_metadata(NOTED_KEY, "; ".join(dict.fromkeys(self._faults_and_contacts)))
        record = recorder.finish()
        is_complete = completed and recorder.is_complete and record is not None
        return PlaybackFinished(record, is_complete, model, recorder.model_outputs, self._is_shown)
