# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What tests do with Python inside ParaView's window."""

import ctypes
import os
import time

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

FOLDER = os.environ["SCHLIEREN_TEST_OUTPUT"]

# Not CDLL, which lets go of the interpreter's lock: VTK's observers in Python do not ask for it.
_process_events = ctypes.PyDLL(
    "libQt5Core.so.5")["_ZN16QCoreApplication13processEventsE6QFlagsIN10QEventLoop17ProcessEventsFlagEE"]


def process_events():
    """Lets the window do what is to be done now; returns the seconds that this took."""
    start = time.perf_counter()
    _process_events(0)
    return time.perf_counter() - start


def until(condition, seconds=120):
    """Lets the window go on until something is so."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"Still not so after {seconds} s"
        if process_events() < 1e-3:
            time.sleep(1e-3)


def pause(seconds):
    end = time.monotonic() + seconds
    until(lambda: time.monotonic() > end)


def information(source, name):
    """The present value of a property that only tells something."""
    prop = source.SMProxy.GetProperty(name)
    source.SMProxy.UpdatePropertyInformation(prop)
    return prop.GetElement(0)


def finished(source):
    return information(source, "Finished") == 1


def rows_of(source):
    """Of the picture that a filter holds in this program."""
    return source.GetClientSideObject().GetOutputDataObject(0).GetDimensions()[1]


def save(name, source, *views):
    """Keeps the picture that a filter has, as it is, its properties and the cameras of views."""
    here = source.GetClientSideObject()
    image = here.GetOutputDataObject(0) if here else servermanager.Fetch(source)
    cameras = [view.GetActiveCamera() for view in views]
    np.savez(
        os.path.join(FOLDER, name),
        intensity=vtk_to_numpy(image.GetPointData().GetArray("Intensity")),
        dimensions=image.GetDimensions(), origin=image.GetOrigin(), spacing=image.GetSpacing(),
        reduction=source.PreviewReduction, limit=source.TimeLimit, status=information(source, "Status"),
        direction=source.ViewDirection, up=source.ViewUp, focus=source.FocalPoint,
        scale=source.ParallelScale, count=information(source, "PictureCount"),
        **{f"{key}{index}": value for index, camera in enumerate(cameras) for key, value in (
            ("position", camera.GetPosition()), ("focal_point", camera.GetFocalPoint()),
            ("view_up", camera.GetViewUp()), ("angle", camera.GetViewAngle()),
            ("parallel", camera.GetParallelProjection()),
            ("parallel_scale", camera.GetParallelScale()))})


def by_name(*names):
    return [simple.FindSource(name) or simple.FindView(name) for name in names]


# Qt, as far as a script needs it to look at widgets and to press keys. Its functions are called by the names
# that the compiler gave them; none returns an object, whose place would depend on the processor.
CTRL, SHIFT, ESCAPE, RIGHT = 0x04000000, 0x02000000, 0x01000000, 0x01000014
_KEY_PRESS, _KEY_RELEASE, _READ, _RECURSIVELY = 6, 7, 1, 1
_pointer, _int = ctypes.c_void_p, ctypes.c_int


def _function(library, name, result, *arguments):
    function = getattr(ctypes.PyDLL(library), name)
    function.restype, function.argtypes = result, arguments
    return function


_find_child = _function(
    "libQt5Core.so.5",
    "_Z20qt_qFindChild_helperPK7QObjectRK7QStringRK11QMetaObject6QFlagsIN2Qt15FindChildOptionEE",
    _pointer, _pointer, _pointer, _pointer, _int)
_make_string = _function("libQt5Core.so.5", "_ZN7QStringC1EPK5QChari", None, _pointer, _pointer, _int)
_index_of_property = _function(
    "libQt5Core.so.5", "_ZNK11QMetaObject15indexOfPropertyEPKc", _int, _pointer, ctypes.c_char_p)
_metacall = _function(
    "libQt5Core.so.5", "_ZN11QMetaObject8metacallEP7QObjectNS_4CallEiPPv", _int, _pointer, _int, _int,
    _pointer)
_active_window = _function("libQt5Widgets.so.5", "_ZN12QApplication12activeWindowEv", _pointer)
_active_popup = _function("libQt5Widgets.so.5", "_ZN12QApplication17activePopupWidgetEv", _pointer)
_set_active_window = _function(
    "libQt5Widgets.so.5", "_ZN12QApplication15setActiveWindowEP7QWidget", None, _pointer)
_handle_of = _function("libQt5Widgets.so.5", "_ZNK7QWidget12windowHandleEv", _pointer, _pointer)
_set_focus = _function("libQt5Widgets.so.5", "_ZN7QWidget8setFocusEN2Qt11FocusReasonE", None, _pointer, _int)
_handle_key = _function(
    "libQt5Gui.so.5",
    "_Z17qt_handleKeyEventP7QWindowN6QEvent4TypeEi6QFlagsIN2Qt16KeyboardModifierEERK7QStringbt",
    None, _pointer, _int, _int, _int, _pointer, ctypes.c_bool, ctypes.c_ushort)


def _string(text):
    """A QString, which is never freed."""
    letters = text.encode("utf-16-le")
    made = _pointer()
    _make_string(ctypes.byref(made), ctypes.create_string_buffer(letters), len(letters) // 2)
    return made


def _class(name):
    library = ctypes.PyDLL("libQt5Widgets.so.5")
    return ctypes.addressof(ctypes.c_char.in_dll(library, f"_ZN{len(name)}{name}16staticMetaObjectE"))


def _main_window():
    """What the QPointer pqCoreUtilities::MainWidget holds: a count's place, and the widget's."""
    return (_pointer * 2).in_dll(ctypes.PyDLL(None), "_ZN15pqCoreUtilities10MainWidgetE")[1]


class Widget:
    """The one of this name inside those of the names before it; of a class of Qt's."""

    def __init__(self, *names, kind="QWidget"):
        self.kind, self.pointer = _class(kind), _main_window()
        for name, of_kind in zip(names, (len(names) - 1) * [_class("QWidget")] + [self.kind]):
            if self.pointer:
                self.pointer = _find_child(self.pointer, ctypes.byref(_string(name)), of_kind, _RECURSIVELY)

    def exists(self):
        return bool(self.pointer)

    def focus(self):
        """As a click does; the clicks of a session that is played do not."""
        _set_focus(self.pointer, 0)

    def _read(self, name, value):
        index = _index_of_property(self.kind, name.encode())
        assert index >= 0, name
        _metacall(self.pointer, _READ, index, (_pointer * 1)(ctypes.addressof(value)))
        return value

    def number(self, name):
        return self._read(name, _int()).value

    def is_so(self, name):
        return self._read(name, ctypes.c_bool()).value

    def text(self, name="text"):
        """Of a QString: the count of its users, that of its letters, and how far on these begin."""
        data = self._read(name, _string("")).value
        begin = data + ctypes.c_ssize_t.from_address(data + 16).value
        return ctypes.string_at(begin, 2 * _int.from_address(data + 4).value).decode("utf-16-le")


def press_key(key, modifiers=0, release=True):
    """What the keyboard does: to shortcuts, else to the widget that has the focus."""
    # The menu that this script comes from still closes, and then a display without a window manager takes the
    # focus from the window.
    since = time.monotonic()
    while time.monotonic() < since + 1:
        process_events()
        if _active_popup() or not _active_window():
            _set_active_window(_main_window())
            since = time.monotonic()
    for event in (_KEY_PRESS, _KEY_RELEASE) if release else (_KEY_PRESS,):
        _handle_key(_handle_of(_main_window()), event, key, modifiers, ctypes.byref(_string("")), False, 1)
