// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Lets Python import schlieren_figure, which lies in the folder "python" beside the plugin, once that is loaded.
// PYTHON_MODULES of paraview_add_plugin would do so, too, but in ParaView 6.1 a plugin that has them loses its filters
// (vtkPVPythonAlgorithmPlugin::InitializeFromStringAndGetXMLs discards the definitions that are there).
#include "vtkPythonInterpreter.h"
#include "vtksys/SystemTools.hxx"

#include <dlfcn.h>

#include <string>

namespace
{

const bool isInPath = []
{
  static const int here = 0;
  Dl_info library{};
  if (dladdr(&here, &library) == 0 || !library.dli_fname)
  {
    return false;
  }
  // ParaView may have found the plugin by a link.
  const std::string file = vtksys::SystemTools::GetRealPath(library.dli_fname);
  const std::string folder = vtksys::SystemTools::GetFilenamePath(file) + "/python";
  vtkPythonInterpreter::PrependPythonPath(folder.c_str());
  return true;
}();

} // namespace
