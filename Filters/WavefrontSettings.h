// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef WavefrontSettings_h
#define WavefrontSettings_h

/// Values of the properties of vtkWavefront under their names, as in SchlierenSettings.h. Plugin/Wavefront.xml describes
/// them.
struct WavefrontSettings
{
  // members: rest
  int ApertureShape = 0;
  double ApertureDiameter = 0;
  double ApertureCenter[2] = { 0, 0 };
  bool RemoveFocus = false;
  int ZernikeTerms = 15;
  double Wavelength = 632.8;
  // end
};

#endif
