"""Diagnosis of machines with known causes."""
