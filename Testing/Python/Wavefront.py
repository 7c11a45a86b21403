# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Wavefront in scripts: defaults as the XML has them, a beam through the jet, ParaView's filters behind the outputs,
states, and a mistake in one message."""

import os

import numpy as np
from defaults_testing import check_defaults, property_tables
from paraview import simple, smstate
from plugin_testing import Schlieren, Wavefront, comes_back, image_array, is_empty, output
from schlieren.vtkSchlierenFilters import vtkWavefront

SIZE, HALF, DIAMETER, CENTER, WAVELENGTH = 240, 0.01125, 0.012, [0.012, 0], 1064e-9  # pixels, m
jet = simple.OpenDataFile(os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Data", "ladenburg_jet_3d.vti"))
jet.UpdatePipeline()
bench = Schlieren(jet, Density=["POINTS", "rho"], FocalPoint=[0.015, 0, 0], ParallelScale=HALF, ImageSize=[SIZE, SIZE])
wavefront = Wavefront(Input=bench)

# Proxies and the class have the XML's defaults, and PrintSelf names them.
made = vtkWavefront()
checked = check_defaults(wavefront, made, property_tables.WAVEFRONT_FILES)
assert len(checked) == 6, checked
assert all(f"{item.name}:" in str(made) for item in checked)


def numbers(proxy=wavefront):
    proxy.UpdatePipeline()
    table = proxy.GetClientSideObject().GetOutputDataObject(2)
    assert table.GetNumberOfRows() == 1
    return {table.GetColumnName(i): table.GetColumn(i).GetVariantValue(0).ToDouble() for i in range(table.GetNumberOfColumns())}


def report():
    wavefront.UpdatePropertyInformation()
    return str(wavefront.GetProperty("Report").GetData())


# The largest beam has light through the jet's data everywhere.
found, path = numbers(), image_array(bench, "OpticalPathDifference")
inside = np.isfinite(image_array(wavefront, "ResidualWavefront"))
assert inside.sum() == found["AperturePixels"] > 1000, found
assert np.isfinite(path[inside]).all() and image_array(bench, "BlockedFraction")[inside].max() == 0
assert "OPDrms" in report() and "Strehl ratio" in report(), report()

# A beam through the shock cells.
wavefront.ApertureDiameter, wavefront.ApertureCenter, wavefront.Wavelength = DIAMETER, CENTER, 1e9 * WAVELENGTH
found = numbers()

# Without focus less is left.
wavefront.RemoveFocus = 1
assert numbers()["OPDrms"] < found["OPDrms"] and numbers()["StrehlRatio"] > found["StrehlRatio"]
wavefront.RemoveFocus = 0

# ParaView's filters take the outputs.
half = WAVELENGTH / DIAMETER
line = simple.PlotOverLine(Input=simple.OutputPort(wavefront, "Far Field"), Point1=[0, 0, 0], Point2=[10 * half, 0, 0])
line.UpdatePipeline()
assert {"PointSpread", "EncircledEnergy"} <= set(line.PointData.keys())
assert line.PointData["EncircledEnergy"].GetRange()[1] > 0.5
rows = simple.PlotData(Input=simple.OutputPort(wavefront, "Numbers"))
assert output(rows).GetColumnByName("OPDrms").GetValue(0) == found["OPDrms"]

# One message for an aperture that lies elsewhere, and numbers again.
wavefront.ApertureCenter = [1, 0]
assert is_empty(wavefront) and not report(), report()
wavefront.ApertureCenter = CENTER
assert numbers() == found

simple.SaveState("wavefront.pvsm")


def check():
    proxy = next(source for (name, _), source in simple.GetSources().items() if name.startswith("Wavefront"))
    assert proxy.ApertureDiameter == DIAMETER and list(proxy.ApertureCenter) == CENTER
    assert numbers(proxy)["OPDrms"] == found["OPDrms"]


comes_back("wavefront.pvsm", smstate.get_state(), check)
