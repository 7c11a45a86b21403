// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Processes that trace rays for another one: here threads of this one, which know it by requests alone.
#pragma once

#include "AnalyticSources.h"
#include "Rays/Ranks/Processes.h"
#include "Rays/Ranks/RayMessages.h"
#include "Rays/Ranks/RayWorker.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <thread>
#include <vector>

namespace schlieren
{

class OtherProcesses : public Processes
{
public:
  explicit OtherProcesses(int others)
    : arrays(0)
  {
    for (int n = 1; n <= others; ++n)
    {
      workers_.push_back(std::make_unique<RayWorker>(n, others + 1));
    }
  }

  int others() const override { return static_cast<int>(workers_.size()); }
  std::vector<std::vector<char>> request(
    const std::vector<char>& message, const std::function<void()>& meanwhile) override
  {
    bytes += message.size();
    const std::uint32_t kind = RayWorker::kindOf(message);
    arrays += kind == RayWorker::Array ? 1 : 0;
    if (kind == RayWorker::Trace)
    {
      ++traces;
      TraceMessage<float> request; // of doubles the beginning is the same
      read(message, request);
      tiles += request.end - request.first;
    }
    std::vector<std::vector<char>> answers(workers_.size());
    std::vector<std::exception_ptr> problems(workers_.size() + 1);
    std::vector<std::thread> threads;
    for (std::size_t n = 0; n < workers_.size(); ++n)
    {
      threads.emplace_back(
        [&, n]
        {
          try
          {
            if (static_cast<int>(n) == failing && kind == RayWorker::Trace)
            {
              throw Error("lost");
            }
            answers[n] = workers_[n]->answer(message, 2);
          }
          catch (...)
          {
            problems[n] = std::current_exception();
          }
        });
    }
    try
    {
      if (meanwhile)
      {
        meanwhile();
      }
    }
    catch (...)
    {
      problems.back() = std::current_exception();
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
    for (const std::exception_ptr& problem : problems)
    {
      if (problem)
      {
        std::rethrow_exception(problem);
      }
    }
    return answers;
  }

  std::size_t bytes = 0;  ///< of requests
  int arrays = 0;         ///< pieces of arrays that were sent
  int traces = 0;         ///< requests of rays
  std::int64_t tiles = 0; ///< of these
  int failing = -1;       ///< the one that fails

private:
  std::vector<std::unique_ptr<RayWorker>> workers_;
};

inline Field fieldOfBalls()
{
  const auto source = std::make_shared<BallsSource>(threeBalls(3e-4));
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = 1;
  return field;
}

} // namespace schlieren
