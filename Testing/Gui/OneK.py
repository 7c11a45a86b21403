# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One k for all views of a flow: that which the first of them shows first. Other views, of other sizes, have it from their
beginning, also where the first one is turned before its image is complete; so has a state that is saved meanwhile. The
legend says that it is kept, and that a given one is fixed. So is the distance of shadowgraphs' screens one."""

import os
import re

from views_testing import FOLDER, OPEN_JET, ViewsSession

HELPERS = """
import inside_window
def edges():
    return [display.SchlierenBench for display in displays() if display.SchlierenBench.Cutoff == "Knife Edge"]
def check_k(count):
    benches = edges()
    assert len(benches) == count
    k = [(bench.LockedK, information(bench, "KScaleUsed")) for bench in benches]
    assert set(sum(k, ())) == {inside_window.k}, (k, inside_window.k)
def notes(bench):
    array = bench.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetAbstractArray("LegendNotes")
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]
"""
user = ViewsSession()
user.press("OneImage")
user.python(HELPERS + f"""
(bench,) = edges()
assert not finished(bench), "It is complete already"
inside_window.k = bench.LockedK
assert inside_window.k > 0
check_k(1)
save_state({os.path.join(FOLDER, "begun.pvsm")!r})
(view,) = by_name("Schlieren View")
view.GetActiveCamera().Azimuth(20)
Render(view)
check_k(1)
""")
user.press("OneImage")  # as a double click does
user.python(HELPERS + "check_k(2)\nsettle_soon()\ncheck_k(2)\nSetActiveView(FindView('RenderView1'))")
user.press("ThreeImages")
user.python(HELPERS + """
check_k(3)
settle_soon()
check_k(3)
for bench in edges():
    assert f"k = {inside_window.k:.4g} (kept)" in notes(bench), notes(bench)
bench.KMode = "Value"
RenderAllViews()
settle_views()
assert f"k = {bench.KScale:.4g} (fixed)" in notes(bench), notes(bench)
SetActiveView(by_name("Shadowgraph")[0])
""")
user.press("OneImage")  # as the active view's
user.python(HELPERS + """
settle_soon()
shadows = [display.SchlierenBench for display in displays() if display.SchlierenBench.Cutoff == "Shadowgraph"]
assert len(shadows) == 2 and all("(kept)" in notes(bench)[0] for bench in shadows), [notes(bench) for bench in shadows]
assert len({information(bench, "AutomaticUsed") for bench in shadows} | {bench.LockedK for bench in shadows}) == 1
""")
user.play(OPEN_JET)

with open(os.path.join(FOLDER, "begun.pvsm"), encoding="utf-8") as file:
    kept = re.findall(r'<Property name="LockedK".*?</Property>', file.read(), re.DOTALL)
values = [float(value) for text in kept for value in re.findall(r'<Element index="0" value="(.*?)"', text)]
assert max(values) > 0, kept
