# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The toolbar with whatever is selected: nothing, what cannot be used, blocks of meshes without a 3-D view,
a view that draws as Schlieren, a filter."""

from window_testing import BENCH, MESH, PROPERTIES, ViewsSession

user = ViewsSession()
for button in ("OneImage", "ThreeImages"):
    user.check_button(button, "enabled", "false")

user.python('SetActiveSource(Sphere(registrationName="ball"))')
user.press("OneImage")
user.check_message("'ball': There is no array with one value at a point or cell, so nothing gives the "
                   "refractive index. Load or compute a density.")
user.python("""
warm = PassArrays(Input=Calculator(Input=Wavelet(), ResultArrayName="T", Function="250 + RTData"),
                  PointDataArrays=["T"], registrationName="warm")
warm.UpdatePipeline()
SetActiveSource(warm)
""")
user.press("OneImage")
user.check_message("'warm': There is no density, nor a temperature together with a pressure, so nothing gives the "
                   "refractive index. Load or compute one (Documentation/density.md says how), or choose an "
                   "array yourself. Where the pressure of air is the same everywhere, UniformPressure completes the "
                   "temperature (101325 Pa in a room). There are point arrays T (287.353 to 526.829).")


def take_offer(button, expected, chosen, contrast):
    """Takes what the message offers, and checks what is chosen then and that there is an image of some contrast."""
    user.press("OneImage")
    user.event("pqClientMainWindow/SchlierenMessage/qt_msgbox_buttonbox/" + button, "activate")
    user.python(f"""
until(shown_at_all)
(display,) = displays()
bench = display.SchlierenBench
assert ({chosen}) == {expected}, ({chosen})
intensity = bench.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Intensity")
assert np.ptp(vtk_to_numpy(intensity)) > {contrast}
""")


# Where only a temperature is there, air at the pressure of a room is offered; undone for what comes next.
take_offer("UniformPressure", '("Ciddor", ["POINTS", "T"], 101325)',
           "bench.IndexModel, list(bench.Temperature), bench.UniformPressure", 0.2)
user.undo()

# Or it is water, whose index is that of its temperature.
take_offer("Water", '("Water", ["POINTS", "T"])', "bench.IndexModel, list(bench.Temperature)", 0.2)
user.undo()

# Or one of the arrays is the density, whatever it is called.
user.python("""
odd = PassArrays(Input=Calculator(Input=Wavelet(), ResultArrayName="a17", Function="1 + 1e-4*RTData"), PointDataArrays=["a17"],
                 registrationName="odd")
odd.UpdatePipeline()
SetActiveSource(odd)
""")
user.press("OneImage")
user.python("""
message = widget("SchlierenMessage")
(action,) = message.findChild(QtWidgets.QMenu, "Arrays").actions()
assert action.text() == "a17", action.text()
action.trigger()
until(shown_at_all)
(display,) = displays()
assert (display.SchlierenBench.IndexModel, list(display.SchlierenBench.Density)) == ("Gladstone-Dale", ["POINTS", "a17"])
assert not message.isVisible()
""")
user.undo()

user.python("""
until(lambda: len(GetRenderViews()) == 1 and not displays())
assert GetActiveView() == GetRenderViews()[0] and widget("Frame.0"), "Of the second undo a cell is left, or no view is active"
SetActiveSource(FindSource("warm"))
""")

# From the Representation box: the view says why there is no image, and what helps does.
user.python("""
import re
view = GetActiveViewOrCreate("RenderView")
shown = Show(FindSource("warm"), view)
shown.SetRepresentationType("Schlieren")
Render(view)
def line():
    return widget("Frame.0", "Viewport", "SchlierenStatus")
until(lambda: line() is not None and line().isVisible())
assert line().text().startswith("No image: ") and "UniformPressure (101325 Pa in a room)" in line().text(), line().text()
shown.SchlierenBench.UniformPressure = 101325
shown.SchlierenBench.Quality = "Interactive"
Render(view)
settle_views()
until(lambda: re.match("[0-9]+ samples? per pixel", line().text()))
Hide(FindSource("warm"), view)
SetActiveSource(FindSource("warm"))
""")
user.python(MESH + """
table = Histogram(Input=mesh, registrationName="table")
table.UpdatePipeline()
SetActiveSource(table)
""")
user.press("OneImage")
user.check_message("'table' has no cells to send light through. Select data that fill a volume.")
user.python("""
nothing = Threshold(Input=FindSource("mesh"), registrationName="nothing")
nothing.Scalars = ["POINTS", "rho"]
nothing.LowerThreshold = nothing.UpperThreshold = 100  # where a slider still reaches
nothing.UpdatePipeline()
SetActiveSource(nothing)
""")
user.press("ThreeImages")
user.check_message("'nothing' has no cells to send light through. Select data that fill a volume.")


# Points and lines, alone and in blocks.
user.python("""
mesh = FindSource("mesh")
points = MaskPoints(Input=mesh, GenerateVertices=1, SingleVertexPerCell=1, registrationName="points")
both = GroupDatasets(Input=[points, PlotOverLine(Input=mesh)], registrationName="both")
for source in points, both:
    source.UpdatePipeline()
assert both.GetDataInformation().GetNumberOfCells() > 0

""")
for name in ("points", "both"):
    user.python(f"SetActiveSource(FindSource({name!r}))")
    user.press("OneImage")
    user.check_message(f"'{name}' has nothing but points or lines, so there is no volume for light to cross. Make a volume of "
                       "particles with Point Volume Interpolator, SPH Volume Interpolator or Gaussian Resampling.")

# Made from the menu and not applied yet.
user.python('SetActiveSource(FindSource("mesh"))')
user.choose_filter("Schlieren")
user.press("OneImage")
user.check_message("'Schlieren1' has not been applied yet. Press Apply first.")
user.delete()

# Nothing was made by all this.
user.python("assert not filters() and len(GetRenderViews()) == 1")

# Two blocks, and no view at all.
user.python("""
mesh = FindSource("mesh")
other = Transform(Input=mesh, registrationName="other")
other.Transform.Translate = [20, 0, 0]
blocks = GroupDatasets(Input=[mesh, other], registrationName="blocks")
blocks.UpdatePipeline()
SetActiveSource(blocks)
Delete(GetActiveView())
""")
user.press("OneImage")
user.python("""
((_, scene), (_, view)) = views()
blocks = FindSource("blocks")
assert drawn(blocks, view).SchlierenBench.Density == ["POINTS", "rho"] and not filters()
assert GetRepresentation(blocks, scene).Visibility == 1
check_linked_now(scene, view)
drawn(blocks, view).SchlierenBench.Quality = "Interactive"
Render(view)
until(lambda: information(drawn(blocks, view).SchlierenBench, "ImageCount") > 0)
assert np.ptp(intensity(drawn(blocks, view).SchlierenBench)) > 0.2
""")

# In that view, another one with its settings, from the menu.
user.properties = BENCH
user.choose("Cutoff/ComboBox", "Shadowgraph")
user.python("""
(display,) = displays()
display.SchlierenBench.GradedFilter.Points = [0, 0.25, 0.5, 0, 1, 0.75, 0.5, 0]
""")
user.menu("menuSchlieren", "actionOneImage")
user.python("""
((left, scene), (top, first), (bottom, second)) = views()
assert (left, top, bottom) == (1, 5, 6)
check_linked_now(scene, first, second)
benches = [drawn(FindSource("blocks"), view).SchlierenBench for view in (first, second)]
for bench in benches:
    assert bench.Cutoff == "Shadowgraph" and bench.GradedFilter.Points[1] == 0.25
assert benches[0].GradedFilter.SMProxy != benches[1].GradedFilter.SMProxy, "A curve of both"
""")
user.choose("Cutoff/ComboBox", "Bright Field")
user.python("""
assert [drawn(FindSource("blocks"), view).SchlierenBench.Cutoff for _, view in views()[1:]] == ["Shadowgraph", "Bright Field"]
""")

# With a filter selected, its flow and its settings.
user.choose_filter("Schlieren")
user.properties = PROPERTIES
user.choose("Cutoff/ComboBox", "Color Filter")
user.choose("ImageSize/LineEdit0", "64")
user.choose("ImageSize/LineEdit1", "64")
user.apply()
user.press("OneImage")
user.python("""
(bench,) = filters().values()
assert bench.Input == FindSource("blocks") and len(views()) == 5
cutoffs = [display.SchlierenBench.Cutoff for display in displays()]
assert len(cutoffs) == 3 and all(name in cutoffs for name in ("Bright Field", "Color Filter", "Shadowgraph")), cutoffs
""")
user.play("", expected="No array is chosen for Density, and none is known by its name. Choose one of: point arrays T (287.353")
