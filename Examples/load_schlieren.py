# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin for the scripts beside this one: that of SCHLIEREN_PLUGIN, else that of the build, else that of the package
paraview-schlieren. A script of your own needs one line of load_schlieren."""

import os

from paraview import simple

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def plugin_file():
    """The plugin's file; empty: the package's is meant."""
    built = os.path.join(ROOT, "build", "release", "plugin-file.txt")
    if not os.environ.get("SCHLIEREN_PLUGIN") and os.path.exists(built):
        with open(built) as file:
            return file.read().strip()
    return os.environ.get("SCHLIEREN_PLUGIN", "")


def load_schlieren(names):
    """Loads it and adds what it brings, such as Schlieren(), to a script's globals()."""
    if plugin_file():
        simple.LoadPlugin(plugin_file(), remote=False, ns=names)
    else:
        simple.LoadDistributedPlugin("Schlieren", remote=False, ns=names)
