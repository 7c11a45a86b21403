# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What tests do with Python inside ParaView's window."""

import ctypes
import os
import sys
import time
import traceback
from importlib import import_module

import numpy as np

sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))

import quick_sessions  # noqa: E402, F401
import shown_testing  # noqa: E402
from paraview import servermanager, simple, smtrace  # noqa: E402
from shown_testing import (check_display, check_linked, drawn, filters, frame_view, shown, values,  # noqa: E402, F401
                           views)
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

import_module("schlieren.vtkSchlierenFilters")  # for GetMediumBuilds, before the first filter is wrapped
FOLDER = os.environ["SCHLIEREN_TEST_OUTPUT"]

# The Qt that the window uses: 5 or 6.
with open("/proc/self/maps", encoding="utf-8") as _maps:
    QT = 6 if "/libQt6Core.so" in _maps.read() else 5
QtCore, QtGui, QtTest, QtWidgets = (import_module(f"PyQt{QT}.{name}")
                                    for name in ("QtCore", "QtGui", "QtTest", "QtWidgets"))
QEvent, QPointF, Qt, QTimer = QtCore.QEvent, QtCore.QPointF, QtCore.Qt, QtCore.QTimer
QMouseEvent, QTest = QtGui.QMouseEvent, QtTest.QTest
QApplication, QWidget = QtWidgets.QApplication, QtWidgets.QWidget
QAction = (QtGui if QT == 6 else QtWidgets).QAction

# Neither PyQt nor CDLL, which let go of the interpreter's lock: VTK's observers in Python do not take it.
_process_events = ctypes.PyDLL(
    f"libQt{QT}Core.so.{QT}")["_ZN16QCoreApplication13processEventsE6QFlagsIN10QEventLoop17ProcessEventsFlagEE"]


def process_events():
    """Lets the window do what is to be done now; returns the seconds that this took."""
    start = time.perf_counter()
    _process_events(0)
    return time.perf_counter() - start


def until(condition, seconds=300):
    """Lets the window run until something is so, which is looked at twenty times a second: asking more often would take the
    time of what is waited for."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"Still not so after {seconds} s"
        turn = time.monotonic() + 5e-2
        while time.monotonic() < turn:
            if process_events() < 1e-3:
                time.sleep(1e-2)


def pause(seconds):
    end = time.monotonic() + seconds
    until(lambda: time.monotonic() > end)


def information(source, name):
    """The present value of a property that only shows something."""
    prop = source.SMProxy.GetProperty(name)
    source.SMProxy.UpdatePropertyInformation(prop)
    return prop.GetElement(0)


def builds(source):
    """How often the medium of a bench has been built."""
    return source.GetClientSideObject().GetMediumBuilds()


def finished(source):
    return information(source, "Finished") == 1


def settle(*filters):
    """Until views show the images of filters as they are set."""
    simple.RenderAllViews()
    pause(0.3)
    assert all(finished(one) for one in filters)


def displays():
    """What draws data as Schlieren."""
    found, all_of_them = [], servermanager.vtkSMProxyIterator()
    all_of_them.SetSession(servermanager.ActiveConnection.Session)
    all_of_them.SetModeToOneGroup()
    all_of_them.Begin("representations")
    while not all_of_them.IsAtEnd():
        proxy = all_of_them.GetProxy()
        kind = proxy.GetProperty("Representation")
        if kind and kind.GetElement(0) == "Schlieren" and proxy.GetProperty("Visibility").GetElement(0) == 1:
            found.append(servermanager._getPyProxy(proxy))  # of all, it would take long  # pylint: disable=protected-access
        all_of_them.Next()
    return found


def shown_at_all():
    """Whether all that is drawn as Schlieren has an image, complete or not."""
    return displays() and all(information(display.SchlierenBench, "ImageCount") > 0 for display in displays())


def settle_views():
    """Until all that is drawn as Schlieren is complete and nothing changes it any more."""
    kept = []  # with references to them, they are described once

    def whole():
        kept[:] = [(display, display.SchlierenBench) for display in displays()]
        return all(finished(bench) and information(bench, "ImageCount") > 0
                   and not information(bench, "Status").startswith("Preview") for _, bench in kept)
    until(whole)
    pause(0.5)
    until(whole)


def settle_soon():
    """As settle_views(), with the quality whose images are complete soonest: where it is not what is looked at."""
    for display in displays():
        display.SchlierenBench.Quality = "Interactive"
    simple.RenderAllViews()
    settle_views()


def save(name, source, *views):
    """Keeps the image that a filter has, as it is, its properties and the cameras of views."""
    here = source.GetClientSideObject()
    image = here.GetOutputDataObject(0) if here else servermanager.Fetch(source)
    cameras = [view.GetActiveCamera() for view in views]
    np.savez(
        os.path.join(FOLDER, name),
        intensity=vtk_to_numpy(image.GetPointData().GetArray("Intensity")),
        dimensions=image.GetDimensions(), origin=image.GetOrigin(), spacing=image.GetSpacing(),
        status=information(source, "Status"),
        direction=source.ViewDirection, up=source.ViewUp, focus=source.FocalPoint,
        scale=source.ParallelScale, count=information(source, "ImageCount"),
        k=information(source, "KScaleUsed"),
        **{f"{key}{index}": value for index, camera in enumerate(cameras) for key, value in (
            ("position", camera.GetPosition()), ("focal_point", camera.GetFocalPoint()),
            ("view_up", camera.GetViewUp()), ("angle", camera.GetViewAngle()),
            ("parallel", camera.GetParallelProjection()),
            ("parallel_scale", camera.GetParallelScale()))})


def check_linked_now(scene, *others):
    """As check_linked() does in a state."""
    save_state(os.path.join(FOLDER, "links.pvsm"))
    check_linked("links.pvsm", scene, *others)


def has_links():
    """Whether any views are linked."""
    return servermanager.ProxyManager().SMProxyManager.GetNumberOfLinks() > 0


def intensity(bench):
    """The image that a bench has, as it is."""
    return np.array(vtk_to_numpy(bench.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Intensity")))


def by_name(*names):
    return [simple.FindSource(name) or simple.FindView(name) for name in names]


def widget(*names):
    """The widget of this name inside those of the names before it; None where it is not."""
    (found,) = [window for window in QApplication.topLevelWidgets()
                if window.objectName() == "pqClientMainWindow"]
    for name in names:
        found = found and found.findChild(QWidget, name)
    return found


def save_state(name):
    """As File > Save State does. But since ParaView 5.13, whatever writes a file leaves a step to undo; so
    this is what the program prints."""
    state = servermanager.ProxyManager().SMProxyManager.SaveXMLState()
    flush = ctypes.CDLL(None).fflush
    with open(name, "wb") as file:
        output = os.dup(1)
        flush(None)  # what was printed before
        os.dup2(file.fileno(), 1)
        state.PrintXML()
        flush(None)
        os.dup2(output, 1)
        os.close(output)


_failed = set()  # sessions


def add_steps(name, folder, count):
    """Buttons out of sight that run the scripts of Session.python; the window becomes as small as its panels allow, for
    half of a session's time goes into drawing its views."""
    widget().resize(940, 640)
    steps = QWidget(widget())
    steps.setObjectName(name)
    for number in range(1, count + 1):
        button = QtWidgets.QPushButton(steps)
        button.setObjectName(f"step{number}")
        button.clicked.connect(lambda _, number=number: _run_step(name, os.path.join(folder, f"{name}{number}.py"), number))


def _run_step(name, path, number):
    """Runs a step, unless one of the same session has failed: it could wait for minutes for what that one did not do."""
    if name in _failed:
        return
    try:
        with open(path, encoding="utf-8") as file:
            exec(compile(file.read(), path, "exec"), {"__name__": "__main__"})
        print(f"Step {number} of {name} is done.", flush=True)
    except Exception:  # PyQt would end the window
        traceback.print_exc()
        if not _failed:
            _close_waiting()
        _failed.add(name)


def _close_waiting(before=None):
    """From the first failure on closes dialogs that wait for ten seconds: what would answer them may be skipped."""
    dialog = QApplication.activeModalWidget()
    if dialog and dialog is before:
        dialog.close()
    QTimer.singleShot(10000, lambda: _close_waiting(dialog))


def confirm():
    """Answers a question with Yes, if there is one now."""
    question = QApplication.activeModalWidget()
    if isinstance(question, QtWidgets.QMessageBox):
        question.button(QtWidgets.QMessageBox.StandardButton.Yes).click()


def reset_session():
    """Edit > Reset Session, without waiting for it; its question, if ParaView asks one, is answered. Nothing is selected: where
    a filter has been deleted, the output that was its input is, and ParaView crashes if nothing else keeps that one's source
    (pqDeleteReaction::canDeleteTree)."""
    simple.SetActiveSource(None)
    (action,) = [one for one in widget("menu_Edit").actions() if one.objectName() == "actionDelete_All"]
    confirming = QTimer(widget(), interval=100)
    confirming.timeout.connect(confirm)

    def reset():
        action.trigger()
        confirming.stop()

    confirming.start()
    QTimer.singleShot(0, reset)


def end_reset(folder):
    """When the new session has begun: the panel and the files are as in a new window."""
    global FOLDER  # pylint: disable=global-statement
    until(lambda: not simple.GetSources() and simple.GetRenderViews())
    if servermanager.vtkSMTrace.GetActiveTracer():
        smtrace.stop_trace()
    FOLDER = shown_testing.FOLDER = folder
    widget("propertiesPanel", "AdvancedButton").setChecked(False)


def click(button):
    """Clicks a button and returns when the window has done what that leads to; with the interpreter's lock held,
    so that VTK may call Python meanwhile."""
    QTimer.singleShot(0, button.click)
    process_events()


def click_during(algorithm, fraction, button):
    """Clicks an enabled button as the mouse does when an update of a VTK algorithm has come so far, until that is
    aborted: ParaView's progress bar swallows clicks that are posted just before it is painted. Returns what ends this."""
    clicked, aborted = [0], []

    def watch(*_):
        if algorithm.GetAbortExecute():
            aborted.append(True)
        elif (not aborted and algorithm.GetProgress() > fraction and button.isEnabled()
              and time.monotonic() > clicked[0] + 0.1):
            clicked[0] = time.monotonic()
            window = widget().windowHandle()
            place = button.mapTo(widget(), button.rect().center())
            left, none = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton
            for kind, held in ((QEvent.Type.MouseButtonPress, left), (QEvent.Type.MouseButtonRelease, none)):
                QApplication.postEvent(window, QMouseEvent(
                    kind, QPointF(place), QPointF(window.mapToGlobal(place)), left, held,
                    Qt.KeyboardModifier.NoModifier))

    tag = algorithm.AddObserver("ProgressEvent", watch)
    return lambda: algorithm.RemoveObserver(tag)


def press_key(key, modifiers=Qt.KeyboardModifier.NoModifier, release=True):
    """What the keyboard does: to shortcuts, else to the widget that has the focus."""
    # The menu that this script comes from still closes, and then a display without a window manager takes the
    # focus from the window.
    since = time.monotonic()
    while time.monotonic() < since + 1:
        process_events()
        time.sleep(1e-2)
        if QApplication.activePopupWidget() or not QApplication.activeWindow():
            QApplication.setActiveWindow(widget())
            since = time.monotonic()
    focus = QApplication.focusWidget() or widget()
    QTest.keyPress(focus, key, modifiers)
    if release:
        QTest.keyRelease(focus, key, modifiers)
