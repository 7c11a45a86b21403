// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Medium/Tree/MediumTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

/// All that rays see of two trees, to the last bit.
template <class Real>
void expectIdentical(const schlieren::MediumTree<Real>& a, const schlieren::MediumTree<Real>& b)
{
  EXPECT_EQ(a.roots(), b.roots());
  EXPECT_EQ(a.children(), b.children());
  EXPECT_EQ(a.samples(), b.samples());
  EXPECT_EQ(a.gasDistances(), b.gasDistances());
  ASSERT_EQ(a.leaves().size(), b.leaves().size());
  for (std::size_t n = 0; n < a.leaves().size(); ++n)
  {
    const schlieren::Leaf<Real>& p = a.leaves()[n];
    const schlieren::Leaf<Real>& q = b.leaves()[n];
    ASSERT_EQ(p.kind, q.kind);
    ASSERT_EQ(p.brick, q.brick);
    ASSERT_EQ(p.map, q.map);
    ASSERT_EQ(p.offset, q.offset);
    ASSERT_EQ(p.perIndex, q.perIndex);
    ASSERT_TRUE(std::equal(p.first, p.first + 3, q.first));
  }
}
