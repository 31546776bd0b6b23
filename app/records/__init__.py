"""The library of records: played, recorded and opened ones, with their data."""
