"""Model, records, diagnosis.

Robot files, records, the nominal plant, and its comparison with a real machine.
"""
