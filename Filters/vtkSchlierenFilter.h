// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenFilter
 * @brief   the image of a flow by a schlieren, shadowgraph or interferometry bench
 *
 * Bends light through the refractive index of a flow and produces a 2-D vtkImageData, in the plane
 * z = 0, whose coordinates are those of the view: x = position . u, y = position . v in data units,
 * where u points right and v up. So the image of the default view covers the data.
 *
 * Point arrays of the image (their vtkDataArray::UNITS_LABEL is the unit). Deflection,
 * OpticalPathDifference and Displacement belong to the ray through the pixel's centre, from the
 * middle of the light source; if a solid stops that ray, they are means of the pixel's other rays.
 * Vectors have a third component, 0:
 * - `Intensity` (float, active scalars): see Cutoff; the luminance of a coloured image;
 * - `Color` (3 unsigned chars, then the active scalars), of coloured images: in sRGB with
 *   COLOR_FILTER, WhiteLight or a background's PICTURE; else, with ColorByField, the tinted
 *   intensity as linear bytes: 255 is 1, of a shadowgraph 2;
 * - `Deflection` (3 floats): direction cosines along u and v of the emerging light; light bends
 *   towards higher index;
 * - `OpticalPathDifference` (double): metres, relative to undisturbed light;
 * - `Displacement` (3 floats): lateral, in the plane where light leaves the data, data units;
 * - `BlockedFraction` (float): fraction of the pixel's rays that a solid stopped;
 * - `ErrorEstimate` (float), with ErrorEstimate: the pixel's error;
 * - `Background` (float) and `BackgroundDisplacement` (3 floats, data units), with
 *   BACKGROUND_ORIENTED only: the image without the flow, and the point of the pattern that is
 *   seen, less that without the flow (the image has moved in the opposite direction); with an
 *   FNumber, this and the rays' other arrays are means over the aperture;
 * - `Recorded` and, with BACKGROUND_ORIENTED, `RecordedBackground` (unsigned chars, or unsigned
 *   shorts for a BitDepth above 8), with a FullWell: what the sensor makes of `Intensity` and
 *   `Background`.
 *
 * Field data: `AxisRight` and `AxisUp` (u and v), `Device`, `PathModel` (`Straight` or `Refracted`),
 * `KScale` (the k used), `UndisturbedLevel` (intensity of undisturbed light), `SaturatedShare`
 * (fraction of the rays at the cutoff's darkest or brightest level), `LightEmitted`, `LightOnFilm`
 * and `LightOutside` (behind the cutoff, in units of full light of all pixels; the first is the sum
 * of the others), `FringeSpacing` (of finite fringes, data units), `AmbientRefractivity` and `ExitRefractivity`
 * (the values used), `RaysTraced`, `RaysLost` (trapped in the medium, turned back by it, or totally
 * reflected at the exit), `StepsTaken` (of all rays), `TraceSeconds` (0 without tracing), and the
 * accuracy: `SkippingBound` (maximum error of direction cosines by skipping, omitted where it is
 * not useful) and `MomentumDrift` (maximum relative error of |p| = n at the exit of refracted rays; else 0). For a
 * legend: `LegendTitle` (the cutoff's name), `LegendLabel` (texts: what the light stands for, and
 * its unit: rad, m or none), `LegendRange` (the first and last value, in that unit), `LegendSize`
 * (numbers of values; both 0 without a scale, the second above 1 for deflections along u and v),
 * `LegendColors` (3 unsigned chars each, the lowest value first), `LegendNotes` (texts, such as k; these
 * two only if there are any),
 * `LegendAngle` (degrees, of an edge: the direction of the deflection), `WhiteLevel` (the intensity
 * that is shown as white) and `LengthScale`.
 *
 * The second output is the histogram of the light on the cutoff plane: an image with a point at the
 * centre of each bin, whose coordinates are the deflections along u and v, with the array `Rays`
 * (64-bit integers), 256 bins along both axes.
 *
 * The properties of the medium are those of vtkFlowAlgorithm. Results are kept
 * until something that they depend on changes: another cutoff, k or knife angle needs no
 * re-tracing, and another view keeps the medium.
 *
 * Each user error is one error that says what to do, with an empty output.
 *
 * @sa vtkRefractiveIndex
 */

#ifndef vtkSchlierenFilter_h
#define vtkSchlierenFilter_h

#include "SchlierenSettings.h" // for the values of the properties
#include "vtkFlowAlgorithm.h"
#include "vtkSchlierenFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"           // for GradedFilter

#include <algorithm>  // for std::max
#include <atomic>     // for std::atomic
#include <functional> // for std::function
#include <memory>     // for std::unique_ptr, std::shared_ptr
#include <optional>   // for std::optional
#include <string>     // for std::string
#include <vector>     // for std::vector

class vtkImageData;
class vtkPiecewiseFunction;
struct MadeRefractivity;

namespace filters
{
struct Choice;
struct ImageCircumstances;
struct TimeStep;
} // namespace filters

namespace schlieren
{
class MediumSource;
struct Image;
struct Monitor;
struct Scene;
} // namespace schlieren

class VTKSCHLIERENFILTERS_EXPORT vtkSchlierenFilter : public vtkFlowAlgorithm,
                                                      private SchlierenSettings
{
public:
  static vtkSchlierenFilter* New();
  vtkTypeMacro(vtkSchlierenFilter, vtkFlowAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What SetCutoff() takes.
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
    NUMERICAL_SCHLIEREN = 8,
    PHASE_CONTRAST = 9
  };

  /// What SetLockK() takes; LOCK_OVER_TIME keeps a value from one time step to the next.
  enum LockModes
  {
    LOCK_OFF = 0,
    LOCK_OVER_TIME = 1,
    LOCK_ALWAYS = 2
  };

  /// What SetExitInto() takes.
  enum Exits
  {
    EXIT_AUTO = 0,
    EXIT_SURROUNDINGS = 1,
    EXIT_AIR = 2,
    EXIT_CUSTOM = 3
  };

  /// What SetSourceShape() takes.
  enum SourceShapes
  {
    POINT = 0,
    SLIT = 1,
    DISC = 2
  };

  /// What SetLightModel() takes.
  enum LightModels
  {
    LIGHT_RAYS = 0,
    LIGHT_WAVES = 1,
    LIGHT_AUTO = 2
  };

  /// What SetBackgroundPattern() takes.
  enum BackgroundPatterns
  {
    DOTS = 0,
    STRIPES = 1,
    PICTURE = 2,
    SCENE = 3
  };

  /// The image, and the histogram of the cutoff plane.
  enum OutputPorts
  {
    IMAGE_PORT = 0,
    HISTOGRAM_PORT = 1
  };

  /// What SetQuality() takes; CUSTOM is what GetQuality() returns for settings of no preset.
  enum Qualities
  {
    INTERACTIVE = 0,
    FINE = 1,
    PUBLICATION = 2,
    REFERENCE = 3,
    AUTOMATIC = 4,
    CUSTOM = 5
  };

  /// What SetPathModel() takes.
  enum PathModels
  {
    STRAIGHT = 0,
    REFRACTED = 1
  };

  /// What SetPrecision() takes.
  enum Precisions
  {
    SINGLE = 0,
    DOUBLE = 1
  };

  /// What SetDevice() takes; AUTO is CUDA where there is a GPU that can be used.
  enum Devices
  {
    AUTO = 0,
    CPU = 1,
    CUDA = 2
  };

  ///@{
  /// Returns the image, or the output of another port.
  vtkImageData* GetOutput();
  vtkImageData* GetOutput(int port);
  ///@}

  /**
   * Returns the grid of the last image as text. Empty before the first and after a failed one.
   */
  const char* GetGrid() const;

  /**
   * Wavelength of the light in vacuum, nanometres, for the medium and for interferograms. Default: 632.8.
   */
  void SetWavelength(double wavelength) override;

  ///@{
  /**
   * Metres per unit of the data's coordinates. Default: 1. An error where it is not positive.
   */
  vtkSetMacro(LengthScale, double);
  vtkGetMacro(LengthScale, double);
  ///@}

  ///@{
  /**
   * Ambient refractivity n - 1. Up to -1, which is the default and no refractivity: the median over
   * the domain's boundary, found for the first image and kept at all other times, so that all
   * fringes of a series refer to the same light. It is found again for other data or another
   * medium. LockedAmbient is the ambient kept from an earlier image, else 0; setting it (as state
   * files do) sets that of the next image, where 0 means that it is found.
   */
  vtkSetMacro(AmbientRefractivity, double);
  vtkGetMacro(AmbientRefractivity, double);
  void SetLockedAmbient(double ambient);
  double GetLockedAmbient() const;
  ///@}

  ///@{
  /**
   * The gas that light enters where it leaves the data, through a plane window across the line of
   * sight that conserves n sin(angle) (Snell). One of Exits: EXIT_AIR (n - 1 = 2.718e-4);
   * EXIT_CUSTOM (ExitRefractivity, n - 1, above -1; default: 2.7e-4); EXIT_SURROUNDINGS: no
   * window, angles are those in the data; EXIT_AUTO (the default): air if the ambient is a liquid,
   * n - 1 > 0.1, with one warning; a window to the surroundings if these are a gas but n - 1
   * exceeds 0.1 in the data; else EXIT_SURROUNDINGS. Deflections, screens and patterns are those
   * behind the window; totally reflected light is lost.
   */
  vtkSetClampMacro(ExitInto, int, EXIT_AUTO, EXIT_CUSTOM);
  vtkGetMacro(ExitInto, int);
  vtkSetMacro(ExitRefractivity, double);
  vtkGetMacro(ExitRefractivity, double);
  ///@}

  ///@{
  /**
   * Direction of view, as in vtkCamera, opposite to the light. Any length but 0. Default: (0, 0,
   * -1); see FaceFlatData.
   */
  vtkSetVector3Macro(ViewDirection, double);
  vtkGetVector3Macro(ViewDirection, double);
  ///@}

  ///@{
  /**
   * Upward direction of the image; not parallel to ViewDirection. Default: (0, 1, 0).
   */
  vtkSetVector3Macro(ViewUp, double);
  vtkGetVector3Macro(ViewUp, double);
  ///@}

  ///@{
  /**
   * Whether 2-D data in a plane along z (also the section that Symmetry revolves) are viewed
   * face-on instead of along their plane if ViewDirection is the default (0, 0, -1): then along y,
   * or against x, with z up unless ViewUp is changed. Default: on.
   */
  vtkSetMacro(FaceFlatData, bool);
  vtkGetMacro(FaceFlatData, bool);
  vtkBooleanMacro(FaceFlatData, bool);
  ///@}

  ///@{
  /**
   * Point at the centre of the image, data units. By default, and after ClearFocalPoint(), the
   * data's centre; GetFocalPoint() then returns an unused value.
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
   * Half the height of the image in the focal plane, data units; 0 (the default) fits the data.
   */
  vtkSetMacro(ParallelScale, double);
  vtkGetMacro(ParallelScale, double);
  ///@}

  ///@{
  /**
   * Vertical angle of view, degrees, less than 170; 0 (the default): parallel light. Otherwise
   * light diverges from a point source in the camera's pupil through the flow, so that each pixel
   * has its own direction, as in a perspective vtkCamera. Data behind the camera are ignored.
   * Light stays parallel in 2-D data, whose depth is artificial.
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
   * The cutoff, one of Cutoffs. With the deflection eps, its component e along KnifeEdgeAngle and
   * the sensitivity k, the intensity, clamped to 0 ... 1, is
   * - KNIFE_EDGE (the default): 1/2 - offset + k e;
   * - SHADOWGRAPH: 1, so that the image shows only where light lands on a screen;
   * - CIRCULAR: 1 - k |eps|, inverse of a dark field; CIRCULAR_COMPLEMENT: k |eps|;
   * - GRADED_FILTER: GradedFilter at 1/2 - offset + k e;
   * - COLOR_FILTER: the colour at k eps in ColorFilterImage, or in a colour wheel;
   * - INTERFEROGRAM: (1 + cos(2 pi OPD / wavelength + carrier)) / 2;
   * - BACKGROUND_ORIENTED: a camera's image of a pattern behind the flow;
   * - NUMERICAL_SCHLIEREN: exp(-5 k |eps|), common for computed flows, but no stop of a bench;
   * - PHASE_CONTRAST: 1 + 2 phi of a small phase phi, by a plate (PhasePlateDelay) that the
   *   undisturbed light passes; of waves alone, see LightModel.
   */
  virtual void SetCutoff(int cutoff);
  vtkGetMacro(Cutoff, int);
  ///@}

  ///@{
  /**
   * Return whether a cutoff has a sensitivity k; a straight edge with an angle, an offset and an
   * inverse; fringes; a screen behind the flow, or a pattern; and, with these settings, colours of
   * its own. False for invalid numbers.
   */
  static bool CutoffHasK(int cutoff);
  static bool CutoffHasEdge(int cutoff);
  static bool CutoffHasFringes(int cutoff);
  static bool CutoffHasScreen(int cutoff);
  static bool CutoffHasBackground(int cutoff);
  static bool CutoffHasColor(int cutoff, bool whiteLight, int backgroundPattern);
  bool HasOwnColor() const;
  ///@}

  /**
   * Return the light that is shown as white: 2 for a cutoff whose undisturbed light is 1 and becomes
   * more and less than that, as a shadowgraph's, else 1.
   */
  static double CutoffWhite(int cutoff);

  ///@{
  /**
   * Direction of the deflection that the knife edge and the graded filter measure, degrees: 0 (the
   * default) is u, 90 is v.
   */
  vtkSetMacro(KnifeEdgeAngle, double);
  vtkGetMacro(KnifeEdgeAngle, double);
  ///@}

  ///@{
  /**
   * Advance of the knife edge or graded filter from the middle of the source's image, as a
   * fraction of the image's width, which is also the loss of undisturbed light. Default: 0. With
   * KFromOptics, CutoffPosition is used instead.
   */
  vtkSetMacro(CutoffOffset, double);
  vtkGetMacro(CutoffOffset, double);
  ///@}

  ///@{
  /**
   * Whether the knife edge or graded filter is reversed: I becomes 1 - I; or the phase plate, see
   * PhasePlateDiameter. Default: off.
   */
  vtkSetMacro(InvertCutoff, bool);
  vtkGetMacro(InvertCutoff, bool);
  vtkBooleanMacro(InvertCutoff, bool);
  ///@}

  ///@{
  /**
   * Whether k is chosen so that the 99th percentile of the deflections is full scale. It is
   * limited by the error of the medium's voxels if little flow is in view. Default: on.
   */
  vtkSetMacro(AutoKScale, bool);
  vtkGetMacro(AutoKScale, bool);
  vtkBooleanMacro(AutoKScale, bool);
  ///@}

  ///@{
  /**
   * How long an automatic k is kept, one of LockModes. It is found for the first image and then
   * - LOCK_OFF: for each image;
   * - LOCK_OVER_TIME (the default): kept at all other times, whatever changes with the time, such
   *   as the camera of an animation. Found again if camera, light or quality change at the time
   *   that it was found for, and for data without time steps;
   * - LOCK_ALWAYS: kept even if camera, light or quality change.
   *
   * In each mode it is found again if the settings of the medium, the kind of cutoff or, at the
   * same time, the data change. Images in between without an automatic k do not count.
   */
  vtkSetClampMacro(LockK, int, LOCK_OFF, LOCK_ALWAYS);
  vtkGetMacro(LockK, int);
  ///@}

  ///@{
  /**
   * The k kept from an earlier image by LockK, else 0. Setting it (as state files do) sets the k
   * of the next image, which LockK then keeps; 0 means automatic.
   */
  void SetLockedK(double k);
  double GetLockedK() const;
  ///@}

  /**
   * Finds k again for the next image, whatever LockK has kept.
   */
  void FitK() { this->SetLockedK(0); }

  /**
   * Finds one k for a series: makes an image with one ray per pixel of each time step, of MOST_STEPS evenly spread ones
   * with the first and the last where there are more, and keeps the smallest of their automatic k, that of the largest
   * deflections: no image exceeds full scale then by more than an image with its own k. LockK, which must not be
   * LOCK_OFF, says how long it is kept. Reports progress; aborted, it changes nothing. An error where the data have no
   * time steps or k is not automatic. The output is that of the last update until the next one.
   */
  void FitKOverSeries();
  static constexpr int MOST_STEPS = 100; ///< of FitKOverSeries()

  ///@{
  /**
   * Sensitivity k, used if AutoKScale is off: focal length / source width; the intensity at a
   * knife edge is 1/2 + k times the deflection. Not negative. Default: 1000.
   */
  vtkSetMacro(KScale, double);
  vtkGetMacro(KScale, double);
  ///@}

  ///@{
  /**
   * Whether real optics give sensitivity and offset, instead of AutoKScale, KScale and
   * CutoffOffset: k = FocalLength / SourceWidth, offset = CutoffPosition / SourceWidth. Default:
   * off.
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
   * Size of the source's image at the cutoff, millimetres: its width across the knife edge, or a
   * disc's diameter (default: 1), and a slit's length along the knife edge (default: 10). Not
   * negative; for KFromOptics, the width is positive. Seen from the data, the source has the
   * angular size width / FocalLength.
   */
  vtkSetMacro(SourceWidth, double);
  vtkGetMacro(SourceWidth, double);
  vtkSetMacro(SourceLength, double);
  vtkGetMacro(SourceLength, double);
  ///@}

  ///@{
  /**
   * Advance of the edge into the source's image, millimetres, for KFromOptics. Default: 0.
   */
  vtkSetMacro(CutoffPosition, double);
  vtkGetMacro(CutoffPosition, double);
  ///@}

  ///@{
  /**
   * Returns the k of the last image; 0 before the first, after errors, and without a cutoff.
   */
  vtkGetMacro(KScaleUsed, double);
  ///@}

  /**
   * Returns a text about the last image's sensitivity: k, the full-scale deflection and equivalent
   * optics; of an interferogram, its wavelength. Empty where there is none.
   */
  const char* GetSensitivity() const { return this->Sensitivity.c_str(); }

  ///@{
  /**
   * Transmission, 0 to 1, of the GRADED_FILTER across its width, 0 to 1; undisturbed light passes
   * the middle. Null (the default) or without points: a line from 0 to 1. Sampled at 1025 points.
   */
  virtual void SetGradedFilter(vtkPiecewiseFunction* function);
  vtkPiecewiseFunction* GetGradedFilter() const;
  ///@}

  ///@{
  /**
   * Image of the COLOR_FILTER, in sRGB, which spans -1 to 1 of k times the deflection along both
   * axes: the name of a PNG file, or its content as text: "data:image/png;base64,..." (RFC 2397).
   * May be grey, 16-bit or transparent (blended with white). Empty (the default): a colour wheel
   * with the deflection's direction as hue, red along u, and its size as saturation, full at k
   * |eps| = 1.
   */
  vtkSetStdStringFromCharMacro(ColorFilterImage);
  vtkGetCharFromStdStringMacro(ColorFilterImage);
  ///@}

  ///@{
  /**
   * Fringes of an interferogram. FringeSpacing 0, the default: they are infinite, undisturbed light
   * is bright everywhere. Otherwise a tilted reference beam adds straight fringes, so far apart
   * (data units on the film; negative: so many are in the image's height) along FringeAngle
   * (degrees; 0, the default, is u, 90 is v), as a background's stripes are. Beams that cross at an angle have the spacing
   * wavelength / (2 sin(angle / 2)).
   */
  vtkSetMacro(FringeSpacing, double);
  vtkGetMacro(FringeSpacing, double);
  vtkSetMacro(FringeAngle, double);
  vtkGetMacro(FringeAngle, double);
  ///@}

  ///@{
  /**
   * Whether an interferogram uses white light, whose visible fringes are in `Color`. The medium
   * disperses as Gas, BackgroundGas or moist air, whichever IndexModel uses; a gas given
   * by its constant does not disperse. Default: off.
   */
  vtkSetMacro(WhiteLight, bool);
  vtkGetMacro(WhiteLight, bool);
  vtkBooleanMacro(WhiteLight, bool);
  ///@}

  ///@{
  /**
   * The plane in focus for all cutoffs but SHADOWGRAPH: distance towards the viewer from the
   * middle of the data or, with a ViewAngle, from the focal point, data units. Default: 0.
   */
  vtkSetMacro(FocusOffset, double);
  vtkGetMacro(FocusOffset, double);
  ///@}

  ///@{
  /**
   * Light diverges from a point at this distance before the middle of the data (data units,
   * outside of the data); 0, the default: it is collimated. Ignored with a ViewAngle, where light
   * diverges from the pupil.
   */
  vtkSetMacro(SourceDistance, double);
  vtkGetMacro(SourceDistance, double);
  ///@}

  ///@{
  /**
   * Shape of the source, one of SourceShapes: a POINT (the default), or a SLIT or DISC of
   * SourceWidth and SourceLength, which blurs what is out of focus and softens a knife edge.
   */
  vtkSetClampMacro(SourceShape, int, POINT, DISC);
  vtkGetMacro(SourceShape, int);
  ///@}

  ///@{
  /**
   * How light continues behind the flow, one of LightModels: as rays (LIGHT_RAYS, the default), or
   * as waves of Wavelength (LIGHT_WAVES), for SHADOWGRAPH and, with collimated light, KNIFE_EDGE,
   * CIRCULAR, CIRCULAR_COMPLEMENT, GRADED_FILTER, PHASE_CONTRAST and INTERFEROGRAM without
   * WhiteLight; other settings are errors then. Light may diverge by 0.1 at most. LIGHT_AUTO: of a
   * shadowgraph waves where the width of a pixel and the source's image on the screen is less than
   * four Fresnel widths, sqrt(wavelength distance), and waves can be made; of PHASE_CONTRAST waves.
   * Waves replace Intensity alone; all other arrays remain those of rays.
   */
  vtkSetClampMacro(LightModel, int, LIGHT_RAYS, LIGHT_AUTO);
  vtkGetMacro(LightModel, int);
  ///@}

  ///@{
  /**
   * Full width of the even spectrum of waves around Wavelength, nanometres, 0 or more. Default: 0,
   * one wavelength.
   */
  vtkSetClampMacro(Bandwidth, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Bandwidth, double);
  ///@}

  ///@{
  /**
   * The plate of PHASE_CONTRAST, a disc in the plane where undisturbed light is a point: its
   * diameter in millimetres, with FocalLength (default: 0, which undisturbed light alone passes),
   * by how many waves it delays light (default: 0.25; -0.25 makes dark what 0.25 makes bright) and
   * the fraction of light that it transmits, 0 to 1 (default: 1; 0 is an opaque stop). With
   * InvertCutoff the plate is all around the disc instead; an opaque one is an aperture then.
   */
  vtkSetClampMacro(PhasePlateDiameter, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(PhasePlateDiameter, double);
  vtkSetMacro(PhasePlateDelay, double);
  vtkGetMacro(PhasePlateDelay, double);
  vtkSetClampMacro(PhasePlateTransmission, double, 0, 1);
  vtkGetMacro(PhasePlateTransmission, double);
  ///@}

  ///@{
  /**
   * The pattern of BACKGROUND_ORIENTED, one of BackgroundPatterns (default: DOTS):
   * BackgroundDistance behind the side of the data where light enters (data units; negative, the
   * default: one data depth); dots and stripes BackgroundPeriod apart (data units; 0, the default:
   * eight pixels; they fade below four and vanish at two), which stand in the world: a bright stripe
   * and a corner of dots' cells are where u = v = 0; stripes along FringeAngle; PICTURE: BackgroundImage, given as ColorFilterImage is; SCENE:
   * that of SetBackgroundScene().
   */
  vtkSetClampMacro(BackgroundPattern, int, DOTS, SCENE);
  vtkGetMacro(BackgroundPattern, int);
  vtkSetMacro(BackgroundDistance, double);
  vtkGetMacro(BackgroundDistance, double);
  vtkSetMacro(BackgroundPeriod, double);
  vtkGetMacro(BackgroundPeriod, double);
  vtkSetStdStringFromCharMacro(BackgroundImage);
  vtkGetCharFromStdStringMacro(BackgroundImage);
  ///@}

  /**
   * Sets the image that the camera sees behind the flow, for BACKGROUND_ORIENTED with SCENE: RGB
   * bytes as on a screen, stretched over the image. `distance` is used if BackgroundDistance is
   * negative; negative: one data depth. Null (the default): images with this pattern fail.
   */
  void SetBackgroundScene(vtkImageData* image, double distance);

  ///@{
  /**
   * The lens of the camera, for BACKGROUND_ORIENTED and for all images with a ViewAngle: its focal
   * length over its aperture (0, the default: a pinhole, everything is in focus), its focal length
   * (LensFocalLength, millimetres, positive; default: 50) and the distance from the camera to what
   * is in focus (FocusDistance, data units, with a ViewAngle; 0, the default: BACKGROUND_ORIENTED
   * the pattern, others what FocusOffset says). Each sample of a pixel sees one point of the
   * aperture: something w wide that is blurred over d takes 10 d / w SamplesPerPixel for an error
   * of a hundredth. Without a ViewAngle the lens is telecentric and focuses on the pattern.
   * SensorWidth (millimetres; 0, the default: off) sets the ViewAngle to that of a sensor this wide
   * behind the lens.
   */
  vtkSetMacro(FNumber, double);
  vtkGetMacro(FNumber, double);
  vtkSetMacro(LensFocalLength, double);
  vtkGetMacro(LensFocalLength, double);
  vtkSetMacro(FocusDistance, double);
  vtkGetMacro(FocusDistance, double);
  vtkSetMacro(SensorWidth, double);
  vtkGetMacro(SensorWidth, double);
  ///@}

  /**
   * Sets the pupil of a view's camera instead of FNumber and FocusDistance: its diameter and the
   * distance of what is in focus, data units. `diameter` 0 (the default): there is none.
   */
  void SetPupil(double diameter, double focusDistance);

  ///@{
  /**
   * The camera's sensor, which makes the array `Recorded` of `Intensity`, and `RecordedBackground`
   * of `Background`: electrons that a pixel can hold (FullWell; 0, the default: no sensor), how
   * much of them light 1 fills (Exposure, positive; default: 0.8), the standard deviation of what
   * reading adds (ReadNoise, electrons; default: 10), the exponent of its curve (Gamma, positive;
   * default: 1, linear) and the bits of its values (BitDepth, 1 to 16; default: 8). The value is
   * (electrons / FullWell) ^ (1 / Gamma) of the full scale.
   */
  vtkSetMacro(FullWell, double);
  vtkGetMacro(FullWell, double);
  vtkSetMacro(Exposure, double);
  vtkGetMacro(Exposure, double);
  vtkSetMacro(ReadNoise, double);
  vtkGetMacro(ReadNoise, double);
  vtkSetMacro(Gamma, double);
  vtkGetMacro(Gamma, double);
  vtkSetClampMacro(BitDepth, int, 1, 16);
  vtkGetMacro(BitDepth, int);
  ///@}

  ///@{
  /**
   * Distance of a shadowgraph's screen from the plane where light leaves the data, data units.
   * Negative (default: -1): one data depth.
   */
  vtkSetMacro(ScreenDistance, double);
  vtkGetMacro(ScreenDistance, double);
  ///@}

  ///@{
  /**
   * Whether the Fields tint the image, with any IndexModel (after Brownlee et al. 2011, sec. 8).
   * Along its path, light accumulates g_i = integral |grad f_i| ds of each field f_i (relative to
   * its range, 0 to 1; with TRANSFER_FUNCTIONS, the function's value). Its colour is 1 + s (sum
   * g_i c_i / G - 1), where G = sum g_i, c_i are the FieldColors, and the strength s is G over its
   * 99th percentile in the image, at most 1. In meshes, voxels also resolve the fields: see
   * MediumTolerance. Default: off.
   */
  vtkSetMacro(ColorByField, bool);
  vtkGetMacro(ColorByField, bool);
  vtkBooleanMacro(ColorByField, bool);
  ///@}

  ///@{
  /**
   * Colours of the fields: red, green and blue, 0 to 1. Empty (the default): distinct hues.
   */
  virtual void AddFieldColor(double value);
  virtual void ClearFieldColors();
  VTK_WRAPEXCLUDE const std::vector<double>& GetFieldColors() const { return this->FieldColors; }
  ///@}

  ///@{
  /**
   * Preset of accuracy and speed, one of Qualities. Setting it sets the properties that
   * GetQualitySetting() lists; CUSTOM sets none. Getting it returns the preset whose values the
   * properties have, or CUSTOM. Default: INTERACTIVE, whose values are the properties' defaults.
   */
  virtual void SetQuality(int quality);
  virtual int GetQuality();
  ///@}

  ///@{
  /**
   * Return the names of the properties that Quality sets, from number 0 on, null after the last;
   * and their values in a preset, 0 for invalid numbers.
   */
  static const char* GetQualitySetting(int number);
  static double GetQualityValue(int quality, int number);
  ///@}

  ///@{
  /**
   * Return what has been measured of a preset on four flows (quality.md): the error that 99 % of the
   * pixels keep with a cutoff, in the unit of TargetError, and the time for another view, relative to
   * INTERACTIVE. 0: not known, of REFERENCE, AUTOMATIC and CUSTOM.
   */
  static double GetQualityError(int quality, int cutoff);
  static double GetQualityTime(int quality);
  ///@}

  ///@{
  /**
   * Path of the light, one of PathModels: REFRACTED rays bend; STRAIGHT rays integrate along the
   * undisturbed line of sight. Where the index changes by more than a twentieth in a step, as at a
   * face of glass, the steps of refracted rays are adaptive. A warning reports a MomentumDrift above
   * 1 % and its position.
   */
  vtkSetClampMacro(PathModel, int, STRAIGHT, REFRACTED);
  vtkGetMacro(PathModel, int);
  ///@}

  ///@{
  /**
   * Length of an integration step, voxels; of adaptive ones its maximum. 0.001 (SINGLE: 0.01) to 16.
   * Up to 1, and with a target error, cubic splines through the samples are traced through, else
   * quadratic ones.
   */
  vtkSetMacro(StepSize, double);
  vtkGetMacro(StepSize, double);
  ///@}

  ///@{
  /**
   * Rays cross a block of cells in one step if n - 1 varies in it by at most this fraction of its
   * range in the whole medium. 0 (no skipping) to 1. SkippingBound bounds the error.
   */
  vtkSetMacro(HomogeneityTolerance, double);
  vtkGetMacro(HomogeneityTolerance, double);
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
   * Floating-point precision of tracing, one of Precisions. With DOUBLE and no target error, the
   * steps of refracted rays are adaptive.
   */
  virtual void SetPrecision(int precision);
  vtkGetMacro(Precision, int);
  ///@}

  ///@{
  /**
   * Error of the deflection due to the voxel size in meshes, relative to the maximum deflection;
   * with ColorByField also that of G, relative to its 99th percentile. 0: voxels as fine as the
   * mesh. 0 to 1.
   */
  vtkSetMacro(MediumTolerance, double);
  vtkGetMacro(MediumTolerance, double);
  ///@}

  ///@{
  /**
   * Error that 99 % of the pixels whose light crosses the data shall keep, in the unit that the image
   * is read in: of an interferogram fringes; with Background Oriented pixels of displacement; else a
   * fraction of full scale, of a shadowgraph of the undisturbed light (what light displaced by 0.05
   * pixels explains does not count). Negative: what cannot be seen, 0.02 fringes or pixels, else
   * 0.004. 0, the default: off. It chooses StepSize, SamplesPerPixel (up to 64), MediumTolerance
   * (0.01 to 0.0003), HomogeneityTolerance (0), cubic splines and
   * Precision, whatever these properties are, by tracing some thousand pixels with several settings,
   * and verifies its choice with others. The image's field data say what is reached: ErrorReached,
   * ErrorLargest (of the pixels that were traced) and ErrorLimit, what contributes most. ErrorReached
   * above TargetError: it cannot be kept, as Status says.
   */
  vtkSetMacro(TargetError, double);
  vtkGetMacro(TargetError, double);
  ///@}

  ///@{
  /**
   * Whether an image with a TargetError has the array `ErrorEstimate` (float): the error of each pixel,
   * in the unit of TargetError; 0 where its light does not cross the data. Default: off. All pixels are then made with
   * finer settings, too, which takes several times as long as the image.
   */
  vtkSetMacro(ErrorEstimate, bool);
  vtkGetMacro(ErrorEstimate, bool);
  vtkBooleanMacro(ErrorEstimate, bool);
  ///@}

  ///@{
  /**
   * Memory for a mesh's voxels, MiB. Default: 1024. If it does not suffice, MediumTolerance is not
   * met, and the field data MediumError report the error (the larger of both). MediumError is the
   * maximum over rays through many leaves, so it may be about twice MediumTolerance even with
   * enough memory.
   */
  vtkSetClampMacro(MediumMemory, int, 1, VTK_INT_MAX);
  vtkGetMacro(MediumMemory, int);
  ///@}

  ///@{
  /**
   * Smooths the image by a Gaussian with a standard deviation of half this radius, pixels, up to
   * 32; 0, the default: not at all.
   */
  vtkSetMacro(SmoothingRadius, double);
  vtkGetMacro(SmoothingRadius, double);
  ///@}

  ///@{
  /**
   * Device, one of Devices: AUTO (the default) uses CUDA if available, else the CPU; CUDA without
   * a device is an error.
   */
  vtkSetClampMacro(Device, int, AUTO, CUDA);
  vtkGetMacro(Device, int);
  ///@}

  ///@{
  /**
   * Threads on the CPU; 0 (the default): VTK_SMP_MAX_THREADS if set, else the cores that this
   * process may use. The image does not depend on it.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);

  ///@{
  /**
   * Maximum number of cells of a mesh whose pieces are gathered on rank 0 when ParaView runs as
   * several processes. The pieces of larger meshes stay on their ranks, with ghost cells; so do
   * those of images with more than 160 times as many cells, which become a tree of bricks. 0: none
   * are gathered. Adaptive meshes and 2-D data are always gathered. Default: 10^6.
   */
  vtkSetClampMacro(GatherLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(GatherLimit, int);
  ///@}
  ///@}

  ///@{
  /**
   * Count what this filter has done since it was made: media built and rays traced. Updates that use earlier results add nothing.
   */
  vtkTypeInt64 GetMediumBuilds();
  vtkTypeInt64 GetTotalRaysTraced();
  ///@}

  ///@{
  /**
   * Pixels of the full image, along each axis, for each pixel of a preview: 2 gives the same view
   * with half as many columns and rows. Previews have one ray per pixel, whatever SamplesPerPixel
   * is, and steps no shorter than those of INTERACTIVE. For interaction with a view. Default: 1.
   */
  vtkSetClampMacro(PreviewReduction, int, 1, 64);
  vtkGetMacro(PreviewReduction, int);
  ///@}

  ///@{
  /**
   * Time that an update may spend on rays and light, seconds, approximately; 0 (the default): no
   * limit. After that, the output is the image of the completed samples or, if some pixel has
   * none, the previous image, stretched to the new size (of a new filter: a preview). Refine()
   * works for as long again and, if it has completed samples, lets the next update show them; it
   * also begins an image if only properties of this filter have changed. Without a limit it lets
   * the next update finish the image. GetFinished() returns whether nothing remains to be done.
   * Each call makes some progress, and the finished image equals the one without a limit to the
   * last bit. Changing the limit keeps the image. Making the medium is not limited, and progress
   * is not reported.
   */
  void SetTimeLimit(double seconds) { this->TimeLimit = seconds; }
  vtkGetMacro(TimeLimit, double);
  void Refine();
  bool GetFinished();
  ///@}

  ///@{
  /**
   * Stops an unfinished image, which counts as finished until Refine() resumes it or something
   * changes the image. Aborting an update with a TimeLimit while it computes the refractivity, or
   * any that has called Stop() by then, also stops it, with an empty output: else the next update
   * makes the image anew. GetStopped() returns whether that is so.
   */
  void Stop();
  bool GetStopped();
  ///@}

  /**
   * Returns whether the last update has made an image, which rank 0 has: the same on all ranks.
   */
  bool GetHasImage();

  /**
   * Returns the completed fraction of the image, per cent; 100 only for a finished one.
   */
  int GetPercentDone();

  /**
   * Counts the different images of this filter, including one that Refine() has made for the next
   * update. Unchanged where a step had nothing new to show.
   */
  vtkTypeInt64 GetPictureCount() const;

  /**
   * Returns a text about the last image, in one line: samples per pixel; rays per second of the
   * last tracing; device; path model. Empty before the first image; after a failure, "No image: " and why.
   */
  const char* GetStatus() const { return this->Status.c_str(); }

  ///@{
  /**
   * What the image has at a place, fractions of its width and height from the lower left, in words: position, deflection,
   * optical path difference and intensity. Empty beside the image. The place is no setting of the image.
   */
  void SetProbedPlace(double right, double up);
  const char* GetProbedPlace();
  ///@}

  /// Returns all properties that are numbers and texts.
  VTK_WRAPEXCLUDE const SchlierenSettings& GetSettings() const { return *this; }

  /// Requests the same data of an input (all, a piece or nothing) as this filter does, so that
  /// filters with the same input do not cause another update.
  VTK_WRAPEXCLUDE void RequestSame(vtkInformation* inInfo);

  vtkMTimeType GetMTime() override;

  /// Returns the maker of the medium, with the current settings.
  VTK_WRAPEXCLUDE filters::MediumMaker& GetMaker() override;

  /**
   * Makes the next RequestData() treat this rank as one without input, because something upstream
   * has failed; see vtkSchlierenPipeline.
   */
  VTK_WRAPEXCLUDE void LackInput();

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

protected:
  vtkSchlierenFilter();
  ~vtkSchlierenFilter() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bool ReportMedium(double done) override;
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

  /// Makes the image on rank 0, or leaves the outputs empty where that is aborted. Throws what is reported by Fail().
  void MakeImage(double maxCells, vtkInformationVector* outputs);
  /// Puts the image that was made last on the outputs.
  void ShowLast(vtkInformationVector* outputs);
  /// Returns what is read of the data, chosen once in an update.
  const filters::Choice& Chosen(vtkDataObject* input);
  /// Updates the refractivity. Returns false if aborted.
  bool UpdateRefractivity(vtkDataObject* input, vtkDataObject* bodies);
  /// Returns the refractivity of another filter, or a new one; null if aborted.
  std::shared_ptr<const MadeRefractivity> FindOrMakeRefractivity(
    vtkDataObject* input, vtkDataObject* bodies, const std::vector<double>& description);
  /// Returns null if aborted.
  std::shared_ptr<const MadeRefractivity> MakeRefractivity(
    vtkDataObject* input, vtkDataObject* bodies);
  /// Makes the ranks work for this filter's refractivity, which another filter may have used.
  /// Returns false where they cannot.
  bool UseOwnRanks();
  /// Finds the gradients of the fields that tint, if needed.
  void UpdateFieldGradients(vtkDataObject* input);
  /// Return the newest time of all properties but Refine(), and of these and upstream.
  vtkMTimeType GetTimeOfProperties();
  vtkMTimeType GetTimeOfImage();
  /// Returns whether an update only resumes the unfinished image.
  bool Continues(vtkDataObject* input, vtkDataObject* bodies);
  /// Returns the maximum number of cells that rank 0 gathers.
  double MostGathered();
  /// Returns everything of the inputs that the refractivity depends on.
  std::vector<double> DescribeInputs(vtkDataObject* input, vtkDataObject* bodies);
  /// Returns whether an image's own grid would exceed MediumMemory; it then becomes a tree.
  bool IsLargeImage(vtkDataObject* input) const;
  /// Describes inputs that stay on their ranks, equal for all filters with the same data.
  std::vector<double> DescribePieces(vtkDataObject* input, vtkDataObject* bodies);
  /// Works on an image between updates. Returns whether an update has something to do now.
  bool WorkOn();
  /// Refines the image on rank 0. Returns whether the next update has more to show.
  bool RefineOnRank0();
  /// Returns whether a new image can begin between updates. `now`: GetTimeOfImage().
  bool CanBegin(vtkMTimeType now);
  /// Return the automatic k and ambient refractivity kept from an earlier image; unset: none.
  std::optional<double> KeptK();
  std::optional<double> KeptAmbient();
  filters::ImageCircumstances CircumstancesOf(std::vector<double> medium, std::vector<double> rays);
  schlieren::Image Begin(bool isPreview, double seconds, const schlieren::Monitor& monitor);
  /// Passes what was found for the last image to the locks.
  void KeepFound(const schlieren::Image& image);
  /// Reports the progress of the image.
  void Progress(double fraction);
  /// Makes the image from the refractivity, or resumes it. Returns false if aborted.
  bool Render(vtkImageData* output, vtkImageData* histogram, bool continues);
  /// Outputs an image, if anything in it is new. Returns false if aborted.
  bool Show(schlieren::Image&& image, vtkImageData* output, vtkImageData* histogram);
  void ForgetImage();
  /// Reports a problem of the inputs and properties at time `now`, and empties the outputs.
  void Fail(const std::string& problem, vtkMTimeType now, vtkInformationVector* outputs);

  std::unique_ptr<Internals> Inside;

  vtkSmartPointer<vtkPiecewiseFunction> GradedFilter;
  double KScaleUsed = 0;
  std::string Sensitivity;
  vtkTypeInt64 PictureCount = 0;
  std::string Status;
  double ProbedPlace[2] = { -1, -1 };
  std::string Probed;
};

#endif
