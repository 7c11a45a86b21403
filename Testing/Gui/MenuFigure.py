# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The menu's Examples open a flow, here seen in perspective and by parallel light, and show it as an image; Save Schlieren
Figure saves what the active view shows, of a drawn flow and of a filter; without an image it says why."""

import json
import os

import numpy as np
from PIL import Image
from views_testing import ViewsSession, drawn, load, png, simple, views
from window_testing import FOLDER

FIGURE, IMAGE = os.path.join(FOLDER, "it's a figure.png"), os.path.join(FOLDER, "image.svg")


OPTIONS = "pqClientMainWindow/SchlierenFigureOptions"


def save_figure(user, path, **options):
    user.menu("menuSchlieren", "actionSaveFigure")
    user.event("pqClientMainWindow/SaveSchlierenFigure", "filesSelected", path)
    for name, value in options.items():
        user.event(f"{OPTIONS}/scrollArea/qt_scrollarea_viewport/Container/ProxyWidget/{name}", "set_string", value)
    user.event(f"{OPTIONS}/widget/OKButton", "activate")


user = ViewsSession()
user.python("""
menu = widget().findChild(QtWidgets.QMenu, "menuSchlieren")
figure = next(action for action in menu.actions() if action.objectName() == "actionSaveFigure")
menu.aboutToShow.emit()
assert not figure.isEnabled(), "There is no image"
""")
user.menu("menuSchlieren/menuExamples", "mirage")
user.python("""
until(shown_at_all, 60)
(display,) = displays()
view = next(view for view in GetRenderViews() if display in view.Representations)
assert display.SchlierenBench.Cutoff == "Background Oriented" and not view.CameraParallelProjection
assert {name for name, _ in GetSources()} == {"mirage.vti"}, GetSources()
ResetSession()
""")
user.menu("menuSchlieren/menuExamples", "jet")
user.python("""
until(lambda: displays(), 60)
settle_soon()
""")
save_figure(user, FIGURE, **{"Title/Title": "The jet", "Resolution/LineEdit0": 300})
user.python("""
(display,) = displays()
view = next(view for view in GetRenderViews() if display in view.Representations)
assert {name for name, _ in GetSources()} == {"ladenburg_jet_3d.vti"}, GetSources()
display.SchlierenLegend = view.OrientationAxesVisibility = 0
SaveScreenshot(os.path.join(FOLDER, "seen.png"), view, ImageResolution=list(view.ViewSize))
""")
user.save_state("example.pvsm")

# Of a filter that is chosen and applied.
user.choose_filter("Schlieren")
user.choose("ImageSize/LineEdit0", "64")
user.choose("ImageSize/LineEdit1", "64")
user.choose("Quality/ComboBox", "Interactive")
user.apply()
user.python("settle_views()")
save_figure(user, IMAGE)
user.play("import os\nfrom paraview.simple import *")

load("example.pvsm")
(_, scene), (_, view) = views()
jet = simple.FindSource("ladenburg_jet_3d.vti")
assert drawn(jet, view).SchlierenBench.Density == ["POINTS", "rho"]
assert simple.GetRepresentation(jet, scene).Representation == "Volume"

numbers = png(FIGURE.replace(".png", "_intensity.png"))[..., 0]
seen = png(os.path.join(FOLDER, "seen.png"))[..., 0]
assert numbers.shape == seen.shape and np.abs(numbers / 257 - seen).max() < 1.01
assert png(FIGURE).shape[0] > numbers.shape[0]
with Image.open(FIGURE) as figure:
    assert np.allclose(figure.info["dpi"], 300, atol=0.1)
with open(FIGURE.replace(".png", ".json"), encoding="utf-8") as file:
    assert json.load(file)["title"] == "The jet"
with open(IMAGE.replace(".svg", ".json"), encoding="utf-8") as file:
    description = json.load(file)
assert description["sources"][0]["properties"]["FileName"][0].endswith("ladenburg_jet_3d.vti")
with open(IMAGE, encoding="utf-8") as file:
    assert "x / mm" in file.read()
