"""Facts about a record, by which others tell it apart."""

from dataclasses import replace

import pytest

from rotemina.sim.gap.output.report.facts import record_facts


def test_a_record_is_told_by_its_content_and_not_by_its_name(records):
    first, second = records
    again = replace(first, metadata={})
    one, same, other = record_facts([first, again, second], ["a.csv", "b.csv"])
    assert one.fingerprint == same.fingerprint != other.fingerprint
    assert (one.name, same.name, other.name) == ("a.csv", "b.csv", "")


def test_one_changed_reading_makes_another_record(records):
    record = records[0]
    values = record.values.copy()
    values[7, 0] += 1e-12
    one, other = record_facts([record, replace(record, values=values)], [])
    assert one.fingerprint != other.fingerprint


@pytest.mark.parametrize(("power", "rate"), [(1.0, "500 Hz"), (1.1, "uneven, ")])
def test_the_rate_is_one_number_where_samples_are_even(records, power, rate):
    record = records[0]
    (one,) = record_facts([replace(record, time_s=record.time_s**power)], [])
    assert one.rate.startswith(rate)


def test_long_metadata_are_cut(records):
    many = {f"key {number}": "x" * 1000 for number in range(100)}
    (one,) = record_facts([replace(records[0], metadata=many)], [])
    assert len(one.metadata) < len(many)
    assert max(len(value) for _, value in one.metadata) < 1000
