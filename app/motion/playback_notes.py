"""Notes about a playback that are stored with its record."""

from datetime import datetime

from rotemina.app.motion.model_in_use import NOTED, ModelInUse
from rotemina.app.motion.recorder import PlaybackRecorder
from rotemina.app.motion.run_labels import RunLabels
from rotemina.app.motion.state import PlaybackFinished
from rotemina.drivers.driver import Driver
from rotemina.drivers.model_abilities import EffectCarrier


class PlaybackNotes:
    """Metadata of playbacks, and faults and contacts since the latest one began."""

    def __init__(self) -> None:
        #: What the operator says of all that is played; replaced as a whole by any thread.
        self.labels = RunLabels()
        self._noted: list[str] = []
        self._shown = True

    def begin(self, *, shown: bool) -> None:
        """Forget what was noted before a playback, which is ``shown`` or a way to somewhere."""
        self._noted.clear()
        self._shown = shown

    def add(self, *what: str) -> None:
        """Note faults or contacts: what is learned from this motion may come from them."""
        self._noted.extend(what)

    def metadata(self, driver: Driver, model: ModelInUse) -> dict[str, str]:
        """Return the metadata of a playback that begins now."""
        effects = driver.effects_text if isinstance(driver, EffectCarrier) else ""
        return {
            "began": datetime.now().astimezone().isoformat(timespec="milliseconds"),
            "robot_sha256": model.machine.robot,
            "machine_kind": driver.machine_kind,
            **({"effects": effects} if effects else {}),
            **self.labels.metadata,
        }

    def finished(
        self, recorder: PlaybackRecorder, model: ModelInUse, *, completed: bool
    ) -> PlaybackFinished:
        """Return the end of a playback, its record with what was noted."""
        recorder.say("model", model.id)
        if self._noted:
            recorder.say(NOTED, "; ".join(dict.fromkeys(self._noted)))
        record = recorder.finish()
        whole = completed and recorder.complete and record is not None
        return PlaybackFinished(record, whole, model, recorder.answers, self._shown)
