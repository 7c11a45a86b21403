// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWavefront.h"

#include "Guarded.h"
#include "Image/FieldData.h"
#include "NumberText.h"
#include "Ranks/Ranks.h"
#include "Wavefront/BeamQuality.h"
#include "Wavefront/Zernike.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

using namespace filters;

vtkStandardNewMacro(vtkWavefront);

using Pipeline = vtkStreamingDemandDrivenPipeline;

static_assert(static_cast<int>(ApertureShape::Round) == vtkWavefront::APERTURE_ROUND &&
  static_cast<int>(ApertureShape::Square) == vtkWavefront::APERTURE_SQUARE);

namespace
{

constexpr double metresPerNanometre = 1e-9;

vtkSmartPointer<vtkDoubleArray> arrayFrom(
  const std::string& name, const std::vector<double>& values, const char* unit)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  setUnit(array, unit);
  return array;
}

std::vector<double> pathOf(vtkImageData* image)
{
  vtkDataArray* array = image->GetPointData()->GetArray("OpticalPathDifference");
  if (!array)
  {
    throw std::runtime_error("The input has no point array OpticalPathDifference. Choose an image "
                             "of the filter Schlieren.");
  }
  std::vector<double> path(static_cast<std::size_t>(image->GetNumberOfPoints()));
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    path[i] = array->GetComponent(static_cast<vtkIdType>(i), 0);
  }
  return path;
}

Aperture apertureOf(
  vtkImageData* image, const std::vector<double>& path, const WavefrontSettings& settings)
{
  const LitPixels pixels = litPixelsOf(image, path);
  const auto shape = static_cast<ApertureShape>(settings.ApertureShape);
  if (settings.ApertureDiameter == 0)
  {
    const Aperture largest = largestAperture(pixels, shape);
    if (largest.diameter == 0)
    {
      throw std::runtime_error("No pixel of the image has light that has come through the data.");
    }
    return largest;
  }
  const double *origin = image->GetOrigin(), *spacing = image->GetSpacing();
  const Aperture aperture{ shape, (settings.ApertureCenter[0] - origin[0]) / spacing[0],
    (settings.ApertureCenter[1] - origin[1]) / spacing[1], settings.ApertureDiameter / spacing[0] };

  // One pixel more all around, of which none may be in it.
  int inside = 0, dark = 0;
  bool isBeyond = false;
  for (int row = -1; row <= pixels.rows; ++row)
  {
    for (int column = -1; column <= pixels.columns; ++column)
    {
      if (aperture.has(column, row))
      {
        const bool isOfImage =
          0 <= row && row < pixels.rows && 0 <= column && column < pixels.columns;
        isBeyond = isBeyond || !isOfImage;
        ++inside;
        dark += isOfImage &&
            pixels.isLit[static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels.columns) +
              static_cast<std::size_t>(column)]
          ? 0
          : 1;
      }
    }
  }
  if (isBeyond || dark > 0 || inside == 0)
  {
    const std::string problem = isBeyond ? "reaches beyond the image"
      : inside == 0
      ? "covers no pixel of the image"
      : "has no light through the data at " + textOf(100. * dark / inside, 2) + " % of its pixels";
    throw std::runtime_error("The aperture " + problem +
      ". Choose another ApertureDiameter or ApertureCenter; with an ApertureDiameter of 0, it is "
      "the largest one inside the flow.");
  }
  return aperture;
}

std::string inWords(const BeamQuality& found, double diameter)
{
  return "Over an aperture of " + lengthInWords(diameter, 3) + ": OPDrms " +
    lengthInWords(found.rms, 3) + ", peak to valley " + lengthInWords(found.peakToValley, 3) +
    ", Strehl ratio " + textOf(found.strehl, 4) + " (Mar\xC3\xA9" + "chal " +
    textOf(found.marechal, 4) + "), " + textOf(100 * found.energyWithinAiry, 4) +
    " % of the light within 1.22 \xCE\xBB/D.";
}

} // namespace

vtkWavefront::vtkWavefront() { this->SetNumberOfOutputPorts(3); }

void vtkWavefront::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ApertureShape: " << this->ApertureShape << "\n"
     << indent << "ApertureDiameter: " << this->ApertureDiameter << "\n"
     << indent << "ApertureCenter: " << this->ApertureCenter[0] << " " << this->ApertureCenter[1]
     << "\n"
     << indent << "Wavelength: " << this->Wavelength << "\n"
     << indent << "RemoveFocus: " << this->RemoveFocus << "\n"
     << indent << "ZernikeTerms: " << this->ZernikeTerms << "\n"
     << indent << "Report: " << this->Report << "\n";
}

int vtkWavefront::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkWavefront::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == NUMBERS ? "vtkTable" : "vtkImageData");
  return 1;
}

int vtkWavefront::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const char* const active[] = { "ResidualWavefront", "PointSpread" };
  for (int port = RESIDUAL; port <= FAR_FIELD; ++port)
  {
    vtkInformation* info = outputVector->GetInformationObject(port);
    vtkDataObject::SetActiveAttribute(
      info, vtkDataObject::FIELD_ASSOCIATION_POINTS, active[port], vtkDataSetAttributes::SCALARS);
    vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_DOUBLE, 1);
  }
  // What angles it covers depends on the light: RequestData says it.
  vtkInformation* info = outputVector->GetInformationObject(FAR_FIELD);
  const int extent[6] = { 0, farFieldPoints - 1, 0, farFieldPoints - 1, 0, 0 };
  const double unturned[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  info->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::DIRECTION(), unturned, 9);
  return 1;
}

int vtkWavefront::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkInformation* info = inputVector[0]->GetInformationObject(0);
  info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
  return 1;
}

int vtkWavefront::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* image = vtkImageData::GetData(inputVector[0]);
  vtkImageData* residual = vtkImageData::GetData(outputVector, RESIDUAL);
  vtkImageData* farField = vtkImageData::GetData(outputVector, FAR_FIELD);
  vtkTable* numbers = vtkTable::GetData(outputVector, NUMBERS);
  const auto empty = [&]
  {
    residual->Initialize();
    farField->Initialize();
    numbers->Initialize();
    this->Report.clear();
  };
  empty();
  const auto work = [&]
  {
    if (!isRank0() || image->GetNumberOfPoints() == 0)
    {
      return; // the image is on rank 0; an empty one has said why
    }
    const std::vector<double> path = pathOf(image);
    const Aperture aperture = apertureOf(image, path, *this);
    vtkDataArray* scale = image->GetFieldData()->GetArray("LengthScale");
    const double metres = scale ? scale->GetComponent(0, 0) : 1;
    const double *origin = image->GetOrigin(), *spacing = image->GetSpacing();
    const BeamQuality found = qualityOf(path, image->GetDimensions()[0], aperture,
      { spacing[0] * metres, this->Wavelength * metresPerNanometre, this->ZernikeTerms,
        this->RemoveFocus });

    residual->CopyStructure(image);
    residual->GetPointData()->SetScalars(arrayFrom("ResidualWavefront", found.residual, "m"));

    farField->SetDimensions(farFieldPoints, farFieldPoints, 1);
    farField->SetSpacing(found.angle, found.angle, found.angle);
    const double corner = -found.angle * (farFieldPoints / 2);
    farField->SetOrigin(corner, corner, 0);
    farField->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1);
    farField->GetPointData()->SetScalars(arrayFrom("PointSpread", found.pointSpread, "1"));
    farField->GetPointData()->AddArray(arrayFrom("EncircledEnergy", found.energy, "1"));

    const auto add = [&](const std::string& name, double value, const char* unit)
    { numbers->AddColumn(arrayFrom(name, { value }, unit)); };
    add("OPDrms", found.rms, "m");
    add("PeakToValley", found.peakToValley, "m");
    add("StrehlRatio", found.strehl, "1");
    add("StrehlMarechal", found.marechal, "1");
    add("EncircledEnergy", found.energyWithinAiry, "1");
    add("TiltRight", found.tilt[0], "rad");
    add("TiltUp", found.tilt[1], "rad");
    add("ApertureX", origin[0] + aperture.column * spacing[0], "data units");
    add("ApertureY", origin[1] + aperture.row * spacing[1], "data units");
    add("ApertureDiameter", aperture.diameter * spacing[0], "data units");
    add("AperturePixels", found.pixels, "1");
    for (std::size_t term = 0; term < found.zernike.size(); ++term)
    {
      add(nameOfZernike(static_cast<int>(term) + 1), found.zernike[term], "m");
    }
    this->Report = inWords(found, aperture.diameter * spacing[0] * metres);
  };
  const vtkMTimeType now = std::max(this->GetMTime(), image->GetMTime());
  const auto fail = [&](const std::string& problem)
  {
    empty();
    if (this->FailedOf != now) // of what has failed before, one message is enough
    {
      this->FailedOf = now;
      vtkErrorMacro(<< problem);
    }
  };
  guarded(
    work, "There is not enough memory for the wavefront. Use an image of fewer pixels.", fail);
  setComplete(outputVector);
  return 1;
}
