# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Input while views are made, when ParaView handles events: keys have their effect afterwards, clicks none. While the
session is reset the toolbar makes nothing."""

from views_testing import OPEN_JET, ViewsSession

HELPERS = """
import inside_window
QApplication.setActiveWindow(widget())
button = widget("SchlierenToolBar", "ThreeImages")
def type_key(key):
    QTest.keyClick(widget(), key, Qt.KeyboardModifier.ControlModifier)
def make_and(do):
    "Makes three views, and does something as soon as ParaView handles events."
    inside_window.done = []
    def during():
        inside_window.done.append(len(GetRenderViews()))
        do()
    QTimer.singleShot(0, button.click)
    QTimer.singleShot(0, during)
    until(lambda: inside_window.done)
    (there,) = inside_window.done
    assert there < 4, "All views are there already"
"""
user = ViewsSession()
user.python(HELPERS + """
# A dialog of ParaView's, which finds all that is to be made, once.
def close():
    dialog = QApplication.activeModalWidget()
    if not dialog:
        QTimer.singleShot(50, close)
        return
    inside_window.found = len(GetRenderViews()), len(displays())
    dialog.reject()
def ask():
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    type_key(Qt.Key.Key_O)
    QTimer.singleShot(0, close)
make_and(ask)
until(lambda: hasattr(inside_window, "found"))
assert inside_window.found == (4, 3), inside_window.found
""")
user.idle()  # some of which are played inside of the dialog
user.python("until(shown_at_all)\nassert len(displays()) == 3")
user.undo()
user.python(HELPERS + """
assert len(GetRenderViews()) == 1 and not displays()
make_and(lambda: type_key(Qt.Key.Key_Z))
until(lambda: len(GetRenderViews()) == 1 and not displays())

# The example, as soon as events are handled after a new session has been agreed to, where ParaView asks.
import inside_window
(reset,) = [one for one in widget("menu_Edit").actions() if one.objectName() == "actionDelete_All"]
(example,) = [one for one in widget("menuExamples").actions() if one.objectName() == "jet"]
inside_window.tried = []
def try_example():
    question = QApplication.activeModalWidget()
    if question:
        QTimer.singleShot(0, try_example)
        question.button(QtWidgets.QMessageBox.StandardButton.Yes).click()
        return
    inside_window.tried.append(widget("menuExamples").isEnabled())
    example.trigger()
QTimer.singleShot(0, reset.trigger)
QTimer.singleShot(0, try_example)
""")
user.idle()
user.python("""
import inside_window
((cell, view),) = views()
assert cell == 0 and len(GetRenderViews()) == 1 and not GetSources()
assert inside_window.tried == [False], inside_window.tried
""")
user.play(OPEN_JET)
