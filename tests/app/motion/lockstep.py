"""Threads that take their steps one at a time in a given order."""

import threading

RUNNING, BLOCKED, DONE = "(running)", "(blocked)", "(done)"


class Lockstep:
    """Actors on separate threads; each waits at every named step until it may proceed."""

    def __init__(self):
        self.changed = threading.Condition()
        # The step that each actor waits to take.
        self.at = {}
        self._permitted_actor, self._free = None, False
        self._own = threading.local()
        self._threads = []

    @property
    def actor(self):
        """The actor of the current thread; None on a thread without an actor."""
        return getattr(self._own, "actor", None)

    def start(self, actor, work):
        """Start an actor, which runs up to its first step."""

        def run():
            self._own.actor = actor
            try:
                work()
            finally:
                with self.changed:
                    self.at[actor] = DONE
                    self.changed.notify_all()

        self.at[actor] = RUNNING
        thread = threading.Thread(target=run)
        self._threads.append(thread)
        thread.start()
        self._settle()

    def arrive(self, step):
        """Wait before a step, unless the thread has no actor or all actors run freely."""
        actor = self.actor
        if actor is None or self._free:
            return
        with self.changed:
            self.at[actor] = step
            self.changed.notify_all()
            self.changed.wait_for(lambda: self._permitted_actor == actor or self._free)
            self._permitted_actor, self.at[actor] = None, RUNNING

    def go(self, actor, step):
        """Let an actor take a step if it waits for this step; return whether it did."""
        with self.changed:
            if self.at[actor] != step:
                return False
            self._permitted_actor, self.at[actor] = actor, RUNNING
            self.changed.notify_all()
        self._settle()
        return True

    def run_freely(self):
        """Let all actors run to their ends."""
        with self.changed:
            self._free = True
            self.changed.notify_all()
        for thread in self._threads:
            thread.join()

    def _settle(self):
        with self.changed:
            self.changed.wait_for(lambda: RUNNING not in self.at.values())


class Lock:
    """A reentrant lock; an actor that waits for it counts as blocked, not as running."""

    def __init__(self, lockstep):
        self._lockstep = lockstep
        self._owner, self._depth = None, 0

    def __enter__(self):
        changed, at, actor = self._lockstep.changed, self._lockstep.at, self._lockstep.actor
        thread_id = threading.get_ident()
        with changed:
            if self._owner not in (None, thread_id):
                if actor is not None:
                    at[actor] = BLOCKED
                    changed.notify_all()
                changed.wait_for(lambda: self._owner is None)
                if actor is not None:
                    at[actor] = RUNNING
            self._owner, self._depth = thread_id, self._depth + 1

    def __exit__(self, *_):
        with self._lockstep.changed:
            self._depth -= 1
            if not self._depth:
                self._owner = None
                self._lockstep.changed.notify_all()
