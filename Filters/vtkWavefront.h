// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkWavefront
 * @brief   the aberrations of a beam through a flow, and the light in its far field
 *
 * The input is an image of vtkSchlierenFilter, whose `OpticalPathDifference` (metres) is the beam's wavefront; `LengthScale`
 * of its field data says how long a data unit is (metres, 1 without it). One time step is looked at.
 *
 * The first output is an image with the input's points and the point array `ResidualWavefront` (double, metres): the path within the
 * aperture without piston, tilt and, with RemoveFocus, focus, which are found by least squares; NaN beyond.
 *
 * The second output is the far field, an image of 257 x 257 points whose coordinates are angles (radians, to the right and
 * up), with the point arrays `PointSpread` (double, active scalars; 1: the peak of a plane wavefront) and `EncircledEnergy` (double:
 * the fraction of the light within each point's angle, NaN beyond the image's sides). It reaches to 16 wavelengths over the diameter;
 * to 32 or 64 where less than 95 % of the light is in it; or to half a wavelength over a pixel.
 *
 * The third output is a vtkTable with one row of doubles: `OPDrms` and `PeakToValley` of the residual (metres); `StrehlRatio` (the far
 * field's peak over that of a plane wavefront); `StrehlMarechal` (exp(-(2 pi OPDrms / wavelength)^2), Marechal's approximation as
 * extended by Mahajan, 1983); `EncircledEnergy` (the fraction of the light within 1.22 wavelengths over the diameter; 0.838 of a
 * plane wavefront behind a round aperture); `TiltRight` and `TiltUp` (radians, what has been removed; light bends to longer paths);
 * `ApertureX`, `ApertureY` and `ApertureDiameter` (data units; of a square, the side); `AperturePixels`; and the Zernike coefficients of
 * the whole path, `Z1 Piston` and so on (metres, Noll, J. Opt. Soc. Am. 66, 207, 1976), found by least squares. Their unit circle is
 * the round aperture, or the circle around the square one.
 *
 * Each user error is one error that says what to do, with empty outputs.
 *
 * @sa vtkSchlierenFilter
 */

#ifndef vtkWavefront_h
#define vtkWavefront_h

#include "WavefrontSettings.h" // for the values of the properties
#include "vtkImageAlgorithm.h"
#include "vtkSchlierenFiltersModule.h" // for export macro

#include <string> // for std::string

class VTKSCHLIERENFILTERS_EXPORT vtkWavefront : public vtkImageAlgorithm, private WavefrontSettings
{
public:
  static vtkWavefront* New();
  vtkTypeMacro(vtkWavefront, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The output ports.
  enum OutputPorts
  {
    RESIDUAL = 0,
    FAR_FIELD = 1,
    NUMBERS = 2
  };

  /// Returns what has been found, in a sentence. Empty before the first update and after a failed one.
  const char* GetReport() const { return this->Report.c_str(); }

  // setters: rest
  /// Values of ApertureShape.
  enum ApertureShapes
  {
    APERTURE_ROUND = 0,
    APERTURE_SQUARE = 1
  };

  /// Which shape the beam has. Default: Round.
  vtkSetClampMacro(ApertureShape, int, APERTURE_ROUND, APERTURE_SQUARE);
  vtkGetMacro(ApertureShape, int);

  /// The diameter of the beam, data units; of a square, its side. 0: the largest beam that has
  /// passed through the data everywhere, wherever that is. Default: 0.
  vtkSetClampMacro(ApertureDiameter, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(ApertureDiameter, double);

  /// Where the middle of a beam with an Aperture Diameter is in the image, data units. Default: 0
  /// 0.
  vtkSetVector2Macro(ApertureCenter, double);
  vtkGetVector2Macro(ApertureCenter, double);

  /// Whether focus is removed as well, as optics that follow it do. Default: off.
  vtkSetMacro(RemoveFocus, bool);
  vtkGetMacro(RemoveFocus, bool);
  vtkBooleanMacro(RemoveFocus, bool);

  /// How many Zernike coefficients are found, in the order and normalization of Noll (1976). 15
  /// reach the fourth degree, 66 the tenth. Default: 15.
  vtkSetClampMacro(ZernikeTerms, int, 1, 66);
  vtkGetMacro(ZernikeTerms, int);

  /// Wavelength of the beam in vacuum, nanometres: of Strehl ratios and of the far field. Default:
  /// 632.8.
  vtkSetClampMacro(Wavelength, double, 1, VTK_DOUBLE_MAX);
  vtkGetMacro(Wavelength, double);

  // end

protected:
  vtkWavefront();
  ~vtkWavefront() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkWavefront(const vtkWavefront&) = delete;
  void operator=(const vtkWavefront&) = delete;

  std::string Report;
  vtkMTimeType FailedOf = 0; // the times of input and properties that one message was about
};

#endif
