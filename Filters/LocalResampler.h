// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkObjectFactory.h"
#include "vtkResampleToImage.h"

/// vtkResampleToImage of this process alone. ParaView makes another one when asked for that, which waits for
/// all other processes.
class LocalResampler : public vtkResampleToImage
{
public:
  static LocalResampler* New() { VTK_STANDARD_NEW_BODY(LocalResampler); }
  vtkTypeMacro(LocalResampler, vtkResampleToImage);
};
