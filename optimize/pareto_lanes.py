"""Searches side by side in lockstep: one batch at a time, in an order that no worker's speed decides.

NLopt asks for one design at a time and waits for it, so each search has a thread of its own; all evaluations and the
journal stay with the caller's thread. A batch goes out when every search has asked for its next design or has ended:
the same searches then see the same designs in the same order on one worker or many, and replay over a journal.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from queue import SimpleQueue

from fluxbore.optimize.outcome import Candidate
from fluxbore.optimize.problem import Point

Ask = Callable[[Point], Candidate]
"""Scaled point -> its design, evaluated; raises `LaneStoppedError` when all searches are to end."""

Job = Callable[[Ask], None]
"""A search, which keeps what it finds itself. Between two asks no other lane's designs arrive."""

Serve = Callable[[Sequence[Point]], Sequence[Candidate]]
"""Evaluates the points of one batch, in their order."""


class LaneStoppedError(Exception):
    """All lanes are to end, whatever the reason is."""


class _Lane:
    """One search in its thread. Its messages: a point it waits for, or None when it has ended."""

    def __init__(self, job: Job) -> None:
        self.asked: SimpleQueue[Point | None] = SimpleQueue()
        self.answers: SimpleQueue[Candidate | None] = SimpleQueue()
        self.error: BaseException | None = None
        self._job = job
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _run(self) -> None:
        try:
            self._job(self._ask)
        except LaneStoppedError:
            pass
        except BaseException as error:  # it is raised again in the caller's thread
            self.error = error
        finally:
            self.asked.put(None)

    def _ask(self, point: Point) -> Candidate:
        self.asked.put(point)
        answer = self.answers.get()
        if answer is None:
            raise LaneStoppedError
        return answer


def side_by_side(jobs: Sequence[Job], serve: Serve) -> None:
    """Run the searches to their ends, with ``serve`` called in this thread.

    What ``serve`` or a search raises, and Ctrl-C, ends them all and is raised again here.
    """
    lanes: list[_Lane] = []
    try:
        lanes += [_Lane(job) for job in jobs]
        live = list(lanes)
        while live:
            waiting: list[tuple[_Lane, Point]] = []
            for lane in live:
                point = lane.asked.get()
                if point is not None:
                    waiting.append((lane, point))
                elif lane.error is not None:
                    raise lane.error
            live = [lane for lane, _ in waiting]
            if live:
                answers = serve([point for _, point in waiting])
                for lane, answer in zip(live, answers, strict=True):
                    lane.answers.put(answer)
    finally:
        for lane in lanes:
            lane.answers.put(None)
        for lane in lanes:
            lane.thread.join()
