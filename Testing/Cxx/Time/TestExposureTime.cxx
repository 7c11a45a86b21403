// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images that are means over an interval of time. The truth is a Gaussian ball that moves, whose deflection of light is
// known at each time; its mean is that of many times.
#include "BallOnLevels.h"
#include "CellMeshes.h"
#include "Changing.h"
#include "WatchedProgress.h"

#include "vtkDataSetTriangleFilter.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"

#include <functional>

namespace
{

using Filter = vtkSchlierenFilter;
using Pipeline = vtkStreamingDemandDrivenPipeline;

/// A ball A exp(-r^2/s^2) that is at (time - 1, 0, 0), and what it does to light along z.
struct MovingBall
{
  double A = 2.7e-4;
  double s = 0.3;

  double at(const Vec& x, double time) const
  {
    const double dx = x[0] - (time - 1);
    return this->A * std::exp(-(dx * dx + x[1] * x[1] + x[2] * x[2]) / (this->s * this->s));
  }
  std::array<double, 2> deflection(double x, double y, double time) const
  {
    const double dx = x - (time - 1);
    const double strength =
      -2 * std::sqrt(pi) * this->A / this->s * std::exp(-(dx * dx + y * y) / (this->s * this->s));
    return { strength * dx, strength * y };
  }
  double opticalPath(double x, double y, double time) const
  {
    const double dx = x - (time - 1);
    return std::sqrt(pi) * this->A * this->s * std::exp(-(dx * dx + y * y) / (this->s * this->s));
  }
};

vtkSmartPointer<vtkDataObject> ballOnGrid(double time)
{
  auto image = cube(48);
  addPointArray(image, "N", [time, ball = MovingBall()](const Vec& x) { return ball.at(x, time); });
  return image;
}

/// A mesh that moves with the ball.
vtkSmartPointer<vtkUnstructuredGrid> ballOnMovingMesh(double time, int points)
{
  auto image = cube(points);
  addPointArray(image, "N", [ball = MovingBall()](const Vec& x) { return ball.at(x, 1); });
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputData(image);
  tetrahedra->Update();
  vtkSmartPointer<vtkUnstructuredGrid> mesh = tetrahedra->GetOutput();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    Vec x;
    mesh->GetPoint(i, x.data());
    mesh->GetPoints()->SetPoint(i, x[0] + time - 1, x[1], x[2]);
  }
  return mesh;
}

constexpr int pixels = 48;
constexpr double sensitivity = 1000; // with which nothing is saturated

double circular(const std::array<double, 2>& deflection, double)
{
  return 1 - sensitivity * std::hypot(deflection[0], deflection[1]);
}

class ExposureTime : public testing::Test
{
protected:
  ExposureTime()
    : filter(bench(nullptr, pixels))
  {
    this->source->make = ballOnGrid;
    this->filter->SetInputConnection(this->source->GetOutputPort());
    this->filter->SetAutoKScale(false);
    this->filter->SetKScale(sensitivity);
    this->filter->SetParallelScale(0.8);
    this->filter->SetFocalPoint(0, 0, 0);
  }

  /// The mean, over times, of what a function says of the deflection at each pixel and its optical path.
  std::vector<double> meanOf(const std::vector<double>& times,
    const std::function<double(const std::array<double, 2>& deflection, double path)>& value)
  {
    auto* image = vtkImageData::SafeDownCast(this->filter->GetOutputDataObject(0));
    std::vector<double> means;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const double* x = image->GetPoint(i);
      double sum = 0;
      for (const double time : times)
      {
        sum +=
          value(this->ball.deflection(x[0], x[1], time), this->ball.opticalPath(x[0], x[1], time));
      }
      means.push_back(sum / static_cast<double>(times.size()));
    }
    return means;
  }

  static std::vector<double> middlesOf(double begin, double end, int parts)
  {
    std::vector<double> times;
    for (int i = 0; i < parts; ++i)
    {
      times.push_back(begin + (i + 0.5) / parts * (end - begin));
    }
    return times;
  }

  std::vector<double> seen(const char* name = "Intensity") { return valuesOf(this->filter, name); }

  /// The plain image of an instant.
  std::vector<double> instant(double time, const char* name = "Intensity")
  {
    auto plain = bench(nullptr, pixels);
    plain->SetInputConnection(this->source->GetOutputPort());
    plain->SetAutoKScale(false);
    plain->SetKScale(sensitivity);
    plain->SetParallelScale(0.8);
    plain->SetFocalPoint(0, 0, 0);
    plain->SetCutoff(this->filter->GetCutoff());
    plain->UpdateTimeStep(time);
    return valuesOf(plain, name);
  }

  MovingBall ball;
  vtkNew<Changing> source;
  vtkSmartPointer<Filter> filter;
};

double largestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  EXPECT_EQ(a.size(), b.size());
  std::vector<double> differences;
  std::transform(
    a.begin(), a.end(), b.begin(), std::back_inserter(differences), std::minus<double>());
  return largest(differences);
}

} // namespace

// The interval lies around the time of the image, and its instants in the middles of its parts.
TEST_F(ExposureTime, IsTheMeanOfInstantsOfABallThatMoves)
{
  this->filter->SetCutoff(Filter::CIRCULAR);
  this->filter->SetExposureTime(0.6);
  this->filter->UpdateTimeStep(1.1);
  const auto mean = this->meanOf(middlesOf(0.8, 1.4, 8), circular);
  EXPECT_LT(largestDifference(this->seen(), mean), 5e-3);
  EXPECT_EQ(fieldValue(this->filter, "ExposureInterval"), 0.8);
  EXPECT_NE(std::string(this->filter->GetStatus()).find("mean of 8 instants from 0.8 to 1.4"),
    std::string::npos);
  // So are the numbers that come with it.
  const auto path = this->meanOf(middlesOf(0.8, 1.4, 8), [](auto&, double opd) { return opd; });
  EXPECT_LT(relativeDifference(this->seen("OpticalPathDifference"), path), 3e-3);
  // Nothing else would do: neither the image at the time, nor that of the mean refractivity.
  EXPECT_GT(largestDifference(this->seen(), this->instant(1.1)), 0.05);
  const auto along = [](int axis)
  { return [axis](const std::array<double, 2>& deflection, double) { return deflection[axis]; }; };
  const auto u = this->meanOf(middlesOf(0.8, 1.4, 8), along(0));
  const auto v = this->meanOf(middlesOf(0.8, 1.4, 8), along(1));
  std::vector<double> ofMean;
  for (std::size_t i = 0; i < u.size(); ++i)
  {
    ofMean.push_back(circular({ u[i], v[i] }, 0));
  }
  EXPECT_GT(largestDifference(this->seen(), ofMean), 0.02);
}

TEST_F(ExposureTime, ConvergesToTheIntegralOverTime)
{
  this->filter->SetExposureTime(0.4);
  std::vector<double> errors;
  for (const int samples : { 2, 4, 8, 32 })
  {
    this->filter->SetExposureSamples(samples);
    this->filter->UpdateTimeStep(1);
    const auto deflection = this->seen("Deflection"); // at the centres of pixels
    std::vector<double> u;
    for (std::size_t i = 0; i < deflection.size(); i += 2)
    {
      u.push_back(deflection[i]);
    }
    errors.push_back(relativeDifference(u,
      this->meanOf(middlesOf(0.8, 1.2, 1000),
        [](const std::array<double, 2>& ofRay, double) { return ofRay[0]; })));
  }
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.5); // of second order
  EXPECT_LT(errors[2], 8e-3);
  EXPECT_LT(errors[3], 4e-3); // which is that of an instant on this grid
}

TEST_F(ExposureTime, FringesOfAnInterferogramAreBlurred)
{
  this->filter->SetCutoff(Filter::INTERFEROGRAM);
  this->filter->SetLengthScale(0.003);
  this->filter->SetExposureTime(0.6);
  this->filter->SetExposureSamples(5);
  this->filter->UpdateTimeStep(1);
  const auto mean = this->meanOf(middlesOf(0.7, 1.3, 5),
    [](auto&, double path) { return 0.5 + 0.5 * std::cos(2 * pi * 0.003 * path / 632.8e-9); });
  EXPECT_LT(largestDifference(this->seen(), mean), 5e-3);
}

TEST_F(ExposureTime, OfNoneOrOneSampleOrSteadyDataIsThePlainImage)
{
  const auto plain = this->instant(0.9);
  for (const auto& [time, samples] : { std::pair(0., 8), std::pair(0.4, 1) })
  {
    this->filter->SetExposureTime(time);
    this->filter->SetExposureSamples(samples);
    this->filter->UpdateTimeStep(0.9);
    EXPECT_EQ(this->seen(), plain);
    EXPECT_EQ(
      this->filter->GetOutputDataObject(0)->GetFieldData()->GetArray("ExposureInterval"), nullptr);
  }
  this->source->make = [](double) { return ballOnGrid(0.9); };
  this->source->steps = { 0, 1, 2 };
  this->source->Modified();
  this->filter->SetExposureTime(0.8);
  for (const int samples : { 3, 8 })
  {
    this->filter->SetExposureSamples(samples);
    this->filter->UpdateTimeStep(0.7);
    EXPECT_EQ(this->seen(), plain);
    EXPECT_EQ(this->seen("Deflection"), this->instant(0.9, "Deflection"));
  }
}

// Between time steps data are linear, so that the ball fades from one place to the next.
TEST_F(ExposureTime, TimeStepsAreInterpolatedAndEachIsReadOnce)
{
  this->source->steps = { 0, 0.75, 1, 1.5, 2 };
  this->filter->SetCutoff(Filter::CIRCULAR);
  this->filter->SetExposureTime(0.8);
  this->filter->SetExposureSamples(8);
  this->filter->UpdateTimeStep(1.2);
  EXPECT_EQ(this->source->requested, (std::vector<double>{ 0.75, 1, 1.5, 2 }));

  auto* image = vtkImageData::SafeDownCast(this->filter->GetOutputDataObject(0));
  std::vector<double> mean;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    double sum = 0;
    for (const double time : middlesOf(0.8, 1.6, 8))
    {
      const double before = time < 1 ? 0.75 : time < 1.5 ? 1 : 1.5;
      const double after = time < 1 ? 1 : time < 1.5 ? 1.5 : 2;
      const double ratio = (time - before) / (after - before);
      const auto from = this->ball.deflection(x[0], x[1], before);
      const auto to = this->ball.deflection(x[0], x[1], after);
      sum +=
        circular({ from[0] + ratio * (to[0] - from[0]), from[1] + ratio * (to[1] - from[1]) }, 0);
    }
    mean.push_back(sum / 8);
  }
  EXPECT_LT(largestDifference(this->seen(), mean), 5e-3);

  // Whatever has been read last, the image is of the time that was requested.
  EXPECT_EQ(image->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 1.2);
  const auto before = this->seen();
  this->filter->UpdateTimeStep(2);
  EXPECT_NE(this->seen(), before);
  this->filter->UpdateTimeStep(1.2);
  EXPECT_EQ(this->seen(), before);
}

TEST_F(ExposureTime, EndsWhereTheDataDo)
{
  this->source->steps = { 0, 0.5, 1, 1.5, 2 };
  this->filter->SetExposureTime(0.5);
  this->filter->SetExposureSamples(4);
  const auto interval = [this](double time)
  {
    this->filter->UpdateTimeStep(time);
    vtkDataArray* array =
      this->filter->GetOutputDataObject(0)->GetFieldData()->GetArray("ExposureInterval");
    return array ? std::pair(array->GetComponent(0, 0), array->GetComponent(1, 0))
                 : std::pair(time, time);
  };
  EXPECT_EQ(interval(1), std::pair(0.75, 1.25));
  EXPECT_EQ(interval(0), std::pair(0., 0.25));
  EXPECT_EQ(interval(1.875), std::pair(1.625, 2.));
  EXPECT_EQ(interval(3), std::pair(3., 3.)); // no part of it is within the data
}

// The sensitivity is that of the first instant, and LockK keeps it as that of any image.
TEST_F(ExposureTime, AllInstantsHaveTheSameSensitivityAndSurroundings)
{
  this->source->make = [](double time)
  {
    auto image = cube(24);
    addPointArray(image, "N",
      [time, column = GaussianColumn()](const Vec& x) { return (1 + time) * (1e-4 + column(x)); });
    return image;
  };
  const auto automatic = [this](double time)
  {
    auto plain = bench(nullptr, pixels);
    plain->SetInputConnection(this->source->GetOutputPort());
    plain->SetAutoAmbientRefractivity(true);
    plain->UpdateTimeStep(time);
    return std::array{ fieldValue(plain, "KScale"), fieldValue(plain, "AmbientRefractivity") };
  };
  this->filter->ClearFocalPoint();
  this->filter->SetParallelScale(0);
  this->filter->SetAutoKScale(true);
  this->filter->SetAutoAmbientRefractivity(true);
  this->filter->SetExposureTime(0.5);
  this->filter->SetExposureSamples(2);
  const auto k = [this](double time)
  {
    this->filter->UpdateTimeStep(time);
    return fieldValue(this->filter, "KScale");
  };
  EXPECT_EQ(k(1), automatic(0.875)[0]);
  EXPECT_EQ(fieldValue(this->filter, "AmbientRefractivity"), automatic(0.875)[1]);
  EXPECT_EQ(this->filter->GetLockedK(), 0);

  // Not even with LockK off does the second instant have another one.
  const auto plain = [&, this](double time, double ofAll)
  {
    auto one = bench(nullptr, pixels);
    one->SetInputConnection(this->source->GetOutputPort());
    one->SetAutoKScale(false);
    one->SetKScale(ofAll);
    one->SetAutoAmbientRefractivity(false);
    one->SetAmbientRefractivity(automatic(0.875)[1]);
    one->UpdateTimeStep(time);
    return valuesOf(one, "Intensity");
  };
  this->filter->SetLockK(Filter::LOCK_OFF);
  this->filter->UpdateTimeStep(1);
  const auto first = plain(0.875, automatic(0.875)[0]), second = plain(1.125, automatic(0.875)[0]);
  std::vector<double> mean;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    mean.push_back((first[i] + second[i]) / 2);
  }
  EXPECT_LT(largestDifference(this->seen(), mean), 1e-6);

  // At other times, with other light and without an exposure.
  this->filter->SetLockK(Filter::LOCK_OVER_TIME);
  const double kept = k(1);
  EXPECT_EQ(k(0.5), kept);
  this->filter->SetKnifeEdgeAngle(30);
  EXPECT_EQ(k(0.5), kept);
  this->filter->SetExposureTime(0);
  EXPECT_EQ(k(0.5), kept);
  EXPECT_EQ(this->filter->GetLockedK(), kept);
  this->filter->SetExposureTime(0.2);
  EXPECT_EQ(k(0.5), kept);
  EXPECT_NE(std::string(this->filter->GetStatus()).find("k locked at"), std::string::npos);
}

// The points of a mesh move in between, and what is known of its cells serves for all instants where they do not.
TEST_F(ExposureTime, MeshesMoveBetweenTimeSteps)
{
  this->source->make = [](double time) { return ballOnMovingMesh(time, 24); };
  this->source->steps = { 0.5, 1.5 };
  this->filter->SetCutoff(Filter::CIRCULAR);
  this->filter->SetMediumTolerance(1e-3);
  this->filter->SetExposureTime(0.6);
  this->filter->SetExposureSamples(4);
  this->filter->UpdateTimeStep(1);
  EXPECT_LT(largestDifference(this->seen(), this->meanOf(middlesOf(0.7, 1.3, 4), circular)), 1e-2);

  this->source->make = [](double time)
  {
    auto mesh = ballOnMovingMesh(1, 12);
    mesh->GetPointData()->Initialize();
    addPointArray(
      mesh, "N", [time, still = MovingBall()](const Vec& x) { return still.at(x, time); });
    return mesh;
  };
  this->source->Modified();
  const vtkTypeInt64 builds = this->filter->GetMeshBuilds();
  this->filter->UpdateTimeStep(1);
  EXPECT_FALSE(isEmpty(this->filter));
  EXPECT_EQ(this->filter->GetMeshBuilds(), builds + 1);
}

// What is linear in time is the same between time steps and from a source of any time.
TEST_F(ExposureTime, AllKindsOfDataAreInterpolated)
{
  const auto strength = [](const Vec& x, double time)
  { return 1e-4 * (std::sin(3 * x[0]) + time * std::cos(2 * x[1] - x[2])); };
  const auto addStrength = [strength](vtkDataSet* data, double time)
  { addPointArray(data, "N", [&](const Vec& x) { return strength(x, time); }); };
  using Make = std::function<vtkSmartPointer<vtkDataObject>(double)>;
  constexpr int edge = 10; // points
  const std::pair<const char*, Make> kinds[] = {
    { "cells of an image, some masked, and texts",
      [strength](double time)
      {
        auto image = cube(12);
        addCellArray(image, "N", [&](const Vec& x) { return strength(x, time); });
        addCellArray(image, "mask", [](const Vec& x) { return x[0] > 0.5 ? 1. : 0.; });
        image->GetCellData()->GetArray("N")->SetComponent(300, 0, std::nan(""));
        vtkNew<vtkStringArray> words;
        words->SetName("words");
        words->SetNumberOfValues(image->GetNumberOfCells());
        image->GetCellData()->AddArray(words);
        return image;
      } },
    { "single precision",
      [strength](double time)
      {
        auto image = cube(12);
        vtkNew<vtkFloatArray> values;
        values->SetName("N");
        for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
        {
          values->InsertNextValue(
            static_cast<float>(1e-4 * (1 + time * static_cast<double>(i % 12) / 12)));
        }
        image->GetPointData()->AddArray(values);
        return image;
      } },
    { "a rectilinear grid that grows",
      [](double time)
      {
        auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
        grid->SetDimensions(edge, edge, edge);
        vtkNew<vtkDoubleArray> x, y;
        for (int i = 0; i < edge; ++i)
        {
          x->InsertNextValue((i - 4.5) / 5 * (1 + 0.1 * time));
          y->InsertNextValue((i - 4.5) / 5);
        }
        grid->SetXCoordinates(x);
        grid->SetYCoordinates(y);
        grid->SetZCoordinates(y);
        int number = 0; // the same of a point wherever it is
        addPointArray(
          grid, "N", [&](const Vec&) { return 1e-5 * std::sin(0.3 * (number++ % edge)); });
        return grid;
      } },
    { "a structured grid that moves",
      [](double time)
      {
        auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
        vtkNew<vtkPoints> points;
        points->SetDataTypeToDouble();
        const auto image = cube(edge);
        for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
        {
          const double* x = image->GetPoint(i);
          points->InsertNextPoint(x[0] + 0.2 * time * x[1], x[1], x[2]);
        }
        grid->SetDimensions(edge, edge, edge);
        grid->SetPoints(points);
        int number = 0; // the same of a point wherever it is
        addPointArray(
          grid, "N", [&](const Vec&) { return 1e-5 * std::sin(0.3 * (number++ % edge)); });
        return grid;
      } },
    { "blocks, one of which is empty",
      [addStrength](double time)
      {
        auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
        for (unsigned i = 0; i < 3; i += 2)
        {
          auto image = cube(10);
          image->SetOrigin(i == 0 ? -1 : 1, -1, -1);
          addStrength(image, time);
          blocks->SetBlock(i, image);
        }
        return blocks;
      } },
    { "AMR",
      [](double time) {
        return ballOnLevels(8, { { 0, 8 }, { 4, 8, true } }, { 1e-4 * (1 + time), 0.3 });
      } }
  };
  for (const auto& [name, make] : kinds)
  {
    SCOPED_TRACE(name);
    const auto imageOf = [this, &made = make](const std::vector<double>& steps)
    {
      this->source->make = made;
      this->source->steps = steps;
      this->source->Modified();
      const auto first = made(0);
      auto* leaf = vtkDataSet::SafeDownCast(first);
      const bool isOfCells =
        (leaf && leaf->GetCellData()->HasArray("N")) || first->IsA("vtkOverlappingAMR");
      auto one = bench(nullptr, pixels);
      one->SetInputConnection(this->source->GetOutputPort());
      one->SetInputArrayToProcess(vtkRefractiveIndex::INDEX_ARRAY, 0, 0,
        isOfCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS
                  : vtkDataObject::FIELD_ASSOCIATION_POINTS,
        "N");
      if (leaf && leaf->GetCellData()->HasArray("mask"))
      {
        one->SetInputArrayToProcess(
          vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "mask");
      }
      one->SetFocalPoint(0, 0, 0);
      one->SetParallelScale(1.2);
      one->SetAutoKScale(false);
      one->SetKScale(sensitivity);
      one->SetMediumTolerance(0.2);
      one->SetExposureTime(1);
      one->SetExposureSamples(4);
      one->UpdateTimeStep(1);
      EXPECT_FALSE(isEmpty(one));
      return valuesOf(one, "OpticalPathDifference");
    };
    const auto ofSteps = imageOf({ 0, 0.75, 2 });
    EXPECT_LT(relativeDifference(ofSteps, imageOf({})), 1e-6);
    EXPECT_GT(largest(ofSteps), 0);
  }
}

// They are interpolated, too; what is not a number, as masks, is of the earlier step.
TEST_F(ExposureTime, BodiesMoveAndMasksStay)
{
  this->source->steps = { 0, 2 };
  vtkNew<Changing> body;
  body->make = [](double time)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetThetaResolution(32);
    sphere->SetPhiResolution(32);
    sphere->SetRadius(0.2);
    sphere->SetCenter(0.5 * (time - 1), 0, 0);
    sphere->Update();
    return vtkSmartPointer<vtkDataObject>(sphere->GetOutput());
  };
  body->steps = { 0, 2 };
  this->filter->SetInputConnection(vtkRefractiveIndex::BODIES, body->GetOutputPort());
  this->filter->SetExposureTime(0.8);
  this->filter->SetExposureSamples(2);
  this->filter->UpdateTimeStep(1);
  auto* image = vtkImageData::SafeDownCast(this->filter->GetOutputDataObject(0));
  const auto blocked = this->seen("BlockedFraction");
  const auto at = [&](double x)
  {
    double place[3] = { x, 0, 0 };
    return blocked[static_cast<std::size_t>(image->FindPoint(place))];
  };
  EXPECT_EQ(at(0), 1); // by both
  EXPECT_EQ(at(-0.2), 0.5);
  EXPECT_EQ(at(0.2), 0.5);
  EXPECT_EQ(at(0.5), 0);

  this->filter->SetInputConnection(vtkRefractiveIndex::BODIES, nullptr);
  this->source->make = [](double time)
  {
    auto grid = cube(24);
    addPointArray(grid, "N", GaussianColumn());
    vtkNew<vtkUnsignedCharArray> mask;
    mask->SetName("mask");
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      mask->InsertNextValue(grid->GetPoint(i)[0] > 0.2 * time ? 200 : 0);
    }
    grid->GetPointData()->AddArray(mask);
    return grid;
  };
  this->source->Modified();
  this->filter->SetInputArrayToProcess(
    vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "mask");
  this->filter->SetMaskThreshold(150);
  this->filter->UpdateTimeStep(1);
  const auto masked = this->seen("BlockedFraction");
  this->filter->SetExposureTime(0);
  this->filter->UpdateTimeStep(0);
  EXPECT_EQ(masked, this->seen("BlockedFraction"));
}

TEST_F(ExposureTime, DoesNotDependOnThreadsAndTimeLimits)
{
  this->source->steps = { 0, 0.5, 1, 1.5, 2 };
  this->filter->SetExposureTime(0.7);
  this->filter->SetSamplesPerPixel(3);
  this->filter->SetNumberOfThreads(1);
  this->filter->UpdateTimeStep(1);
  const auto one = this->seen();
  this->filter->SetNumberOfThreads(3);
  this->filter->UpdateTimeStep(1);
  EXPECT_EQ(this->seen(), one);

  this->filter->SetTimeLimit(1e-9);
  this->filter->SetKnifeEdgeAngle(90);
  this->filter->Refine(); // which does not begin an image of an instant
  this->filter->SetKnifeEdgeAngle(0);
  this->filter->Refine();
  this->filter->UpdateTimeStep(1);
  EXPECT_TRUE(this->filter->GetFinished());
  EXPECT_EQ(this->filter->GetPercentDone(), 100);
  EXPECT_EQ(this->seen(), one);
}

TEST_F(ExposureTime, PreviewsAreOfTheInstant)
{
  this->source->steps = { 0, 0.5, 1, 1.5, 2 };
  this->filter->SetPreviewReduction(2);
  this->filter->UpdateTimeStep(1);
  const auto plain = this->seen();
  this->filter->SetExposureTime(1);
  this->source->requested.clear();
  this->filter->UpdateTimeStep(1);
  EXPECT_TRUE(this->source->requested.empty());
  EXPECT_EQ(this->seen(), plain);
  this->filter->SetPreviewReduction(1);
  this->filter->UpdateTimeStep(1);
  EXPECT_EQ(this->source->requested.size(), 3u);
}

TEST_F(ExposureTime, AddsUpColoursOfLight)
{
  this->filter->SetCutoff(Filter::COLOR_FILTER);
  this->filter->SetKScale(300);
  this->filter->SetExposureTime(0.8);
  this->filter->SetExposureSamples(2);
  this->filter->UpdateTimeStep(1);
  const auto linear = [](double byte)
  {
    const double value = byte / 255;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  const auto sum = this->seen("Color");
  this->filter->SetExposureTime(0);
  std::vector<double> mean(sum.size());
  for (const double time : { 0.8, 1.2 })
  {
    this->filter->UpdateTimeStep(time);
    const auto color = this->seen("Color");
    for (std::size_t i = 0; i < mean.size(); ++i)
    {
      mean[i] += linear(color[i]) / 2;
    }
  }
  std::vector<double> ofSum;
  std::transform(sum.begin(), sum.end(), std::back_inserter(ofSum), linear);
  EXPECT_LT(largestDifference(ofSum, mean), 0.01);
}

TEST_F(ExposureTime, HistogramIsThatOfAllInstants)
{
  // Twice as much bending as before needs twice the range.
  this->source->make = [](double time)
  {
    auto image = cube(24);
    addPointArray(
      image, "N", [time](const Vec& x) { return 1e-4 * (1 + 3 * time) * (x[0] - 0.5 * x[1]); });
    return image;
  };
  const auto countAt = [this](double u, double v)
  {
    auto* bins =
      vtkImageData::SafeDownCast(this->filter->GetOutputDataObject(Filter::HISTOGRAM_PORT));
    const double* spacing = bins->GetSpacing();
    const int column = static_cast<int>(std::floor((u - bins->GetOrigin()[0]) / spacing[0] + 0.5));
    const int row = static_cast<int>(std::floor((v - bins->GetOrigin()[1]) / spacing[1] + 0.5));
    return bins->GetPointData()->GetScalars()->GetComponent(
      row * bins->GetDimensions()[0] + column, 0);
  };
  for (const int size : { 8, 64 })
  {
    this->filter->SetHistogramSize(size);
    this->filter->SetExposureTime(1.6);
    this->filter->SetExposureSamples(2);
    this->filter->UpdateTimeStep(1);
    // Light crosses a depth of 2.
    const double weak = 2e-4 * (1 + 3 * 0.6), strong = 2e-4 * (1 + 3 * 1.4);
    EXPECT_EQ(countAt(weak, -0.5 * weak), pixels * pixels) << size;
    EXPECT_EQ(countAt(strong, -0.5 * strong), pixels * pixels) << size;
  }
}

TEST_F(ExposureTime, MistakesAreSaidOnce)
{
  this->source->steps = { 0, 1, 2 };
  this->filter->SetExposureTime(1);
  const auto off = [](Filter* made) { made->SetExposureTime(0); };
  const auto requestIt = [this](Filter* made)
  {
    made->UpdateInformation();
    made->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), 1);
    made->SetExposureTime(1);
  };
  const auto change = [this](const std::function<vtkSmartPointer<vtkDataObject>(double)>& make)
  {
    this->source->make = make;
    this->source->Modified();
  };

  change(
    [](double time)
    {
      auto image = cube(time > 1 ? 20 : 24);
      addPointArray(image, "N", GaussianColumn());
      return image;
    });
  expectOneMessage(this->filter.GetPointer(), requestIt, { "13824 and 8000 points" }, off);

  change(
    [](double time)
    {
      auto image = cube(24);
      addPointArray(image, "N", GaussianColumn());
      image->GetPointData()->GetArray(0)->SetName(time > 1 ? "M" : "N");
      return image;
    });
  expectOneMessage(this->filter.GetPointer(), requestIt, { "array N is not in both" }, off);

  change(
    [](double time)
    {
      auto image = cube(24);
      image->SetOrigin(-1, -1, time);
      addPointArray(image, "N", GaussianColumn());
      return image;
    });
  expectOneMessage(this->filter.GetPointer(), requestIt, { "different places" }, off);

  change(
    [](double time)
    {
      auto mesh = ballOnMovingMesh(1, 8);
      if (time > 1) // the same cells in another order
      {
        vtkNew<vtkUnstructuredGrid> other;
        other->SetPoints(mesh->GetPoints());
        for (vtkIdType cell = mesh->GetNumberOfCells(); cell-- > 0;)
        {
          other->InsertNextCell(mesh->GetCellType(cell), mesh->GetCell(cell)->GetPointIds());
        }
        other->GetPointData()->ShallowCopy(mesh->GetPointData());
        mesh->ShallowCopy(other);
      }
      return mesh;
    });
  expectOneMessage(this->filter.GetPointer(), requestIt, { "cells have different points" }, off);

  // The image would move with the mesh.
  change([](double time) { return ballOnMovingMesh(time, 8); });
  this->filter->ClearFocalPoint();
  expectOneMessage(
    this->filter.GetPointer(), requestIt, { "Set FocalPoint and ParallelScale" }, off);

  // What is upstream says the rest.
  change(ballOnGrid);
  this->source->broken = { 2 };
  expectOneMessage(this->filter.GetPointer(), requestIt, { "no data of the time step 2" }, off);
}

TEST_F(ExposureTime, CanBeAborted)
{
  this->source->steps = { 0, 0.5, 1, 1.5, 2 };
  this->filter->SetExposureTime(1);
  WatchedProgress watch(this->filter, 0.6);
  this->filter->UpdateTimeStep(1);
  EXPECT_TRUE(isEmpty(this->filter));
  EXPECT_TRUE(std::is_sorted(watch.seen.begin(), watch.seen.end()));
  watch.seen.pop_back(); // VTK's, of the end
  EXPECT_LT(watch.seen.back(), 0.8);

  // As the window does, which lets it continue.
  this->filter->SetTimeLimit(1);
  this->filter->Modified();
  this->filter->UpdateTimeStep(1);
  EXPECT_TRUE(isEmpty(this->filter));
  EXPECT_TRUE(this->filter->GetStopped());
  EXPECT_STREQ(this->filter->GetStatus(), "No image: the exposure was stopped");
  watch.stopAt = 2;
  this->filter->UpdateTimeStep(1);
  EXPECT_TRUE(isEmpty(this->filter));
  this->filter->Refine();
  this->filter->UpdateTimeStep(1);
  EXPECT_FALSE(isEmpty(this->filter));
}
