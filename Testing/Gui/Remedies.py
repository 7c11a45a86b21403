# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What a message proposes is a button in the view, where one click does it, as one step to undo: a pressure that is
missing, water for the density of a liquid, a plane beside an axis that is revolved. Without such a message there is none."""

from window_testing import ViewsSession

HELPERS = """
def buttons():
    box = widget("Frame.0", "Viewport", "SchlierenRemedies")
    return {one.text(): one for one in box.findChildren(QtWidgets.QPushButton)} if box and box.isVisible() else {}
def press(text):
    QTest.mouseClick(buttons()[text], Qt.MouseButton.LeftButton)
def undo_name():
    (action,) = [one for one in widget("menu_Edit").actions() if one.objectName() == "actionEditUndo"]
    return action.text()
def show(data):
    "Draws data as Schlieren in the only view; returns the settings of the image."
    for (name, _), source in GetSources().items():
        Hide(source)
    display = Show(data)
    display.SetRepresentationType("Schlieren")
    ResetCamera()
    SetActiveSource(data)
    Render()
    return display.SchlierenBench
def made(extent, **functions):
    data = Wavelet(WholeExtent=extent)
    for name, function in functions.items():
        data = Calculator(Input=data, ResultArrayName=name.replace("_", " "), Function=function)
    return PassArrays(Input=data, PointDataArrays=[name for name in functions])
CUBE = [-8, 8, -8, 8, -8, 8]
"""
user = ViewsSession()
user.python(HELPERS + """
import inside_window
bench = inside_window.bench = show(made(CUBE, T="250 + RTData"))
until(buttons)
assert list(buttons()) == ["Air at 101325 Pa", "Water"], buttons()
press("Air at 101325 Pa")
until(lambda: bench.UniformPressure == 101325 and not buttons())
settle_views()
assert np.ptp(intensity(bench)) > 0.2
assert undo_name() == "&Undo Air at 101325 Pa", undo_name()
""")
user.undo()
user.python(HELPERS + """
import inside_window
bench = inside_window.bench
until(buttons)
assert bench.UniformPressure == 0
press("Water")
until(lambda: bench.IndexModel == "Water" and not buttons())

# The density of a liquid, with a temperature or without.
bench = show(made(CUBE, rho="1000 - 0.1 * RTData", T="290 + 0.1 * RTData"))
until(buttons)
assert list(buttons()) == ["Water"], buttons()
press("Water")
until(lambda: bench.IndexModel == "Water" and not buttons())
show(made(CUBE, rho="1000 - 0.1 * RTData"))
settle_soon()
assert not buttons()

# A plane beside an axis, one across it, and a volume.
bench = show(made([0, 16, -8, 8, 0, 0], rho="1 + 1e-3 * RTData"))
until(buttons)
assert list(buttons()) == ["Revolve it"], buttons()
press("Revolve it")
until(lambda: bench.Symmetry == "Axisymmetric" and not buttons())
settle_soon()
for extent in ([-8, 8, -8, 8, 0, 0], [0, 16, 0, 16, 0, 16]):
    show(made(extent, rho="1 + 1e-3 * RTData"))
    settle_soon()
    assert not buttons(), extent
""")
user.play("from paraview.simple import *\nGetActiveViewOrCreate('RenderView')",
          expected="No array is chosen for Density, and none is known by its name.")
