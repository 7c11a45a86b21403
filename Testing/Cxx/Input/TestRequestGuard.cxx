// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// No exception leaves the requests of a filter.
#include "Common/RequestGuard.h"

#include "vtkInformation.h"
#include "vtkInformationRequestKey.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using filters::RequestGuard;
using Pipeline = vtkStreamingDemandDrivenPipeline;

class Guard : public testing::Test
{
protected:
  int Process(vtkInformationRequestKey* key, const std::function<int()>& work)
  {
    vtkNew<vtkInformation> request;
    request->Set(key);
    return this->Of.Process(
      request, work, "no memory", [this](const std::string& text) { this->Said.push_back(text); });
  }

  RequestGuard Of;
  std::vector<std::string> Said;
};

int failing() { throw std::runtime_error("wrong"); }

TEST_F(Guard, WhatRequestDataThrowsIsSaid)
{
  EXPECT_EQ(this->Process(Pipeline::REQUEST_DATA(), failing), 1);
  EXPECT_EQ(this->Said, std::vector<std::string>{ "wrong" });
  this->Process(Pipeline::REQUEST_DATA(), []() -> int { throw std::bad_alloc(); });
  EXPECT_EQ(this->Said.back(), "no memory");
  EXPECT_NO_THROW(this->Of.ThrowEarlier());
}

TEST_F(Guard, WhatOthersThrowIsSaidInRequestData)
{
  for (vtkInformationRequestKey* key :
    { Pipeline::REQUEST_INFORMATION(), Pipeline::REQUEST_UPDATE_EXTENT() })
  {
    EXPECT_EQ(this->Process(key, failing), 1);
    EXPECT_TRUE(this->Said.empty());
    EXPECT_THROW(this->Of.ThrowEarlier(), std::runtime_error);
    EXPECT_NO_THROW(this->Of.ThrowEarlier()); // once
    this->Process(key, failing);
    this->Process(Pipeline::REQUEST_DATA(),
      [this]
      {
        this->Of.ThrowEarlier();
        return 1;
      });
    EXPECT_EQ(this->Said, std::vector<std::string>{ "wrong" });
    this->Said.clear();
  }
}

TEST_F(Guard, ANewUpdateForgetsIt)
{
  this->Process(Pipeline::REQUEST_UPDATE_EXTENT(), failing);
  EXPECT_EQ(this->Process(Pipeline::REQUEST_DATA_OBJECT(), [] { return 7; }), 7);
  EXPECT_NO_THROW(this->Of.ThrowEarlier());
}

} // namespace
