"""Model, records, diagnosis."""
