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
 *   COLOR_FILTER or a background's PICTURE;
 * - `Deflection` (3 floats): direction cosines along u and v of the emerging light; light bends
 *   towards higher index;
 * - `OpticalPathDifference` (double): metres, relative to undisturbed light;
 * - `Displacement` (3 floats): lateral, in the plane where light leaves the data, data units;
 * - `BlockedFraction` (float): fraction of the pixel's rays that a solid stopped;
 * - `ErrorEstimate` (float), with ErrorEstimate: the pixel's error;
 * - `Background` (float) and `BackgroundDisplacement` (3 floats, data units), with
 *   BACKGROUND_ORIENTED only: the image without the flow, and the point of the pattern that is
 *   seen, less that without the flow (the image has moved in the opposite direction); with an
 *   FNumber, this and the rays' other arrays are means over the aperture.
 *
 * Field data: `AxisRight` and `AxisUp` (u and v), `Device`, `PathModel` (`Straight` or `Refracted`),
 * `KScale` (the k used), `UndisturbedLevel` (intensity of undisturbed light), `SaturatedShare`
 * (fraction of the rays at the cutoff's darkest or brightest level), `LightEmitted`, `LightOnFilm`
 * and `LightOutside` (behind the cutoff, in units of full light of all pixels; the first is the sum
 * of the others), `PatternPixel` (with BACKGROUND_ORIENTED: the side of a pixel where the pattern is, data units),
 * `FringeSpacing` (data units) and `FringeAngle` (degrees) of finite fringes, `Wavelength` (metres, of an INTERFEROGRAM),
 * `AmbientRefractivity` and `ExitRefractivity`
 * (the values used), `RaysTraced`, `RaysLost` (trapped in the medium, turned back by it, or totally
 * reflected at the exit), `StepsTaken` (of all rays), `TraceSeconds` (0 without tracing), and the
 * accuracy: `MomentumDrift` (maximum relative error of |p| = n at the exit of refracted rays; else 0). For a
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
 * The properties of the medium are those of vtkFlowAlgorithm; Documentation/properties.md says more about all of them.
 * Results are kept until something that they depend on changes: another cutoff, k or knife angle needs no re-tracing, and
 * another view keeps the medium.
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
#include <array>      // for std::array
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

  /// The image, and the histogram of the cutoff plane.
  enum OutputPorts
  {
    IMAGE_PORT = 0,
    HISTOGRAM_PORT = 1
  };

  // values: Quality
  /// Values of Quality.
  enum Qualities
  {
    INTERACTIVE = 0,
    FINE = 1,
    PUBLICATION = 2,
    REFERENCE = 3,
    AUTOMATIC = 4,
    CUSTOM = 5
  };

  // end

  ///@{
  /// Returns the image, or the output of another port.
  vtkImageData* GetOutput() { return this->GetOutput(IMAGE_PORT); }
  vtkImageData* GetOutput(int port);
  ///@}

  /// Returns the grid of the last image as text. Empty before the first and after a failed one.
  const char* GetGrid() const;

  /// Returns the bounds of the last medium, data units: those of the data, unless these are revolved or extruded; without
  /// a medium they are not initialized.
  void GetMediumBounds(double bounds[6]) const;

  // setters: rest
  /// Values of Symmetry.
  enum Symmetries
  {
    SYMMETRY_AUTO = -1,
    SYMMETRY_NONE = 0,
    SYMMETRY_AXISYMMETRIC = 1
  };

  /// What 2-D data are a section of. Default: Auto.
  vtkSetClampMacro(Symmetry, int, SYMMETRY_AUTO, SYMMETRY_AXISYMMETRIC);
  vtkGetMacro(Symmetry, int);

  /// Values of SymmetryAxis.
  enum SymmetryAxes
  {
    AXIS_AUTO = 0,
    AXIS_X = 1,
    AXIS_Y = 2,
    AXIS_Z = 3
  };

  /// The direction of the axis of symmetry. Default: Auto.
  vtkSetClampMacro(SymmetryAxis, int, AXIS_AUTO, AXIS_Z);
  vtkGetMacro(SymmetryAxis, int);

  /// A point of the axis of symmetry. Default: 0 0 0.
  vtkSetVector3Macro(SymmetryOrigin, double);
  vtkGetVector3Macro(SymmetryOrigin, double);

  /// Metres per unit of the data's coordinates; 0.001 for data in millimetres. Default: 1.
  vtkSetMacro(LengthScale, double);
  vtkGetMacro(LengthScale, double);

  /// Refractivity n - 1 of the surroundings; air at room conditions has 2.7e-4. -1: it is found for
  /// the first image, and kept while the time changes, so that the fringes of a series are counted
  /// from the same reference. Default: -1.
  vtkSetMacro(AmbientRefractivity, double);
  vtkGetMacro(AmbientRefractivity, double);

  /// Values of ExitInto.
  enum Exits
  {
    EXIT_AUTO = 0,
    EXIT_SURROUNDINGS = 1,
    EXIT_AIR = 2,
    EXIT_CUSTOM = 3
  };

  /// What light enters where it leaves the data through a plane across the line of sight, the
  /// window of a tank, which refracts it: Air (n - 1 = 2.718e-4), or Custom, of Exit Refractivity.
  /// Default: Auto.
  vtkSetClampMacro(ExitInto, int, EXIT_AUTO, EXIT_CUSTOM);
  vtkGetMacro(ExitInto, int);

  /// Refractivity n - 1 of what light leaves the data into: 2.7e-4 of air, 0.333 of water. Default:
  /// 2.7e-4.
  vtkSetMacro(ExitRefractivity, double);
  vtkGetMacro(ExitRefractivity, double);

  /// The direction of sight, as that of a parallel camera; light travels against it, towards the
  /// viewer. Default: 0 0 -1.
  vtkSetVector3Macro(ViewDirection, double);
  vtkGetVector3Macro(ViewDirection, double);

  /// The direction that points up in the image; not parallel to View Direction. Default: 0 1 0.
  vtkSetVector3Macro(ViewUp, double);
  vtkGetVector3Macro(ViewUp, double);

  /// Half the height of the image in the plane of the focal point, data units; 0: all of the data
  /// is visible. Default: 0.
  vtkSetMacro(ParallelScale, double);
  vtkGetMacro(ParallelScale, double);

  /// Perspective: degrees between the lower and the upper side of the image, seen from the camera;
  /// 0: parallel light, as of a wind tunnel's mirrors. Default: 0.
  vtkSetMacro(ViewAngle, double);
  vtkGetMacro(ViewAngle, double);

  /// Width and height of the image in pixels. 0: so many that the image has the proportions of the
  /// data as they are seen, up to 8 to 1; as many in all as 512 by 512, or by the other side where
  /// that is given. Default: 0 0.
  vtkSetVector2Macro(ImageSize, int);
  vtkGetVector2Macro(ImageSize, int);

  /// Values of Cutoff.
  enum Cutoffs
  {
    KNIFE_EDGE = 0,
    SHADOWGRAPH = 1,
    BRIGHT_FIELD = 2,
    DARK_FIELD = 3,
    GRADED_FILTER = 4,
    COLOR_FILTER = 5,
    INTERFEROGRAM = 6,
    BACKGROUND_ORIENTED = 7,
    NUMERICAL_SCHLIEREN = 8,
    PHASE_CONTRAST = 9
  };

  /// Which deflection the knife edge or the graded filter measures, degrees: 0 for a vertical edge,
  /// where deflection to the right is bright; 90 for a horizontal one, where deflection upwards is
  /// bright; 180 more exchanges bright and dark. Default: 0.
  vtkSetMacro(KnifeEdgeAngle, double);
  vtkGetMacro(KnifeEdgeAngle, double);

  /// Position of the knife edge or the graded filter relative to the middle of the source's image,
  /// as a fraction of its width, of Source Width where K Mode is Bench. Default: 0.
  vtkSetMacro(CutoffOffset, double);
  vtkGetMacro(CutoffOffset, double);

  /// Values of KMode.
  enum KModes
  {
    K_AUTOMATIC = 0,
    K_AUTOMATIC_KEPT = 1,
    K_VALUE = 2,
    K_BENCH = 3
  };

  /// Where the sensitivity k comes from. Default: Automatic Kept.
  vtkSetClampMacro(KMode, int, K_AUTOMATIC, K_BENCH);
  vtkGetMacro(KMode, int);

  /// Sensitivity k of the cutoff, where K Mode is Value: the focal length over the width of the
  /// light source. Default: 1000.
  vtkSetMacro(KScale, double);
  vtkGetMacro(KScale, double);

  /// Focal length of the second mirror, metres; more than 0. Default: 1.
  vtkSetMacro(MirrorFocalLength, double);
  vtkGetMacro(MirrorFocalLength, double);

  /// Width of the source's image at the cutoff, across the knife edge, or diameter of a disc;
  /// millimetres. Default: 1.
  vtkSetMacro(SourceWidth, double);
  vtkGetMacro(SourceWidth, double);

  /// The image of the colour filter, which covers k times the deflection from -1 to 1 along both
  /// axes: the name of a PNG file that the server can read, or the file's content as text,
  /// data:image/png;base64,..., which is stored in state files. Default: none.
  vtkSetStdStringFromCharMacro(ColorFilterImage);
  vtkGetCharFromStdStringMacro(ColorFilterImage);

  /// 0: infinite fringes, undisturbed light is bright everywhere, and fringes follow the optical
  /// path. Default: 0.
  vtkSetMacro(FringeSpacing, double);
  vtkGetMacro(FringeSpacing, double);

  /// Direction from fringe to fringe, and from stripe to stripe of a background, degrees: 0 to the
  /// right, 90 upwards. Default: 0.
  vtkSetMacro(FringeAngle, double);
  vtkGetMacro(FringeAngle, double);

  /// Values of BackgroundPattern.
  enum BackgroundPatterns
  {
    DOTS = 0,
    STRIPES = 1,
    PICTURE = 2
  };

  /// The pattern behind the flow: Dots, Stripes or a Picture, which is Background Image. Default:
  /// Dots.
  vtkSetClampMacro(BackgroundPattern, int, DOTS, PICTURE);
  vtkGetMacro(BackgroundPattern, int);

  /// Distance from where the data begin to the pattern behind them, data units; negative: one data
  /// depth. Default: -1.
  vtkSetMacro(BackgroundDistance, double);
  vtkGetMacro(BackgroundDistance, double);

  /// Distance between dots or stripes, data units; 0: eight pixels. Default: 0.
  vtkSetMacro(BackgroundPeriod, double);
  vtkGetMacro(BackgroundPeriod, double);

  /// The image behind the flow: the name of a PNG file that the server can read, or the file's
  /// content as text, data:image/png;base64,..., which is stored in state files. Default: none.
  vtkSetStdStringFromCharMacro(BackgroundImage);
  vtkGetCharFromStdStringMacro(BackgroundImage);

  /// Of a shadowgraph: distance from the plane where light leaves the data's box to the screen,
  /// data units; negative: automatic, so that 1 % of the light that has crossed the data is darker
  /// or brighter by more than half of undisturbed light, one depth of the box or more. Default: -1.
  vtkSetMacro(ScreenDistance, double);
  vtkGetMacro(ScreenDistance, double);

  /// The plane in focus, except of a shadowgraph: its distance from the middle of the data, with a
  /// perspective from the focal point, towards the viewer, data units. Default: 0.
  vtkSetMacro(FocusOffset, double);
  vtkGetMacro(FocusOffset, double);

  /// The lens of the camera, of Background Oriented and of images with a View Angle: focal length
  /// over aperture; 0: a pinhole, everything is in focus. Default: 0.
  vtkSetMacro(FNumber, double);
  vtkGetMacro(FNumber, double);

  /// Focal length of the camera's lens, millimetres; more than 0. Default: 50.
  vtkSetMacro(LensFocalLength, double);
  vtkGetMacro(LensFocalLength, double);

  /// Distance from the camera to the plane in focus, with a View Angle, data units; 0: Background
  /// Oriented focuses on the pattern, other images on the focal point, or as Focus Offset says.
  /// Default: 0.
  vtkSetMacro(FocusDistance, double);
  vtkGetMacro(FocusDistance, double);

  /// Width of the sensor behind the lens, millimetres: sets the View Angle. 0: off. Default: 0.
  vtkSetMacro(SensorWidth, double);
  vtkGetMacro(SensorWidth, double);

  /// Light diverges from a point at this distance before the middle of the data, data units; more
  /// than half of the data's depth. 0: it is collimated. Default: 0.
  vtkSetMacro(SourceDistance, double);
  vtkGetMacro(SourceDistance, double);

  /// Values of SourceShape.
  enum SourceShapes
  {
    POINT = 0,
    SLIT = 1,
    DISC = 2
  };

  /// Point, or an extended source: a Slit along the knife edge or a Disc, as wide as Source Width.
  /// Default: Point.
  vtkSetClampMacro(SourceShape, int, POINT, DISC);
  vtkGetMacro(SourceShape, int);

  /// Length of a slit's image at the cutoff, along the knife edge, millimetres. Default: 10.
  vtkSetMacro(SourceLength, double);
  vtkGetMacro(SourceLength, double);

  /// Values of LightModel.
  enum LightModels
  {
    LIGHT_RAYS = 0,
    LIGHT_WAVES = 1,
    LIGHT_AUTO = 2
  };

  /// How light continues behind the flow. Default: Rays.
  vtkSetClampMacro(LightModel, int, LIGHT_RAYS, LIGHT_AUTO);
  vtkGetMacro(LightModel, int);

  /// Of Phase Contrast: diameter of the plate in the middle of the cutoff plane, millimetres, with
  /// Mirror Focal Length; 0: only undisturbed light passes it. Default: 0.
  vtkSetClampMacro(PhasePlateDiameter, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(PhasePlateDiameter, double);

  /// Of Phase Contrast: by how much the plate delays light, wavelengths. 0.25: denser gas is
  /// bright; -0.25: it is dark. Default: 0.25.
  vtkSetMacro(PhasePlateDelay, double);
  vtkGetMacro(PhasePlateDelay, double);

  /// Of Phase Contrast: the fraction of light that the plate lets pass. Default: 1.
  vtkSetClampMacro(PhasePlateTransmission, double, 0, 1);
  vtkGetMacro(PhasePlateTransmission, double);

  /// Values of PathModel.
  enum PathModels
  {
    STRAIGHT = 0,
    REFRACTED = 1
  };

  /// How light passes the medium. Default: Refracted.
  vtkSetClampMacro(PathModel, int, STRAIGHT, REFRACTED);
  vtkGetMacro(PathModel, int);

  /// Length of an integration step, voxels; with solids no longer than 1. Default: 2.
  vtkSetMacro(StepSize, double);
  vtkGetMacro(StepSize, double);

  /// Rays per pixel; the first is at the pixel's centre. Default: 1.
  vtkSetMacro(SamplesPerPixel, int);
  vtkGetMacro(SamplesPerPixel, int);

  /// Values of Precision.
  enum Precisions
  {
    SINGLE = 0,
    DOUBLE = 1
  };

  /// Smooths the image by a Gaussian with a standard deviation of half this radius, pixels; 0: not
  /// at all. Default: 0.
  vtkSetMacro(SmoothingRadius, double);
  vtkGetMacro(SmoothingRadius, double);

  /// Of meshes: the error of the deflection that the size of voxels may cause, relative to a strong
  /// one, as k shows it at full scale; 0: voxels are as fine as the mesh. Default: 0.003.
  vtkSetMacro(MediumTolerance, double);
  vtkGetMacro(MediumTolerance, double);

  /// Whether an image with a target error has the array ErrorEstimate, the error of each pixel in
  /// the unit of Target Error. Default: off.
  vtkSetMacro(ErrorEstimate, bool);
  vtkGetMacro(ErrorEstimate, bool);
  vtkBooleanMacro(ErrorEstimate, bool);

  /// Of meshes: memory for voxels, MiB. Default: 1024.
  vtkSetClampMacro(MediumMemory, int, 1, VTK_INT_MAX);
  vtkGetMacro(MediumMemory, int);

  /// Values of Device.
  enum Devices
  {
    AUTO = 0,
    CPU = 1,
    CUDA = 2
  };

  /// What traces the rays. Default: Auto.
  vtkSetClampMacro(Device, int, AUTO, CUDA);
  vtkGetMacro(Device, int);

  /// Threads on the CPU; 0: VTK_SMP_MAX_THREADS where that is set, else the cores that the process
  /// may use. Default: 0.
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);

  /// Where ParaView runs as several processes: up to how many cells in all the pieces of a mesh
  /// that these have are put together on rank 0. Default: 1000000.
  vtkSetClampMacro(GatherLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(GatherLimit, int);

  // end

  /// Wavelength of the light in vacuum, nanometres, for the medium and for interferograms. Default: 632.8.
  void SetWavelength(double wavelength) override;

  ///@{
  /// Whether 2-D data in a plane along z (also the section that Symmetry revolves) are viewed
  /// face-on instead of along their plane if ViewDirection is the default (0, 0, -1): then along y,
  /// or against x, with z up unless ViewUp is changed. Default: on.
  vtkSetMacro(FaceFlatData, bool);
  vtkGetMacro(FaceFlatData, bool);
  vtkBooleanMacro(FaceFlatData, bool);
  ///@}

  ///@{
  /// Point at the centre of the image, data units. By default, and after ClearFocalPoint(), the
  /// data's centre; GetFocalPoint() then returns an unused value.
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
  /// The cutoff, one of Cutoffs. With the deflection eps, its component e along KnifeEdgeAngle and
  /// the sensitivity k, the intensity, clamped to 0 ... 1, is
  /// - KNIFE_EDGE (the default): 1/2 - offset + k e;
  /// - SHADOWGRAPH: 1, so that the image shows only where light lands on a screen;
  /// - BRIGHT_FIELD: 1 - k |eps|, dark on bright; DARK_FIELD: k |eps|;
  /// - GRADED_FILTER: GradedFilter at 1/2 - offset + k e;
  /// - COLOR_FILTER: the colour at k eps in ColorFilterImage, or in a colour wheel;
  /// - INTERFEROGRAM: (1 + cos(2 pi OPD / wavelength + carrier)) / 2;
  /// - BACKGROUND_ORIENTED: a camera's image of a pattern behind the flow;
  /// - NUMERICAL_SCHLIEREN: exp(-5 k |eps|), common for computed flows, but no stop of a bench;
  /// - PHASE_CONTRAST: 1 + 2 phi of a small phase phi, by a plate (PhasePlateDelay) that the
  ///   undisturbed light passes; of waves alone.
  virtual void SetCutoff(int cutoff);
  vtkGetMacro(Cutoff, int);
  ///@}

  ///@{
  /// Return whether a cutoff has a sensitivity k; a straight edge with an angle, an offset and an
  /// inverse; fringes; a screen behind the flow, or a pattern; and, with these settings, colours of
  /// its own. False for invalid numbers.
  static bool CutoffHasK(int cutoff);
  static bool CutoffHasEdge(int cutoff);
  static bool CutoffHasFringes(int cutoff);
  static bool CutoffHasScreen(int cutoff);
  static bool CutoffHasBackground(int cutoff);
  static bool CutoffHasColor(int cutoff, int backgroundPattern);
  bool HasOwnColor() const;
  ///@}

  /// Return the light that is shown as white: 2 for a cutoff whose undisturbed light is 1 and becomes
  /// more and less than that, as a shadowgraph's, else 1.
  static double CutoffWhite(int cutoff);

  ///@{
  /// The automatic k, or distance of a shadowgraph's screen, kept from an earlier image, the ambient refractivity, and the
  /// depth of a plane; else 0. Setting them (as state files do) sets those of the next image, which are then kept; 0
  /// means automatic.
  void SetLockedK(double k);
  double GetLockedK() const;
  void SetLockedAmbient(double ambient);
  double GetLockedAmbient() const;
  void SetLockedDepth(double depth);
  double GetLockedDepth() const;
  ///@}

  /// Finds an automatic k, or distance of a screen, again for the next image, whatever has been kept.
  void FitK();

  /// Finds one k for a series: makes an image with one ray per pixel of each time step, of MOST_STEPS evenly spread ones
  /// with the first and the last where there are more, and keeps the smallest of their automatic k, that of the largest
  /// deflections: no image exceeds full scale then by more than an image with its own k. Reports progress; aborted, it
  /// changes nothing. An error where the data have no time steps or k is not automatic. The output is that of the last
  /// update until the next one.
  void FitKOverSeries();
  static constexpr int MOST_STEPS = 100; ///< of FitKOverSeries()

  ///@{
  /// Returns the k of the last image; 0 before the first, after errors, and without a cutoff.
  vtkGetMacro(KScaleUsed, double);
  ///@}

  /// Returns what SetLockedK() keeps of the last image: its automatic k, or distance of a shadowgraph's screen, data units;
  /// 0: neither.
  vtkGetMacro(AutomaticUsed, double);

  /// Returns a text about the last image's sensitivity: k, the full-scale deflection and equivalent
  /// optics; of an interferogram, its wavelength. Empty where there is none.
  const char* GetSensitivity() const { return this->Sensitivity.c_str(); }

  ///@{
  /// Transmission, 0 to 1, of the GRADED_FILTER across its width, 0 to 1; undisturbed light passes
  /// the middle. Null (the default) or without points: a line from 0 to 1. Sampled at 1025 points.
  virtual void SetGradedFilter(vtkPiecewiseFunction* function);
  vtkPiecewiseFunction* GetGradedFilter() const;
  ///@}

  /// Sets the pupil of a view's camera instead of FNumber and FocusDistance: its diameter and the
  /// distance of what is in focus, data units. `diameter` 0 (the default): there is none.
  void SetPupil(double diameter, double focusDistance);

  ///@{
  /// Preset of accuracy and speed, one of Qualities. Setting it sets the properties that
  /// GetQualitySetting() lists; CUSTOM sets none. Getting it returns the preset whose values the
  /// properties have, or CUSTOM. Default: INTERACTIVE; of ParaView's filter AUTOMATIC.
  virtual void SetQuality(int quality);
  virtual int GetQuality();
  ///@}

  /// The error that 99 % of the pixels whose light crosses the data shall keep; 0: that of the other properties which Quality
  /// sets; negative: what cannot be seen. Default: 0; of ParaView's filter -1.
  vtkSetMacro(TargetError, double);
  vtkGetMacro(TargetError, double);

  ///@{
  /// Return the names of the properties that Quality sets, from number 0 on, null after the last;
  /// and their values in a preset, 0 for invalid numbers.
  static const char* GetQualitySetting(int number);
  static double GetQualityValue(int quality, int number);
  ///@}

  ///@{
  /// Return what has been measured of a preset on four flows (quality.md): the error that 99 % of the
  /// pixels keep with a cutoff, in the unit of TargetError, and the time for another view, relative to
  /// INTERACTIVE. 0: not known, of REFERENCE, AUTOMATIC and CUSTOM.
  static double GetQualityError(int quality, int cutoff);
  static double GetQualityTime(int quality);
  ///@}

  ///@{
  /// Floating-point precision of tracing, one of Precisions. With DOUBLE and no target error, the
  /// steps of refracted rays are adaptive.
  virtual void SetPrecision(int precision);
  vtkGetMacro(Precision, int);
  ///@}

  ///@{
  /// Count what this filter has done since it was made: media built and rays traced. Updates that use earlier results add nothing.
  vtkTypeInt64 GetMediumBuilds();
  vtkTypeInt64 GetTotalRaysTraced();
  ///@}

  ///@{
  /// Pixels of the full image, along each axis, for each pixel of a preview: 2 gives the same view
  /// with half as many columns and rows. Previews have one ray per pixel, whatever SamplesPerPixel
  /// is, and steps no shorter than those of INTERACTIVE. For interaction with a view. Default: 1.
  vtkSetClampMacro(PreviewReduction, int, 1, 64);
  vtkGetMacro(PreviewReduction, int);
  ///@}

  ///@{
  /// Time that an update may spend on rays and light, seconds, approximately; 0 (the default): no
  /// limit. After that, the output is the image of the completed samples or, if some pixel has
  /// none, the previous image, stretched to the new size (of a new filter: a preview). Refine()
  /// works for as long again and, if it has completed samples, lets the next update show them; it
  /// also begins an image if only properties of this filter have changed. Without a limit it lets
  /// the next update finish the image. GetFinished() returns whether nothing remains to be done.
  /// Each call makes some progress, and the finished image equals the one without a limit to the
  /// last bit. Changing the limit keeps the image. Making the medium is not limited, and progress
  /// is not reported.
  void SetTimeLimit(double seconds) { this->TimeLimit = seconds; }
  vtkGetMacro(TimeLimit, double);
  void Refine();
  bool GetFinished();
  ///@}

  ///@{
  /// Stops an unfinished image, which counts as finished until Refine() resumes it or something
  /// changes the image. Aborting an update with a TimeLimit while it computes the refractivity, or
  /// any that has called Stop() by then, also stops it, with an empty output: else the next update
  /// makes the image anew. GetStopped() returns whether that is so.
  void Stop();
  bool GetStopped();
  ///@}

  /// Returns whether the last update has made an image, which rank 0 has: the same on all ranks.
  bool GetHasImage();

  /// Returns the completed fraction of the image, per cent; 100 only for a finished one.
  int GetPercentDone();

  /// Counts the different images of this filter, including one that Refine() has made for the next
  /// update. Unchanged where a step had nothing new to show.
  vtkTypeInt64 GetImageCount() const;

  /// Returns a text about the last image, in one line: samples per pixel; rays per second of the
  /// last tracing; device; path model. Empty before the first image; after a failure, "No image: " and why.
  const char* GetStatus() const { return this->Status.c_str(); }

  ///@{
  /// What the image has at a place, fractions of its width and height from the lower left, in words: position, deflection,
  /// optical path difference and intensity. Empty beside the image. The place is no setting of the image.
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

  /// Makes the next RequestData() treat this rank as one without input, because something upstream
  /// has failed; see vtkSchlierenPipeline.
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
  /// Returns the size of the image, which is promised before it is made: where a side is not given, by the proportions of the
  /// input as far as it is there, on a single rank; else 512.
  std::array<int, 2> SizeFor(vtkInformationVector* input) const;
  /// Returns the settings with that size, facing flat data.
  SchlierenSettings SettingsFor(int flatAxis) const;
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
  /// Sets what is automatic in a scene, k or the distance of a screen, to that kept from an earlier image, if any.
  void UseKept(schlieren::Scene& scene);
  /// Returns the ambient refractivity kept from an earlier image; unset: none.
  std::optional<double> KeptAmbient();
  filters::ImageCircumstances CircumstancesOf(std::vector<double> medium, std::vector<double> rays);
  filters::ImageCircumstances CircumstancesOfRays();
  schlieren::Image Begin(bool isPreview, double seconds, const schlieren::Monitor& monitor);
  /// Passes what was found for the last image to the locks.
  void KeepFound(const schlieren::Image& image);
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
  double AutomaticUsed = 0;
  std::string Sensitivity;
  vtkTypeInt64 ImageCount = 0;
  std::string Status;
  double ProbedPlace[2] = { -1, -1 };
  std::string Probed;
};

#endif
