"""Cell penetration, from approach to retraction.

Phases: approach, contact, thrust, hold, retract.
"""
