"""Effects of the running simulator: switch, tune, load and save them."""
