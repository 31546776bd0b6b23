"""Decoding of reports into axes and buttons, as the report descriptor declares them."""

from collections import Counter
from dataclasses import dataclass
from math import nan

from rotemina.drivers.contract import DescriptorError
from rotemina.drivers.inputs.hid_controls import (
    AxisControl,
    BitField,
    ButtonControl,
    ButtonListControl,
    Control,
    HatControl,
)
from rotemina.drivers.inputs.hid_descriptor import ReportDescriptor, ReportField
from rotemina.drivers.inputs.hid_usages import (
    HAT_USAGE,
    JOYSTICK_APPLICATIONS,
    find_axis_name,
    find_button_name,
)
from rotemina.sim.messages import message


@dataclass(frozen=True, slots=True)
class IgnoredCounts:
    """Counts of ignored reports and values.

    Attributes
    ----------
    unknown : int
        Reports that the descriptor declares without axes or buttons, such as those of a keyboard.
    undeclared : int
        Reports whose number the descriptor does not declare.
    short : int
        Reports with fewer bytes than declared.
    long : int
        Reports with more bytes than declared; the additional bytes are ignored.
    beyond : int
        Axis values outside the declared range.
    """

    unknown: int = 0
    undeclared: int = 0
    short: int = 0
    long: int = 0
    beyond: int = 0


class HidDecoder:
    """Decodes reports, and keeps the latest state of a device's axes and buttons.

    Axes are in the order of the descriptor. If several reports of one collection contain the same
    usage, they share one axis or button. If one report contains a usage twice, there are two.

    Raises
    ------
    DescriptorError
        If the descriptor declares neither axes nor buttons of a joystick.
    """

    def __init__(self, descriptor: ReportDescriptor) -> None:
        plan = _ControlPlan(descriptor)
        if not plan.axes and not plan.buttons:
            raise DescriptorError(
                "its report descriptor has no axis and no button of a joystick, gamepad or "
                "multi-axis controller"
            )
        self.axes = tuple(plan.axes)
        self.buttons = tuple(plan.buttons)
        #: Why the latest report could not be decoded; None if it could.
        self.fault: str | None = None
        self._has_report_ids = descriptor.has_report_ids
        self._declared_numbers = frozenset(descriptor.bits)
        self._reports = {
            number: _ReportLayout(
                tuple(sorted(controls, key=lambda control: control.bits.end)),
                -(-descriptor.bits[number] // 8),
            )
            for number, controls in plan.reports.items()
        }
        self._release_all()
        # The largest number of bytes received so far, by report number.
        self._max_lengths: Counter[int] = Counter()
        self._ignored: Counter[str] = Counter()

    @property
    def ignored(self) -> IgnoredCounts:
        """Counts of ignored data since the decoder was created."""
        return IgnoredCounts(**self._ignored)

    def decode(self, report: bytes) -> tuple[tuple[float, ...], tuple[bool, ...]] | None:
        """Decode a report and return all axes and buttons; None if the report contains none.

        This never raises, whatever the bytes are. An axis is NaN if it has not been reported yet,
        or if its value is outside its declared range. After a report that cannot be decoded, every
        axis is NaN and no button is held; :attr:`fault` gives the reason.
        """
        number, payload = (
            (report[0], report[1:]) if report and self._has_report_ids else (0, report)
        )
        layout = self._reports.get(number)
        if layout is None and number in self._declared_numbers:
            self._ignored["unknown"] += 1
            return None
        self.fault = self._find_fault(number, payload)
        if layout is None or self.fault is not None:
            self._release_all()
            return tuple(self._axes), tuple(self._buttons)
        self._max_lengths[number] = max(self._max_lengths[number], min(len(payload), layout.size))
        self._update_controls(payload, layout)
        return tuple(self._axes), tuple(self._buttons)

    def _find_fault(self, number: int, payload: bytes) -> str | None:
        if number not in self._declared_numbers:
            self._ignored["undeclared"] += 1
            return message(
                "engine",
                "it sent a report of the undeclared type {number}, and all controls count as "
                "released. Release the controls and start again; if this happens again, replug the "
                "device",
            ).fill(number=number)
        if len(payload) < self._max_lengths[number]:
            self._ignored["short"] += 1
            return message(
                "engine",
                "it sent a report of {length} bytes after reports of {longest}, and all controls "
                "count as released. Release the controls and start again; if this happens again, "
                "replug the device",
            ).fill(length=len(payload), longest=self._max_lengths[number])
        return None

    def _update_controls(self, payload: bytes, layout: "_ReportLayout") -> None:
        """Update the controls whose bits are in the report.

        Some devices always send fewer bytes than they declare.
        """
        self._ignored["long"] += len(payload) > layout.size
        self._ignored["short"] += len(payload) < layout.size
        report = int.from_bytes(payload, "little")
        for control in layout.controls:
            if control.bits.end <= 8 * len(payload):
                is_in_range = control.update(report, self._axes, self._buttons)
                self._ignored["beyond"] += not is_in_range

    def _release_all(self) -> None:
        self._axes = [nan] * len(self.axes)
        self._buttons = [False] * len(self.buttons)


@dataclass(frozen=True, slots=True)
class _ReportLayout:
    """The controls of a report in the order of their last bits, and its size in bytes."""

    controls: tuple[Control, ...]
    size: int


class _ControlPlan:
    def __init__(self, descriptor: ReportDescriptor) -> None:
        self.axes: list[str] = []
        self.buttons: list[str] = []
        self.reports: dict[int, list[Control]] = {}
        # Indices of axes and buttons; for the keys see _make_key.
        self._axis_indices: dict[tuple[int, int, int], int] = {}
        self._button_indices: dict[tuple[int, int, int], int] = {}
        self._usage_counts: Counter[tuple[int, int, int]] = Counter()
        for field in descriptor.fields:
            application = (
                descriptor.applications[field.application] if field.application >= 0 else 0
            )
            if application in JOYSTICK_APPLICATIONS:
                (self._add_list if field.is_list else self._add_single)(field)

    def _add_single(self, field: ReportField) -> None:
        usage = field.usages[0]
        if usage == HAT_USAGE:
            axis = self._find_axis(field, ("Hat right", "Hat towards"))
            self._add(field, HatControl.of(field, axis))
        elif (name := find_axis_name(usage, field.is_relative)) is not None:
            if field.high > field.low:
                axis = self._find_axis(field, (name,))
                self._add(
                    field,
                    AxisControl(BitField.of(field), axis, field.low, field.high, field.has_null),
                )
        elif (name := find_button_name(usage)) is not None:
            self._add(field, ButtonControl.of(field, self._find_button(field, usage, name)))

    def _add_list(self, field: ReportField) -> None:
        button_indices = tuple(
            None
            if (name := find_button_name(usage)) is None
            else self._find_button(field, usage, name)
            for usage in field.usages
        )
        if any(index is not None for index in button_indices):
            self._add(field, ButtonListControl.of(field, button_indices))

    def _add(self, field: ReportField, control: Control) -> None:
        self.reports.setdefault(field.report_id, []).append(control)

    def _find_axis(self, field: ReportField, names: tuple[str, ...]) -> int:
        key = self._make_key(field, field.usages[0])
        if key not in self._axis_indices:
            self._axis_indices[key] = len(self.axes)
            suffix = _make_suffix(names[0], self.axes)
            self.axes += [name + suffix for name in names]
        return self._axis_indices[key]

    def _find_button(self, field: ReportField, usage: int, name: str) -> int:
        key = self._make_key(field, usage)
        if key not in self._button_indices:
            self._button_indices[key] = len(self.buttons)
            self.buttons.append(name + _make_suffix(name, self.buttons))
        return self._button_indices[key]

    def _make_key(self, field: ReportField, usage: int) -> tuple[int, int, int]:
        """Return application, usage, and number of earlier fields with this usage in the report."""
        usage_in_report = (field.application, field.report_id, usage)
        earlier_count = self._usage_counts[usage_in_report]
        self._usage_counts[usage_in_report] += 1
        return field.application, usage, earlier_count


def _make_suffix(name: str, names: list[str]) -> str:
    count = sum(1 for other in names if other == name or other.startswith(f"{name} "))
    return f" {count + 1}" if count else ""
