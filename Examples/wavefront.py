# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A beam of 50 mm through a turbulent layer, over time: OPDrms, Strehl ratio and the jitter of the tilt.

    pvpython Examples/wavefront.py        (writes layer.pvd and its files, wavefront.csv and wavefront.png)

The layer is made here: fluctuations of the density of 1 % along a wall, which the flow carries past the beam. Of your own
simulation, take the second half of this script.
"""

import os
import sys

import matplotlib
import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(root, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())

# --- The simulation. ---------------------------------------------------------------------------------------------------
speed, step, steps, thickness = 200, 25e-6, 16, 0.02  # m/s, s, number, m
random = np.random.default_rng(1)
scale, waves = 0.012, 60  # length, m, and number of the waves that the layer consists of
directions = random.normal(size=(waves, 3))
directions /= np.linalg.norm(directions, axis=1)[:, None]
vectors = directions * (2 * np.pi / scale * random.lognormal(sigma=0.4, size=waves))[:, None]
phases = random.uniform(0, 2 * np.pi, waves)


def density(x, y, z, time):
    """kg/m^3 at places in metres; the fluctuations are 0 on the wall, y = 0, and beyond the layer."""
    x = x - speed * time
    sum_of_waves = sum(np.cos(k[0] * x + k[1] * y + k[2] * z + phase) for k, phase in zip(vectors, phases))
    return 1.2 * (1 + 0.01 * np.sqrt(2 / waves) * sum_of_waves * np.sin(np.pi * y / thickness) ** 2)


axes = [np.linspace(-0.03, 0.03, 61), np.linspace(0, thickness, 21), np.linspace(-0.03, 0.03, 61)]
with open("layer.pvd", "w") as series:
    series.write('<VTKFile type="Collection" version="0.1"><Collection>\n')
    for i in range(steps):
        image = vtkImageData()
        image.SetDimensions([len(axis) for axis in axes])
        image.SetOrigin([axis[0] for axis in axes])
        image.SetSpacing([axis[1] - axis[0] for axis in axes])
        values = density(*np.meshgrid(*axes, indexing="ij"), i * step)
        array = numpy_to_vtk(values.ravel(order="F"), deep=True)
        array.SetName("rho")
        image.GetPointData().SetScalars(array)
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(f"layer_{i}.vti")
        writer.SetInputData(image)
        writer.Write()
        series.write(f'<DataSet timestep="{i * step}" file="layer_{i}.vti"/>\n')
    series.write("</Collection></VTKFile>\n")

# --- The beam. ---------------------------------------------------------------------------------------------------------
layer = PVDReader(FileName="layer.pvd")
layer.UpdatePipeline()
schlieren = Schlieren(Input=layer, Density=["POINTS", "rho"], ViewDirection=[0, -1, 0], ViewUp=[0, 0, -1],
                      FocalPoint=[0, thickness / 2, 0], ParallelScale=0.026, ImageSize=[208, 208], Quality="Interactive")
wavefront = Wavefront(Input=schlieren, ApertureDiameter=0.05, Wavelength=1064)

# One row for each time step.
over_time = PlotDataOverTime(Input=OutputPort(wavefront, "Numbers"), FieldAssociation="Rows", OnlyReportSelectionStatistics=0)
SaveData("wavefront.csv", proxy=over_time)
table = servermanager.Fetch(over_time).GetBlock(0)
numbers = {table.GetColumnName(i): vtk_to_numpy(table.GetColumn(i)) for i in range(table.GetNumberOfColumns())}

# Mean and standard deviation of each number, which are those of the one point that a row becomes.
point = TableToPoints(Input=OutputPort(wavefront, "Numbers"), XColumn="ApertureX", YColumn="ApertureY", a2DPoints=1,
                      KeepAllDataArrays=1)
statistics = TemporalStatistics(Input=point)
statistics.UpdatePipeline()


def of_all(name):
    return statistics.PointData[name].GetRange()[0]


print(f"OPDrms {1e9 * of_all('OPDrms_average'):.2f} nm, in the mean over {steps} steps, +- {1e9 * of_all('OPDrms_stddev'):.2f} nm")
print(f"Strehl ratio {of_all('StrehlRatio_average'):.4f} +- {of_all('StrehlRatio_stddev'):.4f}")
print(f"Jitter of the tilt {1e6 * of_all('TiltRight_stddev'):.3f} urad along the flow, "
      f"{1e6 * of_all('TiltUp_stddev'):.3f} urad across it")

figure, (left, right) = pyplot.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
residual = servermanager.Fetch(OutputPort(wavefront, "Residual"))
shown = left.imshow(1e9 * vtk_to_numpy(residual.GetPointData().GetScalars()).reshape(208, 208), origin="lower", cmap="RdBu",
                    extent=[-26, 26, -26, 26])
left.set(title="Residual wavefront, last step", xlabel="mm", ylabel="mm")
figure.colorbar(shown, label="nm")
right.plot(1e6 * numbers["Time"], 1e9 * numbers["OPDrms"], "o-", label="OPDrms")
right.plot(1e6 * numbers["Time"], 1e9 * 0.025 * numbers["TiltRight"], "s-", label="tilt along the flow, at the edge")
right.set(xlabel="time, µs", ylabel="nm")
right.legend()
figure.savefig("wavefront.png", dpi=100)
print("Wrote", os.path.abspath("wavefront.png"), "and, beside it, wavefront.csv, layer.pvd and its time steps")
