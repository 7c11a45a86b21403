// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MenuActions.h"

#include "ImagesInViews.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqFileDialog.h"
#include "pqLoadDataReaction.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqProxyWidgetDialog.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqUndoStack.h"
#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"
#include "vtkSchlierenFilter.h"

#include <QFileInfo>
#include <QMap>
#include <QScopeGuard>
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

/// Runs Python inside the window. Returns why it cannot; else empty.
QString runPython(const QByteArray& code)
{
  QObject* python = pqApplicationCore::instance()->manager("PYTHON_MANAGER");
  return python && QMetaObject::invokeMethod(python, "executeCode", Q_ARG(QByteArray, code))
    ? QString()
    : "This ParaView was built without Python, which this needs.";
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

/// Returns the reader of a photograph by the ending of its name; empty: ParaView asks.
QString readerOf(const QString& file)
{
  static const QMap<QString, QString> readers{ { "png", "PNGSeriesReader" },
    { "jpg", "JPEGSeriesReader" }, { "jpeg", "JPEGSeriesReader" }, { "tif", "TIFFSeriesReader" },
    { "tiff", "TIFFSeriesReader" } };
  return readers.value(QFileInfo(file).suffix().toLower());
}

/// Returns the source that is meant, of those that an image may have: the selected one, or one whose image the active view shows.
template <class Is>
pqPipelineSource* meant(const Is& is)
{
  pqPipelineSource* selected = pqActiveObjects::instance().activeSource();
  if (is(selected))
  {
    return selected;
  }
  pqView* view = pqActiveObjects::instance().activeView();
  for (pqPipelineSource* shown : view ? imagesInViews::imagesIn(view) : QList<pqPipelineSource*>())
  {
    if (is(shown))
    {
      return shown;
    }
  }
  return nullptr;
}

} // namespace

bool menuActions::hasImage()
{
  pqView* view = pqActiveObjects::instance().activeView();
  pqPipelineSource* source = pqActiveObjects::instance().activeSource();
  return imagesInViews::isSchlieren(source) || imagesInViews::isComparison(source) ||
    (view && !(imagesInViews::benchesIn(view).empty() && imagesInViews::imagesIn(view).empty()));
}

QString menuActions::saveFigure()
{
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
  return runPython(code + ")\n");
}

QString menuActions::compareWithPhotograph()
{
  pqPipelineSource* image = meant(imagesInViews::isSchlieren);
  if (!image || image->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return "There is no image to compare with a photograph. Choose Filters > Schlieren > "
           "Schlieren, and click Apply.";
  }
  pqServer* server = image->getServer();
  pqFileDialog dialog(server, pqCoreUtilities::mainWidget(), "Open Photograph", QString(),
    "Photographs (*.png *.jpg *.jpeg *.tif *.tiff);;All files (*)", false);
  dialog.setObjectName("OpenPhotograph");
  dialog.setFileMode(pqFileDialog::ExistingFile);
  if (dialog.exec() != QDialog::Accepted)
  {
    return QString();
  }
  BEGIN_UNDO_SET("Beside a Photograph");
  const QScopeGuard end([]() { END_UNDO_SET(); });
  pqPipelineSource* photograph = pqLoadDataReaction::loadData(
    dialog.getSelectedFiles(), "sources", readerOf(dialog.getSelectedFiles().front()), server);
  if (!photograph)
  {
    return "The photograph '" + dialog.getSelectedFiles().front() + "' could not be opened.";
  }
  photograph->setModifiedState(pqProxy::UNMODIFIED);
  photograph->getSourceProxy()->UpdatePipeline();
  if (photograph->getOutputPort(0)->getDataInformation()->GetDataSetType() != VTK_IMAGE_DATA)
  {
    return "'" + dialog.getSelectedFiles().front() + "' is no image.";
  }
  pqPipelineSource* comparison = pqApplicationCore::instance()->getObjectBuilder()->createFilter(
    "filters", "CompareWithPhotograph",
    { { "Input", { image->getOutputPort(0) } },
      { "Photograph", { photograph->getOutputPort(0) } } },
    server);
  comparison->getSourceProxy()->UpdatePipeline();
  comparison->setModifiedState(pqProxy::UNMODIFIED); // which shows it
  pqActiveObjects::instance().setActiveSource(comparison);
  return QString();
}

double menuActions::kOfPhotograph()
{
  pqPipelineSource* comparison = meant(imagesInViews::isComparison);
  vtkPVArrayInformation* k = comparison
    ? comparison->getOutputPort(0)->getDataInformation()->GetArrayInformation(
        "PhotographK", vtkDataObject::FIELD)
    : nullptr;
  return k ? k->GetComponentRange(0)[0] : 0;
}

void menuActions::copyK()
{
  const double k = kOfPhotograph();
  auto* comparison = qobject_cast<pqPipelineFilter*>(meant(imagesInViews::isComparison));
  pqPipelineSource* image = comparison
    ? imagesInViews::filterOf(comparison->getInputs("Input").front()->getSource())
    : nullptr;
  if (k > 0 && image)
  {
    BEGIN_UNDO_SET("Copy k of Photograph");
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", image->getProxy());
    vtkSMPropertyHelper(image->getProxy(), "KMode").Set(vtkSchlierenFilter::K_VALUE);
    vtkSMPropertyHelper(image->getProxy(), "KScale").Set(k);
    image->getProxy()->UpdateVTKObjects();
    END_UNDO_SET();
    image->renderAllViews();
  }
}

QString menuActions::openExample(const QString& name)
{
  pqServer* server = pqActiveObjects::instance().activeServer();
  if (!server || server->isRemote())
  {
    return "The examples are files of this computer, which the server does not read. Disconnect "
           "from the server first.";
  }
  const QString problem = runPython(
    "import schlieren_examples\nschlieren_examples.open_in_window(" + quoted(name) + ")\n");
  return !problem.isEmpty() ||
      imagesInViews::isSchlieren(pqActiveObjects::instance().activeSource())
    ? problem
    : "The example could not be opened: see the messages.";
}
