"""Mapping of one device: controls are assigned by moving them."""

from collections.abc import Callable

from rotemina.app.motion.teleoperation.input_arbiter import DevicesView, DeviceView
from rotemina.app.motion.teleoperation.input_devices import InputSnapshot
from rotemina.app.motion.teleoperation.moved_control import Detected
from rotemina.app.motion.teleoperation.profile import OperatorRole, Profile, SilencePolicy
from rotemina.app.shell.engine_words import error_text, spoken
from rotemina.app.shell.state_tone import Tone, set_tone
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.labels import plain_text, show_text
from rotemina.app.widgets.layouts import in_grid
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.inputs import mark, tr
from rotemina.plugins.inputs.control_finding import Finding
from rotemina.plugins.inputs.mapping_rows import ActionRow, Row, TargetRow
from rotemina.plugins.inputs.profile_edits import Edited, exchanged, threshold, turned
from rotemina.plugins.inputs.profiles import ProfileChoice
from rotemina.plugins.inputs.words import ACTIONS, axis_targets, device_name, way_of
from rotemina.sim.errors import InputError

HINT = mark("Press a field, then move the control for its action.")
_SEATS = {
    mark("Trainer"): OperatorRole.TRAINER,
    mark("Trainee"): OperatorRole.TRAINEE,
    mark("No action"): None,
}


#: What the choice says, and what it means.
_SILENCE = {
    SilencePolicy.STOP: (
        mark("When silent: stop"),
        mark(
            "Held still, the device must report at least once a second, or it counts as released."
        ),
    ),
    SilencePolicy.CONTINUE: (
        mark("When silent: continue"),
        mark(
            "The robot continues while the device is silent, even if its link has failed. Only for "
            "a device on a cable that reports nothing while it is held still."
        ),
    ),
}


class MappingSection(Section):
    """What the controls of the device that is examined do.

    Changes are used at once; nothing is sent while they are made.
    """

    def __init__(self, workbench: Workbench, profiles: ProfileChoice) -> None:
        super().__init__(tr("Mapping"))
        self._workbench = workbench
        self._devices = workbench.operation.devices
        self._profiles = profiles
        self._device: DeviceView | None = None
        self._view = DevicesView()
        self._finding: Finding | None = None
        self._row: Row | None = None
        self.seat = SteadyChoice(tr("Seat of the device"), letters=8)
        for name, seat in _SEATS.items():
            self.seat.addItem(tr(name), seat)
        self.seat.activated.connect(lambda _: self._choose_seat())
        self.exchange = button(tr("Exchange seats"), self._exchange)
        self.add_row(self.seat, self.exchange, equal=False)
        self.silence = SteadyChoice(tr("When the device is silent"), letters=8)
        for policy, (name, _) in _SILENCE.items():
            self.silence.addItem(tr(name), policy)
        self.silence.activated.connect(lambda _: self._choose_silence())
        self.add_row(self.silence)
        self.silence_meaning = self.add_text()
        self.message = plain_text(wrap=True)  # placed where it stays in sight
        self.message.setText(tr(HINT))
        grid = in_grid(spacing=(5, 3), stretched=(0, 1))
        self.column.addLayout(grid)
        self.target_rows = {
            target: TargetRow(target, grid) for target in axis_targets(tuple(workbench.robot.axes))
        }
        self.action_rows = {action: ActionRow(action, grid) for action in ACTIONS}
        for row in self._rows:
            row.asked.connect(lambda row=row: self._ask(row))
        for target, row in self.target_rows.items():
            row.cleared.connect(lambda t=target: self._apply(lambda e: e.without_axis(t)))
            row.changed.connect(lambda turn, t=target: self._invert(t, bool(turn)))
        for action, row in self.action_rows.items():
            row.cleared.connect(lambda a=action: self._apply(lambda e: e.without_action(a)))
            row.changed.connect(lambda at, a=row: self._use_threshold(a, float(at)))

    @property
    def _rows(self) -> tuple[Row, ...]:
        return (*self.target_rows.values(), *self.action_rows.values())

    @property
    def _edited(self) -> Edited:
        assert self._device is not None
        plugged = tuple(one.device for one in self._view.devices)
        return Edited(self._devices.profile, self._device.device, plugged)

    # --- what is shown ----------------------------------------------------------------------------

    def refresh(self, view: DevicesView, device: DeviceView | None, now_s: float) -> None:
        """Show the mapping of a device."""
        if _key(device) != _key(self._device):
            self.cancel()
        self._view, self._device = view, device
        if device is None:
            return
        self.heading.show_text(
            tr("Mapping of {device}").format(device=device_name(device.device.identity))
        )
        self._look(now_s)
        edited = self._edited
        self.seat.select(None if edited.mapping is None else edited.mapping.seat)
        self._show_silence(edited)
        profile = self._devices.profile
        seats = {each.seat for each in profile.devices} if profile is not None else set()
        alone = None if len(seats) > 1 else tr("all devices of the profile belong to one seat")
        allow(self.exchange, alone, tr("Exchange the devices of trainer and trainee"))
        for row in self._rows:
            row.show_edited(edited, self.message.text() if row is self._row else None)

    def _show_silence(self, edited: Edited) -> None:
        mapped = edited.mapping is not None
        policy = SilencePolicy.STOP if edited.mapping is None else edited.mapping.when_silent
        allow(
            self.silence,
            None if mapped else tr("the device has no action yet"),
            tr("When the device is silent"),
        )
        self.silence.select(policy)
        show_text(self.silence_meaning, tr(_SILENCE[policy][1]))
        set_tone(
            self.silence_meaning, Tone.WARNING if policy is SilencePolicy.CONTINUE else Tone.QUIET
        )

    def receive(self, snapshot: InputSnapshot) -> None:
        """Take in what the devices have said."""
        if self._finding is not None:
            self._finding.receive(snapshot)

    # --- finding a control ------------------------------------------------------------------------

    def cancel(self) -> None:
        """Cancel the search for a control."""
        self._finding = self._row = None
        self._tell(tr(HINT))

    def _ask(self, row: Row) -> None:
        again = row is self._row
        self.cancel()
        # As it stands at this moment, not when the last frame was drawn.
        now = (one for one in self._devices.view.devices if _key(one) == _key(self._device))
        device = next(now, None)
        if not again and device is not None:
            self._row = row
            self._finding = Finding(device, axis=isinstance(row, TargetRow))

    def _look(self, now_s: float) -> None:
        if self._finding is None or self._row is None:
            return
        row, found = self._row, self._finding.look(now_s)
        if found.detected is not None:
            self.cancel()
            self._take(row, found.detected)
        elif isinstance(row, TargetRow):
            self._tell(
                tr("{name}: {message}, {target}. Press again to cancel.").format(
                    name=row.name, message=spoken(found.message), target=way_of(row.target)
                )
            )
        else:
            self._tell(
                tr("{name}: {message}. Press again to cancel.").format(
                    name=row.name, message=spoken(found.message)
                )
            )

    def _take(self, row: Row, found: Detected) -> None:
        assert self._device is not None
        calibration = self._device.calibration
        if isinstance(row, TargetRow):
            inverted = turned(found, calibration)
            self._apply(lambda e: e.with_axis(row.target, found.control, inverted=inverted))
        elif isinstance(row, ActionRow):
            at = threshold(found, calibration)
            self._apply(lambda e: e.with_action(row.action, found.control, at))

    # --- changes ----------------------------------------------------------------------------------

    def _invert(self, target: str, inverted: bool) -> None:
        mapping = self._edited.axis(target)
        if mapping is not None:
            control = mapping.control
            self._apply(lambda e: e.with_axis(target, control, inverted=inverted))

    def _use_threshold(self, row: ActionRow, percent: float) -> None:
        mappings = self._edited.actions(row.action)
        if len(mappings) == 1 and mappings[0].at is not None:
            before = mappings[0]
            if not self._apply(lambda e: e.with_threshold(row.action, percent / 100.0)):
                row.at.reset(100.0 * (before.at or 0.0))

    def _choose_seat(self) -> None:
        seat = self.seat.currentData()
        edited = self._edited
        if seat is not (None if edited.mapping is None else edited.mapping.seat):
            self._apply(lambda e: e.with_seat(seat))

    def _choose_silence(self) -> None:
        policy = self.silence.currentData()
        edited = self._edited
        if edited.mapping is not None and policy is not edited.mapping.when_silent:
            self._apply(lambda e: e.with_silence(policy))

    def _exchange(self) -> None:
        profile = self._devices.profile
        if profile is not None:
            self._apply(lambda _: exchanged(profile))

    def _apply(self, change: Callable[[Edited], Profile]) -> bool:
        """Use a changed profile; what is refused is told here and as a notice."""
        try:
            self._profiles.edit(change(self._edited))
        except InputError as error:
            self._tell(tr("Refused: {error}").format(error=error))
            self._workbench.notify(Level.ERROR, error_text(error), about=error)
            return False
        self._tell(tr(HINT))
        return True

    def _tell(self, words: str) -> None:
        if words != self.message.text():
            self.message.setText(words)


def _key(device: DeviceView | None) -> str:
    return "" if device is None else device.device.identity.key
