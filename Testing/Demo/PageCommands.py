# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What README, tutorial, examples and the pages by person print for a shell runs as it is printed, but with smaller images;
what another test runs is listed here. Each script of the examples' table, and each Python script that a page prints, is run by a
test."""

import glob
import os
import re
import shlex
import subprocess

import numpy as np
from demo_testing import DATA, PVPYTHON, SOURCE, image_array, run_here
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkImagingCore import vtkExtractVOI
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLUnstructuredGridWriter

PAGES = ["README.md", *(f"Documentation/{page}.md" for page in ("tutorial", "examples", "simulation", "bench", "teaching",
                                                                "in_situ"))]
# What runs the other commands.
ELSEWHERE = {"apt install": "Utilities/Packaging/try-packages", "Utilities/test": ".ci/run",
             "python3 -m venv": "Testing/Demo/WebPage.py", "Utilities/with-display": "Testing/Demo/WebPage.py",
             "pip wheel": "Testing/Core/PythonModule.py",
             "mpiexec -np 4 pvbatch --sym Examples/in_situ/": "Testing/Demo/InSitu.py",
             "Utilities/demo --help": "Testing/Demo/Mistakes.py", "Utilities/demo --all": "Testing/Demo/ContactSheet.py"}


def read(name):
    with open(os.path.join(SOURCE, name), encoding="utf-8") as file:
        return file.read()


def commands(page):
    """Lines that are set as code, and code within a sentence that begins as a command does."""
    text = re.sub(r"^```.*?^```", "", page, flags=re.DOTALL | re.MULTILINE)
    within = re.findall(r"`((?:python3|pvpython|mpiexec|Utilities/demo) [^`]+)`", text)
    return re.findall(r"^    (\S.*)$", text, re.MULTILINE) + within


os.makedirs("checkout", exist_ok=True)
os.chdir("checkout")
for name in ("Testing", "Examples", "Documentation"):
    if not os.path.lexists(name):
        os.symlink(os.path.join(SOURCE, name), name)
python = os.path.join(os.path.dirname(os.path.realpath(PVPYTHON)), "python3")

# A flow.vtu with a density rho.
reader = vtkXMLImageDataReader()
reader.SetFileName(os.path.join(DATA, "ladenburg_jet_3d.vti"))
coarse = vtkExtractVOI()
coarse.SetInputConnection(reader.GetOutputPort())
coarse.SetSampleRate(4, 4, 4)
coarse.SetVOI(0, 10**6, 0, 10**6, 0, 10**6)
grid = vtkAppendFilter()
grid.SetInputConnection(coarse.GetOutputPort())
writer = vtkXMLUnstructuredGridWriter()
writer.SetInputConnection(grid.GetOutputPort())
writer.SetFileName("flow.vtu")
assert writer.Write() == 1

ran = []
for page in PAGES:
    for command in commands(read(page)):
        words = shlex.split(command, comments=True)
        elsewhere = next((test for start, test in ELSEWHERE.items() if command.startswith(start)), None)
        print(f"{page}: {command}" + (f" (by {elsewhere})" if elsewhere else ""), flush=True)
        if elsewhere:
            assert os.path.exists(os.path.join(SOURCE, elsewhere)), elsewhere
            continue
        if words[0] == "Utilities/demo" and len(words) > 1:
            code, out, err = run_here(*words[1:], "--size", "64x48")
            assert code == 0, err
            made = re.search(r"The image: (.*)$", out, re.MULTILINE).group(1)
            assert image_array(made).std() > 10, made
        elif words[0] == "Utilities/demo":
            assert run_here("--check")[0] == 0  # the rest is in JetImages.py
        elif words[0] == "python3":
            subprocess.run([python, *words[1:]], check=True, timeout=100)
        else:
            raise AssertionError(f"{page}: '{command}' is run by no test.")
        ran.append(command)
assert len(ran) >= 5, ran

# A script of the table that no other test runs, on one rank.
subprocess.run(["pvbatch", "--force-offscreen-rendering", "Examples/distributed.py", "32"], check=True, timeout=170)
for name in ("sphere", "jet"):
    assert np.ptp(image_array(name + ".png")) > 100, name

# The tutorial's lines are those of its script, and a test runs each script that the examples name.
for lines in re.findall(r"^```python\n(.*?)^```", read("Documentation/tutorial.md"), re.DOTALL | re.MULTILINE):
    assert lines in read("Examples/openfoam_jet.py"), lines
tests = "".join(read(test) for test in glob.glob(os.path.join(SOURCE, "Testing", "*", "*.py")))
for page in ["../README.md", *os.listdir(os.path.join(SOURCE, "Documentation"))]:
    stem = page.removesuffix(".md")
    if stem != page and "```python" in read(f"Documentation/{page}"):
        assert re.search(rf'snippets\("{stem}"\)|\b{stem}\.md"', tests) or f'"{stem}"' in read("Testing/Demo/PageScripts.py"), page
for script in re.findall(r"\(\.\./Examples/(\w+)(?:\.py)?\)", read("Documentation/examples.md")):
    assert script in tests, f"No test runs {script}"
