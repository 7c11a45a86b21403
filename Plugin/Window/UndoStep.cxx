// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "UndoStep.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSMCameraLink.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSession.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"
#include "vtkSMUndoElement.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSmartPointer.h"

#include <QScopedValueRollback>
#include <QSignalBlocker>

#include <map>
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

/// A link that renders other views only where they have not been drawn with the camera yet: ParaView's renders them whenever
/// one is, also where a colour has changed.
class CameraLink : public vtkSMCameraLink
{
public:
  static CameraLink* New();
  vtkTypeMacro(CameraLink, vtkSMCameraLink);

  void UpdateViews(vtkSMProxy* caller, bool isInteractive) override
  {
    const std::vector<double> seen = seenBy(caller, isInteractive);
    if (this->IsRendered)
    {
      this->Drawn[caller] = seen;
    }
    for (unsigned int i = 0; i < this->GetNumberOfLinkedObjects(); ++i)
    {
      vtkSMProxy* other = this->GetLinkedProxy(static_cast<int>(i));
      if (other != caller && this->Drawn[other] != seen)
      {
        this->Superclass::UpdateViews(caller, isInteractive);
        return;
      }
    }
  }

protected:
  CameraLink() = default;
  ~CameraLink() override = default;

  void PropertyModified(vtkSMProxy* proxy, const char* name) override
  {
    const QScopedValueRollback<bool> notRendered(this->IsRendered, false);
    this->Superclass::PropertyModified(proxy, name);
  }

private:
  /// Returns the camera of a view and how it is drawn.
  static std::vector<double> seenBy(vtkSMProxy* view, bool isInteractive)
  {
    vtkCamera* camera = vtkSMRenderViewProxy::SafeDownCast(view)->GetActiveCamera();
    std::vector<double> seen{ isInteractive ? 1. : 0., camera->GetViewAngle(),
      camera->GetParallelScale(), static_cast<double>(camera->GetParallelProjection()),
      camera->GetFocalDisk(), camera->GetFocalDistance() };
    for (const double* place :
      { camera->GetPosition(), camera->GetFocalPoint(), camera->GetViewUp() })
    {
      seen.insert(seen.end(), place, place + 3);
    }
    for (const char* name : { "CenterOfRotation", "RotationFactor", "InteractionMode" })
    {
      const std::vector<double> values = vtkSMPropertyHelper(view, name).GetDoubleArray();
      seen.insert(seen.end(), values.begin(), values.end());
    }
    return seen;
  }

  std::map<vtkSMProxy*, std::vector<double>> Drawn; // at the last rendering of each view
  bool IsRendered = true;                           // what UpdateViews() is called for
};

vtkStandardNewMacro(CameraLink);

void link(vtkSMCameraLink* cameras, const std::string& name, vtkSMProxy* first, vtkSMProxy* second)
{
  for (const int direction : { vtkSMLink::INPUT, vtkSMLink::OUTPUT })
  {
    cameras->AddLinkedProxy(first, direction);
    cameras->AddLinkedProxy(second, direction);
  }
  SCOPED_UNDO_EXCLUDE();
  first->GetSessionProxyManager()->RegisterLink(name.c_str(), cameras);
}

/// Hides the undo stack, which ParaView clears when a link is removed, here during an undo.
void unlink(vtkSMCameraLink* cameras, const std::string& name, vtkSMProxy* view)
{
  pqApplicationCore* core = pqApplicationCore::instance();
  const QSignalBlocker unnoticed(core);
  pqUndoStack* stack = core->getUndoStack();
  core->setUndoStack(nullptr);
  view->GetSessionProxyManager()->UnRegisterLink(name.c_str());
  core->setUndoStack(stack);
  cameras->RemoveAllLinks(); // else it would keep its views
}

} // namespace

void addUndoStep(std::function<void()> undo, std::function<void()> redo)
{
  vtkNew<UndoStep> step;
  step->OnUndo = std::move(undo);
  step->OnRedo = std::move(redo);
  ADD_UNDO_ELEM(step);
}

void keepActiveView()
{
  pqView* active = pqActiveObjects::instance().activeView();
  if (!active)
  {
    return;
  }
  const auto activate = [id = ProxyById(active->getProxy())]()
  {
    pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
    vtkSMProxy* proxy = id.get();
    if (auto* view = proxy ? model->findItem<pqView*>(proxy) : nullptr)
    {
      SCOPED_UNDO_EXCLUDE();
      pqActiveObjects::instance().setActiveView(view);
    }
  };
  addUndoStep(activate, []() {});
}

void noteLayout(vtkSMViewLayoutProxy* layout, int cell)
{
  SCOPED_UNDO_EXCLUDE();
  // Any change makes ParaView note what the layout is like.
  if (layout->GetMaximizedCell() < 0 && layout->MaximizeCell(cell))
  {
    layout->RestoreMaximizedState();
  }
}

ProxyById::ProxyById(vtkSMProxy* proxy)
  : Session(proxy->GetSession())
  , Id(proxy->GetGlobalID())
{
}

vtkSMProxy* ProxyById::get() const
{
  return this->Session ? vtkSMProxy::SafeDownCast(this->Session->GetRemoteObject(this->Id))
                       : nullptr;
}

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
  // Keeps the 2-D mode, in which ParaView shows planes from far away in parallel projection.
  const int mode = vtkSMPropertyHelper(from, "InteractionMode").GetAsInt();
  const int isParallel = vtkSMPropertyHelper(from, "CameraParallelProjection").GetAsInt();
  return [camera, mode, isParallel, id = ProxyById(to)]()
  {
    if (vtkSMProxy* proxy = id.get())
    {
      vtkSMPropertyHelper(proxy, "InteractionMode").Set(mode);
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

void linkCameras(pqRenderView* firstView, pqRenderView* secondView)
{
  vtkSMProxy* first = firstView->getProxy();
  vtkSMProxy* second = secondView->getProxy();
  vtkSMSessionProxyManager* manager = first->GetSessionProxyManager();
  std::string name;
  int number = 1;
  do
  {
    name = "SchlierenViews" + std::to_string(number++);
  } while (manager->GetRegisteredLink(name.c_str()));

  SM_SCOPED_TRACE(CallFunction)
    .arg("AddCameraLink")
    .arg(first)
    .arg(second)
    .arg(name.c_str())
    .arg("comment", "link cameras in two views");
  vtkNew<CameraLink> cameras;
  link(cameras, name, first, second);

  // Keeps the link, because later steps of the undo stack refer to it by its number.
  const vtkSmartPointer<vtkSMCameraLink> kept = cameras.GetPointer();
  const ProxyById one(first);
  const ProxyById other(second);
  addUndoStep(
    [kept, name, one]()
    {
      if (one.get())
      {
        unlink(kept, name, one.get());
      }
    },
    [kept, name, one, other]()
    {
      if (one.get() && other.get())
      {
        link(kept, name, one.get(), other.get());
      }
    });
}
