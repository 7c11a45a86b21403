// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The next time step is read while the image of this one is traced. The truth is what a filter makes that reads each
// step when it is requested: the last bit of every number.
#include "BallOnLevels.h"
#include "CellMeshes.h"
#include "Changing.h"

#include "vtkArrayCalculator.h"
#include "vtkCallbackCommand.h"
#include "vtkSphereSource.h"

#include <numeric>

namespace
{

using Filter = vtkSchlierenFilter;
using Make = std::function<vtkSmartPointer<vtkDataObject>(double)>;
using Times = std::vector<double>;

constexpr int pixels = 24;
constexpr int steps = 8;

double flow(const Vec& x, double time)
{
  return 1e-4 * (1 + std::sin(1 + time) * std::exp(-6 * dot(x, x) + 0.3 * time * x[0]));
}

vtkSmartPointer<vtkDataObject> imageAt(double time)
{
  auto image = cube(24);
  addPointArray(image, "N", [time](const Vec& x) { return flow(x, time); });
  return image;
}

vtkSmartPointer<vtkDataObject> meshAt(double time)
{
  const CellKind kind = linearKinds()[0];
  const Mesh mesh = meshOf(kind.type, 6, kind.cells, 0.2, false);
  addPointArray(mesh, "N", [time](const Vec& x) { return flow(x, time); });
  return mesh;
}

vtkSmartPointer<vtkDataObject> meshThatMoves(double time)
{
  const CellKind kind = linearKinds()[0];
  const Mesh mesh = meshOf(kind.type, 5, kind.cells, 0.1, false);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    Vec x;
    mesh->GetPoint(i, x.data());
    mesh->GetPoints()->SetPoint(i, x[0] + 0.1 * time, x[1], x[2]);
  }
  addPointArray(mesh, "N", [time](const Vec& x) { return flow(x, time); });
  return mesh;
}

vtkSmartPointer<vtkDataObject> amrAt(double time)
{
  return ballOnLevels(4, { { 0, 4 }, { 2, 4 } }, { 1e-4 * (2 + std::sin(time)), 0.3 });
}

class ReadAhead : public testing::Test
{
protected:
  ReadAhead() { this->filter = this->connected(1024); }

  vtkSmartPointer<Filter> connected(int memory)
  {
    auto made = bench(nullptr, pixels);
    this->source->make = imageAt;
    this->source->steps.resize(steps);
    std::iota(this->source->steps.begin(), this->source->steps.end(), 0);
    made->SetInputConnection(this->source->GetOutputPort());
    made->SetReadAheadMemory(memory);
    return made;
  }

  /// What has been read since the last call.
  Times read() { return std::exchange(this->source->requested, {}); }

  Times readFor(double time)
  {
    this->filter->UpdateTimeStep(time);
    EXPECT_EQ(
      this->filter->GetOutputDataObject(0)->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()),
      time);
    return this->read();
  }

  /// Whatever has been read, the images are those of their times.
  void expectSameImages(
    const Make& make, const Times& times, const std::function<void(Filter*)>& set = [](Filter*) {})
  {
    auto plain = this->connected(0);
    this->source->make = make;
    this->source->Modified();
    set(plain);
    set(this->filter);
    std::vector<std::array<std::vector<double>, 3>> expected;
    const auto result = [](Filter* of)
    {
      return std::array{ valuesOf(of, of->GetColorByField() ? "Color" : "Intensity"),
        valuesOf(of, "Deflection"),
        std::vector{ fieldValue(of, "KScale"), fieldValue(of, "AmbientRefractivity") } };
    };
    for (const double time : times)
    {
      plain->UpdateTimeStep(time);
      expected.push_back(result(plain));
    }
    for (std::size_t i = 0; i < times.size(); ++i)
    {
      this->filter->UpdateTimeStep(times[i]);
      EXPECT_EQ(result(this->filter), expected[i]) << "time " << times[i];
    }
  }

  vtkNew<Changing> source;
  vtkSmartPointer<Filter> filter;
};

const Times inAnyOrder{ 0, 1, 2, 3, 2, 1, 5, 7, 0, 0.5, 4, 4, 3, 7, 6 };

void ofCells(Filter* filter)
{
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
}

void tinted(Filter* filter)
{
  filter->SetColorByField(true);
  filter->SetCutoff(Filter::CIRCULAR);
  filter->ClearFields();
  filter->AddField("N");
}

} // namespace

TEST_F(ReadAhead, ImagesOfImagesAreTheSame) { this->expectSameImages(imageAt, inAnyOrder); }

TEST_F(ReadAhead, ImagesOfMeshesAreTheSame) { this->expectSameImages(meshAt, inAnyOrder); }

TEST_F(ReadAhead, ImagesOfMeshesThatMoveAreTheSame)
{
  this->expectSameImages(meshThatMoves, inAnyOrder);
}

TEST_F(ReadAhead, ImagesOfAmrAreTheSame) { this->expectSameImages(amrAt, inAnyOrder, ofCells); }

TEST_F(ReadAhead, TintedImagesAreTheSame)
{
  this->expectSameImages(imageAt, inAnyOrder, tinted);
  this->expectSameImages(meshAt, inAnyOrder, tinted);
}

TEST_F(ReadAhead, DifferencesAreTheSame)
{
  this->expectSameImages(
    meshAt, inAnyOrder, [](Filter* one) { one->SetPathModel(Filter::DIFFERENCE); });
}

TEST_F(ReadAhead, ImagesWithBodiesAreTheSame)
{
  vtkNew<vtkSphereSource> body;
  body->SetRadius(0.4);
  body->SetCenter(0.5, 0.5, 0.5);
  this->expectSameImages(meshAt, inAnyOrder,
    [&](Filter* one)
    { one->SetInputConnection(vtkRefractiveIndex::BODIES, body->GetOutputPort()); });
}

TEST_F(ReadAhead, AmbientThatIsKeptOrOfEachTimeIsTheSame)
{
  for (const bool isLocked : { true, false })
  {
    this->expectSameImages(meshAt, { 0, 1, 2, 1, 0 },
      [=](Filter* one)
      {
        one->SetAutoAmbientRefractivity(true);
        one->SetLockAmbient(isLocked);
      });
  }
}

TEST_F(ReadAhead, EachStepIsReadOnceAndAheadOfItsTime)
{
  EXPECT_EQ(this->readFor(0), Times({ 0, 1 }));
  for (double time = 1; time < steps - 1; ++time)
  {
    EXPECT_EQ(this->readFor(time), Times{ time + 1 });
  }
  EXPECT_EQ(this->readFor(steps - 1), Times());
}

TEST_F(ReadAhead, TheNextStepIsAsFarAsTheLastWas)
{
  EXPECT_EQ(this->readFor(0), Times({ 0, 1 }));
  EXPECT_EQ(this->readFor(2), Times({ 2, 4 }));
  EXPECT_EQ(this->readFor(4), Times({ 6 }));
  EXPECT_EQ(this->readFor(3), Times({ 3, 2 })); // backwards
  EXPECT_EQ(this->readFor(2), Times({ 1 }));
  EXPECT_EQ(this->readFor(6), Times({ 6 }));     // after which there would be 10
  EXPECT_EQ(this->readFor(2.5), Times({ 2.5 })); // which is no step
}

TEST_F(ReadAhead, AStepThatIsShownAgainIsNotReadAgain)
{
  for (const Make& make : { Make(imageAt), Make(meshAt) })
  {
    this->filter = this->connected(1024);
    this->source->make = make;
    this->source->Modified();
    this->readFor(0);
    EXPECT_EQ(this->readFor(1), Times{ 2 });
    const vtkTypeInt64 rays = this->filter->GetTotalRaysTraced();
    this->filter->SetKnifeEdgeAngle(90);
    EXPECT_EQ(this->readFor(1), Times());
    EXPECT_EQ(this->filter->GetTotalRaysTraced(), rays);
    this->filter->SetViewDirection(1, 0, 0);
    EXPECT_EQ(this->readFor(1), Times());
    EXPECT_GT(this->filter->GetTotalRaysTraced(), rays);
    // The same with slices of time, as in a window.
    this->filter->SetTimeLimit(1e-9);
    this->filter->SetKnifeEdgeAngle(0);
    this->filter->SetViewDirection(0, 0, -1);
    EXPECT_EQ(this->readFor(1), Times());
    for (int slice = 0; !this->filter->GetFinished() && slice < 1000; ++slice)
    {
      this->filter->Refine();
      this->filter->UpdateTimeStep(1);
    }
    EXPECT_TRUE(this->filter->GetFinished());
    EXPECT_EQ(this->read(), Times());
  }
}

TEST_F(ReadAhead, MediaAreMadeAhead)
{
  for (const Make& make : { Make(imageAt), Make(meshAt) })
  {
    this->filter = this->connected(1024);
    this->source->make = make;
    this->source->Modified();
    for (double time = 0; time < 4; ++time)
    {
      this->filter->UpdateTimeStep(time);
      EXPECT_EQ(this->filter->GetMediumBuilds(), 1) << time;
    }
  }
}

TEST_F(ReadAhead, NothingIsReadWhereThereIsNoMemoryForIt)
{
  this->source->make = [](double time)
  {
    auto image = cube(60); // of 1.6 MiB
    addPointArray(image, "N", [time](const Vec& x) { return flow(x, time); });
    return image;
  };
  this->filter->SetReadAheadMemory(1);
  EXPECT_EQ(this->readFor(0), Times{ 0 });
  EXPECT_EQ(this->readFor(1), Times{ 1 });
  this->filter->SetReadAheadMemory(2);
  EXPECT_EQ(this->readFor(2), Times({ 2, 3 }));
  this->filter->SetReadAheadMemory(0);
  EXPECT_EQ(this->readFor(3), Times()); // there it is
  EXPECT_EQ(this->readFor(4), Times{ 4 });
  this->filter->SetReadAheadMemory(-5);
  EXPECT_EQ(this->filter->GetReadAheadMemory(), 0);
}

// Upstream has another step then.
TEST_F(ReadAhead, CanBeSwitchedOffAtAnyTime)
{
  auto plain = this->connected(0);
  plain->SetAutoKScale(false);
  plain->SetKnifeEdgeAngle(90);
  plain->UpdateTimeStep(1);
  const auto expected = valuesOf(plain, "Intensity");
  plain->SetExposureTime(1);
  plain->SetExposureSamples(3);
  plain->UpdateTimeStep(1);
  const auto exposed = valuesOf(plain, "Intensity");
  EXPECT_NE(exposed, expected);
  for (const bool isExposed : { false, true })
  {
    this->filter = this->connected(1024);
    this->filter->SetAutoKScale(false);
    this->filter->UpdateTimeStep(0);
    this->filter->UpdateTimeStep(1);
    this->filter->SetKnifeEdgeAngle(90);
    if (isExposed)
    {
      this->filter->SetExposureTime(1);
      this->filter->SetExposureSamples(3);
    }
    else
    {
      this->filter->SetReadAheadMemory(0);
    }
    this->filter->UpdateTimeStep(1);
    EXPECT_EQ(valuesOf(this->filter, "Intensity"), isExposed ? exposed : expected);
  }
}

TEST_F(ReadAhead, StepsOfAnExposureAreReadWhileItsInstantsAreTraced)
{
  const auto expose = [](Filter* one)
  {
    one->SetExposureTime(2);
    one->SetExposureSamples(2); // between the first two steps, and the last two
  };
  for (const auto& make : { imageAt, meshAt, amrAt })
  {
    this->filter = this->connected(1024);
    this->expectSameImages(make, { 1, 5 }, expose);
  }
  for (const bool isAhead : { false, true })
  {
    this->filter = this->connected(isAhead ? 1024 : 0);
    expose(this->filter);
    double whenRead = -1;
    this->source->make = [&](double time)
    {
      whenRead = time == 2 ? this->filter->GetProgress() : whenRead;
      return imageAt(time);
    };
    this->source->Modified();
    this->read();
    EXPECT_EQ(this->readFor(1), Times({ 0, 1, 2 }));
    // The first of two instants is half of the work, and to find its medium the first fifth of that.
    EXPECT_EQ(whenRead <= 0.1, isAhead) << whenRead;
  }
}

TEST_F(ReadAhead, AStepOfAnExposureThatCannotBeReadIsAMistake)
{
  this->source->broken = { 2 };
  this->filter->SetExposureTime(2);
  this->filter->SetExposureSamples(2);
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(this->filter));
  this->filter->UpdateTimeStep(1);
  ASSERT_EQ(complaints->Errors.size(), 1u);
  EXPECT_NE(complaints->Errors[0].find("no data of the time step 2"), std::string::npos);
  EXPECT_TRUE(isEmpty(this->filter));
  EXPECT_EQ(this->read(), Times({ 0, 1, 2 }));
  this->filter->UpdateTimeStep(5);
  EXPECT_FALSE(isEmpty(this->filter));
}

TEST_F(ReadAhead, NothingIsReadForTheNextExposureSlicesOfTimeAndSteadyData)
{
  this->filter->SetTimeLimit(1e-9);
  EXPECT_EQ(this->readFor(0), Times{ 0 });
  this->filter->SetTimeLimit(0);
  this->filter->SetExposureTime(1);
  this->filter->SetExposureSamples(2);
  EXPECT_EQ(this->readFor(1), Times({ 1, 2 })); // 0 is there
  vtkNew<Changing> continuous;
  continuous->make = imageAt;
  this->filter->SetExposureTime(0);
  this->filter->SetInputConnection(continuous->GetOutputPort());
  this->filter->UpdateTimeStep(1);
  this->filter->UpdateTimeStep(1.5);
  EXPECT_EQ(continuous->requested, Times({ 1, 1.5 }));
}

TEST_F(ReadAhead, WhatIsUpstreamMayChange)
{
  this->readFor(0);
  this->readFor(1);
  this->source->make = meshAt;
  this->source->Modified();
  EXPECT_EQ(this->readFor(2), Times({ 2, 3 }));
  EXPECT_FALSE(isEmpty(this->filter));
  this->source->Modified();
  EXPECT_EQ(this->readFor(2), Times({ 2, 3 }));
  // There may be more between, and somebody else may use it for another time.
  vtkNew<vtkArrayCalculator> calculator;
  calculator->SetInputConnection(this->source->GetOutputPort());
  calculator->AddScalarArrayName("N");
  calculator->SetFunction("2 * N");
  calculator->SetResultArrayName("N");
  this->filter->SetInputConnection(calculator->GetOutputPort());
  EXPECT_EQ(this->readFor(2), Times({ 2, 3 }));
  calculator->UpdateTimeStep(6);
  EXPECT_EQ(this->read(), Times{ 6 });
  EXPECT_EQ(this->readFor(3), Times{ 4 });
  this->filter->SetInputConnection(this->source->GetOutputPort());
  EXPECT_EQ(this->readFor(3), Times({ 3, 4 }));
}

// Some readers say at each time step that they have changed.
TEST_F(ReadAhead, NothingIsReadTwiceOfSourcesThatAlwaysChange)
{
  this->source->make = [this](double time)
  {
    this->source->Modified();
    return imageAt(time);
  };
  this->filter->UpdateTimeStep(0);
  this->read();
  this->filter->UpdateTimeStep(1);
  const Times later = this->read();
  EXPECT_EQ(std::count(later.begin(), later.end(), 2), 0);
}

TEST_F(ReadAhead, AStepThatCannotBeReadIsReportedAtItsTime)
{
  this->source->broken = { 1 };
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(this->filter));
  this->filter->UpdateTimeStep(0);
  EXPECT_FALSE(isEmpty(this->filter));
  EXPECT_TRUE(complaints->Errors.empty());
  this->source->broken = {};
  this->source->make = [](double time)
  {
    auto image = imageAt(time);
    if (time == 2)
    {
      vtkImageData::SafeDownCast(image)->GetPointData()->Initialize();
    }
    return image;
  };
  this->filter->UpdateTimeStep(1);
  EXPECT_FALSE(isEmpty(this->filter));
  EXPECT_TRUE(complaints->Errors.empty());
  this->filter->UpdateTimeStep(2);
  EXPECT_TRUE(isEmpty(this->filter));
  EXPECT_EQ(complaints->Errors.size(), 1u);
  this->filter->UpdateTimeStep(3);
  EXPECT_FALSE(isEmpty(this->filter));
  EXPECT_EQ(complaints->Errors.size(), 1u);
}

TEST_F(ReadAhead, CanBeAborted)
{
  this->readFor(0);
  this->filter->SetSamplesPerPixel(64);
  vtkNew<vtkCallbackCommand> observer;
  std::vector<double> progress;
  observer->SetClientData(&progress);
  observer->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void* value)
    {
      static_cast<std::vector<double>*>(data)->push_back(*static_cast<double*>(value));
      vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
    });
  const unsigned long tag = this->filter->AddObserver(vtkCommand::ProgressEvent, observer);
  this->filter->UpdateTimeStep(1);
  EXPECT_TRUE(isEmpty(this->filter));
  progress.pop_back(); // VTK's, of the end
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  this->filter->RemoveObserver(tag);
  this->filter->Modified();
  this->read();
  const Times again = this->readFor(1);
  EXPECT_EQ(std::count(again.begin(), again.end(), 1), 0); // it is there
  EXPECT_FALSE(isEmpty(this->filter));
}
