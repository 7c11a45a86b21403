// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MediumSettings.h"

#include "vtkNew.h"
#include "vtkType.h"

#include "Schlieren.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkDataObject;
class vtkImageData;

namespace schlieren
{
class SharedMedia;
}
namespace filters
{
struct MeshCache;
}

/// What has been said of a flow, so that it is not repeated for every time step and view.
struct SaidOfFlow
{
  std::string Gas; ///< and arrays: for others all may be said again
  std::string Values, Doubtful, Shape, Notes;
  int IndexModel = MediumSettings::AUTO; ///< the one chosen
  std::string Continued; ///< about formulas beyond their range: a line beside the arrays
};

/// The refractivity of a filter's data, independent of views. Immutable once made, but for what is said of it.
struct MadeRefractivity
{
  MadeRefractivity();
  ~MadeRefractivity();

  /// Returns whether it has been made.
  bool IsThere() const;

  vtkNew<vtkImageData> Image;
  std::shared_ptr<const schlieren::MediumSource> Source; ///< for meshes, instead of Image
  vtkMTimeType SourceTime = 0;
  std::shared_ptr<filters::MeshCache> Mesh; ///< of Source
  std::string Grid;                         ///< about Image, as text
  int FlatAxis = -1;                        ///< see Choice
  double Depth = 0;                         ///< of a plane, if it was found; else 0
  std::string Wedge;                        ///< what of the data is revolved by itself, as text
  std::string Warning;                      ///< for the first filter that uses it
  SaidOfFlow Said;

  /// Returns whether `user` is the first one that says something of this kind, which need not be said in every view.
  bool IsForMe(const std::string& kind, const void* user) const
  {
    return this->Speakers.emplace(kind, user).first->second == user;
  }

private:
  mutable std::map<std::string, const void*> Speakers;
};

/// The inputs of a refractivity: equal keys mean equal refractivity.
struct RefractivityKey
{
  const vtkDataObject* Data = nullptr;
  const vtkDataObject* Bodies = nullptr;
  std::vector<double> Inputs; ///< see describeInput()
  MediumSettings Settings;    ///< complete: see MediumChoice

  bool operator==(const RefractivityKey& other) const
  {
    return this->Data == other.Data && this->Bodies == other.Bodies &&
      this->Inputs == other.Inputs && this->Settings == other.Settings;
  }
};

/// Returns the refractivity in this process that a filter with the same data uses; null if there is
/// none.
std::shared_ptr<const MadeRefractivity> findRefractivity(const RefractivityKey& key);
void cacheRefractivity(RefractivityKey key, const std::shared_ptr<const MadeRefractivity>& made);

/// Returns the media made of these refractivities.
std::shared_ptr<schlieren::SharedMedia> mediaOfProcess();
