# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The bench as scripts set it up and state files keep it: every property, an image as text, two outputs."""

import base64
import os
import re
import struct
import zlib

import numpy as np
from paraview import simple, smstate
from plugin_testing import Schlieren, comes_back, gaussian_column, output, image_array
from schlieren.vtkSchlierenFilters import vtkSchlierenFilter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray, vtkOutputWindow


def png(rows):
    """A PNG file with these rows of (red, green, blue), top row first."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    size = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    lines = b"".join(b"\0" + bytes(sum(row, ())) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", zlib.compress(lines))
            + chunk(b"IEND", b""))


def as_text(file):
    return "data:image/png;base64," + base64.b64encode(file).decode()


RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)
FILTER = as_text(png([[RED, GREEN], [BLUE, WHITE]]))
# Every property of the bench, unlike its default.
SETTINGS = {"Wavelength": 500.0, "Cutoff": "Color Filter", "KnifeEdgeAngle": 30.0, "CutoffOffset": 0.1,
            "KMode": "Bench", "KScale": 500.0, "MirrorFocalLength": 2.0,
            "SourceWidth": 0.5, "SourceLength": 5.0, "ColorFilterImage": FILTER,
            "FringeSpacing": 0.125, "FringeAngle": 45.0,
            "ScreenDistance": 3.0, "FocusOffset": 0.5, "SourceDistance": 30.0, "SourceShape": "Slit", "LightModel": "Waves",
            "PhasePlateDiameter": 0.5, "PhasePlateDelay": -0.25,
            "PhasePlateTransmission": 0.5, "BackgroundPattern": "Picture",
            "BackgroundDistance": 4.0, "BackgroundPeriod": 0.25,
            "BackgroundImage": as_text(png([[WHITE, RED]])), "SmoothingRadius": 1.5}
CURVE = [0, 1, 0.5, 0, 0.25, 0.5, 0.5, 0, 1, 0, 0.5, 0]

source = gaussian_column(16)
plain = Schlieren(Input=source, registrationName="plain", Density=["POINTS", "rho"], ImageSize=[16, 16])
for name in SETTINGS:
    assert plain.GetProperty(name).GetData() != SETTINGS[name], name
assert list(plain.GradedFilter.Points) == [0, 0, 0.5, 0, 1, 1, 0.5, 0]
made = Schlieren(Input=source, registrationName="made", **SETTINGS)
made.GradedFilter.Points = CURVE


def check(find=simple.FindSource):
    bench = find("made")
    for key, value in SETTINGS.items():
        assert bench.GetProperty(key).GetData() == value, (key, bench.GetProperty(key).GetData())
        # The filter itself has it.
        there = getattr(bench.GetClientSideObject(), "Get" + key)()
        here = bench.GetProperty(key).SMProperty.GetElement(0)
        assert there == here, (key, there, here)
    assert list(bench.GradedFilter.Points) == CURVE, list(bench.GradedFilter.Points)
    function = bench.GetClientSideObject().GetGradedFilter()
    assert [function.GetValue(x) for x in (0, 0.25, 1)] == [1, 0.5, 0]
    assert list(find("plain").GradedFilter.Points) == [0, 0, 0.5, 0, 1, 1, 0.5, 0]
    return bench


check()

made.UpdatePropertyInformation()
assert made.GetProperty("KScaleUsed").GetData() == 0 and not made.GetProperty("Sensitivity").GetData()
plain.UpdatePipeline()
plain.UpdatePropertyInformation()
k = output(plain).GetFieldData().GetArray("KScale").GetValue(0)
assert k > 0 and plain.GetProperty("KScaleUsed").GetData() == k
assert plain.GetProperty("Sensitivity").GetData().startswith(f"k = {k:.4g}: full scale is ")

# Units.
image = output(plain)
units = {}
for data in (image.GetPointData(), image.GetFieldData()):
    for i in range(data.GetNumberOfArrays()):
        array = data.GetAbstractArray(i)
        if array.GetInformation().Has(vtkDataArray.UNITS_LABEL()):
            units[array.GetName()] = array.GetInformation().Get(vtkDataArray.UNITS_LABEL())
assert units == {"Intensity": "1", "Deflection": "rad", "OpticalPathDifference": "m",
                 "Displacement": "data units", "BlockedFraction": "1", "TraceSeconds": "s"}, units

# ParaView's Calculator takes deflections as vectors.
bent = image_array(plain, "Deflection")
assert bent.shape[-1] == 3 and not bent[..., 2].any() and np.abs(bent[..., :2]).max() > 0
for expression, expected in (("mag(Deflection)", np.linalg.norm(bent, axis=-1)), ("Deflection_X", bent[..., 0])):
    calculator = simple.Calculator(Input=plain, ResultArrayName="calculated", Function=expression)
    assert np.allclose(image_array(calculator, "calculated"), expected, rtol=1e-6, atol=0), expression
    simple.Delete(calculator)

# The histogram is a second output: as many rays as came out, at the deflections that they have.
bins = simple.OutputPort(plain, "Histogram")
assert bins.Port == vtkSchlierenFilter.HISTOGRAM_PORT
assert bins.GetDataInformation().GetNumberOfPoints() == 256**2
histogram = plain.GetClientSideObject().GetOutputDataObject(1)
rays = vtk_to_numpy(histogram.GetPointData().GetArray("Rays")).reshape(256, 256)
assert histogram.GetPointData().GetScalars().GetName() == "Rays"
x = histogram.GetOrigin()[0] + np.arange(256) * histogram.GetSpacing()[0]
assert np.allclose(x, -x[::-1], atol=1e-6 * x[-1]), "The middle of the bins is no deflection"
deflection = image_array(plain, "Deflection")[..., :2].reshape(-1, 2)
assert rays.sum() >= 256, rays.sum()
edges = np.linspace(x[0] - (x[1] - x[0]) / 2, x[-1] + (x[1] - x[0]) / 2, 257)
expected, _, _ = np.histogram2d(deflection[:, 1], deflection[:, 0], bins=2 * [edges])
assert rays.sum() == expected.sum() and np.abs(rays - expected).sum() <= 8, np.abs(rays - expected).sum()

# State files and scripts keep all of it.
simple.SaveState("bench.pvsm")
script = smstate.get_state()
del plain, made
comes_back("bench.pvsm", script, check)

# So do state files with properties that there are no more, without a word.
GONE = ("InvertCutoff", "CutoffPosition", "HomogeneityTolerance", "FullWell", "BitDepth", "Bandwidth", "MaskedSide",
        "WhiteLight", "ErrorEstimate")
with open("bench.pvsm", encoding="utf-8") as file:
    older, count = re.subn(r'<Proxy group="filters" type="Schlieren" id="(\d+)"[^>]*>', lambda proxy: proxy[0] + "".join(
        f'<Property name="{name}" id="{proxy[1]}.{name}" number_of_elements="1"><Element index="0" value="1"/></Property>'
        for name in GONE), file.read())
assert count == 2
with open("older.pvsm", "w", encoding="utf-8") as file:
    file.write(older)
said = []
for event in ("ErrorEvent", "WarningEvent"):
    vtkOutputWindow.GetInstance().AddObserver(event, lambda *_: said.append(1))
simple.ResetSession()
simple.LoadState(os.path.abspath("older.pvsm"))
check()
assert not said
