// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PluginFile.h"

#include "pqServer.h"
#include "vtkPVPluginTracker.h"
#include "vtkSMTrace.h"

#include <QString>

#include <cstring>

namespace
{

/// Returns the file that the plugin was loaded from; empty: it is a part of the program.
QString pluginFile()
{
  vtkPVPluginTracker* plugins = vtkPVPluginTracker::GetInstance();
  for (unsigned int i = 0; i < plugins->GetNumberOfPlugins(); ++i)
  {
    const char* name = plugins->GetPluginName(i);
    if (name && std::strcmp(name, "Schlieren") == 0 && plugins->GetPluginLoaded(i))
    {
      return plugins->GetPluginFileName(i);
    }
  }
  return QString();
}

} // namespace

void traceLoading(pqServer* server)
{
  const QString file = pluginFile();
  if (vtkSMTrace::GetActiveTracer() && !file.isEmpty())
  {
    const QString text = server->isRemote()
      ? "# Load the plugin Schlieren on the server and here: LoadPlugin(FILE, remote=True, "
        "ns=globals())"
      : "LoadPlugin('" + QString(file).replace("'", "\\'") + "', remote=False, ns=globals())";
    SM_SCOPED_TRACE(TraceText)
      .arg(qUtf8Printable(text))
      .arg("comment", "load the plugin Schlieren");
  }
}
