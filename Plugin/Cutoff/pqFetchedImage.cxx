// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFetchedImage.h"

#include "pqApplicationCore.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqTimeKeeper.h"
#include "pqUndoStack.h"

#include "vtkAlgorithm.h"
#include "vtkImageData.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"

namespace
{

vtkSmartPointer<vtkSMSourceProxy> newFilter(const char* name, vtkSMProxy* input, unsigned int port)
{
  auto filter = vtkSmartPointer<vtkSMSourceProxy>::Take(
    vtkSMSourceProxy::SafeDownCast(input->GetSessionProxyManager()->NewProxy("filters", name)));
  if (filter)
  {
    vtkSMPropertyHelper(filter, "Input").Set(input, port);
  }
  return filter;
}

} // namespace

vtkSmartPointer<vtkImageData> fetchedImage(
  vtkSMProxy* filter, unsigned int port, const std::vector<std::string>& arrays)
{
  pqServer* server =
    pqApplicationCore::instance()->getServerManagerModel()->findServer(filter->GetSession());
  if (!server)
  {
    return nullptr;
  }
  SCOPED_UNDO_EXCLUDE();
  const double time = server->getTimeKeeper()->getTime();
  const auto only = newFilter("PassArrays", filter, port);
  const auto mover = only ? newFilter("ClientServerMoveData", only, 0) : nullptr;
  if (!mover)
  {
    return nullptr;
  }
  vtkSMPropertyHelper names(only, "PointDataArrays");
  for (unsigned int i = 0; i < arrays.size(); ++i)
  {
    names.Set(i, arrays[i].c_str());
  }
  only->UpdateVTKObjects();
  only->UpdatePipeline(time);
  vtkPVDataInformation* information = only->GetDataInformation(0);
  if (information->GetDataSetType() != VTK_IMAGE_DATA || information->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  vtkSMPropertyHelper(mover, "OutputDataType").Set(VTK_IMAGE_DATA);
  vtkSMPropertyHelper(mover, "WholeExtent").Set(information->GetExtent(), 6);
  mover->UpdateVTKObjects();
  mover->UpdatePipeline(time);
  auto* client = vtkAlgorithm::SafeDownCast(mover->GetClientSideObject());
  auto* output = client ? vtkImageData::SafeDownCast(client->GetOutputDataObject(0)) : nullptr;
  if (!output)
  {
    return nullptr;
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->ShallowCopy(output);
  return image;
}
