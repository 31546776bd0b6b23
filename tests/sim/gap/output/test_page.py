"""The report: complete, harmless whatever its inputs are, and without network access."""

import re
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest

from rotemina.sim.errors import FileWriteError
from rotemina.sim.gap.output import as_json, make_report_text
from rotemina.sim.gap.output.html_page import write_report
from rotemina.sim.gap.result import (
    AxisDiagnosis,
    Diagnosis,
    GapVerdict,
    RankedCandidate,
)
from rotemina.sim.messages import message
from rotemina.sim.records import Record
from rotemina.sim.units import format_percent, format_quantity

SCRIPT = "<script>alert(1)</script>"
IMAGE = "\"'><img src=x onerror=alert(1)>"
NAMES = (
    "html head meta title style body h1 h2 h3 h4 nav a div strong p span table tr th td code "
    "figure figcaption svg g path defs text use rect clippath"
)
ELEMENTS = set(NAMES.split())


class ParsedPage(HTMLParser):
    """Elements, attributes and texts of a page."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.attributes, self.texts = set(), [], []
        self.feed(text)
        self.text = " ".join(" ".join(self.texts).split())

    def handle_starttag(self, tag, attrs):
        self.elements.add(tag)
        self.attributes += attrs

    def handle_data(self, data):
        self.texts.append(data)

    def values(self, name):
        return [value for key, value in self.attributes if key == name]


@pytest.fixture(scope="module")
def text(diagnosis, records):
    return make_report_text(diagnosis, records, ["day one.csv"])


@pytest.fixture(scope="module")
def page(text):
    return ParsedPage(text)


def rename_axis(record, old, new, metadata):
    columns = tuple(
        channel._replace(axis=new) if channel.axis == old else channel for channel in record.columns
    )
    units = {new if axis == old else axis: unit for axis, unit in record.units.items()}
    return Record(record.time_s, columns, record.values.copy(), units, metadata)


@pytest.fixture(scope="module")
def hostile_page(diagnosis, records):
    """A page about an axis, an effect, a parameter and metadata whose names contain tags."""
    name = f"{SCRIPT}$x_$"
    robot = diagnosis.robot
    axes = {
        name if axis == "thx" else axis: description for axis, description in robot.axes.items()
    }
    thx = diagnosis.axes["thx"]
    cause = thx.causes[0]
    parameter = replace(cause.parameters[0], name=IMAGE, unit=SCRIPT)
    hostile_axis = AxisDiagnosis(
        name,
        GapVerdict.EXPLAINED,
        tuple(replace(place, axis=name) for place in thx.places),
        causes=(
            replace(cause, axis=name),
            replace(cause, axis=name, effect=IMAGE, formulation=SCRIPT, parameters=(parameter,)),
        ),
        shrinkage=(
            replace(
                thx.shrinkage[0],
                axis=name,
                steps=(replace(thx.shrinkage[0].steps[0], effect=IMAGE, axis=name),),
            ),
        ),
        ranking=(*thx.ranking, RankedCandidate(IMAGE, SCRIPT, name, 0.1, 3.0, (2.0, 4.0))),
        remarks=(message("gap", "{text}").fill(text=SCRIPT),),
        fitted=tuple(replace(effect, axis=name) for effect in thx.fitted),
    )
    experiment = replace(
        diagnosis.experiments[0],
        axis=name,
        why=SCRIPT,
        splits=(IMAGE, "creep"),
        predictions={
            IMAGE: diagnosis.experiments[0].predictions["creep"],
            "角度": diagnosis.experiments[0].predictions["hysteresis"],
        },
    )
    metadata = {SCRIPT: IMAGE, "note": "http://example.org"}
    return make_report_text(
        Diagnosis(
            replace(robot, name=SCRIPT, axes=axes, couplings=(), stages={}),
            {name: hostile_axis},
            (experiment,),
        ),
        [rename_axis(record, "thx", name, metadata) for record in records],
        [SCRIPT, IMAGE],
    )


def test_names_from_files_and_third_parties_are_text_and_nothing_else(hostile_page):
    page = ParsedPage(hostile_page)
    assert page.elements <= ELEMENTS
    assert "<script" not in hostile_page
    assert "<img" not in hostile_page
    assert not [name for name, _ in page.attributes if name.startswith("on")]
    assert page.text.count(SCRIPT) > 10
    assert page.text.count(IMAGE) > 5


def test_names_in_drawings_are_escaped_and_not_read_as_formulas(hostile_page):
    drawings = re.findall(r"<svg .*?</svg>", hostile_page, re.DOTALL)
    texts = " ".join(ParsedPage(svg).text for svg in drawings)
    assert "from <script>alert(1)</script>$x_$" in texts
    assert "角度" in texts


def test_the_page_loads_nothing_and_forbids_texts_to_load_anything(text, page):
    assert "http:" not in text
    assert "https:" not in text
    assert "default-src 'none'; style-src 'unsafe-inline'" in page.values("content")
    assert not page.values("src")
    assert not page.values("srcset")
    assert all(link.startswith("#") for link in page.values("href"))
    assert "@import" not in text
    assert all(target.startswith("#") for target in re.findall(r"url\(([^)]*)", text))


def test_every_internal_link_has_a_target(text, page):
    targets = {link[1:] for link in page.values("href")}
    targets |= set(re.findall(r"url\(#([^)]*)\)", text))
    assert targets <= set(page.values("id"))


def test_the_page_contains_the_facts_of_the_document(diagnosis, page):
    facts = as_json(diagnosis)
    for location in facts["where"]:
        words = (location["axis"], location["tap"], location["stage"], location["worst_regime"])
        assert all(word in page.text for word in words)
        assert (
            format_quantity(location["gap_rms"], "m" if location["axis"] == "y" else "rad")
            in page.text
        )
        assert format_percent(location["share"]) in page.text
    (cause,) = facts["causes"]
    assert "Hysteresis hysteresis prandtl ishlinskii actuator meas 91 % Creep" in page.text
    gaps = (format_quantity(cause[key], "rad") for key in ("gap_before", "gap_after"))
    assert " ".join(gaps) in page.text
    assert "width 120 µrad 110 µrad … 130 µrad 0.00012 rad high" in page.text
    (shrinkage,) = facts["shrinkage"]
    for key in ("raw", "retuned", "corrected", "floor", "ceiling"):
        assert format_quantity(shrinkage[key], "rad") in page.text
    assert format_percent(shrinkage["closed"]) in page.text
    assert format_percent(shrinkage["steps"][0]["shapley"]) in page.text
    for candidate in facts["candidates"]["thx"]:
        assert f"{candidate['effect']} " in page.text
        assert format_percent(candidate["probability"]) in page.text
    for text in facts["remarks"]["thx"]:
        assert text in page.text
    assert facts["next_experiments"][0]["why"] in page.text
    assert f"Seed {facts['seed']}" in page.text


def test_drawings_have_the_colours_of_the_page_and_records_their_names(text, page):
    drawings = " ".join(re.findall(r"<svg .*?</svg>", text, re.DOTALL))
    assert "var(--corrected)" in drawings
    assert "#00a0" not in drawings
    assert "prefers-color-scheme: dark" in text
    assert "thx: hysteresis or creep (these records cannot distinguish them)." in page.text
    assert "day one.csv" in page.text
    assert "A & B <b>" in page.text
    assert len(set(re.findall(r"\b[0-9a-f]{16}\b", page.text))) == 2


def test_a_long_session_still_makes_a_page_of_a_few_megabytes(diagnosis, records, text):
    twelve_records = [records[0]] * 12
    page = make_report_text(diagnosis, twelve_records)
    assert len(page) < 3_000_000
    assert "Of 12 records, the 4 with the largest gap are drawn." in page


@pytest.fixture(scope="module")
def healthy_diagnosis(diagnosis):
    return replace(diagnosis, axes={"y": diagnosis.axes["y"]}, experiments=())


def test_a_healthy_robot_has_a_reproducible_page_too(healthy_diagnosis, records):
    text = make_report_text(healthy_diagnosis, records)
    assert make_report_text(healthy_diagnosis, records) == text
    page = ParsedPage(text)
    assert "No gap: model and machine differ by no more than noise" in page.text
    assert "No effect is named." in page.text


def test_an_uneven_or_resting_record_is_reported_and_not_drawn(diagnosis, records):
    record = records[0]
    uneven = replace(record, time_s=record.time_s**1.1, values=record.values.copy())
    text = make_report_text(diagnosis, [uneven])
    assert "No frequency response is drawn: time: row" in text
    assert "No heat map is drawn" in text
    resting = record.select_rows(slice(0, 400))
    values = np.repeat(resting.values[:1], 400, axis=0)
    values = values + 1e-7 * np.random.default_rng(0).standard_normal(values.shape)
    values[:, [resting.columns.index(c) for c in resting.columns if c.tap == "cmd"]] = 5e-4
    text = make_report_text(diagnosis, [replace(resting, values=values)])
    assert "No frequency response is drawn: command: constant" in text


def test_the_file_is_written_completely_or_not_at_all(tmp_path, healthy_diagnosis, records):
    write_report(healthy_diagnosis, records, tmp_path / "report.html")
    assert (tmp_path / "report.html").read_text("utf-8").endswith("</html>\n")
    (tmp_path / "folder").mkdir()
    with pytest.raises(FileWriteError, match="is a folder"):
        write_report(healthy_diagnosis, records, tmp_path / "folder")
    assert [path.name for path in sorted(tmp_path.iterdir())] == ["folder", "report.html"]


def test_values_that_could_not_be_computed_are_not_drawn(diagnosis, records):
    thx = diagnosis.axes["thx"]
    nan, inf = float("nan"), float("inf")
    incomplete = replace(
        thx,
        shrinkage=(replace(thx.shrinkage[0], corrected=nan, ceiling=nan, closed=nan),),
        ranking=tuple(replace(candidate, held_out_rms=inf) for candidate in thx.ranking),
        causes=(
            replace(
                thx.causes[0],
                from_axis="y",
                gap_after=nan,
                parameters=(replace(thx.causes[0].parameters[0], unit="rad/…", interval=None),),
            ),
        ),
    )
    page = ParsedPage(make_report_text(replace(diagnosis, axes={"thx": incomplete}), records))
    assert "nan" not in page.text
    assert "Candidates, most likely first" not in " ".join(page.values("aria-label"))
    assert "width 120 µrad/m – 0.00012 rad/m high" in page.text
