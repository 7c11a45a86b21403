# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The example of five tinted fields: its image against a baseline, and kept in a state file."""

import os
import runpy

import numpy as np
from demo_testing import SOURCE, image_array
from paraview.simple import GetSources, LoadState, ResetSession, SaveState
from vtkmodules.util.numpy_support import vtk_to_numpy

names = runpy.run_path(os.path.join(SOURCE, "Examples", "fields.py"))
made = image_array("fields.png")
kept = image_array(os.path.join(SOURCE, "Testing", "Baseline", "DiskFields.png"))
assert made.shape == kept.shape == (200, 240, 3), (made.shape, kept.shape)
difference = np.abs(made - kept)
print(f"Differs by {difference.mean():.4f} levels on average, {difference.max()} at most")
# Another compiler may round a level up where this one rounds it down.
assert difference.mean() < 0.05 and difference.max() <= 8

# Mirrored about the axis, dark and bright change places but the colours do not.
tint = made / np.maximum(made.max(axis=2, keepdims=True), 1)
lit = (made.max(axis=2) > 60) & (made.max(axis=2) > 60)[:, ::-1]
assert np.ptp(tint[lit], axis=1).max() > 0.3, "The image is grey"
assert np.abs(tint - tint[:, ::-1])[lit].mean() < 0.03, "The colours are not symmetric"



def settings(schlieren):
    """All that is set, and the curves."""
    curves = [list(curve.Points) for curve in schlieren.TransferFunctions]
    return curves, {name: str(schlieren.GetPropertyValue(name)) for name in schlieren.ListProperties()
                    if name not in ("Input", "TransferFunctions", "GradedFilter")
                    and not schlieren.GetProperty(name).SMProperty.GetInformationOnly()}


def tints(schlieren):
    schlieren.UpdatePipeline()
    color = schlieren.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Color")
    return vtk_to_numpy(color).astype(int)


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
made = tints(schlieren)
assert np.ptp(made, axis=1).max() > 60, "The image is grey"
schlieren.TransferFunctions[4].Points = [0, 0, 0.5, 0, 1, 1, 0.5, 0]
assert np.abs(tints(schlieren) - made).max() > 10
