// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "AmrGrid.h"
#include "MeshSource.h"
#include "RefractivitySource.h"
#include "SamplingGrid.h"
#include "WorkProgress.h"
#include "vtkRefractiveIndex.h"

#include "vtkSMPTools.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// What vtkRefractiveIndex keeps between updates, and what its files share.
namespace filters
{

struct GridPlan
{
  std::vector<double> key; // the input, and the filter's time; empty: not chosen yet
  std::optional<Amr> amr;
  Resampling resampling; // where it is no Amr
  vtkTypeInt64 count = 0;
};

/// Of the last MakeSource().
struct KeptMesh
{
  std::optional<std::uint64_t> key; // unset: there is none
  SourceMesh mesh;
  vtkTypeInt64 builds = 0;

  void release()
  {
    this->key.reset();
    this->mesh = {};
  }
};

/// Most builds of ParaView run VTK's threaded loops on one core by default, and else on all of the machine.
int threadsOf(vtkRefractiveIndex* self);
vtkSMPTools::Config loopsWith(int threads);

/// Of all work of a filter, until it is aborted.
WorkProgress progressOf(vtkAlgorithm* self);

std::string noGas(const Source& source);

/// Of 3-D data that are a wedge; else empty.
std::string noteOnWedge(vtkRefractiveIndex* self, const Source& source);

/// Appends a sentence.
void addText(std::string& text, const std::string& more);

} // namespace filters
