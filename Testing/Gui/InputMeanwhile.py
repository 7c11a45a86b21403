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
# A question of ParaView's, which finds all that is to be made, once.
def refuse():
    question = QApplication.activeModalWidget()
    if not question:
        QTimer.singleShot(50, refuse)
        return
    inside_window.found = len(GetRenderViews()), len(displays())
    question.button(QtWidgets.QMessageBox.StandardButton.No).click()
def ask():
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    type_key(Qt.Key.Key_R)
    QTimer.singleShot(0, refuse)
make_and(ask)
until(lambda: hasattr(inside_window, "found"))
assert inside_window.found == (4, 3), inside_window.found
""")
user.idle()  # some of which are played inside of the question
user.python("until(shown_at_all)\nassert len(displays()) == 3")
user.undo()
user.python(HELPERS + """
assert len(GetRenderViews()) == 1 and not displays()
make_and(lambda: type_key(Qt.Key.Key_Z))
until(lambda: len(GetRenderViews()) == 1 and not displays())

# The example, as soon as events are handled after a new session has been agreed to.
import inside_window
(reset,) = [one for one in widget("menu_Edit").actions() if one.objectName() == "actionDelete_All"]
(example,) = [one for one in widget("menuExamples").actions() if one.objectName() == "jet"]
inside_window.tried = []
def try_example():
    inside_window.tried.append(widget("menuExamples").isEnabled())
    example.trigger()
def agree():
    question = QApplication.activeModalWidget()
    if not question:
        QTimer.singleShot(50, agree)
        return
    QTimer.singleShot(0, try_example)
    question.button(QtWidgets.QMessageBox.StandardButton.Yes).click()
QTimer.singleShot(0, reset.trigger)
QTimer.singleShot(50, agree)
""")
user.idle()
user.python("""
import inside_window
((cell, view),) = views()
assert cell == 0 and len(GetRenderViews()) == 1 and not GetSources()
assert inside_window.tried == [False], inside_window.tried
""")
user.play(OPEN_JET)
