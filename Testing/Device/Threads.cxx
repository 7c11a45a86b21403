// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The threads of a block are fibers (stacks of their own) on the thread of the host that runs the kernel.
// They take turns where they wait for each other. Threads that do not all come to the same barrier end the
// program.
#include "Threads.h"

#include <sys/mman.h>
#include <ucontext.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/common_interface_defs.h>
#endif

namespace emulated
{

uint3 thread, block;
dim3 blockSize, gridSize;

void fail(const char* what, int line)
{
  std::fprintf(stderr, "Emulated CUDA device: %s (line %d, block %u,%u, thread %u).\n", what, line,
    block.x, block.y, thread.x);
  std::abort();
}

namespace
{

constexpr int lanesPerWarp = 32;

/// Where some threads wait for each other, again and again.
struct Barrier
{
  int arrived = 0;
  int line = 0; ///< of the kernel, where they wait
  unsigned generation = 0;
  int sum = 0; ///< of what those that have arrived bring
  // Of this generation and of the last one, which some threads have yet to read.
  std::array<int, 2> sums{};
  std::array<std::array<std::uint64_t, lanesPerWarp>, 2> values{};
};

/// Runs the code of one thread after the other.
struct Fiber
{
  static constexpr std::size_t stackBytes = 256 << 10;
  static constexpr std::size_t guardBytes = 64 << 10; ///< below: a stack that overflows is noticed

  void* stack = nullptr;
  void* place[5] = {}; ///< where it continues, of __builtin_setjmp
  int thread = -1;     ///< in its block; -1: none
  const Barrier* waitsAt = nullptr;
  unsigned generation = 0;   ///< that it waits for the end of
  void* fakeStack = nullptr; ///< the address sanitizer's
};

/// What runs now. One kernel runs at a time.
struct Engine
{
  Fiber host; ///< the thread that runs the kernel
  std::vector<std::unique_ptr<Fiber>> fibers;
  Fiber* current = &host;
  Fiber* previous = nullptr;
  ucontext_t start{}; ///< of a fiber's first turn
  const void* hostStack = nullptr;
  std::size_t hostStackBytes = 0;

  const Launch* launch = nullptr;
  int threads = 0, started = 0, ended = 0;
  std::vector<int> threadOrder;
  Barrier all;
  std::vector<Barrier> warps;
};
Engine engine;

/// After a switch, for the address sanitizer.
void arrived([[maybe_unused]] void* fakeStack)
{
#ifdef __SANITIZE_ADDRESS__
  const void* bottom = nullptr;
  std::size_t bytes = 0;
  __sanitizer_finish_switch_fiber(fakeStack, &bottom, &bytes);
  if (engine.previous == &engine.host)
  {
    engine.hostStack = bottom;
    engine.hostStackBytes = bytes;
  }
#endif
}

void runThreads();

/// The first turn of a fiber.
void begin()
{
  arrived(nullptr);
  runThreads();
}

/// swapcontext would enter the kernel of the host's system, and the sanitizer's would clear what is known
/// of the stack.
__attribute__((noinline, no_sanitize("address", "undefined"))) void jump(Fiber& from, Fiber& to)
{
  if (__builtin_setjmp(from.place) != 0)
  {
    return;
  }
  if (to.place[0] == nullptr)
  {
    setcontext(&engine.start);
  }
  __builtin_longjmp(to.place, 1);
}

void setThread(int number)
{
  const auto n = static_cast<unsigned>(number);
  thread = { n % blockSize.x, n / blockSize.x % blockSize.y, n / blockSize.x / blockSize.y };
}

/// The fiber's turn; the caller's next turn comes when another calls this for it.
void resume(Fiber& to)
{
  Fiber& from = *engine.current;
  engine.previous = &from;
  engine.current = &to;
#ifdef __SANITIZE_ADDRESS__
  if (&to == &engine.host)
  {
    __sanitizer_start_switch_fiber(&from.fakeStack, engine.hostStack, engine.hostStackBytes);
  }
  else
  {
    __sanitizer_start_switch_fiber(&from.fakeStack, to.stack, Fiber::stackBytes);
  }
#endif
  jump(from, to);
  arrived(from.fakeStack);
  if (from.thread >= 0)
  {
    setThread(from.thread);
  }
}

void runThreads()
{
  while (true)
  {
    while (engine.started < engine.threads)
    {
      Fiber& self = *engine.current;
      self.thread = engine.threadOrder[static_cast<std::size_t>(engine.started++)];
      setThread(self.thread);
      engine.launch->thread();
      self.thread = -1;
      ++engine.ended;
    }
    resume(engine.host);
  }
}

/// For its first turn.
std::unique_ptr<Fiber> makeFiber()
{
  auto fiber = std::make_unique<Fiber>();
  void* memory = mmap(nullptr, Fiber::guardBytes + Fiber::stackBytes, PROT_NONE,
    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED)
  {
    fail("no memory for the stacks of threads");
  }
  fiber->stack = static_cast<char*>(memory) + Fiber::guardBytes;
  mprotect(fiber->stack, Fiber::stackBytes, PROT_READ | PROT_WRITE);
  return fiber;
}

void start(Fiber& fiber)
{
  if (fiber.place[0] == nullptr)
  {
    getcontext(&engine.start);
    engine.start.uc_stack.ss_sp = fiber.stack;
    engine.start.uc_stack.ss_size = Fiber::stackBytes;
    makecontext(&engine.start, begin, 0);
  }
  resume(fiber);
}

/// Others' turns, until all of a barrier's threads have arrived; the last one, too, waits for its turn.
/// Returns the generation that has ended.
unsigned arrive(Barrier& barrier, int expected, int line)
{
  if (barrier.arrived > 0 && barrier.line != line)
  {
    fail("threads of a block wait for each other in different places", line);
  }
  barrier.line = line;
  const unsigned generation = barrier.generation;
  if (++barrier.arrived == expected)
  {
    barrier.sums[generation % 2] = std::exchange(barrier.sum, 0);
    barrier.arrived = 0;
    ++barrier.generation;
  }
  Fiber& self = *engine.current;
  self.waitsAt = &barrier;
  self.generation = generation;
  resume(engine.host);
  self.waitsAt = nullptr;
  return generation;
}

bool mayResume(const Fiber& fiber)
{
  return fiber.thread >= 0 && fiber.waitsAt->generation != fiber.generation;
}

void runBlock()
{
  engine.started = engine.ended = 0;
  engine.all = {};
  engine.warps.assign(
    static_cast<std::size_t>((engine.threads + lanesPerWarp - 1) / lanesPerWarp), {});
  std::size_t used = 0;
  while (engine.started < engine.threads)
  {
    if (used == engine.fibers.size())
    {
      engine.fibers.push_back(makeFiber());
    }
    start(*engine.fibers[used++]); // runs threads until one of them waits
  }
  while (engine.ended < engine.threads)
  {
    bool progress = false;
    for (std::size_t n = 0; n < used; ++n)
    {
      if (mayResume(*engine.fibers[n]))
      {
        resume(*engine.fibers[n]);
        progress = true;
      }
    }
    if (!progress)
    {
      const auto waits = std::find_if(engine.fibers.begin(), engine.fibers.end(),
        [](const auto& fiber) { return fiber->thread >= 0; });
      setThread((*waits)->thread);
      fail("this thread waits for others that never come", (*waits)->waitsAt->line);
    }
  }
}

/// Of so many, from EMULATED_ORDER.
std::vector<int> order(int count)
{
  static const std::string given = []
  {
    const char* value = std::getenv("EMULATED_ORDER");
    return std::string(value != nullptr ? value : "forward");
  }();
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  if (given == "backward")
  {
    std::reverse(numbers.begin(), numbers.end());
  }
  else if (given != "forward")
  {
    if (given.empty() || given.find_first_not_of("0123456789") != std::string::npos)
    {
      fail("EMULATED_ORDER is neither forward nor backward nor a number");
    }
    static std::mt19937 random(static_cast<unsigned>(std::stoul(given)));
    std::shuffle(numbers.begin(), numbers.end(), random);
  }
  return numbers;
}

} // namespace

int lane() { return engine.current->thread % lanesPerWarp; }

int countOverBlock(int one, int line)
{
  engine.all.sum += one;
  const unsigned generation = arrive(engine.all, engine.threads, line);
  return engine.all.sums[generation % 2];
}

void shuffle(unsigned mask, void* value, std::size_t bytes, int fromLane, int line)
{
  const int number = engine.current->thread;
  Barrier& warp = engine.warps[static_cast<std::size_t>(number / lanesPerWarp)];
  const int first = number / lanesPerWarp * lanesPerWarp;
  const int lanes = std::min(lanesPerWarp, engine.threads - first);
  if (mask != (lanes == lanesPerWarp ? ~0u : (1u << lanes) - 1))
  {
    fail("a shuffle is not over all threads of a warp, which is all that is emulated", line);
  }
  std::memcpy(&warp.values[warp.generation % 2][static_cast<std::size_t>(number % lanesPerWarp)],
    value, bytes);
  const unsigned generation = arrive(warp, lanes, line);
  if (fromLane >= 0 && fromLane < lanes)
  {
    std::memcpy(value, &warp.values[generation % 2][static_cast<std::size_t>(fromLane)], bytes);
  }
}

void run(const Launch& launch)
{
  gridSize = launch.blocks;
  blockSize = launch.threads;
  engine.launch = &launch;
  engine.threads = static_cast<int>(blockSize.x * blockSize.y * blockSize.z);
  engine.threadOrder = order(engine.threads);
  for (const int n : order(static_cast<int>(gridSize.x * gridSize.y * gridSize.z)))
  {
    const auto at = static_cast<unsigned>(n);
    block = { at % gridSize.x, at / gridSize.x % gridSize.y, at / gridSize.x / gridSize.y };
    runBlock();
  }
}

} // namespace emulated
