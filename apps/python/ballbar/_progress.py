"""How far a long call is: told to a callback, or shown by tqdm on a terminal."""
from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator

from ._frame import Progress


def _nobody(done: int, of: int, text: str) -> None:
    """Takes what nobody asked for."""


@contextlib.contextmanager
def progress_or_tqdm(progress: Progress | None) -> Iterator[Progress]:
    """Yields `progress`, or, where it is None, a function that moves a bar of tqdm on a terminal.

    Where tqdm is not installed, or standard error is no terminal, the function does nothing.
    """
    if progress is not None or sys.stderr is None or not sys.stderr.isatty():
        yield progress or _nobody
        return
    try:
        from tqdm import tqdm
    except ImportError:
        yield _nobody
        return
    with tqdm(leave=False, dynamic_ncols=True, delay=0.3) as bar:

        def show(done: int, of: int, text: str) -> None:
            bar.total = of or None
            bar.set_description(text, refresh=False)
            bar.update(done - bar.n)

        yield show
