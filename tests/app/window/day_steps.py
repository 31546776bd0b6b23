"""The steps of an operator's day, each with name, action and condition for its end."""

import logging
from functools import partial
from itertools import chain

import numpy as np
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QComboBox, QDialog, QTabWidget

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.shell.window import BUILT_IN, DIAGNOSE, OPERATE
from rotemina.app.shell.window.layouts import TUNE
from rotemina.app.widgets.style import THEMES
from rotemina.app.workbench import Level
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.simulator import Simulator
from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.trajectory import load_worn_effects, make_demonstration, make_example

# Size of the long record, of the library and of the log.
LONG_RECORD_ROWS = 200_000
LIBRARY_ENTRIES = 500
LOG_MESSAGES = 5000
NOTICES = 50
SIZES = ((1000, 700), (1920, 1080), (1280, 800))
PAGES = ("index", "plugins", "protocol")
THEME_LABEL = "theme"


class Operator:
    """The window, workbench and panels that an operator uses."""

    def __init__(self, window, folder):
        self.window, self.bench, self.panels = window, window.workbench, window.panels
        self.folder = folder

    @property
    def is_at_rest(self):
        state = self.bench.session.snapshot()
        idle = state.activity is DeviceState.IDLE
        return state.lock_reason is None and idle and not self.bench.busy

    def has_phase(self, phase):
        return lambda: self.bench.playback.state.phase is phase

    def is_connected_to(self, *drivers):
        session = self.bench.session
        return session.driver.name in drivers and session.snapshot().connection == "connected"

    @property
    def recordings(self):
        return [entry for entry in self.bench.library.entries if entry.kind == "recording"]

    def has_new_run_since(self, before):
        return lambda: self.bench.run is not before and self.is_at_rest

    def close_dialogs(self):
        for widget in QApplication.topLevelWidgets():
            if isinstance(widget, QDialog) and widget.isVisible():
                widget.close()


def at_once():
    return True


def do_nothing():
    pass


def prepare(folder, robot, part):
    """Write the records of earlier days into a folder."""
    if part != "work":
        return
    played = folder / "data" / "played"
    played.mkdir(parents=True)
    time_s = np.arange(40) / 100.0
    signals = {("x", tap): 1e-3 * time_s for tap in (Tap.CMD, Tap.MEAS)}
    write_record(Record.from_signals(time_s, signals, {"x": "m"}), folder / "short.csv")
    text = (folder / "short.csv").read_bytes()
    for number in range(LIBRARY_ENTRIES):
        timestamp = f"2026-01-{1 + number // 24:02d}_{number % 24:02d}-00-00-000000"
        (played / f"{timestamp}_x{number}.csv").write_bytes(text)
    write_record(make_long_record(robot), folder / "long.csv")


def make_long_record(robot):
    """Return a record of all axes that is longer than three minutes."""
    time_s = np.arange(LONG_RECORD_ROWS) / 1000.0
    signals, units = {}, {}
    rng = np.random.default_rng(1)
    for number, (name, axis) in enumerate(robot.axes.items()):
        swing = 0.02 * axis.span * np.sin(2.0 * np.pi * (0.02 + 0.01 * number) * time_s)
        signals[name, Tap.CMD] = sum(axis.range) / 2.0 + swing
        noise = 1e-4 * axis.span * rng.standard_normal(LONG_RECORD_ROWS)
        signals[name, Tap.MEAS] = signals[name, Tap.CMD] + noise
        units[name] = axis.unit
    return Record.from_signals(time_s, signals, units)


def start(op):
    loader = op.window.panel_loader
    yield "layout Tune at the start", partial(op.window.arrangement.arrange, TUNE), at_once
    yield "start", do_nothing, lambda: not op.panels.pending_names and not loader._next.isActive()
    yield "connect", do_nothing, lambda: op.is_at_rest


def themes(op):
    """Change the theme, which is the reference for all other steps, and change it back."""
    current = op.bench.theme.name
    for name in [*(other for other in THEMES if other != current), current]:
        yield f"{THEME_LABEL} {name}", partial(op.window.use_theme, name), at_once


def arrange(op, layout):
    """Return the step that arranges a layout."""
    action = partial(op.window.arrangement.arrange, layout)
    return f"layout {layout.plain_title}", action, at_once


def layouts(op):
    for layout in BUILT_IN:
        yield arrange(op, layout)
        for size in SIZES:
            resize = partial(op.window.resize, *size)
            yield f"resize {layout.plain_title} to {size[0]}", resize, at_once
    yield arrange(op, OPERATE)


def panels(op):
    for name, panel in op.panels.items():
        yield f"panel {name}", partial(op.window.bring_up, name), at_once
        for tabs in panel.findChildren(QTabWidget):
            for index in range(tabs.count()):
                show_tab = partial(tabs.setCurrentIndex, index)
                yield f"panel {name}, {tabs.tabText(index)}", show_tab, at_once


def windows(op):
    window = op.window
    yield "palette", window.toggle_palette, at_once
    for letter in "plate":
        yield "palette, typing", partial(window.palette_page.field.insert, letter), at_once
    yield "palette", window.toggle_palette, at_once
    for page in PAGES:
        yield f"help {page}", partial(window.help_page.open_page, f"{page}.md"), at_once
    yield "help", window.help_page.close, at_once
    yield "keys", window.show_keys, at_once
    yield "keys", op.close_dialogs, at_once
    yield "choose a trajectory", window.ask_trajectory, at_once
    yield "choose a trajectory", op.close_dialogs, at_once


def messages(op):
    window, logger = op.window, logging.getLogger("day")

    def log(first):
        for number in range(first, first + 1000):
            text = f"message {number}"
            window.log.emit(logger.makeRecord("day", logging.WARNING, "", 0, text, (), None))

    def notify(first):
        for number in range(first, first + 10):
            level = Level.WARNING if number % 3 else Level.ERROR
            op.bench.notify(level, f"notice {number % 40} of many")

    for first in range(0, LOG_MESSAGES, 1000):
        yield "many messages", partial(log, first), at_once
    yield "log", window.show_log, at_once
    yield "log, search", partial(window.log_page.words.setText, "99"), at_once
    yield "log", window.log_page.close, at_once
    for first in range(0, NOTICES, 10):
        yield "many notices", partial(notify, first), at_once
    path = op.folder / "support.zip"
    yield "support bundle", window.show_support, lambda: bool(window._support.items)
    yield "support bundle, save", lambda: window._support.write(path), path.exists
    yield "support bundle", lambda: window._support.close(), at_once


def playback(op):
    bench, phase = op.bench, PlaybackPhase
    play = op.panels["trajectory"].transport.play
    yield arrange(op, OPERATE)
    example = partial(bench.plan_trajectory, "example", make_example(bench.robot))
    yield "load the example", example, lambda: bench.plan is not None and op.is_at_rest
    yield "play", do_nothing, play.isEnabled
    yield "play", play.click, op.has_phase(phase.PLAYING)
    # Presses are ignored for half a second.
    yield "play", do_nothing, play.isEnabled
    yield "pause", play.click, op.has_phase(phase.PAUSED)
    yield "pause", do_nothing, play.isEnabled
    yield "resume", play.click, op.has_phase(phase.PLAYING)
    yield "play to the end", do_nothing, op.has_new_run_since(None)
    yield "play", do_nothing, play.isEnabled
    yield "play", play.click, op.has_phase(phase.PLAYING)
    yield "end", bench.end_playback, lambda: op.is_at_rest


def diagnosis(op):
    bench, gap = op.bench, op.panels["gap"]
    wear = partial(bench.session.service.set_effects, load_worn_effects(bench.robot))
    yield "wear the machine", wear, lambda: op.is_at_rest
    motion = make_demonstration(bench.robot)
    plan = partial(bench.plan_trajectory, "worn", motion)
    yield "load a trajectory", plan, lambda: bench.plan.trajectory is motion and op.is_at_rest
    yield "play on a worn machine", bench.play, op.has_new_run_since(bench.run)
    yield arrange(op, DIAGNOSE)
    yield "diagnose", do_nothing, gap.start.isEnabled
    yield "diagnose", gap.start.click, lambda: gap.answer is not None
    for index in range(gap.result.tabs.count()):
        yield f"diagnosis, tab {index}", partial(gap.result.tabs.setCurrentIndex, index), at_once
    path = op.folder / "report.html"
    report = lambda: gap.exports.save_report(gap.answer, path)  # noqa: E731 (awaits the answer)
    yield "report", report, lambda: path.exists() and not bench.busy
    yield "use the corrected model", do_nothing, gap.result.use.isEnabled
    yield "use the corrected model", gap.result.use.click, lambda: op.is_at_rest
    for layout in BUILT_IN:
        yield arrange(op, layout)
    yield arrange(op, OPERATE)


def records(op):
    window, bench, recorder = op.window, op.bench, op.panels["recorder"]
    yield "panel recorder", partial(window.bring_up, "recorder"), at_once
    toggle = recorder.recording.toggle
    yield "record", toggle, lambda: bench.operation.recording is not None
    is_stopped = lambda: bench.operation.recording is None and op.recordings  # noqa: E731 (awaited)
    yield "end of a recording", toggle, is_stopped
    replay = lambda: bench.open_replay(op.recordings[0].path)  # noqa: E731 (not there before)
    yield "replay", replay, lambda: bench.replaying.paced is not None
    yield "end of a replay", bench.replaying.end, at_once
    open_long = partial(window.open_record, op.folder / "long.csv")
    yield "open a long record", open_long, op.has_new_run_since(bench.run)
    for name in ("comparison", "gap", "plots", "identification"):
        yield f"long record, {name}", partial(window.bring_up, name), at_once
    view = op.panels["identification"].controls.view
    for index in range(view.count()):
        show = partial(view.setCurrentIndex, index)
        yield f"identification, {view.itemText(index)}", show, at_once
    search = recorder.recordings.table.search
    yield "library", partial(window.bring_up, "recorder"), at_once
    yield "library, search", partial(search.setText, "x4"), at_once
    yield "library, all", search.clear, at_once
    yield "choose a record", window.ask_record, at_once
    yield "choose a record", op.close_dialogs, at_once


def views(op):
    window, bench = op.window, op.bench
    view3d, plate = op.panels["view3d"], op.panels["plate"]
    bring_up = lambda name: partial(window.bring_up, name)  # noqa: E731 (an action)
    yield "panel view3d", bring_up("view3d"), lambda: view3d.canvas.paint_count > 3
    for view in view3d.views.values():
        yield "3-D view from another side", view.click, at_once
    microscope = op.panels["microscope"]
    yield "panel microscope", bring_up("microscope"), lambda: bench.microscope.status.cameras
    camera = partial(bench.microscope.camera.open, "simulated:microscope")
    yield "camera", camera, lambda: microscope.view.frame is not None
    yield "jog before the camera", partial(bench.jog, "x", 1e-4), lambda: op.is_at_rest
    yield "panel plate", bring_up("plate"), at_once
    yield "solve the plate", plate.solve, lambda: plate.solved is not None
    for choice in plate.findChildren(QComboBox):
        yield "plate, choices", lambda box=choice: box.setCurrentIndex(box.count() - 1), at_once


def devices(op):
    window, bench = op.window, op.bench
    calibration, compensation = op.panels["calibration"], op.panels["compensation"]
    penetration, faults = op.panels["penetration"], op.panels["faults"]
    is_idle = lambda: not compensation.job.running  # noqa: E731 (awaited)
    yield "panel penetration", partial(window.bring_up, "penetration"), at_once
    yield "prepare a penetration", penetration.prepare, lambda: op.is_at_rest
    yield "panel calibration", partial(window.bring_up, "calibration"), at_once
    yield "plan a calibration", calibration.plan, lambda: op.is_at_rest
    yield "panel compensation", partial(window.bring_up, "compensation"), at_once
    yield "learn inverses", compensation.train_in_simulation, is_idle
    yield "tune gains", compensation.tune, is_idle
    wear = partial(bench.session.service.set_effects, load_worn_effects(bench.robot))
    yield "effects", partial(window.bring_up, "effects"), at_once
    yield "wear the machine", wear, lambda: op.is_at_rest
    board, device = faults.injection.board, op.panels["connection"].device
    yield "virtual boards", partial(board.start, 2, homed=True), lambda: bool(board.ports)
    driver_index = device.choice.findText("mc68hc11")
    yield "choose a driver", partial(device.choice.setCurrentIndex, driver_index), at_once
    boards = partial(op.is_connected_to, "mc68hc11")
    yield "connect to boards", do_nothing, device.connect_button.isEnabled
    yield "connect to boards", device.connect_button.click, boards
    simulator = partial(bench.use_driver, Simulator, {})
    yield "connect to the simulator", simulator, partial(op.is_connected_to, "simulator")
    yield "end of the boards", board.end, lambda: op.is_at_rest


def quit_dialog(op):
    """Close the window during a motion, and reject the question whether to quit."""
    session = op.bench.session
    jog = partial(op.bench.jog, "x", 5e-3)
    yield "a long move", jog, lambda: session.snapshot().activity is not DeviceState.IDLE

    def close():
        QTimer.singleShot(400, lambda: QApplication.activeModalWidget().reject())
        op.window.close()

    yield "quit dialog", close, at_once


def _make_part(*parts):
    return lambda op: chain.from_iterable(part(op) for part in (start, *parts, themes))


PARTS = {
    "window": _make_part(layouts, panels, windows, messages),
    "work": _make_part(playback, diagnosis, records),
    "devices": _make_part(views, devices, quit_dialog),
}
