// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What does not fit into memory is an error, not the end of the program.
#include "Common/AvailableMemory.h"

#include "Fixtures.h"

#include "vtkAppendFilter.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <fstream>
#include <new>
#include <stdexcept>
#include <string>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace
{

constexpr double giga = 1e9;

/// This process may have so many bytes more.
class Limit
{
public:
  explicit Limit(double more)
  {
#ifdef __linux__
    double pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const double inUse = pages * static_cast<double>(sysconf(_SC_PAGESIZE));
    rlimit limit{};
    if (inUse < 1e12 && getrlimit(RLIMIT_AS, &limit) == 0) // a sanitizer takes more, of addresses
    {
      this->Before = limit;
      limit.rlim_cur = static_cast<rlim_t>(inUse + more);
      this->Works = setrlimit(RLIMIT_AS, &limit) == 0;
    }
#endif
  }
  ~Limit()
  {
#ifdef __linux__
    if (this->Works)
    {
      setrlimit(RLIMIT_AS, &this->Before);
    }
#endif
  }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;

  bool Works = false;

private:
#ifdef __linux__
  rlimit Before{};
#endif
};

std::string whatIsSaidOf(double bytes)
{
  try
  {
    filters::requireMemory(bytes, "A grid", "Make it coarser.");
    return "";
  }
  catch (const std::runtime_error& problem)
  {
    return problem.what();
  }
}

} // namespace

TEST(AvailableMemory, WhatDoesNotFitIsSaidWithNumbers)
{
  EXPECT_GT(filters::availableMemory(), 1e6);
  EXPECT_EQ(whatIsSaidOf(1000), "");
  EXPECT_EQ(whatIsSaidOf(1e7), "");
  const std::string text = whatIsSaidOf(3e18);
  EXPECT_NE(text.find("A grid needs 3e+09 GB of memory, but "), std::string::npos) << text;
  EXPECT_NE(text.find(". Make it coarser."), std::string::npos) << text;
}

TEST(AvailableMemory, OfArraysOfVtkIsRequiredBefore)
{
  vtkNew<vtkFloatArray> array;
  array->SetNumberOfComponents(3);
  EXPECT_THROW(filters::setTuples(array, vtkIdType{ 1 } << 58), std::bad_alloc);
  filters::setTuples(array, 5);
  EXPECT_EQ(array->GetNumberOfValues(), 15);
}

TEST(AvailableMemory, LimitsOfTheProcessCount)
{
  const Limit limit(giga);
  if (!limit.Works)
  {
    GTEST_SKIP() << "The memory of this process cannot be limited.";
  }
  EXPECT_NE(whatIsSaidOf(1.5 * giga), "");
  EXPECT_EQ(whatIsSaidOf(0.1 * giga), "");
}

TEST(AvailableMemory, GridsAndImagesThatDoNotFitAreErrors)
{
  auto image = columnImage(8);
  vtkNew<vtkAppendFilter> mesh;
  mesh->AddInputData(image);
  mesh->Update();
  auto filter = bench(mesh->GetOutput());
  filter->Update();
  const Limit limit(2 * giga);
  if (!limit.Works)
  {
    GTEST_SKIP() << "The memory of this process cannot be limited.";
  }
  expectOneMessage(
    filter.Get(), [](vtkSchlierenFilter* f) { f->SetSamplingDimensions(1500, 1500, 1500); },
    { "1500 x 1500 x 1500 points", "memory", "SamplingDimensions" },
    [](vtkSchlierenFilter* f) { f->SetSamplingDimensions(0, 0, 0); });
  expectOneMessage(
    filter.Get(), [](vtkSchlierenFilter* f) { f->SetImageSize(32768, 32768); },
    { "32768 x 32768 pixels", "memory", "ImageSize" },
    [](vtkSchlierenFilter* f) { f->SetImageSize(16, 16); });
}
