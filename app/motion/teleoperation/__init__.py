"""From stick readings to motion.

It turns readings of input devices into motion of axes.
"""
