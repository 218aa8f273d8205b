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
from collections.abc import Callable, Iterator
from typing import Any, NoReturn

from ._errors import BallbarError

# The same checks as apps/history/history.cpp has.
_ENDINGS = (".csv", ".json", ".html")


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(2, f"ballbar: {message.removeprefix('argument ')}; see ballbar history --help\n")


def _checked(take: Callable[[str], Any], expected: str) -> Callable[[str], Any]:
    """A kind of value: `take` raises ValueError where it is none."""

    def kind(text: str) -> Any:
        try:
            return take(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f'expected {expected}, found "{text}"') from None

    return kind


def _if(is_right: bool, value: Any) -> Any:
    if not is_right:
        raise ValueError
    return value


def _limit(text: str) -> tuple[str, float]:
    name, _, number = text.partition("=")
    return name, _if(bool(name) and 0.0 < float(number) < float("inf"), float(number))


_TEXT = _checked(lambda text: _if(bool(text), text), "a value")
_WORKERS = _checked(lambda text: _if(1 <= int(text) <= 1024, int(text)), "a number from 1 to 1024")
_RATE = _checked(lambda text: _if(0.0 <= float(text) <= 1.0, float(text)), "a number from 0 to 1")
_LIMIT = _checked(_limit, "NAME=VALUE with a number above 0")
_OUT = _checked(lambda text: _if(text.endswith(_ENDINGS), text), "a name that ends in .csv, .json or .html")


def _options(words: list[str]) -> argparse.Namespace:
    parser = _Parser(prog="ballbar history", description="The tests of many machines: table, ranking, page", allow_abbrev=False)
    parser.add_argument("paths", nargs="+", type=_TEXT, metavar="FOLDER", help="folders of .b5r files, patterns, or files")
    parser.add_argument("--table", type=_TEXT, metavar="FOLDER", help="where the table is kept: only what is new or changed is read")
    parser.add_argument("--workers", type=_WORKERS, metavar="N", help="processes that read; default: this one, on all cores")
    parser.add_argument("--scheduler", type=_TEXT, metavar="ADDRESS", help="of a Dask cluster, tcp://host:8786, whose workers read")
    parser.add_argument("--tolerance", action="append", type=_LIMIT, default=[], metavar="NAME=VALUE", help="limit of a quantity, to both sides of 0; may be repeated")
    parser.add_argument("--false-discovery-rate", type=_RATE, default=0.05, metavar="RATE", help="share of what is found by chance; default 0.05")
    parser.add_argument("--out", action="append", type=_OUT, default=[], metavar="FILE", help=".csv: the table; .json: what was found; .html: a page; may be repeated")
    parser.add_argument("--json", action="store_true", help="the result for a program")
    return parser.parse_args(words)


@contextlib.contextmanager
def _client(options: argparse.Namespace) -> Iterator[Any]:
    if not options.workers and not options.scheduler:
        yield None
        return
    try:
        from dask.distributed import Client, LocalCluster
    except ImportError:
        raise BallbarError(
            "--workers, --scheduler: expected Dask's distributed, found none; on Debian it is in the package python3-distributed."
        ) from None
    for name in ("distributed", "tornado", "asyncio"):  # what befalls workers stands in what is lacking
        logging.getLogger(name).setLevel(logging.CRITICAL)
    with contextlib.ExitStack() as stack:
        if options.scheduler:
            try:
                client = stack.enter_context(Client(options.scheduler, timeout=20))
            except (OSError, ValueError) as error:
                raise BallbarError(
                    f"--scheduler {options.scheduler}: expected the address of a Dask scheduler that runs, such as "
                    f"tcp://host:8786, found: {error or type(error).__name__}."
                ) from None
        else:
            before = signal.signal(signal.SIGINT, signal.SIG_IGN)  # the workers', whom this process ends
            try:
                cluster = LocalCluster(
                    n_workers=options.workers, threads_per_worker=1, dashboard_address=None, silence_logs=logging.CRITICAL
                )
            finally:
                signal.signal(signal.SIGINT, before)
            client = stack.enter_context(Client(stack.enter_context(cluster)))
        yield client


def _progress(done: int, of: int) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\033[K{done} of {of} files" if done < of else "\r\033[K")
        sys.stderr.flush()


def _expect_outputs(options: argparse.Namespace, files: list[str]) -> None:
    """Before anything is read: folders to write to, and no file that would be written over."""
    inputs = {os.path.realpath(file) for file in files} if options.out else set()
    for path in options.out:
        if not os.path.isdir(os.path.dirname(path) or os.curdir):
            raise BallbarError(f"--out {path}: expected a folder to write to, found none of that name.")
        if os.path.realpath(path) in inputs:
            raise BallbarError(f"--out {path}: expected another file than those that are read, found one of them.")
        if options.table and os.path.realpath(os.path.dirname(path) or os.curdir) == os.path.realpath(options.table):
            raise BallbarError(f"--out {path}: expected another folder than that of the table, found it.")


def _history(options: argparse.Namespace) -> int:
    from .fleet import _ranked, files_of, files_text, limits_of, update
    from ._fleet_files import written_whole

    limits = limits_of(dict(options.tolerance))
    files = files_of(options.paths if len(options.paths) > 1 else options.paths[0])
    _expect_outputs(options, files)
    with contextlib.ExitStack() as stack:
        table = options.table or stack.enter_context(tempfile.TemporaryDirectory(prefix="ballbar-"))
        client = stack.enter_context(_client(options))
        done = update(files, table, client=client, progress=_progress)
    title = os.path.basename(os.path.normpath(options.paths[0]))
    has_page = any(path.endswith(".html") for path in options.out)
    found, page = _ranked(done.table, limits, options.false_discovery_rate, title if has_page else None, len(done.lacking))
    keys = json.dumps(found.to_dict(), indent=2)
    for path in options.out:
        try:
            with written_whole(path) as temporary, open(temporary, "w", encoding="utf-8", newline="") as file:
                if path.endswith(".csv"):
                    done.table.to_csv(file, index=False)
                else:
                    file.write(page if path.endswith(".html") else keys + "\n")
        except OSError as error:
            raise BallbarError(f"--out {path}: could not be written: {error.strerror or error}; it is as it was.") from None
    print(keys if options.json else found.text, end="\n" if options.json else "", flush=True)
    for row in done.table[done.table["fault"].notna()].itertuples():
        print(row.fault, file=sys.stderr)
    for name, why in done.lacking.items():
        print(f"{name}: not read: {why}.", file=sys.stderr)
    kept = f", {done.kept} as they were" if done.kept else ""
    print(f"{files_text(done.read)} read{kept}" + (f", {done.gone} gone" if done.gone else ""), file=sys.stderr)
    for path in options.out:
        print(f"wrote {path}", file=sys.stderr)
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
    except (BallbarError, ValueError) as error:
        sentence = str(error)
    finally:
        _end_output()
    print(f"ballbar: {sentence}", file=sys.stderr)
    return 1


def _end_output() -> None:
    """What could not be written is not tried again as Python ends."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def main() -> int:
    try:
        os.execvp("ballbar", ["ballbar", *sys.argv[1:]])
    except OSError as error:
        if sys.argv[1:2] == ["history"]:
            return history(sys.argv[2:])
        print(f"ballbar: expected the program ballbar on PATH, found: {error.strerror}; without it: python -m ballbar history.", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
