"""How many threads the linear algebra under us may use."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def one_thread() -> Iterator[None]:
    """Keep BLAS to one thread while the block runs.

    The band of a design's matrix is too narrow to share: two threads make it slower, and on a busy machine, where they
    wait for one another, many times slower. Workers and the command line set this before numpy is loaded; in a
    notebook it is too late for that.
    """
    from threadpoolctl import threadpool_limits

    from fluxbore.fem.lapack import routine

    routine("pbtrf", "float64")  # what is loaded later than here would not be held back
    with threadpool_limits(limits=1, user_api="blas"):
        yield
