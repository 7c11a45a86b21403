// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BallOnLevels.h"
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkFloatArray.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkOverlappingAMR.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <limits>
#include <map>

namespace
{

vtkSmartPointer<vtkRefractiveIndex> refractiveIndex(
  vtkDataObject* input, int model, int index, const char* array)
{
  auto filter = vtkSmartPointer<vtkRefractiveIndex>::New();
  filter->SetInputDataObject(input);
  filter->SetIndexModel(model);
  filter->SetInputArrayToProcess(index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array);
  return filter;
}

vtkImageData* outputOf(vtkAlgorithm* filter)
{
  return vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
}

vtkSmartPointer<vtkUnstructuredGrid> voxels(vtkDataSet* data)
{
  vtkNew<vtkAppendFilter> append;
  append->SetInputData(data);
  append->Update();
  return append->GetOutput();
}

double one(const Vec&) { return 1; }

} // namespace

// Gladstone & Dale 1863: N = K rho.
TEST(RefractiveIndex, GladstoneDale)
{
  auto image = cube(4);
  addPointArray(image, "rho", [](const Vec& x) { return 1.2 + x[0]; });
  auto filter =
    refractiveIndex(image, vtkRefractiveIndex::GLADSTONE_DALE, vtkRefractiveIndex::DENSITY, "rho");
  filter->SetGladstoneDaleConstant(2e-4);
  filter->SetDensityScale(10);
  filter->Update();
  vtkDataArray* n = arrayOf(filter, "Refractivity");
  ASSERT_NE(n, nullptr);
  EXPECT_EQ(n->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(outputOf(filter)->GetPointData()->GetScalars(), n);
  for (vtkIdType i = 0; i < n->GetNumberOfTuples(); ++i)
  {
    EXPECT_FLOAT_EQ(static_cast<float>(n->GetComponent(i, 0)),
      static_cast<float>(2e-3 * (1.2 + image->GetPoint(i)[0])));
  }
}

// n - 1 is formed before it is rounded: single precision keeps seven digits of it.
TEST(RefractiveIndex, IndexKeepsItsDigits)
{
  auto image = cube(3);
  addPointArray(image, "n", [](const Vec& x) { return 1 + 1e-9 * (2 + x[0]); });
  auto filter = refractiveIndex(
    image, vtkRefractiveIndex::REFRACTIVE_INDEX, vtkRefractiveIndex::INDEX_ARRAY, "n");
  filter->Update();
  EXPECT_NEAR(arrayOf(filter, "Refractivity")->GetComponent(0, 0), 1e-9, 2.3e-16); // double's n
  EXPECT_NEAR(arrayOf(filter, "Refractivity")->GetComponent(2, 0), 3e-9, 2.3e-16);
}

// Of points and of cells, as the data of an image and of a mesh.
TEST(RefractiveIndex, TakesAnyNumericArray)
{
  for (int type : { VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
         VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG,
         VTK_UNSIGNED_LONG_LONG, VTK_ID_TYPE, VTK_FLOAT, VTK_DOUBLE, -1 })
  {
    auto array = type < 0
      ? vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkSOADataArrayTemplate<double>>::New())
      : vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    array->SetName("rho");
    array->SetNumberOfTuples(27);
    for (vtkIdType i = 0; i < 27; ++i)
    {
      array->SetComponent(i, 0, static_cast<double>(i));
    }
    auto ofPoints = cube(3);
    ofPoints->GetPointData()->AddArray(array);
    auto ofCells = cube(4);
    ofCells->GetCellData()->AddArray(array);
    const auto valuesFrom = [](vtkDataObject* input)
    {
      auto filter = refractiveIndex(
        input, vtkRefractiveIndex::GLADSTONE_DALE, vtkRefractiveIndex::DENSITY, "rho");
      filter->SetGladstoneDaleConstant(0.25);
      filter->Update();
      std::vector<double> values;
      for (const PlacedValue& n : refractivityOf(filter))
      {
        values.push_back(n.value);
      }
      return values;
    };
    const std::vector<double> direct = valuesFrom(ofPoints);
    EXPECT_EQ(valuesFrom(ofCells), direct) << array->GetClassName();
    EXPECT_EQ(valuesFrom(voxels(ofPoints)), direct) << array->GetClassName();
    EXPECT_EQ(valuesFrom(voxels(ofCells)), direct) << array->GetClassName();
    for (std::size_t i = 0; i < 27; ++i)
    {
      EXPECT_EQ(direct[i], 0.25 * static_cast<double>(i)) << array->GetClassName();
    }
  }
}

TEST(RefractiveIndex, IsNanWhereThereIsNoGas)
{
  auto image = cube(5);
  vtkDoubleArray* array = addPointArray(image, "N", one);
  array->SetValue(7, std::nan(""));
  array->SetValue(8, HUGE_VAL);
  addPointArray(image, "solid", [](const Vec& x) { return x[2] > 0.9 ? 1 : 0; });
  image->AllocatePointGhostArray();
  image->GetPointGhostArray()->SetValue(9, vtkDataSetAttributes::HIDDENPOINT);
  auto filter =
    refractiveIndex(image, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  filter->Update();
  for (vtkIdType i = 0; i < 125; ++i)
  {
    const bool valid = (i < 7 || i > 9) && i < 100;
    const double n = arrayOf(filter, "Refractivity")->GetComponent(i, 0);
    EXPECT_TRUE(valid ? n == 1 : std::isnan(n)) << i;
  }
}

// The values are converted in blocks, and a block without bad values in a shorter way.
TEST(RefractiveIndex, FewBadValuesAmongManyAreMasked)
{
  const double inf = std::numeric_limits<double>::infinity();
  auto image = cube(27);
  const vtkIdType count = image->GetNumberOfPoints();
  std::map<vtkIdType, double> bad{ { 0, std::nan("") }, { 2047, inf }, { 2048, -inf },
    { 9000, inf }, { count - 1, -inf } };
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName("vtkValidPointMask");
  for (vtkIdType i = 0; i < count; ++i)
  {
    mask->InsertNextValue(i == 15000 ? 0 : 1);
  }
  for (const bool isMasked : { false, true })
  {
    if (isMasked)
    {
      image->GetPointData()->AddArray(mask);
      bad[15000] = 1;
    }
    vtkNew<vtkFloatArray> rho;
    rho->SetName("rho");
    for (vtkIdType i = 0; i < count; ++i)
    {
      rho->InsertNextValue(
        static_cast<float>(bad.count(i) != 0 ? bad.at(i) : 1 + 1e-6 * static_cast<double>(i)));
    }
    image->GetPointData()->AddArray(rho);
    auto filter = refractiveIndex(
      image, vtkRefractiveIndex::GLADSTONE_DALE, vtkRefractiveIndex::DENSITY, "rho");
    filter->SetGladstoneDaleConstant(2e-4);
    filter->Update();
    vtkDataArray* n = arrayOf(filter, "Refractivity");
    EXPECT_EQ(n->GetDataType(), VTK_FLOAT);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const double expected = 2e-4f * (1 + 1e-6f * static_cast<float>(i));
      EXPECT_TRUE(bad.count(i) != 0 ? std::isnan(n->GetTuple1(i))
                                    : std::abs(n->GetTuple1(i) - expected) < 3e-11)
        << i;
    }
  }
}

// The input with one more array, whatever it is.
TEST(RefractiveIndex, IsAppendedToTheData)
{
  auto image = cube(5);
  image->SetExtent(3, 7, -2, 2, 0, 4);
  vtkNew<vtkMatrix3x3> direction;
  const double rotation[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  std::copy_n(rotation, 9, direction->GetData());
  image->SetDirectionMatrix(direction);
  addPointArray(image, "N", one);
  addPointArray(image, "other", one);
  addCellArray(image, "C", one);
  const auto mesh = voxels(image);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, image);
  blocks->SetBlock(2, mesh);
  blocks->SetBlock(3, cube(2)); // without the array
  for (const char* name : { "N", "C" })
  {
    const bool ofCells = *name == 'C';
    for (vtkDataObject* input : std::initializer_list<vtkDataObject*>{ image, mesh, blocks })
    {
      SCOPED_TRACE(std::string(name) + " of " + input->GetClassName());
      auto filter = refractiveIndex(
        input, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, name);
      filter->Update();
      vtkDataObject* output = filter->GetOutputDataObject(0);
      EXPECT_STREQ(output->GetClassName(), input->GetClassName());
      for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
      {
        EXPECT_EQ(output->GetNumberOfElements(kind), input->GetNumberOfElements(kind));
      }
      EXPECT_EQ(refractivityOf(filter).size(), (ofCells ? 64u : 125u) * (input == blocks ? 2 : 1));
      if (auto* same = vtkImageData::SafeDownCast(output))
      {
        EXPECT_TRUE(std::equal(same->GetExtent(), same->GetExtent() + 6, image->GetExtent()));
        EXPECT_TRUE(std::equal(rotation, rotation + 9, same->GetDirectionMatrix()->GetData()));
        EXPECT_TRUE(same->GetPointData()->HasArray("other"));
        EXPECT_FALSE(image->GetPointData()->HasArray("Refractivity"));
      }
    }
  }
}

// Cells of levels keep theirs, and the levels their places.
TEST(RefractiveIndex, IsAppendedToLevels)
{
  const auto amr = ballOnLevels(8, { { 0, 8, true }, { 4, 8, true } });
  auto filter =
    refractiveIndex(amr, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  filter->Update();
  auto* output = vtkOverlappingAMR::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  EXPECT_EQ(output->GetNumberOfLevels(), 2u);
  EXPECT_EQ(output->GetNumberOfElements(vtkDataObject::CELL),
    amr->GetNumberOfElements(vtkDataObject::CELL));
  EXPECT_EQ(static_cast<vtkIdType>(refractivityOf(filter).size()),
    amr->GetNumberOfElements(vtkDataObject::CELL));
  // Light bends in both alike.
  auto direct = bench(amr), after = bench(output);
  direct->Update();
  after->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Refractivity");
  after->Update();
  EXPECT_EQ(valuesOf(after, "Deflection"), valuesOf(direct, "Deflection"));
}
