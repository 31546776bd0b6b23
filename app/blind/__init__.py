"""The sealed self-test: the diagnosis as a separate process that sees only records."""
