// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Device/Cores.h"
#include "Device/Parallel.h"

#include <gtest/gtest.h>

#include <cmath>

#ifdef __linux__
#include <sched.h>
#endif

namespace schlieren
{

TEST(Cores, OfAQuota)
{
  EXPECT_EQ(coresOfQuota("200000 100000\n"), 2);
  EXPECT_EQ(coresOfQuota("50000 100000"), 0.5);
  EXPECT_EQ(coresOfQuota("150000 \n50000\n"), 3); // two files of version 1
  for (const char* unlimited : { "max 100000\n", "-1 \n100000\n", "", "0 0", "2" })
  {
    EXPECT_TRUE(std::isinf(coresOfQuota(unlimited))) << unlimited;
  }
}

TEST(Cores, ThreadsAreAsManyAsRequested)
{
  EXPECT_EQ(threadCount(7), 7);
  EXPECT_GE(threadCount(0), 1);
}

#ifdef __linux__
TEST(Cores, ThreadsStayOnTheCoresThatTheProcessIsBoundTo)
{
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  if (CPU_COUNT(&before) < 2)
  {
    GTEST_SKIP() << "There is but one core.";
  }
  int core = 0;
  while (!CPU_ISSET(core, &before))
  {
    ++core;
  }
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  const int threads = threadCount(0);
  ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
  EXPECT_EQ(threads, 1);
}
#endif

} // namespace schlieren
