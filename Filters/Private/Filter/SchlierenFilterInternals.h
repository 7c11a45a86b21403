// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Image/LastImage.h"
#include "Image/RgbImages.h"
#include "Image/SceneFromSettings.h"
#include "Image/SensitivityLock.h"
#include "Image/TimeSlicedImage.h"
#include "Ranks/InputsOfRanks.h"
#include "Sources/MediumMaker.h"
#include "Sources/RefractivityCache.h"
#include "vtkSchlierenFilter.h"

#include "Common/FieldFromImage.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkTimeStamp.h"

#include "Schlieren.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// State of vtkSchlierenFilter between updates.
struct vtkSchlierenFilter::Internals
{
  /// Makes the other ranks work for rank 0 during its lifetime.
  class WithRanks
  {
  public:
    explicit WithRanks(Internals& internals)
      : Of(internals)
    {
      filters::FilterRanks& ranks = this->Of.Ranks.ranks();
      this->Of.Images.SetProcesses(ranks.areSeveral() ? &ranks : nullptr);
    }
    ~WithRanks()
    {
      this->Of.Images.SetProcesses(nullptr);
      this->Of.Ranks.ranks().end(this->Outcome);
    }
    WithRanks(const WithRanks&) = delete;
    WithRanks& operator=(const WithRanks&) = delete;

    filters::FilterRanks::Outcome Outcome{ false, false };

  private:
    Internals& Of;
  };

  filters::InputsOfRanks Ranks;
  filters::TimeSlicedImage Images;
  filters::LastImage Shown[2]; // at each output
  filters::RgbImageReader RgbImages;
  schlieren::Lens Pupil; // of a view's camera, where it has an aperture
  std::shared_ptr<const MadeRefractivity> Refractivity = std::make_shared<MadeRefractivity>();
  std::string Grid; // text about the grid of a source
  bool HasNotedOutside = false;

  static schlieren::Field fieldOf(const MadeRefractivity& made)
  {
    if (!made.Source)
    {
      return filters::fieldFrom(made.Image);
    }
    schlieren::Field field;
    field.source = made.Source;
    field.grid = schlieren::coarsestGrid(*field.source);
    field.version = made.SourceTime;
    return field;
  }

  // What Refractivity was made from: the input, and the settings (unset: nothing yet).
  std::vector<double> Input;
  std::optional<MediumSettings> MadeWith;
  std::optional<filters::Choice> Chosen; // in this update
  bool UsesWavelength = true;            // whether Refractivity depends on it

  /// Another wavelength does not make the same refractivity once more.
  MediumSettings inUse(MediumSettings medium) const
  {
    medium.Wavelength = this->UsesWavelength ? medium.Wavelength : MediumSettings().Wavelength;
    return medium;
  }

  bool holdsRefractivityOf(const std::vector<double>& input, const MediumSettings& medium) const
  {
    return this->MadeWith == this->inUse(medium) && this->Input == input;
  }

  // Newest times of this filter and of everything upstream, except Refine(), of the last failure,
  // of the image at the outputs, and of the unfinished image (0: none).
  vtkMTimeType FailedAt = 0;
  bool HasImage = false;     // on rank 0, after the last update
  std::array<int, 2> Size{}; // of the image, pixels
  vtkMTimeType ShownOf = 0;
  vtkMTimeType UnfinishedOf = 0;
  vtkTimeStamp RefineTime;

  /// Of each cutoff: of k, or of the distance of the screen.
  std::map<int, filters::SensitivityLock> SensitivityLocks;
  filters::SensitivityLock AmbientLock;
  filters::SensitivityLock DepthLock; // of a plane
  double KeptDepth = 0;               // what Refractivity is made with; 0: none
  bool FindsAmbient = false;          // for the image that was begun last
  std::optional<double> Time;         // time of the last update; unset: no time steps
  std::optional<double> ShownTime;    // of the image at the outputs

  std::optional<double> RequestedTime;

  bool IsStopping = false;    // this update
  vtkMTimeType StoppedOf = 0; // the image that Stop(), or an abort with a limit, has left; 0: none
  double Done = 0;            // fraction of the latest image

  std::optional<schlieren::Image> Ready; // made by Refine(), for the next update

  void DropShown()
  {
    this->Shown[0].Drop();
    this->Shown[1].Drop();
  }
};

namespace filters
{

/// Fraction of the progress bar for making the refractivity.
inline constexpr double mediumFraction = 0.2;

} // namespace filters
