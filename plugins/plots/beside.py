"""A record of the library, to be drawn beside the present run."""

from collections.abc import Callable

from rotemina.app.panel import Panel
from rotemina.app.records.entry import Entry
from rotemina.app.records.library import read
from rotemina.app.shell.language import translate
from rotemina.app.shell.record_chooser import ask_records
from rotemina.app.shell.workbench import Level
from rotemina.plugins.plots.overlay import OtherRun
from rotemina.sim.records.record import Record


def ask_run(panel: Panel, use: Callable[[OtherRun], None]) -> None:
    """Ask for a record, read it, and hand it on."""
    bench = panel.workbench

    def done(entry: Entry, record: Record) -> None:
        use(OtherRun.of_record(entry.name, record, bench.robot))

    def take(chosen: tuple[Entry, ...]) -> None:
        entry = chosen[0]
        bench.work(
            "run beside",
            translate("plots", "Reading {name} …").format(name=entry.name),
            lambda: read(entry, bench.robot),
            lambda record: done(entry, record),
        )

    def nothing_there() -> None:
        text = translate("plots", "The library has no records: play or record a motion first.")
        bench.notify(Level.WARNING, text, about=panel)

    title = translate("plots", "Record beside the present run")
    ask_records(panel.main_window, bench, title, take, nothing_there)
