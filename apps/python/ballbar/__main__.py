"""``ballbar fleet``: the tests of many machines as a table, and what they say."""
from __future__ import annotations

import argparse
import contextlib
import json
import os
import sys
from collections.abc import Iterator
from typing import Any


def _options(words: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="ballbar fleet", description="The tests of many machines: table, ranking, page")
    parser.add_argument("paths", nargs="+", metavar="FOLDER", help="folders of .b5r files, patterns, or files")
    parser.add_argument("--table", metavar="FOLDER", help="where the table is kept: only what is new or changed is read")
    parser.add_argument("--workers", type=int, default=0, metavar="N", help="processes that read; default: this one, on all cores")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster, tcp://host:8786, whose workers read")
    parser.add_argument("--tolerance", action="append", default=[], metavar="NAME=VALUE", help="limit of a quantity, to both sides of 0; may be repeated")
    parser.add_argument("--false-discovery-rate", type=float, default=0.05, metavar="RATE", help="share of what is called by chance; default 0.05")
    parser.add_argument("--out", action="append", default=[], metavar="FILE", help=".csv: the table; .json: what it says; .html: a page; may be repeated")
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
        raise SystemExit(
            "ballbar: --workers, --scheduler: expected Dask's distributed, found none; on Debian it is in the package "
            "python3-distributed"
        ) from None
    if options.scheduler:
        with Client(options.scheduler, timeout=20) as client:
            yield client
        return
    with LocalCluster(n_workers=options.workers, threads_per_worker=1, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            yield client


def _progress(done: int, of: int) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\033[K{done} of {of} files" if done < of else "\r\033[K")
        sys.stderr.flush()


def fleet(words: list[str]) -> int:
    import tempfile

    from . import BallbarError
    from .fleet import ranked
    from .fleet_table import update

    options = _options(words)
    paths = options.paths if len(options.paths) > 1 else options.paths[0]
    try:
        with contextlib.ExitStack() as stack:
            table = options.table or stack.enter_context(tempfile.TemporaryDirectory(prefix="ballbar-"))
            client = stack.enter_context(_client(options))
            done = update(paths, table, client=client, progress=_progress)
    except BallbarError as error:
        print(f"ballbar: {error}", file=sys.stderr)
        return 1
    limits = {name: float(limit) for name, _, limit in (one.partition("=") for one in options.tolerance)}
    page = next((path for path in options.out if path.endswith(".html")), None)
    try:
        found = ranked(
            done.table, tolerance=limits, false_discovery_rate=options.false_discovery_rate, page=page,
            title=os.path.basename(os.path.normpath(options.paths[0])),
        )
        for path in options.out:
            if path.endswith(".csv"):
                done.table.to_csv(path, index=False)
            elif path.endswith(".json"):
                with open(path, "w", encoding="utf-8") as output:
                    json.dump(found.to_dict(), output, indent=2)
    except (BallbarError, OSError) as error:
        print(f"ballbar: {error}", file=sys.stderr)
        return 1
    print(json.dumps(found.to_dict(), indent=2) if options.json else found.text, end="\n" if options.json else "")
    for row in done.table[done.table["fault"].notna()].itertuples():
        print(row.fault, file=sys.stderr)
    for file, why in done.lacking.items():
        print(f"{file}: not read: {why}", file=sys.stderr)
    kept = f", {done.kept} as they were" if done.kept else ""
    print(f"{done.read} files read{kept}" + (f", {done.gone} gone" if done.gone else ""), file=sys.stderr)
    for path in options.out:
        print(f"wrote {path}", file=sys.stderr)
    return 0 if done.complete else 1


def main() -> int:
    if len(sys.argv) > 1 and sys.argv[1] == "fleet":
        return fleet(sys.argv[2:])
    os.execvp("ballbar", ["ballbar", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
