"""``ballbar history`` with Dask: the tests of many machines as a table, and what was found."""
from __future__ import annotations

import argparse
import contextlib
import io
import json
import logging
import os
import signal
import sys
import tempfile
import warnings
from collections.abc import Callable
from typing import Any, NoReturn

from ._errors import BallbarError, BallbarWarning


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(2, f"ballbar: {message.removeprefix('argument ')}; see ballbar history --help\n")


def _kind(expected: str, is_right: Callable[[Any], object], take: Callable[[str], Any] = str) -> Callable[[str], Any]:
    """Returns a kind of value, as apps/history/history.cpp has it; `take` raises ValueError where it is none."""

    def kind(text: str) -> Any:
        with contextlib.suppress(ValueError):
            if is_right(value := take(text)):
                return value
        raise argparse.ArgumentTypeError(f'expected {expected}, found "{text}"')

    return kind


def _limit(text: str) -> tuple[str, float]:
    name, _, number = text.partition("=")
    return name, float(number)


def _options(words: list[str]) -> argparse.Namespace:
    parser = _Parser(prog="ballbar history", description="The tests of many machines: table, ranking, page", allow_abbrev=False)
    text = _kind("a value", bool)
    workers = _kind("a number from 1 to 1024", lambda value: 1 <= value <= 1024, int)
    rate = _kind("a number from 0 to 1", lambda value: 0.0 <= value <= 1.0, float)
    limit = _kind("NAME=VALUE with a number above 0", lambda value: value[0] and 0.0 < value[1] < float("inf"), _limit)
    out = _kind("a name that ends in .csv, .json or .html", lambda value: value.endswith((".csv", ".json", ".html")))
    parser.add_argument("paths", nargs="+", type=text, metavar="FOLDER", help="folders of .b5r files, patterns, or files")
    parser.add_argument("--table", type=text, metavar="FOLDER", help="where the table is kept: only what is new or changed is read")
    parser.add_argument("--workers", type=workers, metavar="N", help="processes that read; default: this one, on all cores")
    parser.add_argument("--scheduler", type=text, metavar="ADDRESS", help="address of a Dask cluster, tcp://host:8786")
    parser.add_argument("--tolerance", action="append", type=limit, default=[], metavar="NAME=VALUE", help="limit of a quantity, to both sides of 0; may be repeated")
    parser.add_argument("--false-discovery-rate", type=rate, default=0.05, metavar="RATE", help="share of what is found by chance; default 0.05")
    parser.add_argument("--out", action="append", type=out, default=[], metavar="FILE", help=".csv: the table; .json: what was found; .html: a page; may be repeated")
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    return parser.parse_args(words)


def _client(workers: int | None, scheduler: str | None) -> contextlib.AbstractContextManager[Any]:
    if not workers and not scheduler:
        return contextlib.nullcontext()
    from distributed import Client

    for name in ("distributed", "tornado", "asyncio"):  # what befalls workers stands in what is lacking
        logging.getLogger(name).setLevel(logging.CRITICAL)
    if scheduler:
        try:
            return Client(scheduler, timeout=20)
        except (OSError, ValueError) as error:
            raise BallbarError(
                f"--scheduler {scheduler}: expected the address of a Dask scheduler that runs, such as tcp://host:8786, "
                f"found: {error or type(error).__name__}."
            ) from None
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)  # the workers', whom this process ends
    try:
        return Client(n_workers=workers, threads_per_worker=1, dashboard_address=None, silence_logs=logging.CRITICAL)
    finally:
        signal.signal(signal.SIGINT, before)


def _expect_outputs(options: argparse.Namespace, files: list[str]) -> None:
    """Before anything is read: folders to write to, and no file that would be written over."""
    inputs = {os.path.realpath(file) for file in files} if options.out else set()
    for path in options.out:
        folder = os.path.dirname(path) or os.curdir
        if not os.path.isdir(folder):
            raise BallbarError(f"--out {path}: expected a folder to write to, found none of that name.")
        if os.path.realpath(path) in inputs:
            raise BallbarError(f"--out {path}: expected another file than those that are read, found one of them.")
        if options.table and os.path.realpath(folder) == os.path.realpath(options.table):
            raise BallbarError(f"--out {path}: expected another folder than that of the table, found it.")


def _history(options: argparse.Namespace) -> int:
    from . import fleet
    from ._fleet_files import write_whole

    tolerance = fleet.limits_of(dict(options.tolerance))
    files = fleet.files_of(options.paths if len(options.paths) > 1 else options.paths[0])
    _expect_outputs(options, files)
    with contextlib.ExitStack() as stack:
        table = options.table or stack.enter_context(tempfile.TemporaryDirectory(prefix="ballbar-"))
        done = fleet.update(files, table, client=stack.enter_context(_client(options.workers, options.scheduler)))
    pages = [path for path in options.out if path.endswith(".html")]
    how = {"tolerance": tolerance, "false_discovery_rate": options.false_discovery_rate, "lacking": len(done.lacking)}
    try:
        for page in pages or [None]:
            found = fleet.rank(done.table, page=page, title=os.path.basename(os.path.normpath(options.paths[0])), **how)
        keys = json.dumps(found.to_dict(), indent=2) + "\n"
        for path in options.out:
            if path not in pages:
                write_whole(path, (done.table.to_csv(index=False) if path.endswith(".csv") else keys).encode())
    except BallbarError as error:
        raise BallbarError(("--out " if str(error).startswith(tuple(options.out)) else "") + str(error)) from None
    print(keys if options.json else found.text, end="", flush=True)
    counts = f"{fleet.files_text(done.read)} read" + (f", {done.kept} as they were" if done.kept else "") + (f", {done.gone} gone" if done.gone else "")
    lacking = [f"{name}: not read: {why}." for name, why in done.lacking.items()]
    print(*done.table["fault"].dropna(), *lacking, counts, *(f"wrote {path}" for path in options.out), sep="\n", file=sys.stderr)
    return 0 if done.complete else 1


def history(words: list[str]) -> int:
    """Runs the command; its status: 0, 1 where something is at fault, 2 for a misuse, 130 for Ctrl-C.

    Parameters
    ----------
    words : list of str
        Of the command line, after ``ballbar history``.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    warnings.showwarning = lambda said, *_, **__: print(f"ballbar: {said}", file=sys.stderr) if isinstance(said, BallbarWarning) else None
    try:
        return _history(_options(words))
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        return 141  # as the program's other commands, by the signal
    except ImportError as error:
        sentence = f"history: expected pandas and Dask for Python, found: {error}; on Debian install python3-pandas and python3-distributed."
    except OSError as error:
        sentence = f"{error.filename or 'output'}: {error.strerror or error}."
    except ValueError as error:
        sentence = str(error)
    finally:
        try:
            sys.stdout.flush()
        except OSError:  # what could not be written is not tried again as Python ends
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    print(f"ballbar: {sentence}", file=sys.stderr)
    return 1


def main() -> int:
    """Runs the program; where it is not installed, its command history alone."""
    try:
        os.execvp("ballbar", ["ballbar", *sys.argv[1:]])
    except OSError as error:
        if sys.argv[1:2] == ["history"]:
            return history(sys.argv[2:])
        print(f"ballbar: expected the program ballbar on PATH, found: {error.strerror}; without it: python -m ballbar history.", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
