// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Nothing is left of the time steps of a long series: the memory in use after many of them is that after some.
#include "BallOnLevels.h"
#include "CellMeshes.h"
#include "Changing.h"

#include <fstream>

#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
#include <malloc.h>
#define SCHLIEREN_COUNTS_MEMORY 1
#endif

namespace
{

/// Bytes that have been allocated and not freed, of all threads; 0 where nobody counts.
std::size_t memoryInUse()
{
#ifdef SCHLIEREN_COUNTS_MEMORY
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

/// Of the process, as the system sees it; 0 where it does not say.
std::size_t residentBytes()
{
  std::size_t size = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident * 4096;
}

/// Data that repeat themselves, so that what is kept of each step would be seen, and what serves later steps is there
/// soon.
double phaseOf(double step) { return 2 * pi * step / 8; }

double pulse(const Vec& x, double time)
{
  return 1e-4 * (1 + 0.5 * std::sin(phaseOf(time)) * std::exp(-4 * dot(x, x)));
}

vtkSmartPointer<vtkDataObject> imageAt(double time)
{
  auto image = cube(12);
  addPointArray(image, "N", [time](const Vec& x) { return pulse(x, time); });
  return image;
}

vtkSmartPointer<vtkDataObject> meshAt(double time, double moves)
{
  const CellKind kind = linearKinds()[1];
  const Mesh mesh = meshOf(kind.type, 6, kind.cells, 0, false);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    Vec x;
    mesh->GetPoint(i, x.data());
    x = ::moved(x, moves * std::sin(phaseOf(time)));
    mesh->GetPoints()->SetPoint(i, x.data());
  }
  addPointArray(mesh, "N", [time](const Vec& x) { return pulse(x, time); });
  return mesh;
}

constexpr std::size_t MiB = std::size_t{ 1 } << 20;

/// Goes through a series, whose first steps find what serves the later ones. Some pages may come
/// to be in use in part; the system makes 512 of them one of 2 MiB when it likes.
void expectNoGrowth(const std::function<vtkSmartPointer<vtkDataObject>(double)>& make,
  const std::function<void(vtkSchlierenFilter*)>& set)
{
  constexpr std::size_t inPart = 5 * MiB;
  constexpr int steps = 33, warmedUp = 16, last = 32; // the latter of the same phase
  vtkNew<Changing> source;
  source->make = make;
  for (int step = 0; step < steps; ++step)
  {
    source->steps.push_back(step);
  }
  auto filter = bench(nullptr, 4);
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetNumberOfThreads(1);
  filter->SetMediumTolerance(1);
  filter->SetMediumMemory(4);
  set(filter);
  std::size_t inUse = 0, resident = 0;
  for (int step = 0; step < steps; ++step)
  {
    filter->UpdateTimeStep(step);
    ASSERT_FALSE(isEmpty(filter)) << step;
    source->requested.clear();
    if (step == warmedUp)
    {
      inUse = memoryInUse();
      resident = residentBytes();
    }
    if (step == last)
    {
      // An array of a step takes 1700 bytes or more. The first hundred steps of a mesh cost 150 to 420 bytes each, rarely 1070,
      // all of five hundred 70: malloc keeps some small pieces of each size for later.
      EXPECT_LT(memoryInUse(), inUse + (last - warmedUp) * 1400);
      EXPECT_LT(residentBytes(), resident + inPart);
    }
  }
}

void asItIs(vtkSchlierenFilter*) {}

class LongSeries : public testing::Test
{
protected:
  void SetUp() override
  {
    if (memoryInUse() == 0) // so it is where memory is sanitized
    {
      GTEST_SKIP() << "Nobody counts the memory in use.";
    }
  }
};

} // namespace

TEST_F(LongSeries, OfAnImage) { expectNoGrowth(imageAt, asItIs); }

TEST_F(LongSeries, OfAMeshThatStays)
{
  expectNoGrowth([](double time) { return meshAt(time, 0); }, asItIs);
}

TEST_F(LongSeries, OfAMeshThatMoves)
{
  expectNoGrowth([](double time) { return meshAt(time, 0.2); }, asItIs);
}

TEST_F(LongSeries, OfAmr)
{
  expectNoGrowth(
    [](double time) {
      return ballOnLevels(4, { { 0, 4 }, { 2, 4 } }, { 1e-4 * (2 + std::sin(phaseOf(time))), 0.3 });
    },
    [](vtkSchlierenFilter* filter)
    {
      filter->SetInputArrayToProcess(
        vtkRefractiveIndex::INDEX_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "N");
    });
}
