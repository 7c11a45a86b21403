// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenPipeline
 * @brief   The executive of filters whose ranks wait for each other.
 *
 * VTK does not run a filter after an error upstream, even if that is on one rank and the others
 * wait for it. With several ranks, this executive calls LackInput() and runs the filter.
 */
#ifndef vtkSchlierenPipeline_h
#define vtkSchlierenPipeline_h

#include "vtkPVCompositeDataPipeline.h"
#include "vtkSchlierenRepresentationModule.h"

class VTKSCHLIERENREPRESENTATION_EXPORT vtkSchlierenPipeline : public vtkPVCompositeDataPipeline
{
public:
  static vtkSchlierenPipeline* New();
  vtkTypeMacro(vtkSchlierenPipeline, vtkPVCompositeDataPipeline);

protected:
  vtkSchlierenPipeline() = default;
  ~vtkSchlierenPipeline() override = default;

  int ForwardUpstream(vtkInformation* request) override;
  using vtkPVCompositeDataPipeline::ForwardUpstream;

private:
  vtkSchlierenPipeline(const vtkSchlierenPipeline&) = delete;
  void operator=(const vtkSchlierenPipeline&) = delete;
};

#endif
