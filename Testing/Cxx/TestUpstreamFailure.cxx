// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What fails upstream of a filter is noticed, and reported to users as before.
#include "UpstreamFailure.h"

#include "vtkImageAlgorithm.h"
#include "vtkImageAppend.h"
#include "vtkImageShiftScale.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkRTAnalyticSource.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

using filters::UpstreamFailure;

namespace
{

/// An image, or a failure.
class Source : public vtkRTAnalyticSource
{
public:
  static Source* New();
  vtkTypeMacro(Source, vtkRTAnalyticSource);

  bool Fails = true;

protected:
  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override
  {
    return this->Fails ? 0 : this->Superclass::RequestData(request, in, out);
  }
};
vtkStandardNewMacro(Source);

/// Keeps what would be displayed.
class Window : public vtkOutputWindow
{
public:
  static Window* New();
  vtkTypeMacro(Window, vtkOutputWindow);
  void DisplayErrorText(const char* text) override { this->Texts.emplace_back(text); }
  void DisplayText(const char*) override {}

  std::vector<std::string> Texts;
};
vtkStandardNewMacro(Window);

class Upstream : public testing::Test
{
protected:
  Upstream()
  {
    vtkOutputWindow::SetInstance(shown);
    between->SetInputConnection(source->GetOutputPort());
    filter->AddInputConnection(fine->GetOutputPort());
    filter->AddInputConnection(between->GetOutputPort());
    source->SetWholeExtent(0, 2, 0, 2, 0, 2);
    fine->SetWholeExtent(0, 2, 0, 2, 0, 2);
  }
  ~Upstream() override { vtkOutputWindow::SetInstance(before); }

  UpstreamFailure::Report noteIn(std::vector<std::string>& list)
  {
    return [&list](const std::string& name) { list.push_back(name); };
  }

  vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkNew<Window> shown;
  vtkNew<Source> source;
  vtkNew<vtkRTAnalyticSource> fine;
  vtkNew<vtkImageShiftScale> between;
  vtkNew<vtkImageAppend> filter;
  std::vector<std::string> names, others;
};

TEST_F(Upstream, FailureIsReportedOnceToEachThatWatches)
{
  UpstreamFailure one, other;
  one.Watch(filter, noteIn(names));
  one.Watch(filter, noteIn(names)); // as each request does
  other.Watch(between, noteIn(others));
  filter->Update();
  EXPECT_EQ(names, std::vector<std::string>{ "Source" });
  EXPECT_EQ(others, names);
  ASSERT_EQ(shown->Texts.size(), 1u);
  EXPECT_NE(shown->Texts[0].find("returned failure for request"), std::string::npos);
  source->Modified();
  filter->Update();
  EXPECT_EQ(names.size(), 1u); // until it watches again
  one.Watch(filter, noteIn(names));
  source->Modified();
  filter->Update();
  EXPECT_EQ(names.size(), 2u);
  EXPECT_EQ(shown->Texts.size(), 3u);
}

TEST_F(Upstream, SuccessIsNotReported)
{
  UpstreamFailure watch;
  watch.Watch(filter, noteIn(names));
  source->Fails = false;
  filter->Update();
  EXPECT_TRUE(names.empty());
  EXPECT_TRUE(shown->Texts.empty());
}

TEST_F(Upstream, FailureElsewhereOrLaterIsNotReported)
{
  UpstreamFailure watch, ended;
  watch.Watch(between, noteIn(names));
  vtkNew<Source> elsewhere;
  ended.Watch(filter, noteIn(others));
  ended.Ignore();
  {
    UpstreamFailure gone;
    gone.Watch(filter, noteIn(others));
  }
  elsewhere->Update();
  EXPECT_TRUE(names.empty());
  source->Update();
  EXPECT_EQ(names.size(), 1u);
  EXPECT_TRUE(others.empty());
}

// ParaView deletes its filters after static objects that have been made after its own.
TEST(UpstreamAtExit, IsWatchedUntilAllIsGone)
{
  EXPECT_EXIT(
    {
      static UpstreamFailure made;
      vtkNew<vtkImageShiftScale> filter;
      made.Watch(filter, nullptr);
      std::exit(0);
    },
    testing::ExitedWithCode(0), "");
}

} // namespace
