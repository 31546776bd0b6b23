"""The recorder of a session: everything on one clock, safe against crashes."""
