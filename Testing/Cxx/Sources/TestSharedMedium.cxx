// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Filters of the same data, as those of several views and of a pipeline, have one medium together: what makes another,
// and when it goes. The truth is the image of a filter that is alone with its data.
#include "CellMeshes.h"

#include "vtkTrivialProducer.h"
#include "vtkWeakPointer.h"

namespace
{

using Filter = vtkSmartPointer<vtkSchlierenFilter>;
using Producer = vtkSmartPointer<vtkTrivialProducer>;
using Change = std::function<void(vtkSchlierenFilter*)>;

Producer producerOf(vtkDataObject* data)
{
  auto producer = Producer::New();
  producer->SetOutput(data);
  return producer;
}

Filter filterOf(vtkAlgorithm* data, const Change& change = nullptr)
{
  Filter filter = bench(nullptr, 24);
  filter->SetInputConnection(data->GetOutputPort());
  if (change)
  {
    change(filter);
  }
  return filter;
}

vtkSmartPointer<vtkImageData> blobImage(int points = 16)
{
  auto image = cube(points);
  const auto blob = [](const Vec& x) { return 1e-4 * std::exp(-3 * dot(x, x) + x[0]); };
  addPointArray(image, "N", blob);
  addPointArray(image, "rho", [&](const Vec& x) { return 1 + 1e4 * blob(x); });
  return image;
}

vtkSmartPointer<vtkUnstructuredGrid> tetMesh()
{
  return meshOf(VTK_TETRA, 4,
    { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
      { { 1, 1, 1 }, { 0, 1, 1 }, { 1, 0, 1 }, { 1, 1, 0 } },
      { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 0 } },
      { { 0, 1, 1 }, { 1, 0, 1 }, { 0, 0, 1 }, { 1, 1, 0 } },
      { { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 0 }, { 0, 1, 1 } },
      { { 1, 0, 0 }, { 0, 0, 1 }, { 1, 1, 0 }, { 1, 0, 1 } } },
    0.1, false);
}

std::vector<double> imageOf(vtkSchlierenFilter* filter)
{
  filter->Update();
  std::vector<double> values = valuesOf(filter, "Deflection");
  const std::vector<double> more = valuesOf(filter, "Intensity");
  values.insert(values.end(), more.begin(), more.end());
  return values;
}

void array(vtkSchlierenFilter* filter, int index, const char* name)
{
  filter->SetInputArrayToProcess(index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
}

void density(vtkSchlierenFilter* filter)
{
  filter->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE);
  array(filter, vtkRefractiveIndex::DENSITY, "rho");
}

} // namespace

TEST(SharedMedium, ViewsAndFiltersOfTheSameDataHaveOne)
{
  const auto image = blobImage();
  const auto mesh = tetMesh();
  for (vtkDataObject* data : std::initializer_list<vtkDataObject*>{ image, mesh })
  {
    SCOPED_TRACE(data->GetClassName());
    const Producer producer = producerOf(data);
    Filter filters[3];
    vtkTypeInt64 builds = 0;
    for (int n = 0; n < 3; ++n)
    {
      filters[n] = filterOf(producer);
      filters[n]->SetViewDirection(0.3 * n, 0.2, -1);
      filters[n]->SetCutoff(n);
      imageOf(filters[n]);
      builds += filters[n]->GetMediumBuilds();
    }
    EXPECT_EQ(builds, 1);
    EXPECT_EQ(filters[0]->GetMediumBuilds(), 1);
    EXPECT_EQ(filters[2]->GetMeshBuilds(), data == mesh ? 1 : 0);
    EXPECT_STREQ(filters[0]->GetGrid(), filters[1]->GetGrid());

    // It stays with those that are left, and goes with the last.
    filters[0] = nullptr;
    filters[1]->SetViewDirection(1, 0, -0.1);
    imageOf(filters[1]);
    EXPECT_EQ(filters[1]->GetMediumBuilds(), 0);
    filters[1] = filters[2] = nullptr;
    const Filter again = filterOf(producer);
    imageOf(again);
    EXPECT_EQ(again->GetMediumBuilds(), 1);
  }
}

// What other index models would read: ParaView sets such arrays on its own.
TEST(SharedMedium, ArraysThatAreNotReadDoNotMatter)
{
  const Producer producer = producerOf(blobImage());
  const Filter first = filterOf(producer, density), second = filterOf(producer, density);
  array(second, vtkRefractiveIndex::INDEX_ARRAY, "none");
  const std::vector<double> image = imageOf(first);
  EXPECT_EQ(imageOf(second), image);
  EXPECT_EQ(second->GetMediumBuilds(), 0);
}

TEST(SharedMedium, OtherDataMakeAnother)
{
  const auto image = blobImage();
  const Producer producer = producerOf(image), alike = producerOf(blobImage());
  const Filter first = filterOf(producer);
  const std::vector<double> before = imageOf(first);
  const Filter ofAlike = filterOf(alike);
  EXPECT_EQ(imageOf(ofAlike), before);
  EXPECT_EQ(ofAlike->GetMediumBuilds(), 1);

  // A new version of the data is made for the first that is updated.
  const Filter second = filterOf(producer);
  imageOf(second);
  vtkDataArray* values = image->GetPointData()->GetArray("N");
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    values->SetTuple1(i, 3e-4 - 2 * values->GetTuple1(i));
  }
  values->Modified();
  image->Modified();
  producer->Modified();
  const std::vector<double> after = imageOf(second);
  EXPECT_NE(after, before);
  EXPECT_EQ(imageOf(first), after);
  EXPECT_EQ(first->GetMediumBuilds() + second->GetMediumBuilds(), 2);
}

TEST(SharedMedium, TimeStepsOfAMeshUseTheMeshOfAnyFilter)
{
  const auto mesh = tetMesh();
  const Producer producer = producerOf(mesh);
  Filter first = filterOf(producer);
  const Filter second = filterOf(producer);
  imageOf(first);
  imageOf(second);
  addPointArray(mesh, "N", [](const Vec& x) { return 1e-4 * std::sin(2 * x[0] + x[1]); });
  mesh->Modified();
  producer->Modified();
  imageOf(second);
  imageOf(first);
  EXPECT_EQ(second->GetMediumBuilds(), 1);
  EXPECT_EQ(first->GetMeshBuilds(), 1);

  // What one of them does with another mesh is not the others' concern.
  first->SetInputConnection(producerOf(blobImage())->GetOutputPort());
  imageOf(first);
  EXPECT_EQ(second->GetMeshBuilds(), 1);
  addPointArray(mesh, "N", linear);
  mesh->Modified();
  producer->Modified();
  const std::vector<double> shared = imageOf(second);
  EXPECT_EQ(second->GetMeshBuilds(), 1);
  first = nullptr;
  EXPECT_EQ(imageOf(filterOf(producerOf(tetMesh()))), shared);
}

// As views of one flow do; a flow of other settings has messages of its own.
TEST(SharedMedium, OneOfItsUsersSaysWhatIsOfTheMedium)
{
  const auto water = [](const Vec& x) { return 0.333 + 1e-4 * x[0]; };
  const auto mesh = tetMesh();
  addPointArray(mesh, "rho", [&](const Vec& x) { return 1000 * water(x); });
  addPointArray(mesh, "N", water);
  const Producer producer = producerOf(mesh);
  for (const Change& change : { Change(density), Change(nullptr) })
  {
    std::vector<Filter> filters;
    std::vector<vtkSmartPointer<Complaints>> complaints;
    const auto warnings = [&]
    {
      std::size_t all = 0;
      for (const auto& each : complaints)
      {
        EXPECT_TRUE(each->Errors.empty());
        all += each->Warnings.size();
      }
      return all;
    };
    for (int n = 0; n < 3; ++n)
    {
      filters.push_back(filterOf(producer, change));
      filters[n]->SetAmbientRefractivity(-1);
      filters[n]->SetExitInto(vtkSchlierenFilter::EXIT_AUTO);
      filters[n]->SetViewDirection(0.3 * n, 0.2, -1);
      complaints.push_back(vtkSmartPointer<Complaints>::Take(new Complaints(filters[n])));
      imageOf(filters[n]);
      EXPECT_EQ(warnings(), 1u) << n;
    }
    filters[1]->SetGas("helium");
    filters[1]->SetIndexModel(vtkRefractiveIndex::GLADSTONE_DALE);
    array(filters[1], vtkRefractiveIndex::DENSITY, "rho");
    imageOf(filters[1]);
    EXPECT_EQ(warnings(), 2u);
  }
}

// What one has said at a time, another one that makes the next time's medium does not repeat.
TEST(SharedMedium, WhatIsOfAllTimesIsSaidOnce)
{
  const auto mesh = tetMesh();
  addPointArray(mesh, "rho", [](const Vec& x) { return 1000 + x[0]; });
  const Producer producer = producerOf(mesh);
  const Filter filters[] = { filterOf(producer, density), filterOf(producer, density) };
  vtkSmartPointer<Complaints> complaints[2];
  for (int n = 0; n < 2; ++n)
  {
    complaints[n] = vtkSmartPointer<Complaints>::Take(new Complaints(filters[n]));
    imageOf(filters[n]);
  }
  addPointArray(mesh, "rho", [](const Vec& x) { return 1001 + x[0]; });
  mesh->Modified();
  producer->Modified();
  imageOf(filters[1]);
  imageOf(filters[0]);
  EXPECT_EQ(complaints[0]->Warnings.size(), 1u);
  EXPECT_EQ(complaints[1]->Warnings.size(), 0u);
}

TEST(SharedMedium, WhatCannotBeMadeIsNotShared)
{
  const Producer producer = producerOf(blobImage());
  for (int n = 0; n < 2; ++n)
  {
    const Filter filter = filterOf(producer,
      [](vtkSchlierenFilter* one) { array(one, vtkRefractiveIndex::INDEX_ARRAY, "none"); });
    auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
    filter->Update();
    EXPECT_EQ(complaints->Errors.size(), 1u);
  }
}
