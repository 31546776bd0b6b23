"""Automatic cell penetration."""
