"""Builds the package for pip by CMake, with what the system has: nothing is fetched (PEP 517, PEP 427).

The page of :func:`ballbar.report`, for which npm fetches a chart library, is left out unless BALLBAR_PAGE=ON is in the
environment. BALLBAR_BUILD: a folder of CMake that has built the package already.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
TREE = HERE.parent.parent


def _version():
    return re.search(r"project\(ballbar VERSION ([\d.]+)", (TREE / "CMakeLists.txt").read_text())[1]


def _tag():
    abi = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{abi}-{abi}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _metadata():
    return (
        f"Metadata-Version: 2.1\nName: ballbar\nVersion: {_version()}\n"
        "Summary: Ballbar logs of machine tools: circles, errors, thermal drift, models and what they lack\n"
        "License: BSD-3-Clause\nRequires-Python: >=3.11\nRequires-Dist: numpy\nRequires-Dist: pandas\n"
        + "".join(
            f'Provides-Extra: {extra}\n' + "".join(f'Requires-Dist: {name}; extra == "{extra}"\n' for name in names)
            for extra, names in (("fleet", ("dask", "distributed")), ("plot", ("matplotlib",)), ("sklearn", ("scikit-learn",)))
        )
    )


def _built(folder):
    build = os.environ.get("BALLBAR_BUILD")
    if not build:
        build = os.path.join(folder, "build")
        page = os.environ.get("BALLBAR_PAGE", "OFF")
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DBALLBAR_PYTHON=ON", f"-DBALLBAR_PAGE={page}", f"-DPython3_EXECUTABLE={sys.executable}"]
        subprocess.run(["cmake", "-S", TREE, "-B", build, *options], check=True)
    subprocess.run(["cmake", "--build", build, "-j", str(os.cpu_count() or 1), "--target", "ballbar_python", "ballbar_python_files"], check=True)
    return pathlib.Path(build, "python", "ballbar")


def get_requires_for_build_wheel(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    name = f"ballbar-{_version()}.dist-info"
    folder = pathlib.Path(metadata_directory, name)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "METADATA").write_text(_metadata())
    return name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    version, record = _version(), []
    name = f"ballbar-{version}-{_tag()}.whl"
    info = f"ballbar-{version}.dist-info"
    with tempfile.TemporaryDirectory() as folder:
        package = _built(folder)
        files = {f"ballbar/{path.name}": path.read_bytes() for path in sorted(package.iterdir()) if path.is_file()}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: ballbar\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{path},sha256={digest},{len(data)}")
            wheel.writestr(path, data)
        wheel.writestr(f"{info}/RECORD", "\n".join([*record, f"{info}/RECORD,,", ""]))
    return name
