"""Section for the mapping of a device. The operator assigns a control by moving it."""

from collections.abc import Callable

from rotemina.app.language import describe_error, translate_message
from rotemina.app.motion.inputs import (
    InputDeviceView,
    InputDisplayState,
    InputProfile,
    InputSnapshot,
    MovedControl,
    OperatorRole,
    SilencePolicy,
)
from rotemina.app.widgets.controls import WheelSafeComboBox, enable_unless, make_button
from rotemina.app.widgets.layout import Section, make_grid
from rotemina.app.widgets.text import make_plain_label, show_or_hide_text
from rotemina.app.workbench import Level, StateTone, Workbench, set_tone
from rotemina.plugins.inputs import mark, tr
from rotemina.plugins.inputs.control_finding import ControlFinder
from rotemina.plugins.inputs.mapping_rows import ActionMappingRow, MappingRow, TargetMappingRow
from rotemina.plugins.inputs.profile_edits import (
    ProfileEditor,
    compute_threshold,
    exchange_seats,
    is_inversion_needed,
)
from rotemina.plugins.inputs.profiles import ProfileChoice
from rotemina.plugins.inputs.words import (
    ACTION_NAMES,
    describe_direction,
    format_device_name,
    list_axis_targets,
)
from rotemina.sim.errors import InputError

MAPPING_HINT = mark("Press a field, then move the control for its action.")
_SEATS_BY_NAME = {
    mark("Trainer"): OperatorRole.TRAINER,
    mark("Trainee"): OperatorRole.TRAINEE,
    mark("No action"): None,
}
# The text of each choice, and its explanation.
_SILENCE_TEXTS = {
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
    """Section with the functions of all controls of the selected device.

    Changes take effect at once. During the set-up, no device moves the robot.
    """

    def __init__(self, workbench: Workbench, profiles: ProfileChoice) -> None:
        super().__init__(tr("Mapping"))
        self._workbench = workbench
        self._devices = workbench.operation.devices
        self._profiles = profiles
        self._device: InputDeviceView | None = None
        self._view = InputDisplayState()
        self._finder: ControlFinder | None = None
        self._finder_row: MappingRow | None = None
        self.seat = WheelSafeComboBox(tr("Seat of the device"), letters=8)
        for name, seat in _SEATS_BY_NAME.items():
            self.seat.addItem(tr(name), seat)
        self.seat.activated.connect(lambda _: self._choose_seat())
        self.exchange = make_button(tr("Exchange seats"), self._exchange_seats)
        self.add_row(self.seat, self.exchange, equal=False)
        self.silence = WheelSafeComboBox(tr("When the device is silent"), letters=8)
        for policy, (name, _) in _SILENCE_TEXTS.items():
            self.silence.addItem(tr(name), policy)
        self.silence.activated.connect(lambda _: self._choose_silence())
        self.add_row(self.silence)
        self.silence_meaning = self.add_text()
        # The panel places the message outside the scroll area, so that it stays visible.
        self.message = make_plain_label(wrap=True)
        self.message.setText(tr(MAPPING_HINT))
        grid = make_grid(spacing=(5, 3), stretched=(0, 1))
        self.column.addLayout(grid)
        self.target_rows = {
            target: TargetMappingRow(target, grid)
            for target in list_axis_targets(tuple(workbench.robot.axes))
        }
        self.action_rows = {action: ActionMappingRow(action, grid) for action in ACTION_NAMES}
        for row in self._rows:
            row.find_requested.connect(lambda row=row: self._toggle_finder(row))
        for target, row in self.target_rows.items():
            row.clear_requested.connect(
                lambda target=target: self._apply_change(lambda editor: editor.without_axis(target))
            )
            row.setting_changed.connect(
                lambda inverted, target=target: self._invert_axis(target, bool(inverted))
            )
        for action, row in self.action_rows.items():
            row.clear_requested.connect(
                lambda action=action: self._apply_change(
                    lambda editor: editor.without_action(action)
                )
            )
            row.setting_changed.connect(
                lambda percent, row=row: self._use_threshold(row, float(percent))
            )

    @property
    def _rows(self) -> tuple[MappingRow, ...]:
        return (*self.target_rows.values(), *self.action_rows.values())

    @property
    def _editor(self) -> ProfileEditor:
        assert self._device is not None
        plugged_devices = tuple(view.device for view in self._view.devices)
        return ProfileEditor(self._devices.profile, self._device.device, plugged_devices)

    def refresh(
        self, view: InputDisplayState, device: InputDeviceView | None, now_s: float
    ) -> None:
        """Show the mapping of a device."""
        if _get_key(device) != _get_key(self._device):
            self.cancel()
        self._view, self._device = view, device
        if device is None:
            return
        self.heading.show_text(
            tr("Mapping of {device}").format(device=format_device_name(device.device.identity))
        )
        self._update_finder(now_s)
        editor = self._editor
        self.seat.select(None if editor.mapping is None else editor.mapping.seat)
        self._show_silence(editor)
        profile = self._devices.profile
        seats = {mapping.seat for mapping in profile.devices} if profile is not None else set()
        one_seat_reason = (
            None if len(seats) > 1 else tr("all devices of the profile belong to one seat")
        )
        enable_unless(
            self.exchange, one_seat_reason, tr("Exchange the devices of trainer and trainee")
        )
        for row in self._rows:
            row.show_mapping(editor, self.message.text() if row is self._finder_row else None)

    def _show_silence(self, editor: ProfileEditor) -> None:
        is_mapped = editor.mapping is not None
        policy = SilencePolicy.STOP if editor.mapping is None else editor.mapping.when_silent
        enable_unless(
            self.silence,
            None if is_mapped else tr("the device has no action yet"),
            tr("When the device is silent"),
        )
        self.silence.select(policy)
        show_or_hide_text(self.silence_meaning, tr(_SILENCE_TEXTS[policy][1]))
        set_tone(
            self.silence_meaning,
            StateTone.WARNING if policy is SilencePolicy.CONTINUE else StateTone.QUIET,
        )

    def receive(self, snapshot: InputSnapshot) -> None:
        """Pass new readings to the running search for a control."""
        if self._finder is not None:
            self._finder.receive(snapshot)

    def cancel(self) -> None:
        """Cancel the search for a control."""
        self._finder = self._finder_row = None
        self._show_message(tr(MAPPING_HINT))

    def _toggle_finder(self, row: MappingRow) -> None:
        is_running = row is self._finder_row
        self.cancel()
        # The search needs the current state of the device, and not the state at the last refresh.
        matches = (
            view for view in self._devices.view.devices if _get_key(view) == _get_key(self._device)
        )
        device = next(matches, None)
        if not is_running and device is not None:
            self._finder_row = row
            self._finder = ControlFinder(device, axis=isinstance(row, TargetMappingRow))

    def _update_finder(self, now_s: float) -> None:
        if self._finder is None or self._finder_row is None:
            return
        row, result = self._finder_row, self._finder.find_control(now_s)
        if result.moved_control is not None:
            self.cancel()
            self._map_control(row, result.moved_control)
        elif isinstance(row, TargetMappingRow):
            self._show_message(
                tr("{name}: {message}, {target}. Press again to cancel.").format(
                    name=row.name,
                    message=translate_message(result.message),
                    target=describe_direction(row.target),
                )
            )
        else:
            self._show_message(
                tr("{name}: {message}. Press again to cancel.").format(
                    name=row.name, message=translate_message(result.message)
                )
            )

    def _map_control(self, row: MappingRow, detected: MovedControl) -> None:
        assert self._device is not None
        calibration = self._device.calibration
        if isinstance(row, TargetMappingRow):
            inverted = is_inversion_needed(detected, calibration)
            self._apply_change(
                lambda editor: editor.with_axis(row.target, detected.control, inverted=inverted)
            )
        elif isinstance(row, ActionMappingRow):
            threshold = compute_threshold(detected, calibration)
            self._apply_change(
                lambda editor: editor.with_action(row.action, detected.control, threshold)
            )

    def _invert_axis(self, target: str, inverted: bool) -> None:
        mapping = self._editor.find_axis_mapping(target)
        if mapping is not None:
            control = mapping.control
            self._apply_change(lambda editor: editor.with_axis(target, control, inverted=inverted))

    def _use_threshold(self, row: ActionMappingRow, percent: float) -> None:
        mappings = self._editor.find_action_mappings(row.action)
        if len(mappings) == 1 and mappings[0].at is not None:
            mapping = mappings[0]
            if not self._apply_change(
                lambda editor: editor.with_threshold(row.action, percent / 100.0)
            ):
                row.threshold_field.reset(100.0 * (mapping.at or 0.0))

    def _choose_seat(self) -> None:
        seat = self.seat.currentData()
        editor = self._editor
        if seat is not (None if editor.mapping is None else editor.mapping.seat):
            self._apply_change(lambda editor: editor.with_seat(seat))

    def _choose_silence(self) -> None:
        policy = self.silence.currentData()
        editor = self._editor
        if editor.mapping is not None and policy is not editor.mapping.when_silent:
            self._apply_change(lambda editor: editor.with_silence(policy))

    def _exchange_seats(self) -> None:
        profile = self._devices.profile
        if profile is not None:
            self._apply_change(lambda _: exchange_seats(profile))

    def _apply_change(self, change: Callable[[ProfileEditor], InputProfile]) -> bool:
        """Use a changed profile, and return whether it was accepted.

        A refusal is shown in this section and as a notice.
        """
        try:
            self._profiles.use_changed_profile(change(self._editor))
        except InputError as error:
            self._show_message(tr("Refused: {error}").format(error=error))
            self._workbench.notify(Level.ERROR, describe_error(error), about=error)
            return False
        self._show_message(tr(MAPPING_HINT))
        return True

    def _show_message(self, text: str) -> None:
        if text != self.message.text():
            self.message.setText(text)


def _get_key(device: InputDeviceView | None) -> str:
    return "" if device is None else device.device.identity.key
