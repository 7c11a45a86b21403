// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCompareWithPhotograph
 * @brief   a photograph of an experiment beside a schlieren image
 *
 * The first input is an image of vtkSchlierenFilter, the second a photograph as any reader of images has it, the optional
 * third the same photograph without flow. The output is the image with more point arrays:
 * - `Photograph` (float): the photograph's luminance, 0 to 1, at the image's points; NaN beyond it;
 * - `Simulated` (float): the image as this camera would have recorded it, by contrast, offset and angle of the cutoff, gamma, black
 *   level, and what undisturbed light looks like;
 * - `Difference` (float): Photograph less Simulated, NaN where they are not compared;
 * - `FeatureShift` (3 floats, data units), with FindFeatureShift: how far features of the photograph lie from those of the image, across
 *   them; NaN where there are none;
 * - `Comparison` (3 unsigned chars, active scalars): see the property.
 *
 * Field data, all doubles of one value but for the first two: `PhotographReport` (texts: what has been found, in sentences);
 * `PhotographPlace` (x and y of the photograph's middle, data units); `PhotographScale` (data units per pixel); `PhotographRotation`
 * (degrees to the left); `PhotographContrast` (k / (1/2 - offset), per radian); `PhotographContrastUncertainty` (one
 * standard deviation); `PhotographK` and `PhotographKUncertainty` (per radian), `PhotographOffset`, of a knife edge only where all light
 * passes it at 1 % of the points, as they cannot be separated otherwise; `PhotographAngle` and `PhotographAngleUncertainty`
 * (degrees), not where light is deflected along one direction only, as any angle fits then;
 * `PhotographFringeSpacing` (data units, 0 of infinite fringes), `PhotographFringeAngle` (degrees), `PhotographFringePhase` (0 to 1, at
 * the image's middle, 0 where undisturbed light is bright) and `PhotographFringeContrast` (0 to 1, as recorded), of an interferogram in light of one
 * wavelength that shows fringes;
 * `PhotographFullFraction` (where all light passes the edge); `PhotographBlackLevel`; `PhotographResidual` (root mean square of
 * Difference); `PhotographCorrelation`; `FeatureShiftMedian` and `FeatureShift95` (its median, and what 95 % do not exceed). What the
 * technique does not have is left out. `LegendNotes` of the input gets the most important ones.
 *
 * The place is never fitted to the flow unless FitPlace is FIT_FLOW: a jet that is computed 2 % too long would be moved to where it
 * agrees. Knife edges are fitted by their contrast and offset, of which k follows: see Documentation/photograph.md.
 *
 * Each user error is one error that says what to do, with an empty output.
 *
 * @sa vtkSchlierenFilter
 */

#ifndef vtkCompareWithPhotograph_h
#define vtkCompareWithPhotograph_h

#include "PhotographSettings.h" // for the values of the properties
#include "vtkImageAlgorithm.h"
#include "vtkSchlierenFiltersModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class VTKSCHLIERENFILTERS_EXPORT vtkCompareWithPhotograph : public vtkImageAlgorithm,
                                                            private PhotographSettings
{
public:
  static vtkCompareWithPhotograph* New();
  vtkTypeMacro(vtkCompareWithPhotograph, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The input ports; WITHOUT_FLOW is optional.
  enum InputPorts
  {
    IMAGE = 0,
    PHOTOGRAPH = 1,
    WITHOUT_FLOW = 2
  };

  /// Returns what has been found, in sentences. Empty before the first update and after a failed one.
  const char* GetReport() const { return this->Report.c_str(); }

  ///@{
  /// As those of vtkSchlierenFilter; the first line is how far the photograph's feature there lies from the simulated one, and the
  /// light of both.
  void SetProbedPlace(double right, double up);
  const char* GetProbedPlace();
  ///@}

  // setters: rest
  /// Values of Comparison.
  enum Comparisons
  {
    SHOW_PHOTOGRAPH = 0,
    SHOW_SIMULATED = 1,
    SHOW_OVER = 2,
    SHOW_SWIPE = 3,
    SHOW_CHEQUERBOARD = 4,
    SHOW_RED_CYAN = 5,
    SHOW_DIFFERENCE = 6
  };

  /// What the array Comparison shows, in red, green and blue. Default: Swipe.
  vtkSetClampMacro(Comparison, int, SHOW_PHOTOGRAPH, SHOW_DIFFERENCE);
  vtkGetMacro(Comparison, int);

  /// Of Swipe: the fraction of the width, from the left, that shows the photograph. Default: 0.5.
  vtkSetClampMacro(SwipePosition, double, 0, 1);
  vtkGetMacro(SwipePosition, double);

  /// Values of Placement.
  enum Placements
  {
    PLACE_FILL_IMAGE = 0,
    PLACE_BY_HAND = 1,
    PLACE_ONE_POINT = 2,
    PLACE_TWO_POINTS = 3
  };

  /// Where the photograph lies. Default: Fill Image.
  vtkSetClampMacro(Placement, int, PLACE_FILL_IMAGE, PLACE_TWO_POINTS);
  vtkGetMacro(Placement, int);

  /// Of By Hand: where the photograph's middle lies in the image, data units. Default: 0 0.
  vtkSetVector2Macro(PhotographPosition, double);
  vtkGetVector2Macro(PhotographPosition, double);

  /// Of By Hand and One Point: how far the photograph is turned to the left, degrees. Default: 0.
  vtkSetMacro(PhotographRotation, double);
  vtkGetMacro(PhotographRotation, double);

  /// Of By Hand and One Point: the height of a pixel of the photograph, data units: a known length
  /// over the number of pixels that it has in the photograph. 0: the photograph is as high as the
  /// image. Default: 0.
  vtkSetMacro(PhotographScale, double);
  vtkGetMacro(PhotographScale, double);

  /// Of One Point and Two Points: a point of the photograph, pixels; the middle of the pixel at the
  /// lower left is 0 0. Default: 0 0.
  vtkSetVector2Macro(PhotographPoint1, double);
  vtkGetVector2Macro(PhotographPoint1, double);

  /// The same point in the image, data units. Default: 0 0.
  vtkSetVector2Macro(FlowPoint1, double);
  vtkGetVector2Macro(FlowPoint1, double);

  /// Of Two Points: another point of the photograph, pixels, as far away as can be. Default: 1 0.
  vtkSetVector2Macro(PhotographPoint2, double);
  vtkGetVector2Macro(PhotographPoint2, double);

  /// The same point in the image, data units. Default: 1 0.
  vtkSetVector2Macro(FlowPoint2, double);
  vtkGetVector2Macro(FlowPoint2, double);

  /// Width over height of the photograph's pixels; scanned prints and films differ from 1. Default:
  /// 1.
  vtkSetClampMacro(PixelAspect, double, 0.1, 10);
  vtkGetMacro(PixelAspect, double);

  /// Values of FitPlace.
  enum FitPlaces
  {
    FIT_OFF = 0,
    FIT_BODY = 1,
    FIT_FLOW = 2
  };

  /// Whether the place is improved. Default: Off.
  vtkSetClampMacro(FitPlace, int, FIT_OFF, FIT_FLOW);
  vtkGetMacro(FitPlace, int);

  /// The middle of the mirror or window in the photograph, pixels. Default: 0 0.
  vtkSetVector2Macro(MirrorCenter, double);
  vtkGetVector2Macro(MirrorCenter, double);

  /// Its radius, a little less than that of its edge, pixels; what is beyond is not compared. 0:
  /// all of the photograph is. Default: 0.
  vtkSetMacro(MirrorRadius, double);
  vtkGetMacro(MirrorRadius, double);

  /// The photograph's values are the light to the power 1 / Gamma: 1 of a scientific camera, 2.2 of
  /// a JPEG file. Default: 1.
  vtkSetClampMacro(Gamma, double, 0.2, 5);
  vtkGetMacro(Gamma, double);

  /// The photograph's value without light, where white is 1. Default: -1.
  vtkSetClampMacro(BlackLevel, double, -1, 0.9);
  vtkGetMacro(BlackLevel, double);

  /// Whether the cutoff is fitted: of a Knife Edge contrast, offset and angle, of a Graded Filter k
  /// and angle, of Bright Field and Dark Field k, of an Interferogram contrast, phase and tilt of
  /// the reference beam's fringes. Default: on.
  vtkSetMacro(FitCutoff, bool);
  vtkGetMacro(FitCutoff, bool);
  vtkBooleanMacro(FitCutoff, bool);

  /// Whether the array FeatureShift is made: how far features of the photograph lie from those of
  /// the image. Default: on.
  vtkSetMacro(FindFeatureShift, bool);
  vtkGetMacro(FindFeatureShift, bool);
  vtkBooleanMacro(FindFeatureShift, bool);

  // end

protected:
  vtkCompareWithPhotograph();
  ~vtkCompareWithPhotograph() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkCompareWithPhotograph(const vtkCompareWithPhotograph&) = delete;
  void operator=(const vtkCompareWithPhotograph&) = delete;

  std::string Report;
  double ProbedPlace[2] = { -1, -1 };
  std::string Probed;
  struct Last; // what has been found, and from what: another view of it needs no other fit
  std::unique_ptr<Last> Kept;
};

#endif
