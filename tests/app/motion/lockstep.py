"""Threads that take their steps one at a time, in an order that is given to them."""

import threading

RUNNING, BLOCKED, DONE = "(running)", "(blocked)", "(done)"


class Lockstep:
    """Actors on threads of their own; each waits at every named step until it is its turn."""

    def __init__(self):
        self.came = threading.Condition()
        self.at = {}  # of each actor, the step before which it waits
        self._turn, self._free = None, False
        self._own = threading.local()
        self._threads = []

    @property
    def actor(self):
        """Whose thread this is; None on any other one."""
        return getattr(self._own, "actor", None)

    def start(self, actor, work):
        """Begin an actor, which goes as far as its first step."""

        def run():
            self._own.actor = actor
            try:
                work()
            finally:
                with self.came:
                    self.at[actor] = DONE
                    self.came.notify_all()

        self.at[actor] = RUNNING
        thread = threading.Thread(target=run)
        self._threads.append(thread)
        thread.start()
        self._settle()

    def arrive(self, step):
        """Wait before a step; on other threads, and at the end, nobody does."""
        actor = self.actor
        if actor is None or self._free:
            return
        with self.came:
            self.at[actor] = step
            self.came.notify_all()
            self.came.wait_for(lambda: self._turn == actor or self._free)
            self._turn, self.at[actor] = None, RUNNING

    def go(self, actor, step):
        """Let an actor take a step, if that is what it waits for; return whether it was."""
        with self.came:
            if self.at[actor] != step:
                return False
            self._turn, self.at[actor] = actor, RUNNING
            self.came.notify_all()
        self._settle()
        return True

    def let_go(self):
        """Let all of them go on to their ends."""
        with self.came:
            self._free = True
            self.came.notify_all()
        for thread in self._threads:
            thread.join()

    def _settle(self):
        with self.came:
            self.came.wait_for(lambda: RUNNING not in self.at.values())


class Lock:
    """A lock like any other; whoever waits for it counts as waiting, not as running."""

    def __init__(self, lockstep):
        self._lockstep = lockstep
        self._owner, self._depth = None, 0

    def __enter__(self):
        came, at, actor = self._lockstep.came, self._lockstep.at, self._lockstep.actor
        me = threading.get_ident()
        with came:
            if self._owner not in (None, me):
                if actor is not None:
                    at[actor] = BLOCKED
                    came.notify_all()
                came.wait_for(lambda: self._owner is None)
                if actor is not None:
                    at[actor] = RUNNING
            self._owner, self._depth = me, self._depth + 1

    def __exit__(self, *_):
        with self._lockstep.came:
            self._depth -= 1
            if not self._depth:
                self._owner = None
                self._lockstep.came.notify_all()
