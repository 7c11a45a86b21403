# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The first minute of a new user: the plugin by Manage Plugins, a file opened and applied, one click, a drag of the view,
a preset, a figure. Nothing is said but what the density is."""

import os

from window_testing import FOLDER, JET, ViewsSession

FIGURE = os.path.join(FOLDER, "figure.png")
HELPERS = """
def button(text):
    "The last button of the dialog that is open."
    until(QApplication.activeModalWidget)
    buttons = QApplication.activeModalWidget().findChildren(QtWidgets.QAbstractButton)
    return [one for one in buttons if one.isVisible() and one.text().replace("&", "") == text][-1]
def choose_file(path):
    until(QApplication.activeModalWidget)
    dialog = QApplication.activeModalWidget()
    dialog.findChild(QtWidgets.QLineEdit, "EntityName").setText(path)
    button("OK").click()
"""
user = ViewsSession()


def step(script):
    user.python(HELPERS + script)
    user.idle()


user.menu("menuTools", "actionManage_Plugins")
step('button("Load New ...").click()')
step('choose_file(os.environ["SCHLIEREN_PLUGIN"])')
step('button("Close").click()')
user.menu("menu_File", "actionFileOpen")
step(f"choose_file({JET!r})")
user.apply()
user.press("OneImage")
user.python("until(displays)\nsettle_views()")
user.drag_view(2, (0.5, 0.5), (0.55, 0.52), (0.6, 0.55))
user.python("""
settle_views()
menu = widget("propertiesPanel", "Cutoff").findChild(QtWidgets.QMenu, "PresetsMenu")
[one for one in menu.actions() if one.text() == "Shadowgraph"][0].trigger()
settle_views()
(display,) = displays()
assert display.SchlierenBench.Cutoff == "Shadowgraph"
""")
user.menu("menuSchlieren", "actionSaveFigure")
user.event("pqClientMainWindow/SaveSchlierenFigure", "filesSelected", FIGURE)
user.event("pqClientMainWindow/SchlierenFigureOptions/widget/OKButton", "activate")
user.python("""
(messages,) = [one for one in widget().findChildren(QtWidgets.QWidget) if one.inherits("pqOutputWidget")]
rows = messages.findChild(QtWidgets.QAbstractItemView).model()
said = [rows.index(row, 0).data() for row in range(rows.rowCount())]
said = [line for line in said if line.strip() and not line.startswith(("Step ", "Begin of session"))]  # not of this test
assert len(said) == 1 and said[0].startswith("Schlieren: Density: 'rho' in kg/m"), said
assert not QApplication.activeModalWidget() and not widget("SchlierenMessage")
""")
user.play("import os", plugin=False)
assert os.path.getsize(FIGURE) > 10000
