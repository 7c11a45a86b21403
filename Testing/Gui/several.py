# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Plays scripts of this folder, named as arguments, one after the other in one window, in a new session each, and says of
each whether it passed. A script runs twice: as far as Session.play(), for what the user does, and as a whole, for what it
checks, where that finds what the window has said."""

import ctypes
import os
import runpy
import shutil
import sys
import traceback
from importlib import import_module

HERE, TOP = os.path.dirname(os.path.abspath(__file__)), os.environ["SCHLIEREN_TEST_OUTPUT"]
NAMES, sys.argv[1:] = sys.argv[1:], []
sys.path.insert(0, os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Python"))


class Recorded(Exception):
    """Ends a script where it plays what the user does."""


def run(name, play):
    """Runs a script, in a folder and with modules of its own, and with this in place of Session.play()."""
    for key, module in list(sys.modules.items()):
        if key != "__main__" and (getattr(module, "__file__", None) or "").startswith(HERE):
            del sys.modules[key]
    os.environ["SCHLIEREN_TEST_OUTPUT"] = os.path.join(TOP, name)
    import_module("window_testing").Session.play = play
    runpy.run_path(os.path.join(HERE, name + ".py"), run_name=name)


def recorded(name):
    """The session of a script, and the Python script before it."""
    def record(user, script, **_):
        found.extend((user, script))
        raise Recorded

    found = []
    shutil.rmtree(os.path.join(TOP, name), ignore_errors=True)
    os.makedirs(os.path.join(TOP, name))
    try:
        run(name, record)
    except Recorded:
        return tuple(found)
    raise AssertionError(f"{name} plays nothing")


sessions = [recorded(name) for name in NAMES]
window = import_module("window_testing")
failed = []
for name, (played, _), said in zip(NAMES, sessions, window.play_together(sessions, TOP, 1500)):
    print("==", name, flush=True)

    def check(_user, _script, expected=None, played=played, said=said):
        window.check_said(played, expected, said)

    try:
        import_module("paraview.simple").ResetSession()
        run(name, check)
    except Exception:  # pylint: disable=broad-except
        traceback.print_exc()
        failed.append(name)
for name in NAMES:
    print("Failed:" if name in failed else "Passed:", name, flush=True)
ctypes.CDLL(None).fflush(None)  # which the next line does not
os._exit(len(failed))  # Python's end closes the display before what is left of the sessions' views
