"""Included robot files."""
