# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A server for the window."""

import os
import re
import shutil
import subprocess
import sys


def start_server():
    """A pvserver and its port, one that is free; skips the test where there is none."""
    pvserver = shutil.which("pvserver")
    if not pvserver:
        print("Skipped: there is no pvserver.")
        sys.exit(77)
    # Without what makes MPI believe that a process belongs to others.
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_", "PRTE_"))}
    for port in range(11200, 11300):
        server = subprocess.Popen([pvserver, f"--server-port={port}", "--force-offscreen-rendering"],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
        line = " "
        while line and not re.search("Accepting|rror|failed", line):
            line = server.stdout.readline()
        if "Accepting" in line:
            return server, port
        server.kill()
        server.wait()
    raise RuntimeError("No port is free.")


def connect(port):
    """The script that connects the window and loads the plugin on the server, for all scripts of the session."""
    return f"""
import os
from paraview import simple
simple.Connect("localhost", {port})
simple.LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=True, ns=vars(simple))
from paraview.simple import *
"""


def play(user, begin, is_remote):
    """Plays a session that begins with a script, of the window alone or connected to a server of its own."""
    server, port = start_server() if is_remote else (None, 0)
    try:
        user.play((connect(port) if is_remote else "") + begin)
    finally:
        if server:
            server.kill()
