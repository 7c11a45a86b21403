# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Plays what a user does in ParaView's window and sees that all of it works."""

import os
import re
import subprocess
import sys
from importlib import import_module
from xml.sax.saxutils import quoteattr

FOLDER = os.environ["SCHLIEREN_TEST_OUTPUT"]
SOURCE = os.environ["SCHLIEREN_SOURCE_DIR"]
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(SOURCE, "Testing", "Python"))
PANEL = "pqClientMainWindow/propertiesDock/propertiesPanel"
VIEW = ("pqClientMainWindow/centralwidget/MultiViewWidget/CoreWidget/qt_tabwidget_stackedwidget"
        "/MultiViewWidget1/Container/Frame.{}/CentralWidgetFrame/Viewport")
PROPERTIES = (PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents"
              "/PropertiesFrame/ProxyPanel")

# Of data that the active view shows: how, and of those drawn as Schlieren the settings of the image.
DISPLAY = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/DisplayFrame/ProxyPanel"
BENCH = DISPLAY + "/SchlierenBench/BenchPanel"

JET = os.path.join(SOURCE, "Testing", "Data", "ladenburg_jet_3d.vti")
COARSE_JET = import_module("coarse_jet").PATH
TOOLBAR = "pqClientMainWindow/SchlierenToolBar/"

# Opened and applied: images are shown as outlines. With a quarter of the points along each axis, the window reads the jet,
# draws it as a volume and makes its medium in a fraction of the time.
OPEN_JET = f"""
from paraview.simple import *
jet = OpenDataFile({COARSE_JET!r}, registrationName="jet")
jet.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
Show(jet, view)
view.ResetCamera()
SetActiveSource(jet)
"""
OPEN_WHOLE_JET = OPEN_JET.replace(COARSE_JET, JET)

# A mesh with a density, shown as a surface.
MESH = """
from paraview.simple import *
wave = Wavelet(WholeExtent=3 * [-8, 8], registrationName="wave")
rho = Calculator(Input=wave, Function="1e-3*RTData+1", ResultArrayName="rho",
                 registrationName="density")
mesh = AppendDatasets(Input=[rho], registrationName="mesh")
mesh.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
Show(mesh, view)
view.ResetCamera()
SetActiveSource(mesh)
"""


class Session:
    """What the user does, step by step; play() does it, and checks what it should have led to. Widgets are named below
    `properties`."""

    def __init__(self, properties=PROPERTIES, name=os.path.basename(FOLDER), folder=FOLDER):
        self.properties, self.name, self.folder = properties, name, folder
        self.lines = []
        self.scripts = 0

    def event(self, widget, command, argument=""):
        self.lines.append(f"<pqevent object={quoteattr(widget)} command={quoteattr(command)} "
                          f"arguments={quoteattr(str(argument))}/>")

    def check(self, widget, name, value):
        """The widget, named below the properties, has this Qt property."""
        self.check_at(f"{self.properties}/{widget}", name, value)

    def check_at(self, widget, name, value):
        self.lines.append(f"<pqcheck object={quoteattr(widget)} "
                          f"property={quoteattr(name)} arguments={quoteattr(str(value))}/>")

    def click(self, widget):
        self.event(f"{self.properties}/{widget}", "activate")

    def choose(self, widget, text):
        self.event(f"{self.properties}/{widget}", "set_string", text)

    def type(self, widget, text):
        """Types into a line and presses Return."""
        self.choose(widget, text)
        self.key(widget, "Return")

    def key(self, widget, name):
        """Presses a key where the widget has the focus."""
        if name.startswith("Shift"):
            self.event(f"{self.properties}/{widget}", "keyEvent", {"ShiftLeft": "6:16777234:33554432::0:1"}[name])
            return
        self.event(f"{self.properties}/{widget}", "key",
                   {"Space": "32", "Return": "16777220", "Left": "16777234", "Up": "16777235",
                    "Right": "16777236", "Down": "16777237", "Home": "16777232",
                    "Minus": "45"}[name])

    def drag(self, widget, *places, modifiers=0):
        """Drags with the left button from place to place, pixels of the widget."""
        events = ["mousePress"] + ["mouseMove"] * (len(places) - 1) + ["mouseRelease"]
        buttons = ["1,1"] + ["0,1"] * (len(places) - 1) + ["1,0"]
        for event, button, (x, y) in zip(events, buttons, places + places[-1:]):
            self.event(f"{self.properties}/{widget}", event, f"{button},{modifiers},{x},{y}")

    def apply(self):
        self.event(PANEL + "/Accept", "activate")

    def reset(self):
        self.event(PANEL + "/Reset", "activate")

    def delete(self):
        self.event(PANEL + "/Delete", "activate")

    def menu(self, menu, action):
        self.event(f"pqClientMainWindow/menubar/{menu}", "activate", action)

    def size_plane(self, side):
        """Gives the plane of the cutoff editor edges of so many pixels, 20 from the left and 2 from the top,
        whatever the panel and its font."""
        self.python(f"""
plane = widget("propertiesPanel", "SchlierenCutoff", "Plane")
font = plane.font()
font.setPixelSize(15)
plane.setFont(font)
assert plane.fontMetrics().height() == 18, plane.fontMetrics().height()
plane.setFixedWidth({side} + 18 + 4)
until(lambda: plane.property("side") == {side})
""")

    def choose_filter(self, name):
        """Of the menu Filters > Schlieren."""
        self.event("pqClientMainWindow/menubar", "activate", "menuFilters")  # opens it, which fills it
        self.menu("menuFilters", "Schlieren")
        self.menu("menuFilters/Schlieren", name)

    def save_state(self, name):
        self.python(f"save_state({os.path.join(FOLDER, name)!r})\n")

    def python(self, script):
        """Runs a Python script within the window; see inside_window.py. As a macro, it would leave a step to
        undo since ParaView 5.13."""
        self.scripts += 1
        with open(os.path.join(self.folder, f"{self.name}{self.scripts}.py"), "w", encoding="utf-8") as file:
            file.write("from paraview.simple import *\nfrom inside_window import *\n" + script)
        self.event(f"pqClientMainWindow/{self.name}/step{self.scripts}", "activate")

    def idle(self):
        """Steps that do nothing for a second in all, after one that loads a state, plays an animation or opens a
        question. ParaView lets the window run in the middle of that, and on a busy machine the player takes this for a
        dialog and plays the next step inside: it must not wait for images, which are not made before that other step
        has ended, nor for the end of a dialog."""
        for _ in range(10):
            self.python("pause(0.1)")

    def drag_view(self, frame, *places, button=1):
        """Drags with a button (1 left, 2 right) from place to place in the view of a frame, whose sides are
        0 to 1."""
        self.view_event(frame, "mousePress", places[0], button, button)
        for place in places[1:]:
            self.view_event(frame, "mouseMove", place, button, button)
        self.view_event(frame, "mouseRelease", places[-1], button, 0)

    def view_event(self, frame, event, place, button, buttons):
        self.event(VIEW.format(frame), event, f"({place[0]:g},{place[1]:g},{button},{buttons},0)")

    def play(self, script, seconds=500, expected=None, plugin=True):
        """Plays it after the Python script `script`, and fails where a step does or VTK complains, but for lines with
        the text `expected`, which must be there. `plugin`: whether the window loads it."""
        check_said(self, expected, *play_together([(self, script)], self.folder, seconds, plugin))


def play_together(sessions, folder, seconds, plugin=True):
    """Plays sessions, each after a Python script, in one window, with Edit > Reset Session between them; returns what
    the window has said, of each."""
    begins = "Begin of session: "
    between = Session(name="between", folder=folder)
    lines, before = [], f"import sys\nsys.path.insert(0, {HERE!r})\nfrom inside_window import add_steps\n"
    for user, script in sessions:
        begin, between.lines = f"print({begins + user.name!r}, flush=True)\n", []
        if lines:
            between.python("reset_session()\n")
            between.idle()
            begin += f"end_reset({user.folder!r})\n" + script
        between.python(begin)
        lines += between.lines + user.lines
    for user, _ in sessions + [(between, "")]:
        before += f"add_steps({user.name!r}, {user.folder!r}, {user.scripts})\n"
    paths = [os.path.join(folder, name) for name in ("events.xml", "before.py")]
    for path, text in zip(paths, ("\n".join(["<pqevents>"] + lines + ["</pqevents>", ""]), before + sessions[0][1])):
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    environment = dict(os.environ, XDG_CONFIG_HOME=os.path.join(folder, "window"), SCHLIEREN_TEST_OUTPUT=sessions[0][0].folder,
                       PV_PLUGIN_PATH=os.path.dirname(os.environ["SCHLIEREN_PLUGIN"]) if plugin else "")
    try:
        done = subprocess.run(
            [os.environ["SCHLIEREN_PARAVIEW"], "--dr", f"--script={paths[1]}",
             f"--test-script={paths[0]}", f"--test-directory={folder}", "--exit"],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            timeout=seconds, check=False)
        output, end = done.stdout, done.returncode
    except subprocess.TimeoutExpired as late:
        output, end = (late.stdout or b"").decode(errors="replace"), f"its time limit of {seconds} s"
    before, *said = re.split(f"^{begins}.*\n", output, flags=re.MULTILINE)
    said = said or [""]
    said[0] = before + said[0]
    said[-1] += f"\nparaview ended with {end}\n"
    return said + (len(sessions) - len(said)) * ["It did not begin."]


def check_said(user, expected, said):
    """What the window has said while it played a session."""
    print(said)
    assert not re.search("^paraview ended with (?!0$)", said, re.MULTILINE)
    lines = re.sub(r"\( *[\d.]+s\) \[.*\n", "", said)  # VTK's messages may be within a line
    for number in range(1, user.scripts + 1):
        assert f"Step {number} of {user.name} is done." in lines, f"Step {number} did not come to its end"
    # Of a server without a display, which since VTK 9.6 draws even so.
    said = re.sub(r"Generic Warning: In vtkXOpenGLRenderWindow.*\nbad X server connection", "", said)
    if expected:
        assert expected in said, expected
        said = "\n".join(line for line in said.splitlines() if expected not in line)
    assert not re.search(r"critical:|ERR\||Traceback|Generic Warning|ERROR: In|was deprecated", said)
    # What ParaView warns of where an image is shown by an array that it does not have.
    assert not re.search("Could not determine array range|Failed to locate selected", said)


class ViewsSession(Session):
    def press(self, name):
        self.event(TOOLBAR + name, "activate")

    def check_button(self, name, prop, value):
        self.check_at(TOOLBAR + name, prop, value)

    def check_message(self, text):
        """The message that a mistake ends in; it is closed."""
        box = "pqClientMainWindow/SchlierenMessage"
        self.check_at(box, "text", text)
        self.event(box + "/qt_msgbox_buttonbox/1QPushButton0", "activate")

    def undo(self):
        self.menu("menu_Edit", "actionEditUndo")

    def redo(self):
        self.menu("menu_Edit", "actionEditRedo")
