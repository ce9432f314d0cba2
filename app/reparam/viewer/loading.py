"""Opening a subject beside the window, which goes on and shows how far it is."""

from __future__ import annotations

from collections.abc import Callable
from threading import Event, Thread

from ..errors import ReparamError
from ..subject import Subject

Opener = Callable[[Callable[[float], None]], Subject]


class GivenUp(ReparamError):
    """The user does not want to wait any longer."""


class Loading:
    """Runs `open(progress)` in a thread of its own; `progress` is told shares from 0 to 1."""

    def __init__(self, name: str, open: Opener) -> None:
        self.name = name
        self.share = 0.0
        self._result: Subject | None = None
        self._fault: BaseException | None = None
        self._over = Event()
        self._given_up = False
        Thread(target=self._run, args=(open,), daemon=True).start()

    def _run(self, open: Opener) -> None:
        try:
            self._result = open(self._progress)
        except BaseException as fault:  # whatever it is, `result` raises it where it is asked for
            self._fault = fault
        self._over.set()

    def _progress(self, share: float) -> None:
        self.share = share
        if self._given_up:
            raise GivenUp(f"{self.name}: not opened")

    def done(self, seconds: float = 0.0) -> bool:
        """Whether it is over, waiting for it so long."""
        return self._over.wait(seconds)

    def give_up(self) -> None:
        """Stop at the next step."""
        self._given_up = True

    def result(self) -> Subject:
        """What was opened; raises what went wrong."""
        self._over.wait()
        if self._fault is not None:
            raise self._fault
        assert self._result is not None
        return self._result
