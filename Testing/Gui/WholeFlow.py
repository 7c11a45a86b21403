# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Views that the toolbar makes show all of the flow: one that no view has shown, one beside something much larger, one
that is revolved, and one whose 3-D view is narrow; each with the k of such an image. A part that the user has chosen
stays."""

from views_testing import OPEN_JET, ViewsSession

HELPERS = """
import inside_window
def reach(view, bounds):
    "How far the corners of the bounds are from the middle of a view whose sides are -1 and 1, at most, along each side."
    camera, (width, height) = view.GetActiveCamera(), view.ViewSize
    matrix = camera.GetCompositeProjectionTransformMatrix(width / height, -1, 1)
    corners = np.array([matrix.MultiplyPoint([bounds[i], bounds[2 + j], bounds[4 + k], 1])
                        for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    return np.abs(corners[:, :2] / corners[:, 3:]).max(axis=0)
def made():
    return [view for view in GetRenderViews() if view.SMProxy.GetXMLName() == "RenderView"
            and any(display in displays() for display in view.Representations)]
def check_whole(bounds, count=1):
    until(shown_at_all)
    assert len(made()) == count, made()
    for view in made():
        far = reach(view, bounds)
        assert 0.4 < far.max() <= 1, (view, far)
    k = [information(display.SchlierenBench, "KScaleUsed") for display in displays()
         if display.SchlierenBench.Cutoff == "Knife Edge"]
    assert np.allclose(k, inside_window.k, rtol=0.1), (k, inside_window.k)
"""
JET = "list(FindSource('jet').GetDataInformation().GetBounds())"

user = ViewsSession()

# Seen as ParaView shows it, its k is this one.
user.press("OneImage")
user.python(HELPERS + f"""
until(shown_at_all)
inside_window.k = information(displays()[0].SchlierenBench, "KScaleUsed")
check_whole({JET})
""")
user.undo()

# In no view yet.
user.python("""
view = GetActiveView()
Hide(FindSource("jet"), view)
view.CameraPosition, view.CameraFocalPoint, view.CameraParallelScale = [0, 0, 10], [0, 0, 0], 3
Render(view)
import inside_window
inside_window.camera = list(view.CameraPosition)
""")
user.press("OneImage")
user.python(HELPERS + f"check_whole({JET})")
user.undo()
user.python("import inside_window\nassert list(GetActiveView().CameraPosition) == inside_window.camera")

# Beside a ball that is a hundred times as large.
user.python("""
view = GetActiveView()
ball = Sphere(Radius=1, registrationName="ball")
Show(ball, view)
ResetCamera(view)
SetActiveSource(FindSource("jet"))
""")
user.press("ThreeImages")
user.python(HELPERS + f"check_whole({JET}, 3)")
user.undo()
user.python("Delete(FindSource('ball'))")

# In a narrow view, whose camera is far away, beside others, so that the images have a tab.
user.python("""
view = GetActiveView()
Show(FindSource("jet"), view)
layout = GetLayout(view)
layout.SplitHorizontal(0, 0.15)
beside = CreateView("RenderView")
AssignViewToLayout(beside, layout, 2)
SetActiveView(view)
process_events()
ResetCamera(view)
SetActiveSource(FindSource("jet"))
""")
user.press("ThreeImages")
user.python(HELPERS + f"check_whole({JET}, 3)")
user.undo()

# A part of it.
user.python("""
view = GetActiveView()
view.CameraFocalPoint, view.CameraPosition = [0.001, 0.005, 0], [0.001, 0.005, 0.01]
Render(view)
""")
user.press("OneImage")
user.python(HELPERS + """
until(shown_at_all)
assert np.allclose(made()[0].CameraFocalPoint, [0.001, 0.005, 0]), made()[0].CameraFocalPoint
""")
user.undo()

# A wedge of one cell, four degrees wide, around x: its cylinder is as high as wide.
user.python("""
jet = FindSource("jet")
Hide(jet, GetActiveView())
code = '''
import numpy as np
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.util.numpy_support import numpy_to_vtk
n, m = 33, 17
x, r, a = np.meshgrid(np.linspace(0, 2, n), np.linspace(0.05, 1, m), np.radians([-2, 2]), indexing="ij")
points = np.stack([x, r * np.cos(a), r * np.sin(a)], -1).transpose(2, 1, 0, 3).reshape(-1, 3)
rho = (1.2 - 0.3 * np.exp(-((x - 1)**2 + r**2) / 0.1)).transpose(2, 1, 0).reshape(-1)
output.SetDimensions(n, m, 2)
p = vtkPoints()
p.SetData(numpy_to_vtk(points, deep=True))
output.SetPoints(p)
array = numpy_to_vtk(rho, deep=True)
array.SetName("rho")
output.GetPointData().AddArray(array)
'''
wedge = AppendDatasets(Input=[ProgrammableSource(OutputDataSetType="vtkStructuredGrid", Script=code)], registrationName="wedge")
wedge.UpdatePipeline()
view = GetActiveView()
Show(wedge, view)
ResetCamera(view)
SetActiveSource(wedge)
""")
user.press("OneImage")
user.python(HELPERS + """
settle_views()
(view,) = made()
far = reach(view, [0, 2, -1, 1, -1, 1])
assert "revolved" in information(displays()[0].SchlierenBench, "Status"), information(displays()[0].SchlierenBench, "Status")
assert 0.4 < far.max() <= 1, far
# ParaView's own Reset shows all of it, too.
ResetCamera(view)
far = reach(view, [0, 2, -1, 1, -1, 1])
assert 0.4 < far.max() <= 1, far
""")

user.play(OPEN_JET)
