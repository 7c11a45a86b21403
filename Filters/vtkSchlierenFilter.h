// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenFilter
 * @brief   the image that a schlieren, shadowgraph or interferometry bench takes of a flow
 *
 * Bends light through the refractive index of a flow and produces a 2-D vtkImageData, in the plane
 * z = 0, whose coordinates are those of the view: x = position . u, y = position . v in data units,
 * where u points right and v up. So the image of the default view lies over the data.
 *
 * Point arrays of the image (their vtkDataArray::UNITS_LABEL is the unit). Deflection, OpticalPathDifference and
 * Displacement are those of the ray through the pixel's centre, from the middle of the light source; where that ends in a
 * solid, the mean of the pixel's rays that do not. Vectors have a third component, 0:
 * - `Intensity` (float, active scalars): see Cutoff; the luminance of a coloured image;
 * - `Color` (3 unsigned chars, active scalars then), where the image has colours: in sRGB behind a
 *   COLOR_FILTER, in WhiteLight and of a background's PICTURE; else, with ColorByField, the intensity, tinted, as linear bytes:
 *   255 is 1, of a shadowgraph 2;
 * - `Deflection` (3 floats): direction cosines along u and v of the light that leaves; light bends
 *   towards higher index;
 * - `OpticalPathDifference` (double): metres, against undisturbed light;
 * - `Displacement` (3 floats): sideways, at the plane where light leaves the data, data units;
 * - `BlockedFraction` (float): fraction of the pixel's rays that a solid stopped;
 * - `Background` (float) and `BackgroundDisplacement` (3 floats, data units), with BACKGROUND_ORIENTED
 *   only: the same without the flow, and the place of the pattern that is seen, less that without the flow
 *   (what is seen has moved in the opposite direction).
 *
 * Field data: `Device`, `PathModel`, `KScale` (the k used), `UndisturbedLevel` (intensity of light that
 * nothing bends), `SaturatedShare` (of the rays: those as dark or bright as the cutoff can make them),
 * `LightEmitted`, `LightOnFilm` and `LightOutside` (behind the cutoff, in full light of all pixels; the
 * first is the sum of the others), `FringeSpacing` (of finite fringes, data units),
 * `ExposureInterval` (of an image with ExposureTime: begin and end, in the data's time), `AmbientRefractivity` and
 * `ExitRefractivity` (the values used), `RaysTraced`, `RaysLost` (trapped in the medium, turned back by it, or totally
 * reflected where they would leave), `StepsTaken` (of all rays), `TraceSeconds` (0 where nothing had to be traced), and what is known
 * of the accuracy: `DisplacementBound` (no ray is shifted further, data units), `SkippingBound` (skipping
 * changes no direction cosine by more), each left out where it says nothing, and `MomentumDrift` (largest relative error of |p| = n where
 * refracted rays leave; 0 for straight ones). `PathModel` is the one used: `Straight`,
 * `Refracted` or `Difference`.
 *
 * The second output is the histogram of the light on the cutoff plane: an image with a point at the
 * centre of each bin, whose coordinates are the deflections along u and v, with the array `Rays`
 * (64-bit integers). Empty where HistogramSize is 0.
 *
 * The inputs and the properties that describe the medium are those of vtkRefractiveIndex; an image
 * that already holds `Refractivity` is used as it stands (see there). What has been computed is kept
 * until something that it depends on changes: another cutoff, k or knife angle needs no re-tracing,
 * another view traces again but keeps the medium.
 *
 * Mistakes end in one error that says what to do, and an empty output.
 *
 * @sa vtkRefractiveIndex
 */

#ifndef vtkSchlierenFilter_h
#define vtkSchlierenFilter_h

#include "SchlierenSettings.h" // for the values of the properties
#include "vtkImageAlgorithm.h"
#include "vtkNew.h"                    // for vtkNew
#include "vtkRefractiveIndex.h"        // for the properties handed on
#include "vtkSchlierenFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"           // for GradedFilter

#include <algorithm>  // for std::max
#include <atomic>     // for std::atomic
#include <functional> // for std::function
#include <memory>     // for std::unique_ptr, std::shared_ptr
#include <optional>   // for std::optional
#include <string>     // for std::string
#include <vector>     // for std::vector

class vtkPiecewiseFunction;
struct MadeRefractivity;

namespace filters
{
class ExposureSteps;
struct ImageCircumstances;
struct TimeStep;
} // namespace filters

namespace schlieren
{
struct Image;
struct Monitor;
struct Scene;
} // namespace schlieren

class VTKSCHLIERENFILTERS_EXPORT vtkSchlierenFilter : public vtkImageAlgorithm,
                                                      private SchlierenSettings
{
public:
  static vtkSchlierenFilter* New();
  vtkTypeMacro(vtkSchlierenFilter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Cutoffs
  {
    KNIFE_EDGE = 0,
    SHADOWGRAPH = 1,
    CIRCULAR = 2,
    CIRCULAR_COMPLEMENT = 3,
    GRADED_FILTER = 4,
    COLOR_FILTER = 5,
    INTERFEROGRAM = 6,
    BACKGROUND_ORIENTED = 7,
    NUMERICAL_SCHLIEREN = 8
  };

  enum LockModes
  {
    LOCK_OFF = 0,
    LOCK_OVER_TIME = 1,
    LOCK_ALWAYS = 2
  };

  enum FringeModes
  {
    INFINITE_FRINGES = 0,
    FINITE_FRINGES = 1
  };

  enum Exits
  {
    EXIT_AUTO = 0,
    EXIT_SURROUNDINGS = 1,
    EXIT_AIR = 2,
    EXIT_CUSTOM = 3
  };

  enum LightSources
  {
    COLLIMATED = 0,
    DIVERGING = 1
  };

  enum SourceShapes
  {
    POINT = 0,
    SLIT = 1,
    DISC = 2
  };

  enum BackgroundPatterns
  {
    DOTS = 0,
    STRIPES = 1,
    PICTURE = 2,
    SCENE = 3
  };

  enum FilmEstimators
  {
    SHEET = 0,
    PHOTON = 1
  };

  enum NoiseFilters
  {
    NO_FILTER = 0,
    GAUSSIAN = 1,
    MEAN = 2,
    CONE = 3
  };

  enum OutputPorts
  {
    IMAGE_PORT = 0,
    HISTOGRAM_PORT = 1
  };

  enum Qualities
  {
    INTERACTIVE = 0,
    DRAFT = 1,
    PUBLICATION = 2,
    REFERENCE = 3,
    CUSTOM = 4
  };

  enum PathModels
  {
    AUTO_PATH = 0,
    STRAIGHT = 1,
    REFRACTED = 2,
    DIFFERENCE = 3
  };

  enum Integrators
  {
    LEAPFROG = 0,
    RK4 = 1,
    ADAPTIVE = 2,
    EULER = 3
  };

  enum Interpolations
  {
    QUADRATIC = 0,
    LINEAR = 1,
    CENTRAL = 2,
    CUBIC = 3
  };

  enum Precisions
  {
    SINGLE = 0,
    DOUBLE = 1
  };

  enum Devices
  {
    AUTO = 0,
    CPU = 1,
    CUDA = 2
  };

  ///@{
  /**
   * The medium: see vtkRefractiveIndex. The arrays are chosen with SetInputArrayToProcess as there
   * (vtkRefractiveIndex::InputArrays).
   */
  vtkRefractiveIndexForwardMacro(Medium);
  virtual double GetGladstoneDaleConstantUsed();
  const char* GetGrid() const;

  /**
   * The arrays that are used, see vtkRefractiveIndex.
   */
  const char* GetArraysUsed();
  ///@}

  ///@{
  /**
   * Wavelength of the light in vacuum, nanometres: of the medium, as in vtkRefractiveIndex, and of an
   * interferogram. Another one finds the refractivity anew only where that depends on it. Default: 632.8.
   */
  vtkSetMacro(Wavelength, double);
  vtkGetMacro(Wavelength, double);
  ///@}

  ///@{
  /**
   * Metres per unit of the data's coordinates. Default: 1. An error where it is not positive.
   */
  vtkSetMacro(LengthScale, double);
  vtkGetMacro(LengthScale, double);
  ///@}

  ///@{
  /**
   * Whether the refractivity around the data is the median over the domain's boundary. Default: on.
   */
  vtkSetMacro(AutoAmbientRefractivity, bool);
  vtkGetMacro(AutoAmbientRefractivity, bool);
  vtkBooleanMacro(AutoAmbientRefractivity, bool);
  ///@}

  ///@{
  /**
   * Refractivity n - 1 around the data, where AutoAmbientRefractivity is off. Default: 0.
   */
  vtkSetMacro(AmbientRefractivity, double);
  vtkGetMacro(AmbientRefractivity, double);
  ///@}

  ///@{
  /**
   * Whether an automatic refractivity around the data is that of the first image, kept at all other times, so that
   * fringes of a series are counted from the same light; else, and with other data or another medium, it is found anew.
   * Default: on. LockedAmbient is that of the last image where it was kept from an earlier one, else 0; setting it
   * (state files do) gives it to the next image, 0 lets it be found.
   */
  vtkSetMacro(LockAmbient, bool);
  vtkGetMacro(LockAmbient, bool);
  vtkBooleanMacro(LockAmbient, bool);
  ///@}

  ///@{
  /**
   * What light enters where it leaves the data through a plane across the line of sight, the window of a tank, at which
   * n sin of its angle is kept (Snell), one of Exits: EXIT_AIR (n - 1 = 2.718e-4); EXIT_CUSTOM (ExitRefractivity,
   * n - 1, more than -1; default: 2.7e-4); EXIT_SURROUNDINGS: there is no window, and angles are those in the data;
   * or EXIT_AUTO (the default): air where the surroundings are a liquid, n - 1 > 0.1, which a warning says once; a
   * window into the surroundings where they are a gas, but there is more than 0.1 in the data; else as
   * EXIT_SURROUNDINGS. Deflections are angles behind the window, as screens and patterns are; light that is totally
   * reflected is lost.
   */
  vtkSetClampMacro(ExitInto, int, EXIT_AUTO, EXIT_CUSTOM);
  vtkGetMacro(ExitInto, int);
  vtkSetMacro(ExitRefractivity, double);
  vtkGetMacro(ExitRefractivity, double);
  void SetLockedAmbient(double ambient);
  double GetLockedAmbient() const;
  ///@}

  ///@{
  /**
   * The direction one looks in, as in vtkCamera; light travels against it. Any length but 0.
   * Default: (0, 0, -1); see FaceFlatData.
   */
  vtkSetVector3Macro(ViewDirection, double);
  vtkGetVector3Macro(ViewDirection, double);
  ///@}

  ///@{
  /**
   * What is up in the image; not parallel to ViewDirection. Default: (0, 1, 0).
   */
  vtkSetVector3Macro(ViewUp, double);
  vtkGetVector3Macro(ViewUp, double);
  ///@}

  ///@{
  /**
   * Whether 2-D data in a plane along z (and the section that data with Symmetry are) are seen from in front where ViewDirection
   * is (0, 0, -1), its default, which is along the plane: then along y, or against x, and z is up unless ViewUp says otherwise. Off,
   * or with any other ViewDirection, the view is as it is set. Default: on.
   */
  vtkSetMacro(FaceFlatData, bool);
  vtkGetMacro(FaceFlatData, bool);
  vtkBooleanMacro(FaceFlatData, bool);
  ///@}

  ///@{
  /**
   * The point at the centre of the image, data units. By default, and after ClearFocalPoint(), the
   * data's centre; what GetFocalPoint() returns is then of no effect.
   */
  virtual void SetFocalPoint(double x, double y, double z);
  virtual void SetFocalPoint(const double point[3])
  {
    this->SetFocalPoint(point[0], point[1], point[2]);
  }
  virtual void ClearFocalPoint();
  vtkGetVector3Macro(FocalPoint, double);
  vtkGetMacro(HasFocalPoint, bool);
  ///@}

  ///@{
  /**
   * Half the height of the image in the plane of the focal point, data units; 0 (the default) fits the data.
   */
  vtkSetMacro(ParallelScale, double);
  vtkGetMacro(ParallelScale, double);
  ///@}

  ///@{
  /**
   * Degrees between the lower and the upper side of the image, seen from the camera, less than 170; 0 (the default):
   * parallel light. Else it is that of a point source in the camera's pupil, which diverges from there through the flow
   * to what is behind it: each pixel has its own direction, as the surfaces that such a vtkCamera sees. Of data that
   * reach beyond the camera nothing counts that is behind it. In 2-D data, whose depth is none of theirs, light stays
   * parallel.
   */
  vtkSetMacro(ViewAngle, double);
  vtkGetMacro(ViewAngle, double);
  ///@}

  ///@{
  /**
   * Width and height in pixels. Default: (512, 512).
   */
  vtkSetVector2Macro(ImageSize, int);
  vtkGetVector2Macro(ImageSize, int);
  ///@}

  ///@{
  /**
   * What turns deflections into light and dark, one of Cutoffs. With the deflection eps, its part e along
   * KnifeEdgeAngle and the sensitivity k, the intensity is, limited to 0 ... 1,
   * - KNIFE_EDGE (the default): 1/2 - offset + k e;
   * - SHADOWGRAPH: 1, so that only where light lands on a screen makes the image;
   * - CIRCULAR: 1 - k |eps|, a dark field's inverse; CIRCULAR_COMPLEMENT: k |eps|;
   * - GRADED_FILTER: that of GradedFilter at 1/2 - offset + k e;
   * - COLOR_FILTER: the colour at k eps of ColorFilterImage, or of a wheel;
   * - INTERFEROGRAM: (1 + cos(2 pi OPD / wavelength + carrier)) / 2;
   * - BACKGROUND_ORIENTED: what a camera sees of a pattern behind the flow;
   * - NUMERICAL_SCHLIEREN: exp(-5 k |eps|), no stop of a bench, but what images of computed flows often show.
   */
  virtual void SetCutoff(int cutoff);
  vtkGetMacro(Cutoff, int);
  ///@}

  ///@{
  /**
   * What one of Cutoffs has: a sensitivity k; a straight edge with an angle, an offset and another side; fringes; a
   * screen behind the flow (full light is 2 there, else 1), or a pattern; and, with these settings, colours of its own.
   * False for other numbers.
   */
  static bool CutoffHasK(int cutoff);
  static bool CutoffHasEdge(int cutoff);
  static bool CutoffHasFringes(int cutoff);
  static bool CutoffHasScreen(int cutoff);
  static bool CutoffHasBackground(int cutoff);
  static bool CutoffHasColor(int cutoff, bool whiteLight, int backgroundPattern);
  bool HasOwnColor() const;
  ///@}

  ///@{
  /**
   * Which deflection the knife edge and the graded filter measure, degrees: 0 (the default) along u, 90
   * along v.
   */
  vtkSetMacro(KnifeEdgeAngle, double);
  vtkGetMacro(KnifeEdgeAngle, double);
  ///@}

  ///@{
  /**
   * How far the knife edge or the graded filter is in from the middle of the source's image, as a fraction
   * of its width; undisturbed light loses as much. Default: 0. CutoffPosition counts with KFromOptics.
   */
  vtkSetMacro(CutoffOffset, double);
  vtkGetMacro(CutoffOffset, double);
  ///@}

  ///@{
  /**
   * Turns the knife edge or the graded filter round: intensity I becomes 1 - I. Default: off.
   */
  vtkSetMacro(InvertCutoff, bool);
  vtkGetMacro(InvertCutoff, bool);
  vtkBooleanMacro(InvertCutoff, bool);
  ///@}

  ///@{
  /**
   * Whether k is chosen so that the 99th percentile of the deflections is full scale, but no larger than the error of
   * the medium's voxels allows where little flow is in view. Default: on.
   */
  vtkSetMacro(AutoKScale, bool);
  vtkGetMacro(AutoKScale, bool);
  vtkBooleanMacro(AutoKScale, bool);
  ///@}

  ///@{
  /**
   * How long an automatic k is kept, one of LockModes. It is found for the first image and then
   * - LOCK_OFF: for each image anew;
   * - LOCK_OVER_TIME (the default): kept at all other times, whatever else changes with the time, as the camera of an
   *   animation does. Found anew where camera, light or quality change at the time that it was found, and where data
   *   have no time steps;
   * - LOCK_ALWAYS: kept where camera, light and quality change, too.
   * In each case it is found anew where the settings of the medium, the kind of cutoff that has a k, or, at the same
   * time, the data change. Images between, whose k is not automatic, do not count.
   */
  vtkSetClampMacro(LockK, int, LOCK_OFF, LOCK_ALWAYS);
  vtkGetMacro(LockK, int);
  ///@}

  ///@{
  /**
   * The k of the last image where LockK has kept it from an earlier one, else 0. Setting it (state files do) gives the
   * next image this k, from which on LockK holds; 0 lets it be found.
   */
  void SetLockedK(double k);
  double GetLockedK() const;
  ///@}

  ///@{
  /**
   * Sensitivity k where AutoKScale is off: focal length over source width, so that a knife edge's
   * intensity is 1/2 + k times the deflection. Not negative. Default: 1000.
   */
  vtkSetMacro(KScale, double);
  vtkGetMacro(KScale, double);
  ///@}

  ///@{
  /**
   * Whether sensitivity and offset are those of real optics, whatever AutoKScale, KScale and CutoffOffset
   * are: k = FocalLength / SourceWidth, offset = CutoffPosition / SourceWidth. Default: off.
   */
  vtkSetMacro(KFromOptics, bool);
  vtkGetMacro(KFromOptics, bool);
  vtkBooleanMacro(KFromOptics, bool);
  ///@}

  ///@{
  /**
   * Focal length of the second mirror, metres, positive. Default: 1.
   */
  vtkSetMacro(FocalLength, double);
  vtkGetMacro(FocalLength, double);
  ///@}

  ///@{
  /**
   * Of the source's image at the cutoff, millimetres: its width across the knife edge, or a disc's diameter
   * (default: 1), and, of a slit, its length along the knife edge (default: 10). Not negative; for
   * KFromOptics, the width is positive. Seen from the data, the source is as large as the width over
   * FocalLength.
   */
  vtkSetMacro(SourceWidth, double);
  vtkGetMacro(SourceWidth, double);
  vtkSetMacro(SourceLength, double);
  vtkGetMacro(SourceLength, double);
  ///@}

  ///@{
  /**
   * With KFromOptics: how far the edge is in from the middle of the source's image, millimetres.
   * Default: 0.
   */
  vtkSetMacro(CutoffPosition, double);
  vtkGetMacro(CutoffPosition, double);
  ///@}

  ///@{
  /**
   * What FocalLength, SourceWidth and CutoffPosition stand for, whether KFromOptics is on or not: k and the
   * offset as a fraction of the source's image. NaN where there is none. And the k of the last image; 0
   * before the first, after a failed one and where there is no cutoff.
   */
  double GetKScaleOfOptics();
  double GetCutoffOffsetOfOptics();
  vtkGetMacro(KScaleUsed, double);
  ///@}

  /**
   * The last image's sensitivity in words: k, the deflection that is full scale, and what optics have it; of an
   * interferogram, its wavelength. Empty where there is none.
   */
  const char* GetSensitivity() const { return this->Sensitivity.c_str(); }

  ///@{
  /**
   * Transmission, 0 to 1, of the GRADED_FILTER over its width, 0 to 1; undisturbed light passes its middle.
   * Null (the default) or without points: a straight line from 0 to 1. Sampled at 1025 places.
   */
  virtual void SetGradedFilter(vtkPiecewiseFunction* function);
  vtkPiecewiseFunction* GetGradedFilter() const;
  ///@}

  ///@{
  /**
   * The image of the COLOR_FILTER, in sRGB; it covers k times the deflection from -1 to 1 along both axes. Either
   * the name of a PNG file, or the file's content itself as text: "data:image/png;base64,..." (RFC 2397).
   * Grey, 16-bit and transparent (shown on white)
   * images will do. Empty (the default): a wheel whose hue is the direction of the deflection, from red
   * along u, and whose saturation is its size, full at k |eps| = 1.
   */
  vtkSetStdStringFromCharMacro(ColorFilterImage);
  vtkGetCharFromStdStringMacro(ColorFilterImage);
  ///@}

  ///@{
  /**
   * Fringes of an interferogram, one of FringeModes. INFINITE_FRINGES (the default): undisturbed light is
   * bright everywhere. FINITE_FRINGES: the reference beam is tilted, which lays straight fringes over the
   * image: FringeSpacing apart (data units on the film, positive; 0, the default: a tenth of the
   * image's height), one after the other in the direction of FringeAngle (degrees; 0, the default, is u,
   * 90 is v). Where the beams cross at a BeamAngle (degrees, above 0 to 180; 0, the default: not given),
   * the spacing is wavelength / (2 sin(BeamAngle / 2)).
   */
  vtkSetClampMacro(FringeMode, int, INFINITE_FRINGES, FINITE_FRINGES);
  vtkGetMacro(FringeMode, int);
  vtkSetMacro(FringeSpacing, double);
  vtkGetMacro(FringeSpacing, double);
  vtkSetMacro(FringeAngle, double);
  vtkGetMacro(FringeAngle, double);
  vtkSetMacro(BeamAngle, double);
  vtkGetMacro(BeamAngle, double);
  ///@}

  ///@{
  /**
   * Whether an interferogram is taken in white light: `Color` then has the fringes as the eye sees them. The
   * medium disperses as Gas, BackgroundGas or moist air does, whichever the IndexModel uses; not at all
   * where that is none or custom. Default: off.
   */
  vtkSetMacro(WhiteLight, bool);
  vtkGetMacro(WhiteLight, bool);
  vtkBooleanMacro(WhiteLight, bool);
  ///@}

  ///@{
  /**
   * For all cutoffs but the shadowgraph: the plane in focus, data units towards the viewer from the middle of
   * the data, with a ViewAngle from the focal point. Default: 0.
   */
  vtkSetMacro(FocusOffset, double);
  vtkGetMacro(FocusOffset, double);
  ///@}

  ///@{
  /**
   * The light, one of LightSources: COLLIMATED (the default), or DIVERGING from a point SourceDistance
   * before the middle of the data (data units, before the data; 0, the default: ten data depths). With a ViewAngle it
   * diverges from the pupil, whatever this is.
   */
  vtkSetClampMacro(LightSource, int, COLLIMATED, DIVERGING);
  vtkGetMacro(LightSource, int);
  vtkSetMacro(SourceDistance, double);
  vtkGetMacro(SourceDistance, double);
  ///@}

  ///@{
  /**
   * The source's shape, one of SourceShapes: a POINT (the default), or a SLIT or DISC of SourceWidth and
   * SourceLength, which blurs what is not in focus and rounds off what a knife edge does.
   */
  vtkSetClampMacro(SourceShape, int, POINT, DISC);
  vtkGetMacro(SourceShape, int);
  ///@}

  ///@{
  /**
   * What is seen behind the flow by BACKGROUND_ORIENTED: one of BackgroundPatterns (default: DOTS);
   * BackgroundDistance behind where the data begin (data units; negative, the default: one data depth);
   * dots and stripes BackgroundPeriod apart (data units; 0, the default: eight pixels; below four they fade,
   * at two they are gone); stripes across BackgroundAngle (degrees; 0, the default: u); the PICTURE is BackgroundImage,
   * given as ColorFilterImage is; the SCENE is that of SetBackgroundScene().
   */
  vtkSetClampMacro(BackgroundPattern, int, DOTS, SCENE);
  vtkGetMacro(BackgroundPattern, int);
  vtkSetMacro(BackgroundDistance, double);
  vtkGetMacro(BackgroundDistance, double);
  vtkSetMacro(BackgroundPeriod, double);
  vtkGetMacro(BackgroundPeriod, double);
  vtkSetMacro(BackgroundAngle, double);
  vtkGetMacro(BackgroundAngle, double);
  vtkSetStdStringFromCharMacro(BackgroundImage);
  vtkGetCharFromStdStringMacro(BackgroundImage);
  ///@}

  /**
   * For BACKGROUND_ORIENTED images with the pattern SCENE: what the camera sees behind the flow, which a view knows: RGB
   * bytes stretched over the image, as they are on a screen. `distance` is used where BackgroundDistance is negative;
   * negative: one data depth. Null (the default): there is none, and images with this pattern fail.
   */
  void SetBackgroundScene(vtkImageData* image, double distance);

  ///@{
  /**
   * For a shadowgraph: from the plane where light leaves the data to the screen, data units.
   * Negative (default: -1): one data depth.
   */
  vtkSetMacro(ScreenDistance, double);
  vtkGetMacro(ScreenDistance, double);
  ///@}

  ///@{
  /**
   * Whether the image is tinted by the colours of the Fields, with any IndexModel (after Brownlee et
   * al. 2011, sec. 8). Along its path, light gathers g_i = integral |grad f_i| ds of each field f_i (its
   * place in its range, 0 to 1; with TRANSFER_FUNCTIONS what its function makes of that). Its colour is
   * 1 + s (sum g_i c_i / G - 1), where G = sum g_i, c_i are the FieldColors, and the strength s is
   * G over its 99th percentile in the image, at most 1. In meshes, voxels are then as fine as the fields need, too:
   * see MediumTolerance. Default: off.
   */
  vtkSetMacro(ColorByField, bool);
  vtkGetMacro(ColorByField, bool);
  vtkBooleanMacro(ColorByField, bool);
  ///@}

  ///@{
  /**
   * The fields' colours: red, green and blue, 0 to 1, of each. Empty (the default): hues that are
   * easily distinguished.
   */
  virtual void AddFieldColor(double value);
  virtual void ClearFieldColors();
  VTK_WRAPEXCLUDE const std::vector<double>& GetFieldColors() const { return this->FieldColors; }
  ///@}

  ///@{
  /**
   * Accuracy against speed, one of Qualities. Setting it sets the properties named by
   * GetQualitySetting(), PathModel to PathTolerance; CUSTOM sets none. What it is follows from them: the
   * preset whose values they have, or CUSTOM. Default: INTERACTIVE, and so is theirs.
   */
  virtual void SetQuality(int quality);
  virtual int GetQuality();
  ///@}

  ///@{
  /**
   * The names of the properties that Quality sets, from number 0 on; null after the last. And what a
   * preset sets them to; 0 where there is no such preset or property.
   */
  static const char* GetQualitySetting(int number);
  static double GetQualityValue(int quality, int number);
  ///@}

  ///@{
  /**
   * How light passes the medium, one of PathModels: REFRACTED rays bend; STRAIGHT ones sum up what the
   * undisturbed line of sight meets; AUTO_PATH takes these where they are proven to be within
   * PathTolerance. DIFFERENCE: what refraction changes. Both are traced, at the k of refracted rays. The
   * intensity is 1/2 (of a shadowgraph 1) plus half of that by refracted rays less that by straight ones, and so
   * are colours; the other arrays are differences, and all else is as of refracted rays.
   */
  vtkSetClampMacro(PathModel, int, AUTO_PATH, DIFFERENCE);
  vtkGetMacro(PathModel, int);
  ///@}

  ///@{
  /**
   * How refracted rays take their steps, one of Integrators: LEAPFROG is of second order and looks up
   * one gradient a step, RK4 of fourth order with four, ADAPTIVE of third order with three and steps as
   * long as AdaptiveTolerance allows, EULER of first order with one (Brownlee et al. 2011). Where the index changes by
   * more than a twentieth in a step, as at a face of glass, steps are adaptive, but of EULER; if MomentumDrift is above
   * 1 % all the same, a warning says so and where that is.
   */
  vtkSetClampMacro(Integrator, int, LEAPFROG, EULER);
  vtkGetMacro(Integrator, int);
  ///@}

  ///@{
  /**
   * Length of an integration step, voxels; of ADAPTIVE, the longest. 0.001 to 16.
   */
  vtkSetMacro(StepSize, double);
  vtkGetMacro(StepSize, double);
  ///@}

  ///@{
  /**
   * Rays cross a cube of cells in one step where n - 1 varies in it by no more than this fraction of its
   * range in the whole medium. 0 (skip nothing) to 1. What that may change: SkippingBound.
   */
  vtkSetMacro(HomogeneityTolerance, double);
  vtkGetMacro(HomogeneityTolerance, double);
  ///@}

  ///@{
  /**
   * What lies between the samples, one of Interpolations: QUADRATIC and CUBIC B-splines have a
   * continuous gradient; LINEAR is faster and prints the grid into the image; CENTRAL takes central
   * differences for the gradient (Brownlee et al. 2011).
   */
  vtkSetClampMacro(Interpolation, int, QUADRATIC, CUBIC);
  vtkGetMacro(Interpolation, int);
  ///@}

  ///@{
  /**
   * Rays per pixel, at least 1.
   */
  vtkSetMacro(SamplesPerPixel, int);
  vtkGetMacro(SamplesPerPixel, int);
  ///@}

  ///@{
  /**
   * How rays become an image, one of FilmEstimators: SHEET draws the light between neighbouring rays, PHOTON
   * divides each ray's light among the four pixels around it.
   */
  vtkSetClampMacro(FilmEstimator, int, SHEET, PHOTON);
  vtkGetMacro(FilmEstimator, int);
  ///@}

  ///@{
  /**
   * Floating-point numbers to trace with, one of Precisions.
   */
  virtual void SetPrecision(int precision);
  vtkGetMacro(Precision, int);
  ///@}

  ///@{
  /**
   * Of ADAPTIVE: the error allowed in a step, relative to what the steepest gradient of the medium bends
   * over the same path. 1e-12 to 1.
   */
  vtkSetMacro(AdaptiveTolerance, double);
  vtkGetMacro(AdaptiveTolerance, double);
  ///@}

  ///@{
  /**
   * Of AUTO_PATH: how far a straight ray may be from the refracted one, pixels. Not negative.
   */
  vtkSetMacro(PathTolerance, double);
  vtkGetMacro(PathTolerance, double);
  ///@}

  ///@{
  /**
   * Of meshes: the error of the deflection that the size of voxels may make, of the largest deflection; with
   * ColorByField also that of G, of its 99th percentile. 0: voxels are as fine as the mesh. 0 to 1.
   */
  vtkSetMacro(MediumTolerance, double);
  vtkGetMacro(MediumTolerance, double);
  ///@}

  ///@{
  /**
   * Of meshes: memory, MiB, for voxels. Default: 1024. Where it does not do, MediumTolerance is not met, and the
   * field data MediumError say by how much (the larger of both errors). MediumError is the largest of a ray through
   * many leaves, so it may be up to some twice MediumTolerance where memory does, too.
   */
  vtkSetClampMacro(MediumMemory, int, 1, VTK_INT_MAX);
  vtkGetMacro(MediumMemory, int);
  ///@}

  ///@{
  /**
   * How long light falls on the film, in the time of the data; 0 (the default): an instant. The image is then the mean
   * of those of ExposureSamples instants (default: 8; 1: as with 0), the middles of as many equal parts of this
   * interval, which lies around the time that is requested, and ends where the data's time does. All arrays of the
   * image are such means; the histogram is the sum of all; the sensitivity k and the refractivity around the data
   * are those of the first instant, unless they are given. Between time steps, arrays of real numbers and the points
   * of meshes are linear in time, and everything else is of the earlier step; cells that differ are an error. Sources
   * without time steps, but with a range of time, give the data of each instant.
   * No effect on data that do not change, and on images with a PreviewReduction. TimeLimit has none on an exposure:
   * it is made at once, and anew, with what is upstream, whenever anything changes.
   */
  vtkSetClampMacro(ExposureTime, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(ExposureTime, double);
  vtkSetClampMacro(ExposureSamples, int, 1, VTK_INT_MAX);
  vtkGetMacro(ExposureSamples, int);
  ///@}

  ///@{
  /**
   * What takes the grain out of the image, one of NoiseFilters: NO_FILTER (the default), a GAUSSIAN whose
   * standard deviation is half of NoiseFilterRadius (pixels, positive; default: 2), the MEAN over a disc, or
   * a CONE that shrinks as samples come in (Jensen 1996): it encloses as many as the radius does of one
   * per pixel.
   */
  vtkSetClampMacro(NoiseFilter, int, NO_FILTER, CONE);
  vtkGetMacro(NoiseFilter, int);
  vtkSetMacro(NoiseFilterRadius, double);
  vtkGetMacro(NoiseFilterRadius, double);
  ///@}

  ///@{
  /**
   * Bins along each axis of the histogram, up to 2048; 0: none is made. Default: 256.
   */
  vtkSetClampMacro(HistogramSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(HistogramSize, int);
  ///@}

  ///@{
  /**
   * Memory, MiB, in which rays are cached so that another cutoff needs no re-tracing. Default: 1024. The image
   * does not depend on it.
   */
  vtkSetClampMacro(MemoryBudget, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryBudget, int);
  ///@}

  ///@{
  /**
   * Chooses the places of the rays within the pixels; the same seed gives the same image.
   * 0 to 2147483647. Default: 1.
   */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * What computes, one of Devices: AUTO (the default) takes CUDA where a device answers, else the
   * CPU; CUDA without a device is an error.
   */
  vtkSetClampMacro(Device, int, AUTO, CUDA);
  vtkGetMacro(Device, int);
  ///@}

  ///@{
  /**
   * Threads on the CPU; 0 (the default): VTK_SMP_MAX_THREADS where that is set, else the cores that this
   * process may use. The image does not depend on it.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);

  ///@{
  /**
   * Where ParaView runs as several processes, the number of cells up to which the pieces that these have of a mesh are put
   * together on rank 0. Larger meshes stay where they are: each rank has its cells, with ghost cells around them, and samples
   * them. So do images, which become a tree of bricks, of more than 160 times as many cells. 0: so do all of these. Adaptive
   * meshes, two-dimensional data, and all where SamplingDimensions or SamplingBounds are in use are always put together. The
   * default is 10^6.
   */
  vtkSetClampMacro(GatherLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(GatherLimit, int);
  ///@}
  ///@}

  ///@{
  /**
   * What this filter has done since it was made: media built, meshes prepared for it (see
   * vtkRefractiveIndex::MakeSource), grids chosen for meshes, and rays traced. They stand still where an update could use what was there.
   */
  vtkTypeInt64 GetMediumBuilds();
  vtkTypeInt64 GetMeshBuilds();
  vtkTypeInt64 GetGridPlans();
  vtkTypeInt64 GetTotalRaysTraced();
  ///@}

  ///@{
  /**
   * How many pixels along each axis one of a preview stands for: with 2, an image that lies at the
   * same place has half as many columns and rows, and one ray for each, whatever SamplesPerPixel is, with
   * steps no shorter than those of INTERACTIVE. For a window to show while the view is being turned.
   * Default: 1.
   */
  vtkSetClampMacro(PreviewReduction, int, 1, 64);
  vtkGetMacro(PreviewReduction, int);
  ///@}

  ///@{
  /**
   * Seconds that an update may take for rays and light, about; 0 (the default): no limit. When they are over,
   * the output is the image of the samples that are there, or, before the first of each pixel is, the
   * image from before, stretched where it was of another size (of a new filter: a preview). Refine()
   * then works for as long again and, if that has completed samples, lets the next update show them; where nothing but
   * properties of this filter has changed since, it takes the first one, too. Without a limit it lets the next
   * update finish the image. GetFinished() says whether there is anything left.
   * Each makes some progress, however short the limit, and the finished image is the one made without a
   * limit, to the last bit. Another limit is no reason to make an image again. What the medium takes does not
   * count, and progress is not reported.
   */
  void SetTimeLimit(double seconds) { this->TimeLimit = seconds; }
  vtkGetMacro(TimeLimit, double);
  void Refine();
  bool GetFinished();
  ///@}

  ///@{
  /**
   * Leaves an unfinished image as it is: it counts as finished then, until Refine() lets the next update resume
   * it, or something else changes the image. So is an update with a TimeLimit left that is aborted while
   * the refractivity is found; the output is empty then. GetStopped() says whether that is so.
   */
  void Stop();
  bool GetStopped();
  ///@}

  /**
   * Whether the last update has left an image, which rank 0 has: the same on all ranks.
   */
  bool GetHasImage();

  /**
   * How much of the rays and the light of the image there is, in per cent; 100 only for a finished one.
   */
  int GetPercentDone();

  /**
   * How many different images this filter has made, with the one that Refine() has made for the next update:
   * unchanged where such a step had nothing new to show.
   */
  vtkTypeInt64 GetPictureCount() const;

  /**
   * The last image in words, in one line: samples per pixel; rays per second, when some were traced last;
   * device; whether rays bend, and where they do not, by how many pixels refracted ones may leave the data beside
   * them (DisplacementBound), if that bound says anything. Empty where there is none.
   */
  const char* GetStatus() const { return this->Status.c_str(); }

  /// All of these properties that are numbers and texts.
  VTK_WRAPEXCLUDE const SchlierenSettings& GetSettings() const { return *this; }

  /// Requests of the data of an input what this filter requests of its own: all, a piece or nothing. So that others who
  /// have the same input do not make it run again.
  VTK_WRAPEXCLUDE void RequestSame(vtkInformation* inInfo);

  vtkMTimeType GetMTime() override;

  /**
   * Says that this rank has no input in the next RequestData(), because something upstream has failed; see vtkSchlierenPipeline.
   */
  VTK_WRAPEXCLUDE void LackInput();

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

protected:
  vtkSchlierenFilter();
  ~vtkSchlierenFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkSchlierenFilter(const vtkSchlierenFilter&) = delete;
  void operator=(const vtkSchlierenFilter&) = delete;

  struct Internals;

  /// Does on other ranks what rank 0 requests, for all steps of an exposure.
  void ServeRank0(filters::ExposureSteps& steps);
  /// Makes the image on rank 0, or leaves the outputs empty where that is aborted. Throws what is reported by Fail().
  void MakeImage(filters::ExposureSteps& steps, double maxCells, vtkInformationVector* outputs);
  /// Puts the image that was made last on the outputs.
  void ShowLast(vtkInformationVector* outputs);
  /// Hands the array selections, and the wavelength if it matters there, on to Medium, which changes
  /// only if they have.
  void PassToMedium();
  void OnMediumProgress();
  /// Brings the refractivity up to date. False if aborted.
  bool UpdateRefractivity(vtkDataObject* input, vtkDataObject* bodies);
  /// That of another filter, or a new one. Null if aborted.
  std::shared_ptr<const MadeRefractivity> FindOrMakeRefractivity(
    vtkDataObject* input, vtkDataObject* bodies, const std::vector<double>& description);
  /// Null if aborted.
  std::shared_ptr<const MadeRefractivity> MakeRefractivity(
    vtkDataObject* input, vtkDataObject* bodies);
  /// Sees to it that the ranks answer this filter about its refractivity, which another filter may have used. False where they
  /// cannot.
  bool UseOwnRanks();
  /// Finds the gradients of the fields that tint, if they do.
  void UpdateFieldGradients(vtkDataObject* input);
  /// The newest time of all properties, Refine() apart, and of those and everything upstream.
  vtkMTimeType GetTimeOfProperties();
  vtkMTimeType GetTimeOfImage();
  /// Whether an update has only to resume the image that is not finished.
  bool Continues(vtkDataObject* input, vtkDataObject* bodies);
  /// Up to how many cells rank 0 gathers.
  double MostGathered();
  /// Everything of the inputs that the refractivity depends on.
  std::vector<double> DescribeInputs(vtkDataObject* input, vtkDataObject* bodies);
  /// Whether an image's own grid would take more than MediumMemory: then it becomes a tree.
  bool IsLargeImage(vtkDataObject* input) const;
  /// The same of data that stay on their ranks, for all filters that have the same.
  std::vector<double> DescribePieces(vtkDataObject* input, vtkDataObject* bodies);
  /// Works on an image between updates. Whether an update has something to do now.
  bool WorkOn();
  /// Refine() there. Whether the next update has more to show.
  bool RefineOnRank0();
  /// Whether a new image can be begun between updates, `now` being GetTimeOfImage().
  bool CanBegin(vtkMTimeType now);
  /// What is kept from an earlier image: the automatic k, and the refractivity of the surroundings. Unset where there is
  /// none, or none counts.
  std::optional<double> KeptK();
  std::optional<double> KeptAmbient();
  filters::ImageCircumstances CircumstancesOf(std::vector<double> medium, std::vector<double> rays);
  schlieren::Image Begin(bool isPreview, double seconds, const schlieren::Monitor& monitor);
  /// Makes the image of an exposure over time. False if aborted.
  bool Expose(filters::ExposureSteps& steps, vtkImageData* output, vtkImageData* histogram);
  /// Hands what was found for the last image that was begun to the locks.
  void KeepFound(const schlieren::Image& image);
  /// Reports progress of what is being made, or of an instant of it.
  void Progress(double fraction);
  /// Makes the image from the refractivity, or resumes it. False if aborted.
  bool Render(vtkImageData* output, vtkImageData* histogram, bool continues);
  /// Hands out what there is of an image, where there is anything new. False if aborted.
  bool Show(schlieren::Image&& image, vtkImageData* output, vtkImageData* histogram);
  void ForgetImage();
  /// Reports a problem of the inputs and properties of a time, and leaves the outputs empty.
  void Fail(const std::string& problem, vtkMTimeType now, vtkInformationVector* outputs);

  vtkNew<vtkRefractiveIndex> Medium;
  std::unique_ptr<Internals> Inside;

  vtkSmartPointer<vtkPiecewiseFunction> GradedFilter;
  double KScaleUsed = 0;
  std::string Sensitivity;
  vtkTypeInt64 PictureCount = 0;
  std::string Status;
};

#endif
