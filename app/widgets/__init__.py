"""Small widgets that the window and its panels share; they know of no panel and no machine."""
