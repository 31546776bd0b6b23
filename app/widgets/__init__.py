"""Small widgets shared by the window and its panels, independent of panels and machine."""
