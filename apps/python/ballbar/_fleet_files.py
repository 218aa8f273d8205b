"""Files of many machines: found, opened wherever they are, known again by size and time; and files written whole."""
from __future__ import annotations

import contextlib
import glob
import hashlib
import os
import stat
import tempfile
import uuid
import zlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Union

from fsspec.core import url_to_fs

from ._errors import BallbarError

Paths = Union[str, "os.PathLike[str]", Iterable[Union[str, "os.PathLike[str]"]]]
Stamp = tuple[int, int]  # size in bytes, ns since 1970; of other file systems a number that differs as the file does


def files_of(paths: Paths, **storage: Any) -> list[str]:
    """The files of a pattern, of a folder, or of a list of files, folders and patterns.

    Parameters
    ----------
    paths : path, pattern, or list of them
        A folder stands for all `.b5r` below it, hidden ones and links to folders left out; so does a folder that a
        pattern (``plant/mill-0?``, ``plant/**/*.b5r``) matches. ``s3://...`` and the like are found by fsspec.
    **storage
        Options of fsspec's file system.

    Returns
    -------
    list of str
        Sorted, as they were named; a file by two names is there once. A name of a list that is not there, and a folder
        that cannot be listed, stand for themselves: whoever reads them says why they cannot be read.

    Raises
    ------
    BallbarError
        Where there is none; a file system that is not known, or not there.
    """
    is_one = isinstance(paths, (str, os.PathLike))
    several = [os.fsdecode(one) for one in ([paths] if isinstance(paths, (str, os.PathLike)) else paths)]
    found: list[str] = []
    for text in several:
        named = _elsewhere(text, storage) if "://" in text else _here(text)
        if not named and is_one:
            kind = "files" if os.path.isdir(text) or glob.has_magic(text) else "a folder, files or a pattern"
            raise BallbarError(f"{text}: expected {kind}, found none of that name.")
        found += named or [text]
    if not found:
        raise BallbarError("paths: expected files, found none.")
    return _once(found)


def _here(text: str) -> list[str]:
    if os.path.lexists(text):
        return _below(text) if os.path.isdir(text) else [text]
    matches = glob.glob(text, recursive=True) if glob.has_magic(text) else []
    return [file for match in matches for file in (_below(match) if os.path.isdir(match) else [match])]


def _is_of_a_folder(name: str) -> bool:
    return name.lower().endswith(".b5r") and not name.startswith(".")


def _below(folder: str) -> list[str]:
    files: list[str] = []
    for at, folders, names in os.walk(folder, onerror=lambda error: files.append(getattr(error, "filename", None) or folder)):
        folders[:] = [name for name in folders if not name.startswith(".")]
        files += [os.path.join(at, name) for name in names if _is_of_a_folder(name)]
    return files


def _elsewhere(text: str, storage: dict[str, Any]) -> list[str]:
    try:
        system, inside = url_to_fs(text, **storage)
        if glob.has_magic(inside):
            matches = {path: about["type"] == "directory" for path, about in system.glob(inside, detail=True).items()}
        elif not os.path.splitext(inside)[1] and system.isdir(inside):
            matches = {inside: True}
        else:
            return [text]
        files: list[str] = []
        for path, is_folder in matches.items():
            files += [one for one in system.find(path) if _is_of_a_folder(os.path.basename(one))] if is_folder else [path]
    except Exception as error:  # noqa: BLE001  each file system has its own
        raise BallbarError(f"{text}: expected files, found: {reason_of(error)}.") from None
    return [f"{text.partition('://')[0]}://{path}" for path in files]


def _once(files: list[str]) -> list[str]:
    real_folders: dict[str, str] = {}
    by_place: dict[str, str] = {}
    for file in sorted(set(files)):
        place = file
        if "://" not in file:
            folder, name = os.path.split(file)
            if folder not in real_folders:
                real_folders[folder] = os.path.realpath(folder)
            place = os.path.realpath(file) if os.path.islink(file) else os.path.join(real_folders[folder], name)
        by_place.setdefault(place, file)
    return list(by_place.values())


def stamp_of(file: str, storage: dict[str, Any]) -> Stamp:
    """What a file is known again by. Raises OSError, or what the file system raises."""
    if "://" not in file:
        found = os.stat(file)
        if stat.S_ISDIR(found.st_mode):
            os.listdir(file)  # raises: it stands for itself, as it could not be listed
        return found.st_size, found.st_mtime_ns
    system, inside = url_to_fs(file, **storage)
    about = system.info(inside)
    changed = about.get("mtime") or about.get("LastModified") or about.get("ETag") or 0
    return int(about.get("size") or 0), zlib.crc32(str(changed).encode())


def reason_of(error: BaseException) -> str:
    """Why, in a few words."""
    if isinstance(error, UnicodeEncodeError):
        return "expected a name in UTF-8"
    return (getattr(error, "strerror", None) or str(error) or type(error).__name__).rstrip(".")


@dataclass
class Local:
    """A file that the program can open."""

    file: str  # as it was named
    path: str
    sha256: str


@contextlib.contextmanager
def opened(files: Sequence[str], storage: dict[str, Any], at: str) -> Iterator[tuple[list[Local], dict[str, str]]]:
    """The files that can be opened, as long as this lasts, and why the others cannot. `at`: whence names are relative."""
    with contextlib.ExitStack() as stack:
        found: list[Local] = []
        lacking: dict[str, str] = {}
        scratch = ""
        for file in files:
            try:
                file.encode()
                path = os.path.join(at or os.curdir, file)
                if "://" in file:
                    scratch = scratch or stack.enter_context(tempfile.TemporaryDirectory(prefix="ballbar-"))
                    path = _fetched(file, scratch, storage)
                with open(path, "rb") as bytes_of:
                    found.append(Local(file, path, hashlib.file_digest(bytes_of, "sha256").hexdigest()))
            except Exception as error:  # noqa: BLE001  each file system has its own
                lacking[file] = reason_of(error)
        yield found, lacking


def _fetched(file: str, scratch: str, storage: dict[str, Any]) -> str:
    """Files of one folder stay in one: two logs after each other may be one test."""
    system, inside = url_to_fs(file, **storage)
    folder, name = os.path.split(inside)
    here = os.path.join(scratch, hashlib.sha256(folder.encode()).hexdigest()[:16])
    os.makedirs(here, exist_ok=True)
    path = os.path.join(here, name or "file")
    system.get(inside, path)
    return path


@contextlib.contextmanager
def written_whole(path: str | os.PathLike[str]) -> Iterator[str]:
    """A name to write to; what is written there takes the place of `path` at the end, and never a part of it."""
    target = os.path.realpath(path)
    temporary = os.path.join(os.path.dirname(target), f".{os.path.basename(target)}.{uuid.uuid4().hex}")
    try:
        yield temporary
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())
        os.replace(temporary, target)
    finally:
        with contextlib.suppress(FileNotFoundError):
            os.remove(temporary)
