# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The jet of Ladenburg's experiment with every fourth point along each axis, in a file; made once for a program's tests."""

import os

from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter
from vtkmodules.vtkImagingCore import vtkExtractVOI

PATH = os.path.join(os.environ["SCHLIEREN_TEST_OUTPUT"], "coarse_jet.vti")

_reader, _coarse, _writer = vtkXMLImageDataReader(), vtkExtractVOI(), vtkXMLImageDataWriter()
_reader.SetFileName(os.path.join(os.environ["SCHLIEREN_SOURCE_DIR"], "Testing", "Data", "ladenburg_jet_3d.vti"))
_reader.Update()
_coarse.SetInputData(_reader.GetOutput())
_coarse.SetVOI(_reader.GetOutput().GetExtent())
_coarse.SetSampleRate(4, 4, 4)
_writer.SetInputConnection(_coarse.GetOutputPort())
_writer.SetFileName(PATH)
_writer.Write()
