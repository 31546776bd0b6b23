"""Recording of sessions: written safely while they run, read back, exported and replayed."""
