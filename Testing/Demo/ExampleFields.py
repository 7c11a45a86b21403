# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The example of five tinted fields: its image against a baseline, and kept in a state file."""

import os
import runpy

import numpy as np
from demo_testing import SOURCE, image_array
from paraview.simple import GetSources, LoadState, ResetSession, SaveState
from vtkmodules.util.numpy_support import vtk_to_numpy

runpy.run_path(os.path.join(SOURCE, "Examples", "fields.py"))
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

SaveState("fields.pvsm")
ResetSession()
LoadState(os.path.abspath("fields.pvsm"))
schlieren = [proxy for proxy in GetSources().values() if proxy.GetXMLName() == "Schlieren"][0]
assert list(schlieren.Fields) == ["Temp", "AsH3", "CH4", "GaMe3", "H2"]
assert list(schlieren.TransferFunctions[1].Points) == [0, 0, 0.5, 0, 1, 0.2, 0.5, 0]
schlieren.UpdatePipeline()
color = schlieren.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Color")
again = vtk_to_numpy(color).reshape(200, 240, 3)[::-1]
# Resampling rounds points between cells differently with the threads' order.
assert np.abs(again - made).max() <= 2, "The state file makes another image"

# Moving a node changes the image; the colours alone need no re-tracing.
schlieren.TransferFunctions[4].Points = [0, 0, 0.5, 0, 1, 1, 0.5, 0]
schlieren.UpdatePipeline()
color = schlieren.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Color")
assert np.abs(vtk_to_numpy(color).reshape(200, 240, 3)[::-1] - made).max() > 10
