"""Columns that hold each value once."""

import pickle

from reina.instruments.coded_column import coded


def test_a_column_reads_as_its_entries() -> None:
    entries = ["open", "1-2", "open", "1-2", "2"]
    column = coded(iter(entries))
    assert list(column) == entries
    assert column == tuple(entries)
    assert column != tuple(entries[:-1])
    assert (len(column), column[3], column[-1]) == (5, "1-2", "2")
    assert column[1:3] == ["1-2", "open"]
    assert hash(column) == hash(coded(entries))
    assert coded(()) == ()


def test_an_entry_takes_a_byte_or_two() -> None:
    few, many = ("a", "b") * 5_000, [str(n % 300) for n in range(10_000)]
    for entries, most in ((few, 11_000), (many, 25_000)):
        column = pickle.loads(pickle.dumps(coded(entries)))
        assert list(column) == list(entries)
        assert len(pickle.dumps(column)) < most
