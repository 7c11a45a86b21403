# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What pip calls to build the wheel (PEP 517): CMake, then a zip file (PEP 427). For this machine's processor; the
environment's SCHLIEREN_SIMD=ALL makes it for all."""

import base64
import hashlib
import os
import re
import subprocess
import sysconfig
import tempfile
import zipfile

CORE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def read(*name):
    with open(os.path.join(CORE, *name), "rb") as file:
        return file.read()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    version = re.search(rb"^  VERSION ([0-9.]+)$", read("..", "CMakeLists.txt"), re.MULTILINE).group(1).decode()
    tag = "py3-none-" + re.sub(r"\W", "_", sysconfig.get_platform())
    info = f"schlieren_core-{version}.dist-info"
    files = {"schlieren_core/__init__.py": read("Python", "schlieren_core", "__init__.py"),
             f"{info}/licenses/LICENSE": read("..", "LICENSE"),
             f"{info}/METADATA": f"Metadata-Version: 2.1\nName: schlieren-core\nVersion: {version}\nSummary: Schlieren images "
                                 "of arrays of numpy\nLicense: BSD-3-Clause AND MPL-2.0\nRequires-Python: >=3.9\n"
                                 "Requires-Dist: numpy\n".encode(),
             f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: schlieren\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()}
    with tempfile.TemporaryDirectory() as build:
        simd = os.environ.get("SCHLIEREN_SIMD", "NATIVE")
        subprocess.run(["cmake", "-S", CORE, "-B", build, "-DBUILD_TESTING=OFF", "-DSCHLIEREN_CUDA=OFF",
                        "-DSCHLIEREN_PYTHON=ON", f"-DSCHLIEREN_SIMD={simd}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "schlieren_core", "--parallel", str(os.cpu_count())], check=True)
        with open(os.path.join(build, "libschlieren_core.so"), "rb") as file:
            files["schlieren_core/libschlieren_core.so"] = file.read()
    record = [f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip('=')},{len(data)}\n"
              for name, data in files.items()]
    files[f"{info}/RECORD"] = "".join([*record, f"{info}/RECORD,,\n"]).encode()
    name = f"schlieren_core-{version}-{tag}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(path, data)
    return name
