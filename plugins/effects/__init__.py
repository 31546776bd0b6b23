"""Effects of the running simulator: switched, tuned, loaded and saved."""
