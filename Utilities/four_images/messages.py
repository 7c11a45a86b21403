# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Shows the user what happens, and keeps VTK from saying more."""

import os
import re
import sys
import time

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow

START = time.monotonic() - float(os.environ.get("SCHLIEREN_ELAPSED", 0))


def say(text):
    print(f"[{time.monotonic() - START:4.0f} s] {text}", flush=True)


class Messages:
    """Keeps what VTK would print, so that the user sees one line and not a page."""

    def __init__(self):
        # pvpython prints through VTK's output window: go round it.
        sys.stdout, sys.stderr = sys.__stdout__, sys.__stderr__
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)
        self.seen = self.warned = 0
        self.said = set()

    def last_error(self):
        """The newest error since the last call, without VTK's file name and address; or nothing."""
        text = self.window.GetOutput()
        new, self.seen = text[self.seen:], len(text)
        errors = re.findall(r"ERROR: In .*?\n.*?\(0x[0-9a-f]+\): (.*?)\n\n", new + "\n\n",
                            re.DOTALL)
        return " ".join(errors[0].split()) if errors else ""

    def warnings(self):
        """The warnings since the last call that have not been said yet."""
        text = self.window.GetOutput()
        new, self.warned = text[self.warned:], len(text)
        found = re.findall(r"Warning: In .*?\n.*?\(0x[0-9a-f]+\): (.*?)\n\n", new + "\n\n", re.DOTALL)
        fresh = [line for line in dict.fromkeys(" ".join(text.split()) for text in found) if line not in self.said]
        self.said.update(fresh)
        return fresh


class Progress:
    """Says every few seconds how far a long computation has come."""

    def __init__(self, proxy):
        self.last = time.monotonic()
        proxy.GetClientSideObject().AddObserver("ProgressEvent", self)

    def __call__(self, algorithm, event):
        if time.monotonic() - self.last > 5 and 0 < algorithm.GetProgress() < 1:
            say(f"  {algorithm.GetProgress():.0%}")
            self.last = time.monotonic()
