"""The events of a session on its own threads; every wait is for an event."""

import threading
import time

WAIT_S = 20.0


class EventLog:
    """Notes the events of a session in ``events`` and waits for conditions."""

    def __init__(self, session, events=None):
        self.session = session
        self.events = [] if events is None else events
        self._changed = threading.Condition()
        session.subscribe(self._note)

    def _note(self, event):
        with self._changed:
            self.events.append(event)
            self._changed.notify_all()

    def list_events(self, kind):
        return [event for event in self.events if isinstance(event, kind)]

    def wait_until(self, condition, limit_s=WAIT_S):
        """Wait until a condition holds; it is checked after every event, and at times."""
        with self._changed:
            end_s = time.monotonic() + limit_s
            while not condition():
                remaining_s = end_s - time.monotonic()
                assert remaining_s > 0.0, (self.session.snapshot(), self.events)
                self._changed.wait(min(remaining_s, 0.05))
