// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkThreshold.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLImageDataWriter.h"

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
  EXPECT_EQ(n->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(outputOf(filter)->GetPointData()->GetScalars(), n);
  for (vtkIdType i = 0; i < n->GetNumberOfTuples(); ++i)
  {
    EXPECT_FLOAT_EQ(static_cast<float>(n->GetComponent(i, 0)),
      static_cast<float>(2e-3 * (1.2 + image->GetPoint(i)[0])));
    EXPECT_EQ(arrayOf(filter, "vtkValidPointMask")->GetComponent(i, 0), 1);
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

TEST(RefractiveIndex, DoublePrecisionRoundsNothing)
{
  auto image = cube(3);
  addPointArray(image, "N", [](const Vec& x) { return 1e-4 * (1 + x[0] / 3); });
  auto filter =
    refractiveIndex(image, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  filter->DoublePrecisionOn();
  filter->Update();
  EXPECT_EQ(arrayOf(filter, "Refractivity")->GetDataType(), VTK_DOUBLE);
  for (vtkIdType i = 0; i < 27; ++i)
  {
    EXPECT_EQ(arrayOf(filter, "Refractivity")->GetComponent(i, 0),
      image->GetPointData()->GetArray("N")->GetComponent(i, 0));
  }
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
      filter->SetSamplingDimensions(3, 3, 3);
      filter->Update();
      return valuesOf(filter, "Refractivity");
    };
    const std::vector<double> direct = valuesFrom(ofPoints);
    EXPECT_EQ(valuesFrom(ofCells), direct) << array->GetClassName();
    const std::vector<double> resampled = valuesFrom(voxels(ofPoints));
    for (std::size_t i = 0; i < 27; ++i)
    {
      EXPECT_EQ(direct[i], 0.25 * static_cast<double>(i)) << array->GetClassName();
      EXPECT_NEAR(resampled[i], direct[i], 1e-4) << array->GetClassName();
    }
    EXPECT_EQ(valuesFrom(voxels(ofCells)).size(), 27u) << array->GetClassName();
  }
}

TEST(RefractiveIndex, InvalidValuesAreMasked)
{
  auto image = cube(5);
  vtkDoubleArray* array = addPointArray(image, "N", one);
  array->SetValue(7, std::nan(""));
  array->SetValue(8, HUGE_VAL);
  array->SetValue(9, 1e200); // infinite in single precision
  auto filter =
    refractiveIndex(image, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  filter->Update();
  for (vtkIdType i = 0; i < 125; ++i)
  {
    const bool valid = i < 7 || i > 9;
    EXPECT_EQ(arrayOf(filter, "vtkValidPointMask")->GetComponent(i, 0), valid ? 1 : 0) << i;
    EXPECT_EQ(arrayOf(filter, "Refractivity")->GetComponent(i, 0), valid ? 1 : 0) << i;
  }
}

// The values are converted in blocks, and a block without bad values in a shorter way.
TEST(RefractiveIndex, FewBadValuesAmongManyAreMasked)
{
  const double inf = std::numeric_limits<double>::infinity();
  const double largest = std::numeric_limits<double>::max(); // infinite as a float
  auto image = cube(27);
  const vtkIdType count = image->GetNumberOfPoints();
  std::map<vtkIdType, double> bad{ { 0, std::nan("") }, { 2047, inf }, { 2048, -inf },
    { 9000, largest }, { count - 1, -largest } };
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
    vtkIdType next = 0;
    addPointArray(image, "rho",
      [&](const Vec&)
      {
        const vtkIdType i = next++;
        return bad.count(i) != 0 ? bad.at(i) : 1 + 1e-6 * static_cast<double>(i);
      });
    auto filter = refractiveIndex(
      image, vtkRefractiveIndex::GLADSTONE_DALE, vtkRefractiveIndex::DENSITY, "rho");
    filter->SetGladstoneDaleConstant(2e-4);
    filter->Update();
    vtkDataArray* n = arrayOf(filter, "Refractivity");
    vtkDataArray* valid = arrayOf(filter, "vtkValidPointMask");
    for (vtkIdType i = 0; i < count; ++i)
    {
      const bool isGood = bad.count(i) == 0;
      EXPECT_EQ(valid->GetTuple1(i), isGood ? 1 : 0) << i;
      EXPECT_EQ(n->GetTuple1(i),
        isGood ? static_cast<float>(2e-4 * (1 + 1e-6 * static_cast<double>(i))) : 0.f)
        << i;
    }
  }
}

TEST(RefractiveIndex, AnImageKeepsItsGrid)
{
  auto image = cube(5);
  image->SetExtent(3, 7, -2, 2, 0, 4);
  vtkNew<vtkMatrix3x3> direction;
  const double rotation[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  std::copy_n(rotation, 9, direction->GetData());
  image->SetDirectionMatrix(direction);
  addPointArray(image, "N", one);
  addCellArray(image, "C", one);
  for (const char* name : { "N", "C" })
  {
    auto filter = refractiveIndex(
      image, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, name);
    filter->Update();
    vtkImageData* output = outputOf(filter);
    const bool cells = *name == 'C';
    EXPECT_EQ(output->GetNumberOfPoints(), cells ? 64 : 125);
    double expected[3];
    image->TransformContinuousIndexToPhysicalPoint(
      3 + (cells ? 0.5 : 0), -2 + (cells ? 0.5 : 0), cells ? 0.5 : 0, expected);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(output->GetPoint(0)[axis], expected[axis], 1e-14) << name;
      EXPECT_EQ(output->GetSpacing()[axis], image->GetSpacing()[axis]);
    }
    EXPECT_TRUE(std::equal(rotation, rotation + 9, output->GetDirectionMatrix()->GetData()));
    // What the pipeline was given beforehand.
    EXPECT_TRUE(std::equal(output->GetExtent(), output->GetExtent() + 6,
      filter->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())));
  }
}

TEST(RefractiveIndex, SamplingDimensionsAreChosenFromTheCells)
{
  // A slab of 10 x 40 x 20 cells with edges of 1, 1 and 0.5.
  vtkNew<vtkImageData> slab;
  slab->SetDimensions(11, 41, 21);
  slab->SetSpacing(1, 1, 0.5);
  addPointArray(slab, "N", one);
  const auto grid = voxels(slab);
  auto filter =
    refractiveIndex(grid, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  filter->Update();
  vtkImageData* output = outputOf(filter);
  const double* spacing = output->GetSpacing();
  EXPECT_NEAR(spacing[1] / spacing[0], 1, 0.02); // but for rounding to whole numbers
  EXPECT_NEAR(spacing[2] / spacing[0], 0.5, 0.02);
  EXPECT_NEAR(static_cast<double>(output->GetNumberOfPoints()), 64. * 64 * 64, 0.05 * 64 * 64 * 64);
  int dimensions[3];
  output->GetDimensions(dimensions);
  vtkDataArray* used = output->GetFieldData()->GetArray("SamplingDimensions");
  ASSERT_NE(used, nullptr);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(used->GetComponent(0, axis), dimensions[axis]);
  }

  // An axis that is given is kept, and the others follow it.
  filter->SetSamplingDimensions(0, 81, 0);
  filter->Update();
  outputOf(filter)->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[0], 21);
  EXPECT_EQ(dimensions[1], 81);
  EXPECT_EQ(dimensions[2], 41);

  filter->SetSamplingDimensions(7, 5, 3);
  filter->Update();
  outputOf(filter)->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[0], 7);
  EXPECT_EQ(dimensions[1], 5);
  EXPECT_EQ(dimensions[2], 3);
}

namespace
{

double sloping(const Vec& x) { return 1e-4 * (1 + 0.2 * x[0] - 0.3 * x[1] + 0.1 * x[2]); }

/// Whether all that is gas has N of `sloping`, and how many points are.
vtkIdType pointsThatSlope(vtkImageData* output)
{
  vtkDataArray* n = output->GetPointData()->GetScalars();
  vtkDataArray* valid = output->GetPointData()->GetArray("vtkValidPointMask");
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const double* x = output->GetPoint(i);
    if (valid->GetComponent(i, 0) == 1)
    {
      EXPECT_NEAR(n->GetComponent(i, 0), sloping({ x[0], x[1], x[2] }), 1e-10);
      ++count;
    }
  }
  return count;
}

void expectBounds(vtkImageData* output, const std::array<double, 6>& expected)
{
  const double* bounds = output->GetBounds();
  for (std::size_t n = 0; n < 6; ++n)
  {
    EXPECT_NEAR(bounds[n], expected[n], 1e-6) << n;
  }
}

} // namespace

TEST(RefractiveIndex, OfABoxOfAMesh)
{
  auto image = cube(21); // from -1 to 1
  addPointArray(image, "N", sloping);
  auto filter = refractiveIndex(
    voxels(image), vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  filter->SetSamplingBounds(-0.31, 0.2, 0.4, 0.7, 0, 0);
  filter->Update();
  expectBounds(outputOf(filter), { -0.31, 0.2, 0.4, 0.7, -1, 1 });
  EXPECT_EQ(pointsThatSlope(outputOf(filter)), outputOf(filter)->GetNumberOfPoints());

  filter->SetSamplingDimensions(6, 7, 8);
  filter->Update();
  EXPECT_EQ(outputOf(filter)->GetNumberOfPoints(), 6 * 7 * 8);
  expectBounds(outputOf(filter), { -0.31, 0.2, 0.4, 0.7, -1, 1 });

  // Another box of as many points is searched anew.
  filter->SetSamplingBounds(0.1, 0.61, -0.4, -0.1, 0, 0);
  filter->Update();
  expectBounds(outputOf(filter), { 0.1, 0.61, -0.4, -0.1, -1, 1 });
  EXPECT_EQ(pointsThatSlope(outputOf(filter)), 6 * 7 * 8);

  // What is beyond the mesh is no gas.
  filter->SetSamplingBounds(0.5, 1.5, -2, 2, -2, 2);
  filter->SetSamplingDimensions(11, 21, 21);
  filter->Update();
  expectBounds(outputOf(filter), { 0.5, 1.5, -2, 2, -2, 2 });
  EXPECT_EQ(pointsThatSlope(outputOf(filter)), 6 * 11 * 11);

  filter->SetSamplingBounds(0, 0, 0, 0, 0, 0);
  filter->Update();
  expectBounds(outputOf(filter), { -1, 1, -1, 1, -1, 1 });
}

TEST(RefractiveIndex, GridOfABoxIsAsFineAsTheCellsThere)
{
  // Cells of 0.2 along x, but of 0.02 from 0 on.
  auto image = cube(21);
  auto mesh = voxels(image);
  vtkPoints* points = mesh->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    points->SetPoint(i, x[0] > 0 ? 0.2 * x[0] : 2 * x[0], x[1], x[2]);
  }
  addPointArray(mesh, "N", sloping);
  auto filter =
    refractiveIndex(mesh, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  const auto ratio = [&](double low, double high)
  {
    filter->SetSamplingBounds(low, high, -0.5, 0.5, -0.5, 0.5);
    filter->Update();
    return outputOf(filter)->GetSpacing()[1] / outputOf(filter)->GetSpacing()[0];
  };
  EXPECT_NEAR(ratio(-1.9, -0.5), 0.5, 0.03);
  EXPECT_NEAR(ratio(0.01, 0.19), 5, 0.3);
}

TEST(RefractiveIndex, OfABoxOfAnImage)
{
  auto image = cube(21);
  image->SetExtent(3, 23, -4, 16, 0, 20);
  image->SetOrigin(-1.3, -0.6, -1);
  addPointArray(image, "N", sloping);
  auto filter =
    refractiveIndex(image, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  filter->SetSamplingBounds(-0.31, 0.2, 0.4, 0.7, 0, 0);
  filter->UpdateInformation();
  filter->Update();
  expectBounds(outputOf(filter), { -0.4, 0.2, 0.4, 0.7, -1, 1 });
  EXPECT_EQ(pointsThatSlope(outputOf(filter)), 7 * 4 * 21);
  EXPECT_EQ(
    filter->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())[1],
    outputOf(filter)->GetExtent()[1]);
}

TEST(RefractiveIndex, BoxesWithoutDataAreAMistake)
{
  auto image = cube(5);
  addPointArray(image, "N", sloping);
  const auto mesh = voxels(image);
  for (vtkDataSet* data : std::initializer_list<vtkDataSet*>{ image, mesh })
  {
    auto filter =
      refractiveIndex(data, vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
    auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
    for (const double low : { 5., std::numeric_limits<double>::quiet_NaN() })
    {
      complaints->Errors.clear();
      filter->SetSamplingBounds(low, low + 1, -1, 1, -1, 1);
      filter->Update();
      ASSERT_EQ(complaints->Errors.size(), 1u);
      EXPECT_NE(complaints->Errors[0].find("SamplingBounds"), std::string::npos);
      EXPECT_TRUE(isEmpty(filter));
    }
    filter->SetSamplingBounds(-0.5, 0.5, 0, 0, 0, 0);
    filter->Update();
    EXPECT_FALSE(isEmpty(filter));
  }
}

TEST(RefractiveIndex, ChosenGridHasAtLeastTwoPointsAlongEachAxis)
{
  vtkNew<vtkImageData> sheet;
  sheet->SetDimensions(101, 101, 2);
  sheet->SetSpacing(1, 1, 1e-6);
  addPointArray(sheet, "N", one);
  auto filter = refractiveIndex(
    voxels(sheet), vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  filter->Update();
  int dimensions[3];
  outputOf(filter)->GetDimensions(dimensions);
  EXPECT_LE(dimensions[2], 4);
  EXPECT_EQ(dimensions[0], dimensions[1]);
  EXPECT_NEAR(
    static_cast<double>(outputOf(filter)->GetNumberOfPoints()), 64. * 64 * 64, 0.05 * 64 * 64 * 64);
}

TEST(RefractiveIndex, SamplingDimensionsOfOneAreAMistake)
{
  auto image = cube(4);
  addPointArray(image, "N", one);
  auto filter = refractiveIndex(
    voxels(image), vtkRefractiveIndex::REFRACTIVITY, vtkRefractiveIndex::INDEX_ARRAY, "N");
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  filter->SetSamplingDimensions(10, 1, 10);
  filter->Update();
  ASSERT_EQ(complaints->Errors.size(), 1u);
  EXPECT_NE(complaints->Errors[0].find("SamplingDimensions"), std::string::npos);
  EXPECT_TRUE(isEmpty(filter));
  filter->SetSamplingDimensions(10, 2, 10);
  filter->Update();
  EXPECT_EQ(complaints->Errors.size(), 1u);
  EXPECT_EQ(outputOf(filter)->GetNumberOfPoints(), 200);
}

// The grid of the cells' centres is one point shorter than what a reader announces before it has read.
TEST(RefractiveIndex, SourceNeedNotHaveBeenUpdated)
{
  auto image = cube(9);
  addCellArray(image, "N", one);
  vtkNew<vtkXMLImageDataWriter> writer;
  const std::string file = std::string(SCHLIEREN_TEST_OUTPUT) + "/not-updated.vti";
  writer->SetFileName(file.c_str());
  writer->SetDataModeToAscii();
  writer->SetInputData(image);
  ASSERT_EQ(writer->Write(), 1);

  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkRefractiveIndex> filter;
  filter->SetInputConnection(reader->GetOutputPort());
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  for (int update = 0; update < 2; ++update)
  {
    filter->Update();
    EXPECT_TRUE(complaints->Errors.empty());
    EXPECT_EQ(outputOf(filter)->GetNumberOfPoints(), 512);
  }
}

// How many points a mesh is resampled to is not known before it is there. The grid that is announced until
// then must not crop the output or have it made again and again.
TEST(RefractiveIndex, MeshNeedNotHaveBeenUpdated)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(9, 12, 5);
  addPointArray(image, "N", one);
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputData(image);
  vtkNew<vtkRefractiveIndex> filter;
  filter->SetInputConnection(tetrahedra->GetOutputPort());
  filter->SetIndexModel(vtkRefractiveIndex::REFRACTIVITY);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N");
  vtkNew<vtkThreshold> consumer; // requests exactly the grid that was announced
  consumer->SetInputConnection(filter->GetOutputPort());
  auto complaints = vtkSmartPointer<Complaints>::Take(new Complaints(filter));
  consumer->Update();
  vtkImageData* output = outputOf(filter);
  EXPECT_NEAR(static_cast<double>(output->GetNumberOfPoints()), 64. * 64 * 64, 0.05 * 64 * 64 * 64);
  EXPECT_NEAR(output->GetBounds()[3], 11, 1e-4);

  const vtkMTimeType made = output->GetUpdateTime();
  consumer->Update();
  filter->Update();
  EXPECT_EQ(output->GetUpdateTime(), made);
  EXPECT_TRUE(complaints->Errors.empty());
}

// A point that several cells share (here every second one along each axis) takes its value from any of
// them, and with several threads not always from the same one.
TEST(RefractiveIndex, ThreadsChangeAMeshByNoMoreThanRounding)
{
  auto image = columnImage(20);
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputData(image);
  tetrahedra->Update();
  std::vector<double> expected, expectedMask;
  for (const int threads : { 1, 2, 7 })
  {
    auto filter = refractiveIndex(tetrahedra->GetOutput(), vtkRefractiveIndex::REFRACTIVITY,
      vtkRefractiveIndex::INDEX_ARRAY, "N");
    filter->SetSamplingDimensions(39, 39, 39);
    filter->SetNumberOfThreads(threads);
    filter->Update();
    if (threads == 1)
    {
      expected = valuesOf(filter, "Refractivity");
      expectedMask = valuesOf(filter, "vtkValidPointMask");
    }
    EXPECT_LT(relativeDifference(valuesOf(filter, "Refractivity"), expected), 1e-5)
      << threads << " threads";
    EXPECT_EQ(valuesOf(filter, "vtkValidPointMask"), expectedMask) << threads << " threads";
  }
}
