# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Real flows on eight kinds of mesh, on one sheet: Documentation/gallery.md.

    pvpython Examples/gallery.py [FOLDER]        (writes gallery.png into it)

The data are in the sources; the package has two of the flows.
"""

import os
import sys
import time

from paraview.simple import *
from paraview import servermanager

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DATA = os.path.join(ROOT, "Testing", "Data")
sys.path.insert(0, os.path.join(ROOT, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
from schlieren_figure import Sheet, pixels_of  # noqa: E402, which comes with the plugin

SIZE = (360, 270)


def read(reader, *path, **properties):
    source = reader(FileName=[os.path.join(DATA, *path)], **properties)
    source.UpdatePipeline()
    return source


def oblique_shock():
    """Fringes in white light, which know the zeroth order."""
    flow = read(XMLImageDataReader, "oblique_shock_extruded.vti")
    return dict(Input=flow, Density=["POINTS", "rho"], DensityScale=1.225 / 1.4, LengthScale=0.01, Cutoff="Interferogram",
                WhiteLight=1, FocalPoint=[1.8, 0.4, 0.5], ParallelScale=0.4)


def blunt_fin():
    flow = PLOT3DReader(FileName=os.path.join(DATA, "bluntfin_plot3d", "bluntfinxyz.bin"), FunctionFileName="",
                        QFileName=os.path.join(DATA, "bluntfin_plot3d", "bluntfinq.bin"), Functions=[100])
    flow.UpdatePipeline()
    return dict(Input=flow, Density=["POINTS", "Density"], DensityScale=0.72, LengthScale=0.0127, ViewDirection=[0, 1, 0],
                ViewUp=[0, 0, 1], FocalPoint=[-0.6, 0, 1.9], ParallelScale=2.2)


def delta_wing():
    half = read(XMLStructuredGridReader, "deltawing.vts")
    return dict(Input=Reflect(half, Plane="Y", Center=0), Density=["POINTS", "Density"], DensityScale=1.225,
                Cutoff="Color Filter", MediumTolerance=0.01, ViewDirection=[-1, 0, 0], ViewUp=[0, 0, 1], FocalPoint=[0.5, 0, 0.2],
                ParallelScale=0.45)


def heating_coil():
    water = Calculator(read(XMLUnstructuredGridReader, "heating_coil_fluid.vtu"), ResultArrayName="N", Function=(
        "0.331418 - 1.1092e-4*(Temperature-300) - 1.4857e-6*(Temperature-300)^2 + 7.088e-9*(Temperature-300)^3"))
    return dict(Input=water, IndexModel="Refractivity", IndexArray=["POINTS", "N"], LengthScale=0.1, KnifeEdgeAngle=90,
                KMode="Value", KScale=300, ExitInto="Air", MediumTolerance=0.005, ViewDirection=[0, 1, 0], ViewUp=[0, 0, 1], ParallelScale=1.1)


def reactor():
    flow = read(ExodusIIReader, "disk_exodus", "disk_out_ref.ex2", PointVariables=["Temp"])
    gas = Calculator(flow, ResultArrayName="rho", Function="101325 * 2.016e-3 / (8.314463 * Temp)")
    return dict(Input=gas, Density=["POINTS", "rho"], GladstoneDaleConstant=1.54e-3, LengthScale=0.01, Outside="Passes",
                Cutoff="Interferogram", FringeSpacing=0.7, FringeAngle=90, ViewDirection=[0, 1, 0],
                ViewUp=[0, 0, 1], FocalPoint=[0, 0, 5.1], ParallelScale=5)


def blob():
    flow = read(XMLUnstructuredGridReader, "blob_lagrange_hex.vtu")
    return dict(Input=flow, Density=["POINTS", "rho"], LengthScale=0.01, Cutoff="Dark Field",
                FocalPoint=[-15, 0, 0], ParallelScale=2.6)


def jet_of_openfoam():
    flow = OpenFOAMReader(FileName=os.path.join(DATA, "ladenburg_openfoam", "ladenburg.foam"), CellArrays=["p", "T"])
    flow.UpdatePipeline(4.5e-4)
    rho = Calculator(flow, AttributeType="Cell Data", ResultArrayName="rho", Function="p/(287.1*T)")
    return dict(Input=rho, Density=["CELLS", "rho"], Symmetry="Axisymmetric", Cutoff="Shadowgraph", ScreenDistance=0.1,
                FocalPoint=[0.0135, 0, 0], ParallelScale=0.0095)


def jet_with_levels():
    """The jet again, with two levels of blocks: a camera's image of stripes behind it."""
    jet = ExtractSubset(read(XMLImageDataReader, "ladenburg_jet_3d.vti"), VOI=[0, 192, 0, 128, 0, 128],
                        SampleRateI=2, SampleRateJ=2, SampleRateK=2)
    levels = ImageDataToAMR(jet, Numberoflevels=2)
    return dict(Input=levels, Density=["POINTS", "rho"], Cutoff="Background Oriented", BackgroundPattern="Stripes",
                FringeAngle=90, BackgroundDistance=0.1, FocalPoint=[0.0118, 0, 0], ParallelScale=0.0088)


FLOWS = (
    (oblique_shock, "Shock and its reflection, white light", "regular grid; Mach 2.9"),
    (blunt_fin, "Blunt fin on a plate, knife edge", "curvilinear grid, far field, body; Mach 2.95"),
    (delta_wing, "Delta wing, colour filter", "curvilinear grid, a wing without thickness; Mach 0.3"),
    (heating_coil, "Heated coil in water, knife edge", "tetrahedra, pyramids, wedges; a body left out of the mesh"),
    (reactor, "Hydrogen in a reactor, interferogram", "hexahedra; finite fringes"),
    (blob, "Blob in a supersonic wind, dark field", "hexahedra of order 3, hanging nodes"),
    (jet_of_openfoam, "Under-expanded jet, shadowgraph", "wedge of OpenFOAM, revolved; screen at 100 mm"),
    (jet_with_levels, "The same jet before stripes (BOS)", "adaptive mesh (AMR) of two levels"),
)


def main(folder, size=SIZE):
    """Writes the sheet; returns the images, rows x columns x 3 bytes, by the names of the functions above."""
    columns, margin, above = 4, 20, 64
    rows = -(-len(FLOWS) // columns)
    sheet = Sheet(columns * (size[0] + margin) + margin, rows * (size[1] + above) + margin)
    images = {}
    for place, (flow, title, line) in enumerate(FLOWS):
        schlieren = Schlieren(**flow(), ImageSize=list(size), Quality="Fine")  # noqa: F821
        begin = time.monotonic()
        schlieren.UpdatePipeline()
        image = servermanager.Fetch(schlieren)
        images[flow.__name__] = pixels_of(image)
        left = margin + place % columns * (size[0] + margin)
        top = above + place // columns * (size[1] + above)
        sheet.text(left, top - 42, title, 17, room=size[0])
        sheet.text(left, top - 20, line, 13, sheet.DIM, room=size[0])
        sheet.image(left, top, images[flow.__name__])
        print(f"{title}: {time.monotonic() - begin:.1f} s", flush=True)
    path = os.path.abspath(os.path.join(folder, "gallery.png"))
    sheet.write(path)
    print("Wrote", path)
    return images


if __name__ == "__main__":
    if not os.path.exists(os.path.join(DATA, "deltawing.vts")):
        sys.exit(f"The flows are not in {DATA}: the package does not have them. Run this script in a checkout.")
    main(sys.argv[1] if len(sys.argv) > 1 else ".")
