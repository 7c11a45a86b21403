# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A click into a view that draws a flow as Schlieren selects the flow, unless what is selected is shown there; scripts that
make a view the active one select nothing."""

from window_testing import MESH, ViewsSession

HELPERS = """
(_, scene), (_, image) = views()
def click(view):
    "In the middle of a view, of which the other one is to the left or right."
    viewports = [one for one in widget("centralwidget").findChildren(QWidget, "Viewport") if one.isVisible()]
    viewports.sort(key=lambda one: one.mapTo(widget(), QtCore.QPoint(0, 0)).x())
    target = viewports[[scene, image].index(view)]
    point = target.mapTo(widget(), target.rect().center())
    QTest.mouseClick(widget().windowHandle(), Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, point)
    until(lambda: GetActiveView() == view)
    pause(0.5)
def selected():
    "The name of the source; at Reset Session, ParaView may crash where an output is selected."
    source = GetActiveSource()
    current = servermanager.ProxyManager().GetSelectionModel("ActiveSources").GetCurrentProxy()
    assert not current or not current.IsA("vtkSMOutputPort")
    return source and [name for (name, _), one in GetSources().items() if one == source][0]
"""
user = ViewsSession()
user.press("OneImage")
user.python(HELPERS + """
settle_views()
assert selected() == "mesh", selected()
other = Sphere(registrationName="other")
Show(other, scene)
SetActiveSource(other)
SetActiveView(image)
pause(0.3)
assert selected() == "other", selected()
SetActiveView(scene)
pause(0.3)
click(image)
assert selected() == "mesh", selected()
click(scene)
assert selected() == "mesh", selected()  # shown there
""")
user.play(MESH)
