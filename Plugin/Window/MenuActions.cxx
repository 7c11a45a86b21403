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
#include "pqRenderView.h"
#include "pqServer.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
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

} // namespace

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
  const QByteArray code = "import schlieren_figure\nschlieren_figure.save_in_window(" +
    quoted(dialog.getSelectedFiles().front()) + ")\n";
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
