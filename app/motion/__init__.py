"""Motion: the session that owns a driver, playback and live data. Free of Qt."""
