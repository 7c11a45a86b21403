// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images tinted by the colours of the fields whose gradients light crosses (ColorByField).
#include "BallOnLevels.h"
#include "Fixtures.h"
#include "Sources/MediumMaker.h"
#include "Surfaces.h"

#include "vtkAppendFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRectilinearGrid.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLStructuredGridReader.h"

namespace
{

using Color = std::array<double, 3>;

constexpr Color red = { 1, 0, 0 };
constexpr Color blue = { 0, 0.5, 1 };
constexpr Color white = { 1, 1, 1 };

double acrossX(const Vec& x) { return 5 + x[0]; }
double acrossY(const Vec& x) { return -300 * x[1]; }

/// The cube from -1 to 1, in which light bends a little, with fields of the same slope in their ranges.
vtkSmartPointer<vtkImageData> flow(int points = 17)
{
  auto image = cube(points);
  addPointArray(image, "N", [](const Vec& x) { return 1e-6 * (x[0] * x[0] + x[0] * x[1]); });
  addPointArray(image, "A", acrossX);
  addPointArray(image, "B", acrossY);
  return image;
}

vtkSmartPointer<vtkSchlierenFilter> tinted(vtkDataObject* input,
  const std::vector<std::string>& fields = { "A", "B" },
  const std::vector<Color>& colors = { red, blue })
{
  auto filter = bench(input, 32);
  filter->SetParallelScale(0.9);
  filter->SetDevice(vtkSchlierenFilter::CPU);
  filter->ColorByFieldOn();
  for (const std::string& field : fields)
  {
    filter->AddField(field.c_str());
  }
  for (const Color& color : colors)
  {
    std::for_each(color.begin(), color.end(), [&](double c) { filter->AddFieldColor(c); });
  }
  return filter;
}

Color mix(const Color& a, double fraction, const Color& b)
{
  Color mixed;
  for (std::size_t i = 0; i < 3; ++i)
  {
    mixed[i] = fraction * a[i] + (1 - fraction) * b[i];
  }
  return mixed;
}

/// The largest difference, in levels of 255, of the colours from the intensity times a tint, where u is
/// between the limits.
double largestDifference(vtkSchlierenFilter* filter, const Color& tint, double fromU = -1,
  double toU = 1, double brightest = 1)
{
  filter->Update();
  if (isEmpty(filter) || !arrayOf(filter, "Color"))
  {
    return HUGE_VAL;
  }
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  double largest = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double u = image->GetPoint(i)[0];
    for (int channel = 0; channel < 3 && u > fromU && u < toU; ++channel)
    {
      const double expected = 255 / brightest * tint[static_cast<std::size_t>(channel)] *
        arrayOf(filter, "Intensity")->GetComponent(i, 0);
      largest =
        std::max(largest, std::abs(arrayOf(filter, "Color")->GetComponent(i, channel) - expected));
    }
  }
  return largest;
}

constexpr double rounding = 0.51; // to whole levels

/// How the colours of two images differ, in levels of 255.
struct ColorDifferences
{
  double largest = 0, rms = 0;
};

ColorDifferences compareColors(vtkSchlierenFilter* a, vtkSchlierenFilter* b)
{
  a->Update();
  b->Update();
  const std::vector<double> ofA = valuesOf(a, "Color"), ofB = valuesOf(b, "Color");
  EXPECT_FALSE(ofA.empty());
  EXPECT_EQ(ofA.size(), ofB.size());
  ColorDifferences found;
  for (std::size_t i = 0; i < std::min(ofA.size(), ofB.size()); ++i)
  {
    const double difference = std::abs(ofA[i] - ofB[i]);
    found.largest = std::max(found.largest, difference);
    found.rms += difference * difference / static_cast<double>(ofA.size());
  }
  found.rms = std::sqrt(found.rms);
  return found;
}

/// Balls of fields, none of them where light is bent.
const GaussianBall ballN{ 1e-6, 0.8 };
double ballA(const Vec& x) { return GaussianBall{ 1, 0.4 }({ x[0] - 0.1, x[1], x[2] }); }
double ballB(const Vec& x)
{
  return GaussianBall{ 1, 0.25 }({ x[0] + 0.2, x[1] - 0.15, x[2] - 0.3 });
}

void addBalls(vtkDataSet* data)
{
  addPointArray(data, "N", ballN);
  addPointArray(data, "A", ballA);
  addPointArray(data, "B", ballB);
}

/// Cells of 0.08 in the middle, which get larger outwards, up to 40 along each edge of the box.
vtkSmartPointer<vtkUnstructuredGrid> meshWithFarField()
{
  vtkNew<vtkDoubleArray> places;
  std::vector<double> positive{ 0 };
  for (double h = 0.08; positive.back() < 20; h *= positive.back() < 1 ? 1 : 1.4)
  {
    positive.push_back(std::min(positive.back() + h, 20.));
  }
  for (std::size_t i = positive.size() - 1; i > 0; --i)
  {
    places->InsertNextValue(-positive[i]);
  }
  for (const double place : positive)
  {
    places->InsertNextValue(place);
  }
  vtkNew<vtkRectilinearGrid> grid;
  const int n = static_cast<int>(places->GetNumberOfValues());
  grid->SetDimensions(n, n, n);
  grid->SetXCoordinates(places);
  grid->SetYCoordinates(places);
  grid->SetZCoordinates(places);
  addBalls(grid);
  vtkNew<vtkAppendFilter> toMesh;
  toMesh->AddInputData(grid);
  toMesh->Update();
  return vtkUnstructuredGrid::SafeDownCast(toMesh->GetOutputDataObject(0));
}

/// Fields that are 0 to 1 everywhere.
void setWholeRanges(vtkSchlierenFilter* filter, std::size_t fields)
{
  for (std::size_t i = 0; i < fields; ++i)
  {
    filter->AddFieldRange(0);
    filter->AddFieldRange(1);
  }
}

} // namespace

TEST(ColorByField, AddsTheTintedImageAndChangesNoOther)
{
  auto filter = tinted(flow());
  EXPECT_LT(largestDifference(filter, mix(red, 0.5, blue)), rounding);
  auto* image = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_STREQ(image->GetPointData()->GetScalars()->GetName(), "Color");
  EXPECT_EQ(image->GetPointData()->GetScalars()->GetDataType(), VTK_UNSIGNED_CHAR);
  EXPECT_GT(arrayOf(filter, "Intensity")->GetRange()[1], 0.8) << "the image shows something";

  const std::vector<double> intensity = valuesOf(filter, "Intensity");
  const std::vector<double> deflection = valuesOf(filter, "Deflection");
  auto plain = tinted(flow());
  plain->ColorByFieldOff();
  plain->Update();
  EXPECT_EQ(arrayOf(plain, "Color"), nullptr);
  // Rays that gather are other kernels, whose bent rays may differ by rounding.
  EXPECT_LT(relativeDifference(valuesOf(plain, "Intensity"), intensity), 1e-6);
  EXPECT_LT(relativeDifference(valuesOf(plain, "Deflection"), deflection), 1e-6);
}

TEST(ColorByField, OfAShadowgraphLeavesRoomForBrightLight)
{
  auto filter = tinted(flow());
  filter->SetCutoff(vtkSchlierenFilter::SHADOWGRAPH);
  EXPECT_LT(largestDifference(filter, mix(red, 0.5, blue), -0.8, 0.8, 2), rounding);
}

TEST(ColorByField, RangesWeighTheFields)
{
  auto filter = tinted(flow());
  for (const double value : { 3., 7., 0., 0. }) // A: twice its own range
  {
    filter->AddFieldRange(value);
  }
  EXPECT_LT(largestDifference(filter, mix(red, 1. / 3, blue)), rounding);
}

TEST(ColorByField, TransferFunctionsCountWhereTheyMakeTheMedium)
{
  auto filter = tinted(flow());
  vtkNew<vtkPiecewiseFunction> flat, steep;
  flat->AddPoint(0, 0.3);
  flat->AddPoint(1, 0.3);
  steep->AddPoint(0, 0);
  steep->AddPoint(1, 2);
  filter->AddTransferFunction(flat);
  filter->AddTransferFunction(steep);
  EXPECT_LT(largestDifference(filter, mix(red, 0.5, blue)), rounding);
  filter->SetIndexModel(vtkRefractiveIndex::TRANSFER_FUNCTIONS);
  EXPECT_LT(largestDifference(filter, blue), rounding);
}

// The refractivity is that of points, a field that of cells: it is brought to the points. Outside of the
// outermost cells' centres it has no values.
TEST(ColorByField, OfCellsOnTheGridOfPoints)
{
  auto image = flow(33);
  addCellArray(image, "cells", acrossX);
  auto filter = tinted(image, { "cells", "B" });
  // Steeper by 32/31 in the centres' range, over a way shorter by as much. A pixel beside the
  // border of this range mixes in some light from there.
  EXPECT_LT(largestDifference(filter, mix(red, 0.5, blue)), 2.5);
}

TEST(ColorByField, OfAMesh)
{
  vtkNew<vtkAppendFilter> toMesh;
  toMesh->AddInputData(flow());
  toMesh->Update();
  auto filter = tinted(toMesh->GetOutput());
  EXPECT_LT(largestDifference(filter, mix(red, 0.5, blue)), 1.01);
}

// What a field is inside of a body does not matter, of any data.
TEST(ColorByField, FieldsEndWithTheGas)
{
  const auto image = flow();
  vtkNew<vtkAppendFilter> toMesh;
  toMesh->AddInputData(image);
  toMesh->Update();
  const auto cells = cube(17);
  addCellArray(cells, "N", [](const Vec& x) { return 1e-6 * x[0] * x[1]; });
  addCellArray(cells, "A", acrossX);
  vtkNew<vtkMultiBlockDataSet> amr; // of one level
  amr->SetBlock(0, cells);
  const auto body = box({ 0.8, 0.8, 0.8 });
  for (vtkDataObject* data :
    std::initializer_list<vtkDataObject*>{ image, toMesh->GetOutputDataObject(0), amr })
  {
    SCOPED_TRACE(data->GetClassName());
    filters::MediumMaker maker;
    maker.settings.IndexModel = MediumSettings::REFRACTIVITY;
    maker.settings.Arrays[MediumSettings::IndexArray].name = "N";
    maker.settings.Fields = { "A" };
    const auto source = maker.make(maker.choose(data), body, true)->Source;
    ASSERT_EQ(source->fields(), 1);
    const schlieren::Lattice lattice{ { -0.9, -0.9, -0.9 }, { 0.1, 0.1, 0.1 }, { 19, 19, 19 } };
    const auto size = static_cast<std::size_t>(lattice.size());
    std::vector<double> refractivity(size), field(size);
    std::vector<schlieren::Place> places(size);
    source->sampleWithFields(lattice, refractivity.data(), places.data(), nullptr, field.data());
    int inside = 0, wrong = 0;
    for (std::size_t i = 0; i < size; ++i)
    {
      const bool isGas = places[i] == schlieren::Place::Gas;
      inside += isGas ? 0 : 1;
      wrong += std::isfinite(field[i]) == isGas ? 0 : 1;
    }
    EXPECT_GE(inside, 7 * 7 * 7);
    EXPECT_EQ(wrong, 0);
  }
}

// In the leaves of a tree, against an image of voxels of 0.03. A grid over all of the mesh would have voxels that are
// larger than the balls.
TEST(ColorByField, OfAMeshWithAFarField)
{
  auto image = cube(101, 1.5);
  addBalls(image);
  auto expected = tinted(image);
  auto filter = tinted(meshWithFarField());
  for (const auto& each : { expected, filter })
  {
    each->SetImageSize(96, 96);
    setWholeRanges(each, 2);
  }
  const ColorDifferences differences = compareColors(filter, expected);
  EXPECT_LT(differences.largest, 6);
  EXPECT_LT(differences.rms, 1.5);
  EXPECT_GT(largest(valuesOf(filter, "Color")), 100);
  EXPECT_LT(fieldValue(filter, "SmallestVoxel"), 0.12);
  EXPECT_LT(fieldValue(filter, "MediumBytes"), 50e6);
  EXPECT_NE(std::string(filter->GetGrid()).find("or of the full colour"), std::string::npos);
}

// Where the medium is the same everywhere, the fields alone say how fine its leaves are.
TEST(ColorByField, OfAMeshWithoutVariationOfN)
{
  const auto mesh = meshWithFarField();
  mesh->GetPointData()->GetArray("N")->Fill(1e-6);
  auto image = cube(101, 1.5);
  addBalls(image);
  image->GetPointData()->GetArray("N")->Fill(1e-6);
  auto expected = tinted(image);
  auto filter = tinted(mesh);
  for (const auto& each : { expected, filter })
  {
    each->SetImageSize(96, 96);
    each->SetAmbientRefractivity(1e-6);
    setWholeRanges(each, 2);
  }
  const ColorDifferences differences = compareColors(filter, expected);
  EXPECT_LT(differences.largest, 6);
  EXPECT_LT(differences.rms, 1.5);
}

// Without colours, nothing of them is left.
TEST(ColorByField, OfAMeshSwitchedOffLeavesNoTrace)
{
  const auto mesh = meshWithFarField();
  auto filter = tinted(mesh);
  auto plain = tinted(mesh);
  plain->ColorByFieldOff();
  filter->Update();
  plain->Update();
  filter->ColorByFieldOff();
  filter->Update();
  EXPECT_EQ(valuesOf(plain, "Intensity"), valuesOf(filter, "Intensity"));
  EXPECT_EQ(fieldValue(plain, "MediumBytes"), fieldValue(filter, "MediumBytes"));
  EXPECT_EQ(filter->GetMeshBuilds(), 1);
}

// A point array beside cell arrays, on levels of which no grid over all of the domain fits: against an image of voxels of
// 0.008. The finest cells are 0.0039.
TEST(ColorByField, OfDeepAmr)
{
  const auto amr = ballOnLevels(32,
    { { 0, 32, true }, { 16, 32, true }, { 48, 32 }, { 112, 32, true }, { 240, 32 } },
    { 1e-6, 0.05 });
  const GaussianBall field{ 1, 0.1 };
  const auto aside = [](const Vec& x) {
    return GaussianBall{ 1, 0.07 }({ x[0] - 0.1, x[1], x[2] });
  };
  auto image = cube(101, 0.4);
  addPointArray(image, "N", GaussianBall{ 1e-6, 0.05 });
  addPointArray(image, "A", field);
  addPointArray(image, "B", aside);
  for (unsigned int level = 0; level < 5; ++level)
  {
    for (unsigned int i = 0; i < blocksOf(amr, level); ++i)
    {
      vtkImageData* block = blockOf(amr, level, i);
      addCellArray(block, "A", MeanOfBall{ field, block->GetSpacing()[0] });
      addPointArray(block, "B", aside);
    }
  }
  auto expected = tinted(image);
  auto filter = tinted(amr);
  for (const auto& each : { expected, filter })
  {
    each->SetImageSize(96, 96);
    each->SetParallelScale(0.25);
    setWholeRanges(each, 2);
  }
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
  const ColorDifferences differences = compareColors(filter, expected);
  EXPECT_LT(differences.largest, 6);
  EXPECT_LT(differences.rms, 1.5);
  EXPECT_TRUE(filter->GetOutput()->GetFieldData()->GetArray("MediumLevels"));
}

// Light that crosses no gradient stays grey.
TEST(ColorByField, ABlockWithoutTheFieldIsNotTinted)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int i = 0; i < 2; ++i)
  {
    auto block = cube(9);
    block->SetOrigin(2 * i - 2, -1, -1);
    addPointArray(block, "N", [](const Vec& x) { return 1e-6 * x[0] * x[1]; });
    if (i == 1)
    {
      addPointArray(block, "A", acrossY);
    }
    blocks->SetBlock(static_cast<unsigned>(i), block);
  }
  auto filter = tinted(blocks, { "A" }, { blue });
  filter->SetImageSize(64, 32);
  EXPECT_LT(largestDifference(filter, white, -1.7, -0.3), rounding);
  EXPECT_LT(largestDifference(filter, blue, 0.3, 1.7), 1.01);
}

// A mask hides cells from the medium and from the fields alike.
TEST(ColorByField, MasksTakeNoColoursAway)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int i = 0; i < 2; ++i)
  {
    auto block = cube(9);
    block->SetOrigin(2 * i - 2, -1, -1);
    addPointArray(block, "N", [](const Vec& x) { return 1e-6 * x[0] * x[1]; });
    addPointArray(block, "A", acrossY);
    addCellArray(block, "solid", [](const Vec& x) { return x[0] < -1 ? 1. : 0.; });
    blocks->SetBlock(static_cast<unsigned>(i), block);
  }
  auto filter = tinted(blocks, { "A" }, { blue });
  filter->SetImageSize(64, 32);
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::MASK, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "solid");
  EXPECT_LT(largestDifference(filter, blue, 0.3, 1.7), 1.01);
  EXPECT_LT(largestDifference(filter, blue, -0.7, -0.3), 1.01);
  EXPECT_GT(largest(valuesOf(filter, "BlockedFraction")), 0.99);
}

TEST(ColorByField, ChoosesColoursFarApart)
{
  EXPECT_LT(largestDifference(tinted(flow(), { "A" }, {}), red), rounding);
  // The second: 0.618 of the circle is between cyan (1/2) and blue (2/3).
  const double hue = (std::sqrt(5.) - 1) / 2;
  auto filter = tinted(flow(), { "A", "B" }, {});
  filter->SetIndexModel(vtkRefractiveIndex::TRANSFER_FUNCTIONS);
  vtkNew<vtkPiecewiseFunction> flat, line;
  flat->AddPoint(0, 0);
  line->AddPoint(0, 0);
  line->AddPoint(1, 1);
  filter->AddTransferFunction(flat);
  filter->AddTransferFunction(line);
  EXPECT_LT(largestDifference(filter, { 0, 4 - 6 * hue, 1 }), rounding);
}

// Of what is negligible to each leaf there may be too much along a ray, in the refractivity or in a field, at different times.
TEST(ColorByField, TheMediumIsFinished)
{
  vtkNew<vtkXMLStructuredGridReader> reader;
  reader->SetFileName(SCHLIEREN_TEST_DATA "/deltawing.vts");
  auto filter = vtkSmartPointer<vtkSchlierenFilter>::New();
  filter->SetInputConnection(reader->GetOutputPort());
  filter->SetInputArrayToProcess(
    vtkRefractiveIndex::DENSITY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  filter->SetViewDirection(0, 0, -1);
  filter->SetImageSize(32, 32);
  filter->AddField("Density");
  filter->ColorByFieldOn();
  filter->SetMediumTolerance(0.02);
  filter->Update();
  ASSERT_FALSE(isEmpty(filter));
  const std::vector<double> colors = valuesOf(filter, "Color");
  EXPECT_GT(*std::max_element(colors.begin(), colors.end()), 100);
}

TEST(ColorByField, Mistakes)
{
  const auto off = [](vtkSchlierenFilter* self) { self->ColorByFieldOff(); };
  expectOneMessage(
    tinted(flow()).Get(), [](auto* self) { self->ClearFields(); },
    { "ColorByField", "Fields is empty" }, off);
  expectOneMessage(
    tinted(flow()).Get(), [](auto* self) { self->AddField("none"); },
    { "no array 'none'", "Fields", "A (4 to 6), B" }, off);
  expectOneMessage(
    tinted(flow()).Get(), [](auto* self) { self->AddFieldColor(1); },
    { "FieldColors holds 7 values for 2 fields" }, [](auto* self) { self->ClearFieldColors(); });
  expectOneMessage(
    tinted(flow(), { "A" }, { { 1, 0, 255 } }).Get(), [](auto*) {},
    { "FieldColors", "between 0 and 1" }, [](auto* self) { self->ClearFieldColors(); });
  expectOneMessage(
    tinted(flow()).Get(), [](auto* self) { self->AddFieldRange(1); },
    { "FieldRanges", "1 values for 2" }, [](auto* self) { self->ClearFieldRanges(); });
  auto computed = flow();
  addPointArray(computed, "Refractivity", [](const Vec& x) { return 1e-6 * x[0]; });
  expectOneMessage(
    tinted(computed).Get(), [](auto* self) { self->AddField("typo"); }, { "no array 'typo'" }, off);
}
