"""The library of records.

It holds played, recorded and opened records with their data.
"""
