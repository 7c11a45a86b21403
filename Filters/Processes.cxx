// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Processes.h"

#include "vtkMultiProcessController.h"

ProcessRole roleOfProcess()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return ProcessRole::Alone;
  }
  return controller->GetLocalProcessId() == 0 ? ProcessRole::First : ProcessRole::Other;
}

std::string warningOfFirstProcess(const std::string& product)
{
  return "The first of several processes makes the " + product +
    ", from all that it is given when it asks for the whole data. Data that a filter has "
    "distributed are not gathered: if a part is missing, use one process.";
}
