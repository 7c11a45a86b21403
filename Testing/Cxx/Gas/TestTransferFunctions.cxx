// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Several fields through transfer functions to one refractivity (IndexModel TRANSFER_FUNCTIONS).
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkPiecewiseFunction.h"
#include "vtkUnstructuredGrid.h"

#include <limits>

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double scale = 2e-4;
constexpr double rounding = 1e-11; // of a table with 2^14 intervals

struct Node
{
  double x, y, midpoint = 0.5, sharpness = 0;
};

vtkSmartPointer<vtkPiecewiseFunction> curve(const std::vector<Node>& nodes)
{
  auto function = vtkSmartPointer<vtkPiecewiseFunction>::New();
  for (const Node& node : nodes)
  {
    function->AddPoint(node.x, node.y, node.midpoint, node.sharpness);
  }
  return function;
}

template <class Filter>
vtkSmartPointer<Filter> combining(vtkDataObject* input, const std::vector<std::string>& fields)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputDataObject(input);
  filter->SetIndexModel(vtkRefractiveIndex::TRANSFER_FUNCTIONS);
  filter->SetRefractivityScale(scale);
  for (const std::string& field : fields)
  {
    filter->AddField(field.c_str());
  }
  return filter;
}

vtkSmartPointer<vtkRefractiveIndex> mean(
  vtkDataObject* input, const std::vector<std::string>& fields)
{
  return combining<vtkRefractiveIndex>(input, fields);
}

/// The largest error of N in the output where there is gas, relative to the scale.
double largestError(vtkRefractiveIndex* filter, const ScalarField& truth)
{
  filter->Update();
  const std::vector<PlacedValue> values = refractivityOf(filter);
  double error = values.empty() ? HUGE_VAL : 0;
  for (const PlacedValue& n : values)
  {
    if (!std::isnan(n.value))
    {
      const double difference = std::abs(n.value - truth(n.place)) / scale;
      error = std::isfinite(difference) ? std::max(error, difference) : HUGE_VAL;
    }
  }
  return error;
}

// Five fields over the cube from -1 to 1, of very different sizes.
const std::vector<std::string> names = { "A", "B", "C", "D", "E" };
const std::vector<ScalarField> fields = { [](const Vec& x) { return x[0]; },
  [](const Vec& x) { return 1e5 + 5e3 * x[1]; }, [](const Vec& x) { return 300 - 20 * x[2]; },
  [](const Vec& x) { return 1e-9 * x[0] * x[1]; }, [](const Vec& x) { return -7 * x[2] - 1e3; } };

vtkSmartPointer<vtkImageData> fiveFields(int points = 9)
{
  auto image = cube(points);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    addPointArray(image, names[i].c_str(), fields[i]);
  }
  return image;
}

/// The fields' places in their ranges, by hand.
double straightMean(const Vec& x)
{
  return scale *
    ((1 + x[0]) / 2 + (1 + x[1]) / 2 + (1 - x[2]) / 2 + (1 + x[0] * x[1]) / 2 + (1 - x[2]) / 2) / 5;
}

void addCurves(vtkRefractiveIndex* filter)
{
  filter->AddTransferFunction(curve({ { 0, 1 }, { 1, 0 } }));             // A turned round
  filter->AddTransferFunction(curve({ { 0, 0 }, { 0.5, 1 }, { 1, 0 } })); // B: a hat
  filter->AddTransferFunction(curve({ { 0, 0.25 }, { 1, 0.25 } }));       // C: nothing of it
  filter->AddTransferFunction(nullptr);                                   // D as it is
  filter->AddTransferFunction(curve({ { 0, -2 }, { 1, 2 } }));            // E, more than others
}

double curvedMean(const Vec& x)
{
  return scale * ((1 - x[0]) / 2 + 1 - std::abs(x[1]) + 0.25 + (1 + x[0] * x[1]) / 2 - 2 * x[2]) /
    5;
}

} // namespace

// Without functions, all fields count alike, from their smallest value to their largest.
TEST(TransferFunctions, StraightLinesOverTheFieldsOwnRanges)
{
  EXPECT_LT(largestError(mean(fiveFields(), names), straightMean), 1e-14);
}

TEST(TransferFunctions, OneCurveForEachOfFiveFields)
{
  auto filter = mean(fiveFields(), names);
  addCurves(filter);
  EXPECT_LT(largestError(filter, curvedMean), rounding);
}

TEST(TransferFunctions, RangesMayBeGivenAndClamp)
{
  auto filter = mean(fiveFields(), { "A", "B", "C" });
  for (const double value : { 0., 0.5, 0., 0., 320., 280. }) // B: its own; C: turned round
  {
    filter->AddFieldRange(value);
  }
  EXPECT_LT(largestError(filter,
              [](const Vec& x) {
                return scale * (std::clamp(2 * x[0], 0., 1.) + (1 + x[1]) / 2 + (1 + x[2]) / 2) / 3;
              }),
    1e-14);
}

TEST(TransferFunctions, HiddenAndNotFiniteValuesDoNotStretchTheRange)
{
  auto image = cube(9);
  vtkDoubleArray* a = addPointArray(image, "A", [](const Vec& x) { return x[0]; });
  a->SetValue(40, notANumber);
  a->SetValue(41, HUGE_VAL);
  a->SetValue(0, 1e6); // the corner: hidden as a point
  image->AllocatePointGhostArray();
  image->GetPointGhostArray()->SetValue(0, vtkDataSetAttributes::HIDDENPOINT);
  auto filter = mean(image, { "A" });
  EXPECT_LT(largestError(filter, [](const Vec& x) { return scale * (1 + x[0]) / 2; }), 1e-14);
  for (const int invalid : { 0, 40, 41 })
  {
    EXPECT_TRUE(std::isnan(refractivityOf(filter)[static_cast<std::size_t>(invalid)].value))
      << invalid;
  }
}

TEST(TransferFunctions, AFieldThatIsTheSameEverywhereCountsAsZero)
{
  auto image = fiveFields();
  addPointArray(image, "same", [](const Vec&) { return 42; });
  EXPECT_LT(
    largestError(mean(image, { "same", "A" }), [](const Vec& x) { return scale * (1 + x[0]) / 4; }),
    1e-14);
}

// Against vtkPiecewiseFunction itself, in places that are no grid points of the table.
TEST(TransferFunctions, CurvesAreReadWithinTheirBound)
{
  constexpr int points = 5003;
  constexpr double h = 1. / (1 << 14);
  vtkNew<vtkImageData> line;
  line->SetDimensions(points, 2, 2);
  line->SetSpacing(1. / (points - 1), 1, 1);
  addPointArray(line, "x", [](const Vec& x) { return x[0]; });
  const auto largestDifference = [&](vtkPiecewiseFunction* function, double jump)
  {
    auto filter = mean(line, { "x" });
    filter->AddTransferFunction(function);
    return largestError(filter,
      [&](const Vec& x)
      {
        // Next to the jump, the place does not count.
        return std::abs(x[0] - jump) > h
          ? scale * function->GetValue(x[0])
          : arrayOf(filter, "Refractivity")
              ->GetComponent(static_cast<vtkIdType>(std::lround(x[0] * (points - 1))), 0);
      });
  };
  constexpr double none = -1;

  // A corner with a change of slope of 20.
  auto corner = curve({ { 0, 0 }, { 0.3123, 0 }, { 0.3623, 1 }, { 1, 1 } });
  EXPECT_LT(largestDifference(corner, none), 20 * h / 4);
  // Off the middle, and smooth (sharpness 0.4): the second derivative is below 60 outside its corners,
  // where the slope changes by less than 20.
  auto smooth = curve({ { 0, 0, 0.3, 0.4 }, { 0.4, 1, 0.7, 0.2 }, { 1, 0.1 } });
  EXPECT_LT(largestDifference(smooth, none), 20 * h / 4 + 60 * h * h / 8);
  // A step.
  auto step = curve({ { 0.1, 0.2 }, { 0.3, 0.2 }, { 0.3 + 1e-9, 0.9 }, { 0.7, 0.9 } });
  EXPECT_LT(largestDifference(step, 0.3), 1e-12);
  // As sharp as can be at the midpoint 0.4 of 0.1 to 0.6: a step, too, but since VTK 9.3 a slope with a
  // second derivative of up to 1600.
  auto sharp = curve({ { 0.1, 0.2, 0.4, 1 }, { 0.6, 0.9, 0.5, 1 }, { 0.7, 0.9 } });
  EXPECT_LT(largestDifference(sharp, 0.3), 1600 * h * h / 8);
  // Nodes beyond 0 to 1, and only one.
  EXPECT_LT(largestDifference(curve({ { -1, -1 }, { 3, 3 } }), none), rounding);
  EXPECT_LT(largestDifference(curve({ { 0.5, 0.7 } }), none), rounding);
}

TEST(TransferFunctions, Mistakes)
{
  const auto make = []()
  {
    auto filter = combining<vtkSchlierenFilter>(fiveFields(), names);
    filter->SetImageSize(16, 16);
    return filter;
  };
  auto line = curve({ { 0, 0 }, { 1, 1 } });
  expectOneMessage(
    make().Get(), [](auto* self) { self->ClearFields(); }, { "No array is chosen for Fields", "A" },
    [](auto* self) { self->AddField("A"); });
  expectOneMessage(
    make().Get(), [&](auto* self) { self->AddTransferFunction(line); },
    { "Fields and TransferFunctions", "5 and 1" },
    [](auto* self) { self->ClearTransferFunctions(); });
  expectOneMessage(
    make().Get(), [](auto* self) { self->AddFieldRange(1); }, { "FieldRanges", "1 values for 5" },
    [](auto* self) { self->ClearFieldRanges(); });
  expectOneMessage(
    make().Get(),
    [](auto* self)
    {
      for (int i = 0; i < 10; ++i)
      {
        self->AddFieldRange(i == 3 ? notANumber : i);
      }
    },
    { "FieldRanges", "finite" }, [](auto* self) { self->ClearFieldRanges(); });
  expectOneMessage(
    make().Get(), [](auto* self) { self->SetRefractivityScale(HUGE_VAL); },
    { "RefractivityScale", "finite" }, [](auto* self) { self->SetRefractivityScale(-1e-4); });
  expectOneMessage(
    make().Get(),
    [](auto* self)
    {
      for (int i = 0; i < 5; ++i)
      {
        self->AddTransferFunction(curve({ { 0, 0 }, { 0.5, HUGE_VAL }, { 1, 1 } }));
      }
    },
    { "TransferFunctions", "not finite" }, [](auto* self) { self->ClearTransferFunctions(); });
}
