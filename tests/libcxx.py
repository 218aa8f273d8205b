"""The program also compiles for the page, whose compiler has another C++ library (libc++ 14): what that library lacks is
an error here, minutes before ballbar.html is built. No code is made.

    python3 libcxx.py BUILD

BUILD is one by clang++ with CMAKE_EXPORT_COMPILE_COMMANDS (tests/sanitized.sh). The headers come from Debian's package
libc++-14-dev, which is unpacked in BUILD: installed, it would remove what Ceres needs.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

source = pathlib.Path(__file__).resolve().parents[1]
build = pathlib.Path(sys.argv[1]).resolve()
headers = build / "libcxx/usr/lib/llvm-14/include/c++/v1"
# What the page does not have.
without = ("libballbar/lab/", "ballbar_images", "src/pictures", "ballbar_machines", "simulate", "python", "apps/hal/", "results/result_types")


def place_of(file):
    """Below the build folder, of files that are compiled together, or else below the sources."""
    path = pathlib.Path(file)
    return path.relative_to(build if path.is_relative_to(build) else source).as_posix()


def fetch():
    (build / "libcxx").mkdir(exist_ok=True)
    for command in ("apt-get download -q libc++-14-dev", "dpkg-deb -x libc++-14-dev_*.deb ."):
        subprocess.run(["sh", "-c", command], cwd=build / "libcxx", check=True)


def kept(words):
    """Of a command for clang++: without what it writes, and without headers that were compiled before."""
    words = iter(words)
    for word in words:
        if word in ("-o", "-include-pch", "-include", "-MF", "-MT"):
            next(words)
        elif word == "-Xclang":
            if next(words) in ("-include-pch", "-include"):
                next(words), next(words)
        elif word not in ("-c", "-MD", "-Winvalid-pch") and not word.startswith("-fsanitize"):
            yield word


def errors_of(command):
    words = [*kept(shlex.split(command["command"])), "-w", "-nostdinc++", "-isystem", str(headers), "-include",
             str(source / "apps/page/engine/from_chars.hpp"), "-fsyntax-only"]
    done = subprocess.run(words, cwd=command["directory"], capture_output=True, text=True, check=False)
    return done.stderr if done.returncode else ""


def main():
    if not headers.is_dir():
        fetch()
    commands = [one for one in json.loads((build / "compile_commands.json").read_text())
                if pathlib.Path(one["file"]).suffix in (".cpp", ".cxx") and not one["file"].endswith("cmake_pch.hxx.cxx")
                and place_of(one["file"]).startswith(("libballbar/", "formats/", "apps/"))
                and not any(part in place_of(one["file"]) for part in without)]
    if not commands:
        sys.exit(f"{build}/compile_commands.json: expected files of libballbar, formats and apps, found none")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        wrong = [errors for errors in pool.map(errors_of, commands) if errors]
    print("".join(wrong), end="")
    print(f"libc++ 14: {len(commands)} files, {len(wrong)} with errors")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
