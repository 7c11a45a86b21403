# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The example of five fields: its image, and kept in a state file."""

import os
import runpy

import numpy as np
from demo_testing import SOURCE
from paraview.simple import GetSources, LoadState, ResetSession, SaveState
from vtkmodules.util.numpy_support import vtk_to_numpy

names = runpy.run_path(os.path.join(SOURCE, "Examples", "fields.py"))
assert os.path.getsize("fields.png") > 10000


def light(schlieren, array="Intensity"):
    schlieren.UpdatePipeline()
    made = schlieren.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray(array)
    return vtk_to_numpy(made).reshape(schlieren.ImageSize[1], schlieren.ImageSize[0])


# The shaft, 7.62 x 5 of 14.4 x 12, is black. The reactor is round: mirrored about its axis, dark and bright change places.
made, blocked = light(names["schlieren"]), light(names["schlieren"], "BlockedFraction")
around = np.maximum(blocked, blocked[:, ::-1]) == 0
free = made[around]
assert abs(blocked.mean() - 7.62 * 5 / (14.4 * 12)) < 0.01 and made[blocked == 1].max() == 0, blocked.mean()
assert free.min() < 0.1 and free.max() > 0.9, (free.min(), free.max())
antisymmetric = np.abs(made + made[:, ::-1] - 1)[around].mean()
assert antisymmetric < 0.02, antisymmetric


def settings(schlieren):
    """All that is set, and the curves."""
    curves = [list(curve.Points) for curve in schlieren.TransferFunctions]
    return curves, {name: str(schlieren.GetPropertyValue(name)) for name in schlieren.ListProperties()
                    if name not in ("Input", "Bodies", "TransferFunctions", "GradedFilter")
                    and not schlieren.GetProperty(name).SMProperty.GetInformationOnly()}


names["schlieren"].ImageSize = [60, 50]  # enough for what follows
kept = settings(names["schlieren"])
SaveState("fields.pvsm")
del names
ResetSession()
LoadState(os.path.abspath("fields.pvsm"))
schlieren = [proxy for proxy in GetSources().values() if proxy.GetXMLName() == "Schlieren"][0]
assert settings(schlieren) == kept
assert list(schlieren.Fields) == ["Temp", "AsH3", "CH4", "GaMe3", "H2"]
assert kept[0][1] == [0, 0, 0.5, 0, 1, 0.2, 0.5, 0], kept[0]

# Moving a node changes the image.
made = light(schlieren)
schlieren.TransferFunctions[4].Points = [0, 0, 0.5, 0, 1, 1, 0.5, 0]
assert np.abs(light(schlieren) - made).max() > 0.1
