// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// Images whose rays are traced by several processes, here threads that know each other by messages alone.
#include "AnalyticSources.h"
#include "Fields.h"
#include "Rays/RayWorker.h"
#include "SameImage.h"

#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace schlieren
{

namespace
{

/// Messages from one thread to another.
class Mail
{
public:
  void put(std::vector<char> message)
  {
    const std::lock_guard<std::mutex> guard(lock_);
    messages_.push_back(std::move(message));
    arrived_.notify_one();
  }
  bool isEmpty() const
  {
    const std::lock_guard<std::mutex> guard(lock_);
    return messages_.empty();
  }
  std::vector<char> take()
  {
    std::unique_lock<std::mutex> guard(lock_);
    arrived_.wait(guard, [this] { return !messages_.empty(); });
    std::vector<char> message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }

private:
  mutable std::mutex lock_;
  std::condition_variable arrived_;
  std::deque<std::vector<char>> messages_;
};

/// One end of a connection.
class End : public Channel
{
public:
  End(Mail& to, Mail& from, const std::atomic<bool>& isOpen)
    : to_(to)
    , from_(from)
    , isOpen_(isOpen)
  {
  }
  void send(std::vector<char> message) override { to_.put(std::move(message)); }
  bool hasMessage() override { return !from_.isEmpty(); }
  std::vector<char> receive() override { return from_.take(); }
  bool isOpen() const override { return isOpen_; }

private:
  Mail& to_;
  Mail& from_;
  const std::atomic<bool>& isOpen_;
};

/// A worker in a thread of its own.
class Worker
{
public:
  /// What goes wrong, once so many messages with tiles have come.
  enum class Fault
  {
    None,
    Forgets,        ///< the arrays
    Leaves,         ///< without an answer
    LosesEverything ///< that it is sent from then on, but says so
  };
  explicit Worker(Fault fault = Fault::None, int after = 0)
    : fault_(fault)
    , after_(after)
    , thread_([this] { work(); })
  {
  }
  ~Worker()
  {
    toWorker_.put({});
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  Channel* channel() { return &here_; }
  int arrays() const { return arrays_; } ///< that it was sent
  int tiles() const { return tiles_; }   ///< messages with tiles

private:
  void work()
  {
    End there(fromWorker_, toWorker_, isOpen_);
    auto worker = std::make_unique<RayWorker>();
    for (std::vector<char> message = there.receive(); !message.empty(); message = there.receive())
    {
      const bool isArray = RayWorker::kindOf(message) == RayWorker::Array;
      arrays_ += isArray ? 1 : 0;
      tiles_ += isArray ? 0 : 1;
      const bool isFaulty = tiles_ > after_;
      if (fault_ == Fault::Leaves && isFaulty)
      {
        isOpen_ = false;
      }
      if (!isOpen_ || (fault_ == Fault::LosesEverything && isFaulty && isArray))
      {
        continue;
      }
      if ((fault_ == Fault::Forgets && tiles_ == after_ + 1) ||
        (fault_ == Fault::LosesEverything && isFaulty))
      {
        worker = std::make_unique<RayWorker>();
      }
      worker->answer(std::move(message), there, 2);
    }
  }

  Mail toWorker_, fromWorker_;
  std::atomic<bool> isOpen_{ true };
  std::atomic<int> arrays_{ 0 }, tiles_{ 0 };
  Fault fault_;
  int after_;
  End here_{ toWorker_, fromWorker_, isOpen_ };
  std::thread thread_;
};

/// Balls, with two fields.
Field fieldOfTree()
{
  const auto balls = std::make_shared<BallsSource>(threeBalls(3e-4));
  const auto source = std::make_shared<SourceWithFields>(balls,
    std::vector<FieldFormula>{ ballField({ 0.1, 0, 0 }, 0.3), ballField({ -0.2, 0.3, 0 }, 0.1) });
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = 1;
  field.gradients.count = 2;
  return field;
}

Scene oblique()
{
  Scene scene;
  scene.device = Device::Cpu;
  scene.view.width = 150; // no multiple of a tile's edge
  scene.view.height = 90;
  scene.view.viewDirection = { -0.2, 0.4, -1 };
  scene.histogramSize = 16;
  scene.samplesPerPixel = 2;
  scene.fieldColors = { { 1, 0, 0 }, { 0, 0.5f, 1 } };
  scene.threads = 1;
  return scene;
}

void expectSameOf(const Field& field, const Scene& scene)
{
  const Image alone = Bench().render(field, scene);
  for (const std::size_t count : { 1u, 2u, 5u })
  {
    SCOPED_TRACE(count);
    std::vector<std::unique_ptr<Worker>> workers;
    std::vector<Channel*> channels;
    while (workers.size() < count)
    {
      workers.push_back(std::make_unique<Worker>());
      channels.push_back(workers.back()->channel());
    }
    Bench bench;
    bench.setWorkers(channels);
    expectSameImage(bench.render(field, scene), alone);
    for (const auto& worker : workers)
    {
      EXPECT_GT(worker->tiles(), 0);
    }
    // With pauses: each call gives tiles back that are not traced.
    Bench paused;
    paused.setWorkers(channels);
    const Monitor atOnce{ {}, {}, [] { return true; } };
    Image image = paused.render(field, scene, atOnce);
    int calls = 0;
    for (; !image.finished && calls < 10000; ++calls)
    {
      image = paused.resume(atOnce);
    }
    EXPECT_GT(calls, 1);
    expectSameImage(image, alone);
  }
}

TEST(Team, ChangesNoBitOfAnImage)
{
  const BlobWithHole flow;
  Scene scene = oblique();
  expectSameOf(flow.tinted(), scene);
  scene.homogeneityTolerance = 1e-3;
  scene.precision = Precision::Double;
  expectSameOf(flow.tinted(), scene);
}

TEST(Team, ChangesNoBitOfATree)
{
  Scene scene = oblique();
  scene.source.distance = 20;
  expectSameOf(fieldOfTree(), scene);
}

TEST(Team, ChangesNoBitBesideWalls)
{
  const auto source = std::make_shared<SphereSource>(2);
  Field field;
  field.source = source;
  field.grid = coarsestGrid(*source);
  field.version = 1;
  Scene scene = oblique();
  scene.view.parallelScale = 1.5;
  scene.mediumTolerance = 0.1;
  scene.fieldColors.clear();
  expectSameOf(field, scene);
}

TEST(Team, SendsTheMediumOnce)
{
  const BlobWithHole flow;
  Worker worker;
  Bench bench;
  bench.setWorkers({ worker.channel() });
  Scene scene = oblique();
  bench.render(flow.tinted(), scene);
  const int arrays = worker.arrays(), tiles = worker.tiles();
  EXPECT_EQ(arrays, 3); // samples, solids, gradients of fields
  scene.view.viewDirection = { 0.3, 0.1, -1 };
  bench.render(flow.tinted(), scene);
  EXPECT_EQ(worker.arrays(), arrays);
  EXPECT_GT(worker.tiles(), tiles);
  scene.interpolation = Interpolation::Cubic; // another medium
  bench.render(flow.tinted(), scene);
  EXPECT_GT(worker.arrays(), arrays);
  bench.setWorkers({});
  const int tilesOfWorker = worker.tiles();
  scene.view.viewDirection = { 0, 0.1, -1 };
  bench.render(flow.tinted(), scene);
  EXPECT_EQ(worker.tiles(), tilesOfWorker);
}

// Not seen in the image, whatever becomes of a worker.
TEST(Team, NeedsNoWorker)
{
  const BlobWithHole flow;
  const Scene scene = oblique();
  const Image alone = Bench().render(flow.tinted(), scene);
  for (const Worker::Fault fault :
    { Worker::Fault::Forgets, Worker::Fault::Leaves, Worker::Fault::LosesEverything })
  {
    for (const int after : { 0, 1, 2 })
    {
      SCOPED_TRACE(testing::Message() << static_cast<int>(fault) << " after " << after);
      Worker good, faulty(fault, after);
      Bench bench;
      bench.setWorkers({ faulty.channel(), good.channel() });
      expectSameImage(bench.render(flow.tinted(), scene), alone);
      Scene next = scene;
      next.view.viewDirection = { 0.3, 0.1, -1 };
      expectSameImage(bench.render(flow.tinted(), next), Bench().render(flow.tinted(), next));
      EXPECT_GT(faulty.tiles(), 0);
    }
  }
}

TEST(Team, AbortsAtOnce)
{
  const BlobWithHole flow;
  Worker worker;
  Bench bench;
  bench.setWorkers({ worker.channel() });
  int questions = 0;
  const Monitor aborting{ {}, [&] { return ++questions > 3; }, {} };
  EXPECT_TRUE(bench.render(flow.tinted(), oblique(), aborting).aborted);
  expectSameImage(bench.render(flow.tinted(), oblique()), Bench().render(flow.tinted(), oblique()));
}

TEST(Team, IgnoresMessagesThatMakeNoSense)
{
  Mail to, from;
  const std::atomic<bool> isOpen{ true };
  End channel(to, from, isOpen);
  RayWorker worker;
  for (const std::size_t bytes : { 0u, 3u, 4u, 40u })
  {
    worker.answer(std::vector<char>(bytes, 7), channel, 1);
  }
  EXPECT_TRUE(to.isEmpty());
}

} // namespace

} // namespace schlieren
