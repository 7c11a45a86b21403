// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPointF>
#include <QRectF>

#include <functional>

/// A cutoff in its plane, whose points are deflections (u, v) in radians.
struct pqCutoff
{
  enum Kinds // as vtkSchlierenFilter::Cutoffs
  {
    NoCutoff = -1, ///< or one that does not depend on the deflection
    KnifeEdge = 0,
    BrightField = 2,
    DarkField = 3,
    GradedFilter = 4,
    ColorFilter = 5,
    NumericalSchlieren = 8
  };

  Kinds Kind = NoCutoff;
  bool HasEdge = false; ///< straight; else a circle or a square
  double K = 0;
  double Angle = 0;                     ///< degrees
  double Offset = 0;                    ///< of the edge, as a fraction of the source's image
  bool IsOfDisc = false;                ///< whether the source is a disc
  bool IsSquare = false;                ///< whether a colour filter is an image, not the wheel
  std::function<double(double)> Graded; ///< transmission, 0 to 1, across the filter's width, 0 to 1

  /// Returns the direction of the deflection that the edge measures.
  QPointF normal() const;

  /// Returns 1/2 - offset + k e of an edge: dark at 0 and below, full light at 1 and above.
  double placeOf(const QPointF& deflection) const;
  /// Inverts placeOf(): returns the deflection along the normal.
  double deflectionOf(double place) const;

  /// Returns the fraction of transmitted light, for all but colour filters.
  double transmission(const QPointF& deflection) const;
};

/// Maps the cutoff plane to a square of pixels, with handles to drag the cutoff by.
class pqCutoffPlane
{
public:
  enum Handle
  {
    NoHandle,
    EdgeLine,   ///< half transmission
    DarkLine,   ///< placeOf() = 0
    BrightLine, ///< placeOf() = 1
    TurnHandle,
    SizeHandle ///< circle or square of full scale
  };

  /// Shows deflections from -range to range along both axes.
  pqCutoffPlane(const QRectF& square, double range);

  QPointF pixelAt(const QPointF& deflection) const;
  QPointF deflectionAt(const QPointF& pixel) const;
  double deflectionPerPixel() const;

  /// Returns the position of the handle that turns the edge.
  QPointF turnHandle(const pqCutoff& cutoff) const;
  double turnRadius() const;

  Handle handleAt(const pqCutoff& cutoff, const QPointF& pixel) const;

  /// Returns the cutoff after dragging a handle of `start` from a pixel to another, rounded to the
  /// resolution of a pixel. `inSteps`: angles are multiples of 15 degrees.
  pqCutoff dragged(const pqCutoff& start, Handle handle, const QPointF& from, const QPointF& to,
    bool inSteps) const;

  /// Returns the next larger (smaller for a negative step) of 1, 2, 5, 10, 20 ...
  static double roundRange(double range, int step);

private:
  QPointF centre() const { return this->Square.center(); }

  QRectF Square;
  double Range;
};

/// Rounds to significant digits.
double rounded(double value, int digits);
