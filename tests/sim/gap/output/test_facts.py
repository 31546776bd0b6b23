"""Facts that identify a record."""

from dataclasses import replace

import pytest

from rotemina.sim.gap.output.report_facts import collect_record_facts


def test_a_record_is_identified_by_its_content_and_not_by_its_name(records):
    first = records[0]
    values = first.values.copy()
    values[7, 0] += 1e-12
    first_facts, copy_facts, changed_facts = collect_record_facts(
        [first, replace(first, metadata={}), replace(first, values=values)], ["a.csv", "b.csv"]
    )
    assert first_facts.fingerprint == copy_facts.fingerprint != changed_facts.fingerprint
    assert (first_facts.name, copy_facts.name, changed_facts.name) == ("a.csv", "b.csv", "")


@pytest.mark.parametrize(("power", "rate"), [(1.0, "500 Hz"), (1.1, "uneven, ")])
def test_the_rate_is_one_number_if_samples_are_even(records, power, rate):
    record = records[0]
    (facts,) = collect_record_facts([replace(record, time_s=record.time_s**power)], [])
    assert facts.rate.startswith(rate)


def test_long_metadata_are_shortened(records):
    metadata = {f"key {number}": "x" * 1000 for number in range(100)}
    (facts,) = collect_record_facts([replace(records[0], metadata=metadata)], [])
    assert len(facts.metadata) < len(metadata)
    assert max(len(value) for _, value in facts.metadata) < 1000
