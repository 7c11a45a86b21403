// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "UndoStep.h"

#include "pqUndoStack.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSession.h"
#include "vtkSMUndoElement.h"

#include <string>
#include <utility>
#include <vector>

namespace
{

class UndoStep : public vtkSMUndoElement
{
public:
  static UndoStep* New();
  vtkTypeMacro(UndoStep, vtkSMUndoElement);

  int Undo() override
  {
    this->OnUndo();
    return 1;
  }

  int Redo() override
  {
    this->OnRedo();
    return 1;
  }

  std::function<void()> OnUndo;
  std::function<void()> OnRedo;

protected:
  UndoStep() = default;
  ~UndoStep() override = default;
};

vtkStandardNewMacro(UndoStep);

} // namespace

//------------------------------------------------------------------------------
void addUndoStep(std::function<void()> undo, std::function<void()> redo)
{
  vtkNew<UndoStep> step;
  step->OnUndo = std::move(undo);
  step->OnRedo = std::move(redo);
  ADD_UNDO_ELEM(step);
}

//------------------------------------------------------------------------------
ProxyById::ProxyById(vtkSMProxy* proxy)
  : Session(proxy->GetSession())
  , Id(proxy->GetGlobalID())
{
}

//------------------------------------------------------------------------------
vtkSMProxy* ProxyById::get() const
{
  return this->Session ? vtkSMProxy::SafeDownCast(this->Session->GetRemoteObject(this->Id))
                       : nullptr;
}

//------------------------------------------------------------------------------
std::function<void()> cameraSetter(vtkSMRenderViewProxy* from, vtkSMProxy* to)
{
  static const char* const names[] = { "CameraPosition", "CameraFocalPoint", "CameraViewUp",
    "CameraViewAngle", "CameraParallelScale", "CenterOfRotation" };
  from->SynchronizeCameraProperties();
  std::vector<std::pair<std::string, std::vector<double>>> camera;
  for (const char* name : names)
  {
    camera.emplace_back(name, vtkSMPropertyHelper(from, name).GetDoubleArray());
  }
  const int isParallel = vtkSMPropertyHelper(from, "CameraParallelProjection").GetAsInt();
  return [camera, isParallel, id = ProxyById(to)]()
  {
    if (vtkSMProxy* proxy = id.get())
    {
      vtkSMPropertyHelper(proxy, "CameraParallelProjection").Set(isParallel);
      for (const auto& [name, values] : camera)
      {
        vtkSMPropertyHelper(proxy, name.c_str())
          .Set(values.data(), static_cast<unsigned int>(values.size()));
      }
      proxy->UpdateVTKObjects();
    }
  };
}
