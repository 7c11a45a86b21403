// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class vtkSMProxy;

/// Brings the pictures of Schlieren filters up to date in the window, in pieces so short that it always
/// answers.
class pqPictureRefiner : public QObject
{
  Q_OBJECT

public:
  /// The one of this program; made when first asked for.
  static pqPictureRefiner* instance();

  enum class Pace
  {
    Hurried, ///< while the mouse is down: a rough picture, and more of them follow
    Shading, ///< while the mouse is down and only optics change: rays are held, and the picture is whole
    Thorough ///< a first picture soon, then better ones up to the set quality
  };

  /// Shows the picture of a filter whose properties have changed and been pushed (UpdateVTKObjects), in all
  /// views that show it. What has been begun for this filter before is given up.
  void refine(vtkSMProxy* filter, Pace pace);

Q_SIGNALS:
  /// Views now show another picture of the filter.
  void pictureChanged(vtkSMProxy* filter);

private:
  explicit pqPictureRefiner(QObject* parent);
};
