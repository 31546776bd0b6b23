"""Decoding of report bytes to axes and buttons by the report descriptor."""

from collections import Counter
from dataclasses import dataclass
from math import nan

from rotemina.drivers.inputs.hid.controls import (
    Bits,
    Button,
    Buttons,
    Control,
    Deflection,
    Hat,
)
from rotemina.drivers.inputs.hid.descriptor import Field, ReportDescriptor
from rotemina.drivers.inputs.hid.items import DescriptorError
from rotemina.drivers.inputs.hid.usages import APPLICATIONS, HAT, axis_name, button_name
from rotemina.sim.messages import message


@dataclass(frozen=True, slots=True)
class Ignored:
    """Counts of data that were not used.

    Attributes
    ----------
    unknown : int
        Reports that the descriptor declares without axes and buttons, such as a keyboard's.
    undeclared : int
        Reports of a number that the descriptor does not declare.
    short : int
        Reports that ended too early.
    long : int
        Reports with more bytes than described; the rest was not looked at.
    beyond : int
        Values of axes outside their declared range.
    """

    unknown: int = 0
    undeclared: int = 0
    short: int = 0
    long: int = 0
    beyond: int = 0


class Decoder:
    """Keeps the latest state of a device's axes and buttons.

    Axes are in the order of the descriptor. The same usage in several reports of one collection is
    one axis or button; twice in the same report, it is two.

    Raises
    ------
    DescriptorError
        If the descriptor has no axis and no button to steer with.
    """

    def __init__(self, descriptor: ReportDescriptor) -> None:
        plan = _Plan(descriptor)
        if not plan.axes and not plan.buttons:
            raise DescriptorError(
                message(
                    "engine",
                    "its report descriptor has no axis and no button of a joystick, gamepad or "
                    "multi-axis controller",
                )
            )
        self.axes = tuple(plan.axes)
        self.buttons = tuple(plan.buttons)
        #: Why the latest report could not be understood; None if it could.
        self.fault: str | None = None
        self._numbered = descriptor.numbered
        self._declared = frozenset(descriptor.bits)
        self._reports = {
            number: _Report(
                tuple(sorted(controls, key=lambda control: control.bits.end)),
                -(-descriptor.bits[number] // 8),
            )
            for number, controls in plan.reports.items()
        }
        self._forget()
        self._longest: Counter[int] = Counter()  # bytes that the reports of a number had so far
        self._ignored: Counter[str] = Counter()

    @property
    def ignored(self) -> Ignored:
        """What was not as described, so far."""
        return Ignored(**self._ignored)

    def decode(self, report: bytes) -> tuple[tuple[float, ...], tuple[bool, ...]] | None:
        """Return all axes and buttons after a report; None if it is declared without any of them.

        Never raises, whatever the bytes are. An axis that no report has told yet, or whose value is
        outside its declared range, is NaN. After a report that cannot be understood, see
        :attr:`fault`, every axis is NaN and no button is held.
        """
        number, payload = (report[0], report[1:]) if report and self._numbered else (0, report)
        known = self._reports.get(number)
        if known is None and number in self._declared:
            self._ignored["unknown"] += 1
            return None
        self.fault = self._fault(number, payload)
        if known is None or self.fault is not None:
            self._forget()
            return tuple(self._axes), tuple(self._buttons)
        self._longest[number] = max(self._longest[number], min(len(payload), known.size))
        self._take(payload, known)
        return tuple(self._axes), tuple(self._buttons)

    def _fault(self, number: int, payload: bytes) -> str | None:
        """Return why a report cannot be understood; None if it can."""
        if number not in self._declared:
            self._ignored["undeclared"] += 1
            return message(
                "engine",
                "it sent a report of type {number}, which it does not declare, and counts as "
                "released. Release it and start again; if this repeats, replug it",
            ).fill(number=number)
        if len(payload) < self._longest[number]:
            self._ignored["short"] += 1
            return message(
                "engine",
                "it sent a report of {length} bytes after reports of {longest}, and counts as "
                "released. Release it and start again; if this repeats, replug it",
            ).fill(length=len(payload), longest=self._longest[number])
        return None

    def _take(self, payload: bytes, known: "_Report") -> None:
        """Note the controls that a report has: some devices always send less than they declare."""
        self._ignored["long"] += len(payload) > known.size
        self._ignored["short"] += len(payload) < known.size
        whole = int.from_bytes(payload, "little")
        for control in known.controls:
            if control.bits.end <= 8 * len(payload):
                declared = control.take(whole, self._axes, self._buttons)
                self._ignored["beyond"] += not declared

    def _forget(self) -> None:
        self._axes = [nan] * len(self.axes)
        self._buttons = [False] * len(self.buttons)


@dataclass(frozen=True, slots=True)
class _Report:
    """What is in a report of one number, by where it ends, and how many bytes it should have."""

    controls: tuple[Control, ...]
    size: int


class _Plan:
    """Which field of which report is which axis or button."""

    def __init__(self, descriptor: ReportDescriptor) -> None:
        self.axes: list[str] = []
        self.buttons: list[str] = []
        self.reports: dict[int, list[Control]] = {}
        # (application, usage, how many of that usage came before in the same report) → index
        self._axis_of: dict[tuple[int, int, int], int] = {}
        self._button_of: dict[tuple[int, int, int], int] = {}
        self._seen: Counter[tuple[int, int, int]] = Counter()
        for field in descriptor.fields:
            application = (
                descriptor.applications[field.application] if field.application >= 0 else 0
            )
            if application in APPLICATIONS:
                (self._list if field.is_list else self._single)(field)

    def _single(self, field: Field) -> None:
        usage = field.usages[0]
        if usage == HAT:
            axis = self._axis(field, ("Hat right", "Hat towards"))
            self._add(field, Hat.of(field, axis))
        elif (name := axis_name(usage, field.is_relative)) is not None:
            if field.high > field.low:
                axis = self._axis(field, (name,))
                self._add(
                    field,
                    Deflection(Bits.of(field), axis, field.low, field.high, field.has_null),
                )
        elif (name := button_name(usage)) is not None:
            self._add(field, Button.of(field, self._button(field, usage, name)))

    def _list(self, field: Field) -> None:
        chosen = tuple(
            None if (name := button_name(usage)) is None else self._button(field, usage, name)
            for usage in field.usages
        )
        if any(button is not None for button in chosen):
            self._add(field, Buttons.of(field, chosen))

    def _add(self, field: Field, control: Control) -> None:
        self.reports.setdefault(field.report_id, []).append(control)

    def _axis(self, field: Field, names: tuple[str, ...]) -> int:
        key = self._key(field, field.usages[0])
        if key not in self._axis_of:
            self._axis_of[key] = len(self.axes)
            suffix = _suffix(names[0], self.axes)
            self.axes += [name + suffix for name in names]
        return self._axis_of[key]

    def _button(self, field: Field, usage: int, name: str) -> int:
        key = self._key(field, usage)
        if key not in self._button_of:
            self._button_of[key] = len(self.buttons)
            self.buttons.append(name + _suffix(name, self.buttons))
        return self._button_of[key]

    def _key(self, field: Field, usage: int) -> tuple[int, int, int]:
        """Return what tells a control from others: also from the same usage before it."""
        place = (field.application, field.report_id, usage)
        before = self._seen[place]
        self._seen[place] += 1
        return field.application, usage, before


def _suffix(name: str, names: list[str]) -> str:
    """Return what makes a name one that is not there yet: " 2" for the second."""
    count = sum(1 for one in names if one == name or one.startswith(f"{name} "))
    return f" {count + 1}" if count else ""
