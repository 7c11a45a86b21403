// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MenuActions.h"

#include "ImagesInViews.h"
#include "PluginFile.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqFileDialog.h"
#include "pqLoadDataReaction.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqProxyWidgetDialog.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <QFileInfo>
#include <QStringList>

namespace
{

/// Returns a text as Python writes it.
QByteArray quoted(const QString& text)
{
  QString escaped = text;
  escaped.replace('\\', "\\\\").replace('\'', "\\'").replace('\n', "\\n");
  return ("'" + escaped + "'").toUtf8();
}

/// Requests the arguments of a figure, and appends them as Python writes them. Returns false if cancelled.
bool appendOptions(pqView* view, QByteArray& code)
{
  vtkSmartPointer<vtkSMProxy> options;
  options.TakeReference(
    view->proxyManager()->NewProxy("misc", "SchlierenFigure")); // of the view's session
  vtkSMPropertyHelper size(options, "Size");
  const bool isDrawn = !imagesInViews::benchesIn(view).empty();
  size.Set(vtkSMPropertyHelper(view->getProxy(), "ViewSize").GetIntArray().data(), 2);
  QStringList rows{ "Title", "Resolution", "Crop" };
  if (isDrawn) // the image of a filter has its own size
  {
    rows.insert(1, "Size");
  }
  pqProxyWidgetDialog dialog(options, rows, pqCoreUtilities::mainWidget());
  dialog.setObjectName("SchlierenFigureOptions");
  dialog.setWindowTitle("Save Schlieren Figure");
  if (dialog.exec() != QDialog::Accepted)
  {
    return false;
  }
  const int dpi = vtkSMPropertyHelper(options, "Resolution").GetAsInt();
  code += ", title=" + quoted(vtkSMPropertyHelper(options, "Title").GetAsString());
  code += ", dpi=" + (dpi > 0 ? QByteArray::number(dpi) : QByteArray("None"));
  code += vtkSMPropertyHelper(options, "Crop").GetAsInt() ? ", crop=True" : "";
  if (isDrawn)
  {
    code += ", size=[" + QByteArray::number(size.GetAsInt(0)) + ", " +
      QByteArray::number(size.GetAsInt(1)) + "]";
  }
  return true;
}

} // namespace

bool menuActions::hasImage()
{
  pqView* view = pqActiveObjects::instance().activeView();
  return imagesInViews::isSchlieren(pqActiveObjects::instance().activeSource()) ||
    (view && !(imagesInViews::benchesIn(view).empty() && imagesInViews::imagesIn(view).empty()));
}

QString menuActions::saveFigure()
{
  QObject* python = pqApplicationCore::instance()->manager("PYTHON_MANAGER");
  if (!python)
  {
    return "This ParaView was built without Python, which draws figures.";
  }
  pqFileDialog dialog(nullptr, pqCoreUtilities::mainWidget(), "Save Schlieren Figure", QString(),
    "PNG, pixel by pixel (*.png);;PDF (*.pdf);;SVG (*.svg)", false);
  dialog.setObjectName("SaveSchlierenFigure");
  dialog.setFileMode(pqFileDialog::AnyFile);
  if (dialog.exec() != QDialog::Accepted)
  {
    return QString();
  }
  QByteArray code = "import schlieren_figure\nschlieren_figure.save_in_window(" +
    quoted(dialog.getSelectedFiles().front());
  if (!appendOptions(pqActiveObjects::instance().activeView(), code))
  {
    return QString();
  }
  code += ")\n";
  return QMetaObject::invokeMethod(python, "executeCode", Q_ARG(QByteArray, code))
    ? QString()
    : "This ParaView does not run Python, which draws figures.";
}

QString menuActions::openExample()
{
  pqServer* server = pqActiveObjects::instance().activeServer();
  if (!server || server->isRemote())
  {
    return "The example is a file of this computer, which the server does not read. Disconnect "
           "from the server first.";
  }
  const QString file = QFileInfo(pluginFile()).canonicalPath() + "/ladenburg_jet_3d.vti";
  if (!QFileInfo::exists(file))
  {
    return "The example '" + file + "' is not there. It is installed with the plugin.";
  }
  pqPipelineSource* jet =
    pqLoadDataReaction::loadData(QStringList(file), "sources", "XMLImageDataReader", server);
  if (!jet)
  {
    return "The example '" + file + "' could not be opened.";
  }
  jet->getSourceProxy()->UpdatePipeline();
  jet->setModifiedState(pqProxy::UNMODIFIED);
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  if (pqRenderView* view = imagesInViews::scene(jet->getOutputPort(0)))
  {
    pqActiveObjects::instance().setActiveView(view);
    controller->Show(jet->getSourceProxy(), 0, view->getViewProxy());
    view->resetCamera();
    view->render();
  }
  pqActiveObjects::instance().setActiveSource(jet);
  return QString();
}
