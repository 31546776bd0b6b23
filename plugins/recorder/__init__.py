"""Recorder: record, recover, list, export and replay sessions."""
