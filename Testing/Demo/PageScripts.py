# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of the README and of pages run as they are printed, and make what the pages say."""

import os

import numpy as np
from demo_testing import DATA, SOURCE, image_array, snippets
from paraview import servermanager
from paraview.simple import Delete, GetActiveView

os.makedirs("run/build/release", exist_ok=True)
os.chdir("run")
for name, target in (("Testing", os.path.join(SOURCE, "Testing")), ("jet.vti", os.path.join(DATA, "ladenburg_jet_3d.vti"))):
    if not os.path.lexists(name):
        os.symlink(target, name)
with open("build/release/plugin-file.txt", "w") as file:
    file.write(os.environ["SCHLIEREN_PLUGIN"] + "\n")


def run(text, names, *changes):
    for printed, quicker in changes:
        assert printed in text, f"The page has no {printed}"
        text = text.replace(printed, quicker)
    exec(compile(text, "page", "exec"), names)


names = {}
run(snippets("../README")[0], names, ("ImageSize=[900, 480]", "ImageSize=[450, 240]"))
for ending in (".png", ".json", ".pvsm", "_intensity.png"):
    assert os.path.getsize("jet" + ending) > 1000, ending
figure = image_array("jet.png")
assert figure.shape[0] > 240 and figure.shape[1] > 450 and figure.std() > 20, figure.shape

run(snippets("wavefront")[0], names)
report = names["wavefront"].GetProperty("Report").GetData()
print(report)
row = servermanager.Fetch(names["numbers"]).GetRowData()
numbers = {name: row.GetArray(name).GetValue(0) for name in ("OPDrms", "StrehlRatio", "EncircledEnergy")}
assert abs(numbers["OPDrms"] / 514e-9 - 1) < 0.005 and abs(numbers["StrehlRatio"] - 0.137) < 0.001, numbers
assert abs(numbers["EncircledEnergy"] - 0.047) < 0.001, numbers

names["flow"] = names["jet"]
run(snippets("bench")[0], names, ("ImageSize=[612, 512]", "ImageSize=[64, 54]"),
    ("SamplesPerPixel=64", "SamplesPerPixel=1"))
for bench, arrays in ((names["bos"], ("Intensity", "Background", "BackgroundDisplacement")),
                      (names["knife"], ("Intensity",))):
    bench.ImageSize = [64, 54]
    bench.UpdatePipeline()
    for array in arrays:
        assert np.ptp(bench.PointData[array].GetRange(0)) > 0, array

# A view that was not reset to the flow shows nothing of it.
run(snippets("representation")[0], names, ("ImageResolution=[3840, 2160]", "ImageResolution=[480, 270]"))
shown = image_array("jet.png")
assert shown.std() > 15, f"The image is empty: {shown.std()}"

# Of other pages each line is taken; what it does is tested elsewhere.
names["schlieren"] = names["Schlieren"](Input=names["jet"], Density=["POINTS", "rho"], ImageSize=[48, 32])
names.update(plane=names["jet"], servermanager=servermanager)
run(snippets("window")[0], names, ("size=[1600, 900]", "size=[320, 180]"), ("dpi=300", "dpi=80"))
for name in ("jet.pdf", "view.png", "flow.png"):
    assert os.path.getsize(name) > 1000, name
for page in ("quality", "flat_data", "cutoffs", "gases", "waves"):
    names["schlieren"] = names["Schlieren"](Input=names["jet"], Density=["POINTS", "rho"], ImageSize=[48, 32])
    for snippet in snippets(page):
        run(snippet, names)
    if page == "waves":
        names["laser"].ImageSize = [48, 32]
        names["laser"].UpdatePipeline()
    if page == "quality":
        assert names["facts"].GetArray("ErrorReached").GetValue(0) < 0.004
Delete(GetActiveView())
