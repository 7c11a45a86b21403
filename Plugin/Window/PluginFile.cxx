// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PluginFile.h"

#include "pqServer.h"
#include "vtkPVPluginTracker.h"
#include "vtkSMTrace.h"

#include <cstring>

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
