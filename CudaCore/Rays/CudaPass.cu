// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rays/CudaPass.h"

#include "Device/CudaBuffer.h"
#include "Device/CudaLaunch.h"

#include <cstring>

namespace schlieren
{

namespace
{

constexpr int threadsPerBlock = 128;

/// The rays of a pass that start in an image.
struct RaysOfImage
{
  const RayExit* first;
  std::int64_t perRow; ///< of the pass
  std::int64_t width, count;

  RaysOfImage(const RayExit* exits, const Pass& pass, int imageWidth, int height)
    : first(exits - pass.firstRow * pass.columns - pass.firstColumn)
    , perRow(pass.columns)
    , width(imageWidth)
    , count(std::int64_t{ imageWidth } * height)
  {
  }
  unsigned blocks() const
  {
    return static_cast<unsigned>((count + threadsPerBlock - 1) / threadsPerBlock);
  }
  /// The ray of this thread; null if there is none.
  __device__ const RayExit* ofThread() const
  {
    const std::int64_t n = blockIdx.x * static_cast<std::int64_t>(threadsPerBlock) + threadIdx.x;
    if (n >= count)
    {
      return nullptr;
    }
    return first + n / width * perRow + n % width;
  }
};

/// Null where it is not counted.
__device__ const RayExit* countedRay(const RaysOfImage& rays)
{
  const RayExit* ray = rays.ofThread();
  return ray != nullptr && DeflectionBins::counts(*ray) ? ray : nullptr;
}
__device__ const RayExit* crossingRay(const RaysOfImage& rays)
{
  const RayExit* ray = rays.ofThread();
  return ray != nullptr && ray->fate == RayFate::Left ? ray : nullptr;
}

/// `here` of 0 or more. All threads of a warp come here.
__device__ void addLargest(double here, long long* largest)
{
  for (int lanes = 16; lanes > 0; lanes /= 2)
  {
    constexpr unsigned all = 0xffffffff;
    here = fmax(here, __shfl_down_sync(all, here, lanes));
  }
  if (threadIdx.x % 32 == 0 && here > 0)
  {
    atomicMax(largest, __double_as_longlong(here)); // bits grow with the number
  }
}

/// All threads of a block come to its end.
__global__ void largestKernel(const RaysOfImage rays, long long* largest)
{
  const RayExit* ray = countedRay(rays);
  addLargest(
    ray == nullptr ? 0 : fmax(fabs(ray->deflection[0]), fabs(ray->deflection[1])), largest);
}

/// All threads of a block come to its end.
__global__ void countSquaresKernel(
  const RaysOfImage rays, unsigned long long* counts, long long* largest)
{
  const RayExit* ray = crossingRay(rays);
  const double square = ray == nullptr ? 0 : squaredDeflection(*ray);
  addLargest(square, largest);
  // Where the gas is undisturbed nothing is bent: one sum of each block.
  const int straight = __syncthreads_count(ray != nullptr && square == 0 ? 1 : 0);
  if (threadIdx.x == 0 && straight > 0)
  {
    atomicAdd(counts, static_cast<unsigned long long>(straight));
  }
  if (ray != nullptr && square != 0)
  {
    atomicAdd(counts + LeadingBits::of(square), 1ull);
  }
}

/// Lists the squared deflections of a bin.
__global__ void findSquaresKernel(
  const RaysOfImage rays, std::size_t bin, unsigned long long* found, double* squares)
{
  const RayExit* ray = crossingRay(rays);
  const double square = ray == nullptr ? 0 : squaredDeflection(*ray);
  if (ray != nullptr && LeadingBits::of(square) == bin)
  {
    squares[atomicAdd(found, 1ull)] = square;
  }
}

/// All threads of a block come to its end.
__global__ void countKernel(
  const RaysOfImage rays, const DeflectionBins bins, unsigned long long* counts)
{
  const RayExit* ray = countedRay(rays);
  std::int64_t bin = ray == nullptr ? -1 : bins.of(*ray);
  // Most rays are hardly bent: the four bins in the middle get one sum of each block.
  for (int quarter = 0; quarter < 4; ++quarter)
  {
    const std::int64_t middle =
      (bins.count / 2 - quarter / 2) * bins.count + bins.count / 2 - quarter % 2;
    const int rest = __syncthreads_count(bin == middle ? 1 : 0);
    if (threadIdx.x == 0 && rest > 0)
    {
      atomicAdd(counts + middle, static_cast<unsigned long long>(rest));
    }
    bin = bin == middle ? -1 : bin;
  }
  if (bin >= 0)
  {
    atomicAdd(counts + bin, 1ull);
  }
}

double numberOf(long long bits)
{
  double value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

template <class T>
void clear(const CudaBuffer<T>& values, std::size_t count)
{
  checkCuda(cudaMemset(values.data(), 0, count * sizeof(T)), "Counting rays");
}

template <class T>
std::vector<T> toHost(const CudaBuffer<T>& values, std::size_t count)
{
  std::vector<T> fetched(count);
  checkCuda(cudaMemcpy(fetched.data(), values.data(), count * sizeof(T), cudaMemcpyDeviceToHost),
    "Counting rays");
  return fetched;
}

} // namespace

bool canKeepOnCuda(std::size_t bytes)
{
  // The next pass, and films of an image of as many pixels: a pixel of films takes up to 88 bytes, a ray 40.
  constexpr std::size_t nextPassAndFilms = 3;
  std::size_t free = 0, total = 0;
  checkCuda(cudaMemGetInfo(&free, &total), "Asking for free memory");
  // For kernels' stacks, which take 624 bytes of each of 2048 threads on each of 132 multiprocessors at most, and for a
  // band of shaded rays.
  const std::size_t reserve = std::min(std::size_t{ 256 } << 20, total / 8);
  return free >= reserve + (1 + nextPassAndFilms) * bytes;
}

CudaPass::CudaPass(std::size_t rays)
  : exits_(allocateOnCuda<RayExit>(rays))
  , size_(rays)
{
}

CudaPass::CudaPass(const RayExits& exits)
  : CudaPass(exits.size())
{
  checkCuda(cudaMemcpy(exits_, exits.data(), size_ * sizeof(RayExit), cudaMemcpyHostToDevice),
    "Sending rays");
}

CudaPass::~CudaPass() { cudaFree(exits_); }

void CudaPass::makeUndisturbed()
{
  // All zero bits are an undisturbed ray.
  checkCuda(cudaMemset(exits_, 0, size_ * sizeof(RayExit)), "Making undisturbed rays");
}

RayExits CudaPass::toHost() const
{
  RayExits exits(size_);
  checkCuda(cudaMemcpy(exits.data(), exits_, size_ * sizeof(RayExit), cudaMemcpyDeviceToHost),
    "Fetching rays");
  return exits;
}

double CudaPass::largestDeflection(const Pass& pass, int width, int height) const
{
  const CudaBuffer<long long> largest(1);
  clear(largest, 1);
  const RaysOfImage rays(exits_, pass, width, height);
  launchKernel(largestKernel, rays.blocks(), threadsPerBlock, 0, nullptr, rays, largest.data());
  checkCuda(cudaGetLastError(), "Counting rays");
  return numberOf(schlieren::toHost(largest, 1)[0]);
}

CudaPass::Squares CudaPass::countSquares(const Pass& pass, int width, int height) const
{
  const CudaBuffer<unsigned long long> counts(LeadingBits::count);
  const CudaBuffer<long long> largest(1);
  clear(counts, LeadingBits::count);
  clear(largest, 1);
  const RaysOfImage rays(exits_, pass, width, height);
  launchKernel(countSquaresKernel, rays.blocks(), threadsPerBlock, 0, nullptr, rays, counts.data(),
    largest.data());
  checkCuda(cudaGetLastError(), "Counting rays");
  const std::vector<unsigned long long> fetched = schlieren::toHost(counts, LeadingBits::count);
  return { { fetched.begin(), fetched.end() }, numberOf(schlieren::toHost(largest, 1)[0]) };
}

std::vector<double> CudaPass::squaresIn(
  std::size_t bin, std::int64_t count, const Pass& pass, int width, int height) const
{
  const auto size = static_cast<std::size_t>(count);
  const CudaBuffer<unsigned long long> found(1);
  const CudaBuffer<double> squares(size);
  clear(found, 1);
  const RaysOfImage rays(exits_, pass, width, height);
  launchKernel(findSquaresKernel, rays.blocks(), threadsPerBlock, 0, nullptr, rays, bin,
    found.data(), squares.data());
  checkCuda(cudaGetLastError(), "Counting rays");
  return schlieren::toHost(squares, size);
}

void CudaPass::countDeflections(const Pass& pass, int width, int height, const DeflectionBins& bins,
  std::vector<std::int64_t>& counts) const
{
  const CudaBuffer<unsigned long long> here(counts.size());
  clear(here, counts.size());
  const RaysOfImage rays(exits_, pass, width, height);
  launchKernel(countKernel, rays.blocks(), threadsPerBlock, 0, nullptr, rays, bins, here.data());
  checkCuda(cudaGetLastError(), "Counting rays");
  const std::vector<unsigned long long> fetched = schlieren::toHost(here, counts.size());
  for (std::size_t n = 0; n < counts.size(); ++n)
  {
    counts[n] += static_cast<std::int64_t>(fetched[n]);
  }
}

} // namespace schlieren
