# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A server that has no plugin Schlieren: every action ends in one message, and nothing is left behind. The
plugin loaded there, the same click makes the image. Skipped without pvserver."""

from server_testing import start_server
from window_testing import MESH, ViewsSession

server, port = start_server()
user = ViewsSession()

# What is there before must be there afterwards, and no more: no undo step, nothing traced.
BEFORE = """
from paraview import smtrace
import inside_window
undo = widget().findChild(QAction, "actionEditUndo")
inside_window.undo_before = undo.text(), undo.isEnabled()
smtrace.start_trace()
"""
AFTER = """
from paraview import smtrace
import inside_window
undo = widget().findChild(QAction, "actionEditUndo")
assert inside_window.undo_before == (undo.text(), undo.isEnabled())
traced = smtrace.get_current_trace_output()
smtrace.stop_trace()
assert "CreateView" not in traced and "Schlieren" not in traced and "Split" not in traced, traced
"""

for button in ("OneImage", "ThreeImages"):
    user.python(BEFORE)
    user.press(button)
    user.check_message(f"The server localhost:{port} has not loaded the plugin Schlieren, so no image can be "
                       "made there. Choose Tools > Manage Plugins, and load Schlieren.so under Remote "
                       "Plugins.")
    user.python(AFTER)
user.python("""
assert len(views()) == 1
LoadPlugin(os.environ["SCHLIEREN_PLUGIN"], remote=True, ns=globals())
SetActiveSource(FindSource("mesh"))
""")
user.press("OneImage")
user.python("""
(_, (_, view)) = views()
drawn(FindSource("mesh"), view)
""")
try:
    user.play(f"""
from paraview.simple import *
Connect("localhost", {port})
""" + MESH)
finally:
    server.kill()
