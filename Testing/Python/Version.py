# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The version of CMakeLists.txt, given as the argument, is that of images, of the plugin manager and of the texts."""

import os
import re
import sys

from paraview.simple import servermanager
from plugin_testing import Schlieren, gaussian_column, output

version = sys.argv[1]
assert re.fullmatch(r"\d+\.\d+\.\d+", version), version

image = output(Schlieren(gaussian_column(16), ImageSize=[8, 8]))
found = image.GetFieldData().GetAbstractArray("SchlierenVersion").GetValue(0)
assert found == version, found

plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
numbers = {plugins.GetPluginName(i): plugins.GetPluginVersion(i) for i in range(plugins.GetNumberOfPlugins())}
# ParaView 6.1 knows the versions of plugins that its lists name, and no others.
listed = "" if servermanager.vtkSMProxyManager.GetVersionMajor() >= 6 else version
assert numbers["Schlieren"] in (version, listed), numbers


def first(name, pattern):
    """What the pattern's group is in a file of the top folder, where it matches first."""
    with open(os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], name), encoding="utf-8") as file:
        return re.search(pattern, file.read(), re.MULTILINE).group(1)


assert first("CITATION.cff", r"^version: (.*)$") == version
assert first("CHANGELOG.md", r"^## \[(.*)\]") == version
