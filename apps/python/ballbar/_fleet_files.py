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
from typing import Any, Union

from ._errors import BallbarError

Paths = Union[str, "os.PathLike[str]", Iterable[Union[str, "os.PathLike[str]"]]]
Stamp = tuple[int, int]  # size in bytes, ns since 1970; of other file systems a number that differs as the file does


def files_of(paths: Paths, **storage: Any) -> list[str]:
    """Returns the files of a pattern, of a folder, or of a list of files, folders and patterns.

    Parameters
    ----------
    paths : path, pattern, or list of them
        A folder stands for all `.b5r` below it, hidden ones and links to folders left out; so does a folder that a
        pattern (``plant/mill-0?``, ``plant/**/*.b5r``) matches. fsspec finds ``s3://...`` and the like.
    **storage
        Options of fsspec's file system.

    Returns
    -------
    list of str
        Sorted, as they were named; a file that is named twice is there once. A name of a list that is not there, and a folder
        that cannot be listed, stand for themselves: whoever reads them says why they cannot be read.

    Raises
    ------
    BallbarError
        There is no file; a file system is not known, or not there.
    """
    is_one = isinstance(paths, (str, os.PathLike))
    found: list[str] = []
    for text in map(os.fsdecode, [paths] if isinstance(paths, (str, os.PathLike)) else paths):
        named = _elsewhere(text, storage) if "://" in text else _here(text)
        if not named and is_one:
            kind = "files" if glob.has_magic(text) else "a folder, files or a pattern"
            if os.path.isdir(text):
                raise BallbarError(f"{text}: expected .b5r files below this folder, found none; a pattern, such as *.csv, names other files.")
            raise BallbarError(f"{text}: expected {kind}, found none of that name.")
        found += named or [text]
    if not found:
        raise BallbarError("paths: expected files, found none.")
    return sorted({os.path.abspath(file): file for file in sorted(set(found), reverse=True)}.values())


def _here(text: str) -> list[str]:
    matches = [text] if os.path.lexists(text) else glob.glob(text, recursive=True) if glob.has_magic(text) else []
    return [file for match in matches for file in (_below(match) if os.path.isdir(match) else [match])]


def _is_of_a_folder(name: str) -> bool:
    return name.lower().endswith(".b5r") and not name.startswith(".")


def _below(folder: str) -> list[str]:
    files: list[str] = []
    for at, folders, names in os.walk(folder, onerror=lambda error: files.append(str(getattr(error, "filename", folder)))):
        folders[:] = [name for name in folders if not name.startswith(".")]
        files += [os.path.join(at, name) for name in names if _is_of_a_folder(name)]
    return files


def _elsewhere(text: str, storage: dict[str, Any]) -> list[str]:
    try:
        system, inside = _system_of(text, storage)
        is_pattern = glob.has_magic(inside)
        if not is_pattern and (os.path.splitext(inside)[1] or not system.isdir(inside)):
            return [text]
        found = system.glob(inside, detail=True) if is_pattern else {inside: {"type": "directory"}}
        files = [path for path, about in found.items() if about["type"] != "directory"]
        folders = [path for path, about in found.items() if about["type"] == "directory"]
        files += [file for folder in folders for file in system.find(folder) if _is_of_a_folder(os.path.basename(file))]
    except Exception as error:  # noqa: BLE001  each file system has its own
        raise BallbarError(f"{text}: expected files, found: {reason_of(error)}.") from None
    return [f"{text.partition('://')[0]}://{path}" for path in files]


def _system_of(file: str, storage: dict[str, Any]) -> tuple[Any, str]:
    from fsspec.core import url_to_fs

    system, inside = url_to_fs(file, **storage)
    return system, str(inside)


def stamp_of(file: str, storage: dict[str, Any]) -> Stamp:
    """Returns what a file is known again by. Raises OSError, or what the file system raises."""
    if "://" not in file:
        found = os.stat(file)
        if stat.S_ISDIR(found.st_mode):
            os.listdir(file)  # raises: it stands for itself, as it could not be listed
        return found.st_size, found.st_mtime_ns
    system, inside = _system_of(file, storage)
    about = system.info(inside)
    changed = about.get("mtime") or about.get("LastModified") or about.get("ETag") or 0
    return int(about.get("size") or 0), zlib.crc32(str(changed).encode())


def reason_of(error: BaseException) -> str:
    """Says why, in a few words."""
    if isinstance(error, UnicodeEncodeError):
        return "expected a name in UTF-8"
    return (getattr(error, "strerror", None) or str(error) or type(error).__name__).rstrip(".")


@contextlib.contextmanager
def opened(files: Sequence[str], storage: dict[str, Any], at: str) -> Iterator[tuple[dict[str, tuple[str, str]], dict[str, str]]]:
    """Yields, by its path on this machine, each file's name and SHA-256; and why the other files could not be opened.

    `at` is the folder that names are relative to. A file from elsewhere is there as long as this lasts.
    """
    with contextlib.ExitStack() as stack:
        found: dict[str, tuple[str, str]] = {}
        lacking: dict[str, str] = {}
        scratch = ""
        for file in files:
            try:
                file.encode()
                path = os.path.join(at, file)
                if "://" in file:
                    scratch = scratch or stack.enter_context(tempfile.TemporaryDirectory(prefix="ballbar-"))
                    system, inside = _system_of(file, storage)
                    folder, name = os.path.split(inside)  # files of one stay in one: two logs may be one test
                    path = os.path.join(scratch, hashlib.sha256(folder.encode()).hexdigest()[:16], name or "file")
                    os.makedirs(os.path.dirname(path), exist_ok=True)
                    system.get(inside, path)
                with open(path, "rb") as stream:
                    found[path] = file, hashlib.file_digest(stream, "sha256").hexdigest()
            except Exception as error:  # noqa: BLE001  each file system has its own
                lacking[file] = reason_of(error)
        yield found, lacking


def write_whole(path: str | os.PathLike[str], data: bytes) -> None:
    """Writes a file whole, or leaves it as it was. Raises BallbarError."""
    target = os.path.realpath(path)
    temporary = os.path.join(os.path.dirname(target), f".{os.path.basename(target)}.{uuid.uuid4().hex}")
    try:
        with open(temporary, "xb") as file:
            file.write(data)
            os.fsync(file.fileno())
        os.replace(temporary, target)
    except OSError as error:
        raise BallbarError(f"{os.fspath(path)}: could not be written: {reason_of(error)}; it is as it was.") from None
    finally:
        with contextlib.suppress(OSError):
            os.remove(temporary)
