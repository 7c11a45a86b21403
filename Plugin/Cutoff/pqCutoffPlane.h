// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPointF>
#include <QRectF>

#include <functional>

/// A cutoff on its plane, where a point is a deflection (along u, along v) in radians.
struct pqCutoff
{
  enum Kinds // as vtkSchlierenFilter::Cutoffs
  {
    NoCutoff = -1, ///< or one that has nothing to do with the deflection
    KnifeEdge = 0,
    Circular = 2,
    CircularComplement = 3,
    GradedFilter = 4,
    ColorFilter = 5,
    NumericalSchlieren = 8
  };

  int Kind = NoCutoff;
  bool HasEdge = false; ///< a straight one, else it is a circle or a square
  double K = 0;
  double Angle = 0;      ///< degrees
  double Offset = 0;     ///< of the edge, as a fraction of the source's image
  bool Inverted = false; ///< knife edge and graded filter
  bool IsOfDisc = false; ///< the source's image is a disc
  bool IsSquare = false; ///< a colour filter that is an image, not the wheel
  bool EdgeIsFastened =
    false; ///< it stays where it is while k changes: Offset is in proportion to k
  std::function<double(double)> Graded; ///< transmission, 0 to 1, over the filter's width, 0 to 1

  /// The direction whose deflection the edge measures.
  QPointF normal() const;

  /// 1/2 - offset + k e, of an edge: dark at 0 and below, full light at 1 and above.
  double placeOf(const QPointF& deflection) const;
  /// The deflection along the normal that has this place.
  double deflectionOf(double place) const;

  /// Of all kinds but the colour filter: the fraction of the light that passes.
  double transmission(const QPointF& deflection) const;
};

/// The cutoff plane as a square of pixels: what of a cutoff is where, and what it becomes by dragging.
class pqCutoffPlane
{
public:
  enum Handle
  {
    NoHandle,
    EdgeLine,   ///< where half of the light passes
    DarkLine,   ///< place 0
    BrightLine, ///< place 1
    TurnHandle,
    SizeHandle ///< the circle or square of full scale
  };

  /// Shows the deflections from -range to range both ways.
  pqCutoffPlane(const QRectF& square, double range);

  QPointF pixelAt(const QPointF& deflection) const;
  QPointF deflectionAt(const QPointF& pixel) const;
  double deflectionPerPixel() const;

  /// The handle that turns the edge.
  QPointF turnHandle(const pqCutoff& cutoff) const;
  double turnRadius() const;

  /// What of the cutoff can be dragged at this pixel.
  Handle handleAt(const pqCutoff& cutoff, const QPointF& pixel) const;

  /// The cutoff that was `start` when the mouse took a handle of it `from` a pixel `to` another. Rounded to
  /// what a pixel resolves. With `inSteps`, angles are multiples of 15 degrees.
  pqCutoff dragged(const pqCutoff& start, Handle handle, const QPointF& from, const QPointF& to,
    bool inSteps) const;

  /// The next larger or, with a negative step, smaller of 1, 2, 5, 10, 20 ...
  static double roundRange(double range, int step);

private:
  QPointF centre() const { return this->Square.center(); }

  QRectF Square;
  double Range;
};

/// With another sensitivity; the edge's offset goes along where it is fastened.
pqCutoff withSensitivity(pqCutoff cutoff, double k);

/// To so many significant digits.
double rounded(double value, int digits);
