// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is seen behind a flow that bends no light: an image of a file, and a scene.
#include "Fixtures.h"

namespace
{

using Filter = vtkSchlierenFilter;

constexpr int pixels = 16;

vtkSmartPointer<Filter> benchWith(int pattern)
{
  auto image = cube(16);
  addPointArray(image, "N", [](const Vec&) { return 3e-4; });
  auto filter = bench(image, pixels);
  filter->SetAmbientRefractivity(3e-4);
  filter->SetParallelScale(0.5);
  filter->SetCutoff(Filter::BACKGROUND_ORIENTED);
  filter->SetBackgroundPattern(pattern);
  return filter;
}

} // namespace

// The colours of an image behind the flow are those of the file.
TEST(Cutoffs, ABackgroundImageFillsWhatIsSeen)
{
  auto filter = benchWith(Filter::PICTURE);
  filter->SetBackgroundImage(
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAAD"
    "ElEQVR4nGP4L6AAAANBATCX20YHAAAAAElFTkSuQmCC");
  filter->Update();
  vtkDataArray* color = arrayOf(filter, "Color");
  ASSERT_NE(color, nullptr);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetScalars(), color);
  constexpr double expected[] = { 255, 16, 32 };
  for (int channel = 0; channel < 3; ++channel)
  {
    EXPECT_NEAR(
      color->GetComponent(pixels / 2 * pixels + pixels / 2, channel), expected[channel], 1.1);
  }
}
