"""The library of records."""
