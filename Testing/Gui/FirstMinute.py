# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The first minute of a new user: the plugin by Manage Plugins, a file opened and applied, one click, a drag of the view,
a preset, a figure. Nothing is said but what the density is. The window as it is before the preset, window.png, is the first
image of Documentation/window.md."""

import os

from window_testing import COARSE_JET, FOLDER, JET, ViewsSession

IS_LARGE = "SCHLIEREN_WINDOW_SIZE" in os.environ
FIGURE, WINDOW = os.path.join(FOLDER, "figure.png"), os.path.join(FOLDER, "window.png")
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


if IS_LARGE:
    step("""
widget().resize(*map(int, os.environ["SCHLIEREN_WINDOW_SIZE"].split("x")))
widget().resizeDocks([widget("pipelineBrowserDock"), widget("propertiesDock")], [100, 700], Qt.Orientation.Vertical)
""")
user.menu("menuTools", "actionManage_Plugins")
step('button("Load New ...").click()')
step('choose_file(os.environ["SCHLIEREN_PLUGIN"])')
step('button("Close").click()')
user.menu("menu_File", "actionFileOpen")
step(f"choose_file({JET if IS_LARGE else COARSE_JET!r})")
user.apply()
user.press("OneImage")
user.python("until(shown_at_all)")
user.drag_view(2, (0.5, 0.5), (0.55, 0.52), (0.6, 0.55))
user.python("settle_views()" if IS_LARGE else "until(shown_at_all)")
user.python(f"""
panel = widget("propertiesPanel", "scrollArea")
panel.verticalScrollBar().setValue(widget("propertiesPanel", "Cutoff").mapTo(panel.widget(), QtCore.QPoint(0, -40)).y())
pause(0.2)
corner = widget().mapToGlobal(QtCore.QPoint(0, 0))
QApplication.primaryScreen().grabWindow(0, corner.x(), corner.y(), widget().width(), widget().height()).save({WINDOW!r})
""")
user.python("""
menu = widget("propertiesPanel", "Cutoff").findChild(QtWidgets.QMenu, "PresetsMenu")
[one for one in menu.actions() if one.text() == "Shadowgraph"][0].trigger()
settle_views()
(display,) = displays()
assert display.SchlierenBench.Cutoff == "Shadowgraph"
distances = information(display.SchlierenBench, "AutomaticUsed"), display.SchlierenBench.LockedK
assert all(0.01 < one < 1 for one in distances), distances  # not the k that was kept before
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
assert os.path.getsize(FIGURE) > 10000 and os.path.getsize(WINDOW) > 100000
