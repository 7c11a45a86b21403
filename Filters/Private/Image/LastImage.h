// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkImageData.h"
#include "vtkNew.h"

namespace filters
{

/// The image that was shown last, for as long as there is nothing better.
class LastImage
{
public:
  bool IsThere() const;
  bool HasColor() const;

  /// Takes no memory of its own as long as `output` lives.
  void Keep(vtkImageData* output);
  void Drop();

  /// Makes `output` that image. Where another extent has been promised, its pixels are stretched to it.
  void Show(vtkImageData* output, const int promised[6]);

private:
  vtkNew<vtkImageData> Image;
};

} // namespace filters
