// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkImageData.h"
#include "vtkNew.h"

namespace filters
{

/// Keeps the last image until a better one is ready.
class LastImage
{
public:
  bool IsThere() const;
  bool HasColor() const;

  /// Keeps a shallow copy.
  void Keep(vtkImageData* output);
  void Drop();

  /// Makes `output` that image, resampled if another extent has been promised.
  void Show(vtkImageData* output, const int promised[6]);

private:
  vtkNew<vtkImageData> Image;
};

} // namespace filters
