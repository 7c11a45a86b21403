// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSchlierenPipeline
 * @brief   The executive of filters whose ranks wait for each other.
 *
 * VTK does not run a filter where something upstream of it has failed, which may be so on one rank alone: the others would
 * wait for it. This runs the filter all the same, where there are several ranks, after LackInput().
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
