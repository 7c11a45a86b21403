// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "UpstreamFailure.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkOutputWindow.h"

#include <algorithm>
#include <set>

namespace filters
{

namespace
{

/// Gets errors of all executives that are upstream of anything. They report that an algorithm has failed.
class Observer : public vtkCommand
{
public:
  static Observer* New() { return new Observer; }

  void Execute(vtkObject* caller, unsigned long, void* text) override
  {
    // As nobody else does it where there is an observer.
    vtkOutputWindow::GetInstance()->DisplayErrorText(static_cast<const char*>(text));
    for (UpstreamFailure* watcher : std::set(this->Watchers))
    {
      watcher->notice(caller);
    }
  }

  std::set<UpstreamFailure*> Watchers;
};

/// Never deleted: when the program exits, filters may be deleted after static objects.
Observer& observer()
{
  static Observer* const one = Observer::New();
  return *one;
}

void addUpstreamOf(vtkAlgorithm* filter, std::vector<vtkObject*>& executives)
{
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int n = 0; n < filter->GetNumberOfInputConnections(port); ++n)
    {
      vtkExecutive* executive = filter->GetInputExecutive(port, n);
      if (executive &&
        std::find(executives.begin(), executives.end(), executive) == executives.end())
      {
        executives.push_back(executive);
        addUpstreamOf(executive->GetAlgorithm(), executives);
      }
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
UpstreamFailure::~UpstreamFailure() { observer().Watchers.erase(this); }

//------------------------------------------------------------------------------
void UpstreamFailure::watch(vtkAlgorithm* filter)
{
  Observer& all = observer();
  all.Watchers.insert(this);
  this->Failed.clear();
  this->Watched.clear();
  addUpstreamOf(filter, this->Watched);
  for (vtkObject* executive : this->Watched)
  {
    if (!executive->HasObserver(vtkCommand::ErrorEvent, &all))
    {
      executive->AddObserver(vtkCommand::ErrorEvent, &all);
    }
  }
}

//------------------------------------------------------------------------------
void UpstreamFailure::notice(vtkObject* failed)
{
  if (this->Failed.empty() &&
    std::find(this->Watched.begin(), this->Watched.end(), failed) != this->Watched.end())
  {
    auto* executive = vtkExecutive::SafeDownCast(failed);
    this->Failed = executive ? executive->GetAlgorithm()->GetClassName() : failed->GetClassName();
  }
}

} // namespace filters
