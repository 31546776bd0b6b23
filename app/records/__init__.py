"""The library of records: what was played, recorded and opened, with what is known of each."""
