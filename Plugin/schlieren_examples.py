# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The examples of the window's menu, with the data that come with the plugin: Documentation/gallery.md.

    import schlieren_examples, schlieren_figure           # once the plugin is loaded
    schlieren_figure.save("jet.png", schlieren_examples.jet())

Each returns a filter Schlieren.
"""

import math
import os

from paraview.simple import *
from schlieren_figure import time_of

LoadPlugins(ns=globals())  # none, but that adds Schlieren() where the plugin was loaded after paraview.simple


def data(name):
    """The full name of a file that comes with the examples."""
    return os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "examples", name)


def read(name):
    """A reader of such a file, which knows its arrays."""
    flow = OpenDataFile(data(name), registrationName=name)
    flow.UpdatePipeline()
    return flow


def jet():
    """Under-expanded jet. Air leaves a nozzle 10 mm wide at a pressure that is too high for it; a barrel shock and a Mach disc
    follow. The knife edge is horizontal: what bends light upwards is bright."""
    flow = read("ladenburg_jet_3d.vti")
    return Schlieren(Input=flow, KnifeEdgeAngle=90)


def bow_shock():
    """Bow shock. A sphere, 20 mm wide, flies at Mach 2. The shock stands 3.5 mm before it; a fit to measurements (Billig 1967) says
    3.2 mm. The data are half a plane, which is revolved. There is no friction: a real wake is turbulent."""
    flow = read("bow_shock.vts")
    return Schlieren(Input=flow, Symmetry="Axisymmetric", Cutoff="Shadowgraph", SmoothingRadius=5, Quality="Interactive",
                     FocalPoint=[0.0095, 0, 0], ParallelScale=0.03, ImageSize=[480, 480])


def aerofoil():
    """Transonic aerofoil. NACA 0012 at Mach 0.8 and 1.25 degrees: the upper shock stands at 63 % of the chord, a weak one below.
    The data are a plane, the wing is 0.1 m deep. The shock has a step where it passes from one line of the mesh to the next."""
    flow = read("aerofoil.vts")
    return Schlieren(Input=flow, Depth=0.1, FocalPoint=[0.05, 0, 0], ParallelScale=0.06, ImageSize=[640, 400])


def shock_bubble():
    """Shock meets a bubble. A shock of Mach 1.22 crosses a cylinder of helium, in which sound is faster: the wave in the bubble is
    ahead. Press play in the window to see it over time."""
    flow = read("shock_bubble.pvd")
    schlieren = Schlieren(Input=flow, Depth=0.089)
    schlieren.UpdatePipeline(flow.TimestepValues[8])
    return schlieren


def interferogram():
    """Laser interferogram. The jet again, before a tilted reference beam: each fringe is one wavelength of path, and where the
    density jumps, so do the fringes."""
    flow = read("ladenburg_jet_3d.vti")
    return Schlieren(Input=flow, Cutoff="Interferogram", Wavelength=532, FringeSpacing=-20, FringeAngle=90)


def plume():
    """Background-oriented schlieren of a plume. Stripes are photographed through the warm air over a heater of 1 W, ten metres
    before them. The temperature is a closed form (Yih 1951); the pressure is that of the room."""
    flow = read("plume.vti")
    return Schlieren(Input=flow, UniformPressure=101325, Symmetry="Axisymmetric", Cutoff="Background Oriented",
                     BackgroundPattern="Stripes", BackgroundPeriod=0.0012, BackgroundDistance=10,
                     FocalPoint=[0, 0.095, 0], ParallelScale=0.0198, ImageSize=[480, 400])


def mirage():
    """Mirage. The air over a road 300 m long is 30 K hotter at its surface. Light that comes down at less than
    sqrt(2 dn) = 0.39 degrees is bent up again: below the car its own image is seen upside down, on a sheet of sky."""
    flow = read("mirage.vti")
    return Schlieren(Input=flow, UniformPressure=101325, Cutoff="Background Oriented", BackgroundPattern="Picture",
                     BackgroundImage=data("mirage.png"), BackgroundDistance=1,
                     ViewAngle=1.5, FocalPoint=[0, 0.25, -150], ParallelScale=1.9636, ImageSize=[640, 320])


def tank():
    """Tank of salt water. Fresh water was put on salt water an hour ago. Slanted stripes half a metre behind the tank are
    displaced in proportion to the gradient of the index, a bell curve, from which the diffusion is found (Wiener 1893)."""
    flow = read("tank.vti")
    return Schlieren(Input=flow, Cutoff="Background Oriented", BackgroundPattern="Stripes", BackgroundPeriod=0.008,
                     FringeAngle=45, BackgroundDistance=0.5)


EXAMPLES = (jet, bow_shock, aerofoil, plume, shock_bubble, interferogram, mirage, tank)


def open_in_window(name):
    """Opens an example in the active 3-D view, seen as its image is, and selects its filter."""
    schlieren = globals()[name]()
    schlieren.KMode = "Automatic Kept"  # as in other views of the toolbar
    time = time_of(schlieren)
    if time:
        GetAnimationScene().AnimationTime = time
    view = GetActiveViewOrCreate("RenderView")
    Show(schlieren.Input, view)
    view.ResetCamera()
    half, angle, middle = schlieren.ParallelScale, schlieren.ViewAngle, list(schlieren.FocalPoint)
    if half > 0:
        distance = half / math.tan(math.radians(angle / 2)) if angle else view.CameraPosition[2]
        view.CameraFocalPoint, view.CameraPosition = middle, middle[:2] + [middle[2] + distance]
        view.CameraViewAngle, view.CameraParallelScale = angle or 30, half
        view.CameraParallelProjection = not angle
    SetActiveSource(schlieren)
