// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Compiled with -fmad=false (see CMakeLists.txt).
#include "Film/CudaFilm.h"

#include "Device/CudaBuffer.h"
#include "Device/CudaLaunch.h"
#include "Film/CudaFilmKernels.inl"

#include <algorithm>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

namespace schlieren
{

namespace
{

/// Fewest rows of a band, of which three more are shaded.
constexpr std::int64_t fewestRows = 16;

/// Limits the blocks of bentKernel, however many cells there are.
constexpr unsigned maxBlocksOfBent = 1024;

void fetch(void* to, const void* from, std::size_t bytes)
{
  checkCuda(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost), "Fetching the image");
}

template <bool isOfPhase, int planes>
void deposit(const ShadedRays<planes>& shaded, const Sums& sums)
{
  const unsigned blocks = shaded.rays.blocks(shaded.rays.endRow - shaded.rays.firstRow);
  if (shaded.rays.pass.side < 1)
  {
    launchKernel(boxKernel<planes, isOfPhase>, blocks, threadsPerBlock, 0, nullptr, shaded, sums);
    return;
  }
  launchKernel(depositKernel<planes, isOfPhase>, blocks, threadsPerBlock, 0, nullptr, shaded, sums);
  launchKernel(bentKernel<planes, isOfPhase>, std::min(blocks, maxBlocksOfBent), threadsPerBlock, 0,
    nullptr, shaded, sums);
}

} // namespace

struct CudaFilm::DeviceMemory
{
  DeviceMemory(const Films& films, std::int64_t raysOfBand)
    : raysPerBand(raysOfBand)
    , pixels(films.planes[0].pixels())
    , light(pixels * films.planes.size())
    , sums(pixels)
    , counts(1)
    , planes(films.planes.size())
    , view{ { films.planes[0].width(), films.planes[0].height(), films.planes[0].one() },
      light.data(), sums.data(), counts.data(), planes.data() }
  {
    // All zero bits are zeros, of all that is summed up here.
    clear(light.data(), pixels * films.planes.size() * sizeof(Counter));
    clear(sums.data(), pixels * sizeof(PixelRays));
    clear(counts.data(), sizeof(RayCounts));
    clear(planes.data(), films.planes.size() * sizeof(LightSums));
  }

  /// A table's copy on the device, as long as none is requested that lies elsewhere.
  Table copyOf(const Table& table)
  {
    if (!copied || onHost != table.values)
    {
      copied = std::make_unique<CudaBuffer<float>>(table.values, table.size, "Copying the cutoff");
      onHost = table.values;
    }
    return { copied->data(), table.size };
  }

  /// Room for shaded rays, which serves again.
  template <int planes>
  FilmRay<planes>* raysAtFilm(std::int64_t count)
  {
    return reinterpret_cast<FilmRay<planes>*>(
      room(shaded, shadedBytes, static_cast<std::size_t>(count) * sizeof(FilmRay<planes>)));
  }
  /// Likewise for cells, none of which is there yet.
  unsigned* bentCells(std::int64_t most)
  {
    auto* const cells = reinterpret_cast<unsigned*>(
      room(bent, bentBytes, (1 + static_cast<std::size_t>(most)) * sizeof(unsigned)));
    clear(cells, sizeof(unsigned));
    return cells;
  }

  static void clear(void* bytes, std::size_t size)
  {
    checkCuda(cudaMemset(bytes, 0, size), "Clearing the film");
  }

  using Bytes = CudaBuffer<unsigned char>;
  static unsigned char* room(std::unique_ptr<Bytes>& bytes, std::size_t& size, std::size_t wanted)
  {
    if (!bytes || size < wanted)
    {
      bytes.reset();
      bytes = std::make_unique<Bytes>(wanted);
      size = wanted;
    }
    return bytes->data();
  }

  std::int64_t raysPerBand;
  std::size_t pixels;
  CudaBuffer<Counter> light;
  CudaBuffer<PixelRays> sums;
  CudaBuffer<RayCounts> counts;
  CudaBuffer<LightSums> planes;
  Sums view;
  std::unique_ptr<CudaBuffer<float>> copied;
  const float* onHost = nullptr; ///< what has been copied
  std::unique_ptr<Bytes> shaded, bent;
  std::size_t shadedBytes = 0, bentBytes = 0;
};

CudaFilm::CudaFilm(const Films& films, std::int64_t raysPerBand)
  : memory_(std::make_unique<DeviceMemory>(films, raysPerBand))
{
}

CudaFilm::~CudaFilm() = default;

void CudaFilm::expose(const CudaPass& traced, const Pass& pass, const Cutoffs& cutoff,
  const Projection& projection, std::int64_t margin)
{
  const Sums& sums = memory_->view;
  const std::int64_t columns = sums.film.columns + 2 * margin;
  const std::int64_t rows = sums.film.rows + 2 * margin;
  const std::int64_t rowsPerBand = std::max(fewestRows, memory_->raysPerBand / columns);
  for (std::int64_t row = 0; row < rows; row += rowsPerBand)
  {
    const std::int64_t end = std::min(rows, row + rowsPerBand);
    // Cells look at the rays below them and at two rows above.
    const RaysOnDevice rays{ traced.exits(), pass, margin, columns, rows, row, end,
      std::max<std::int64_t>(row - 1, 0), std::min(rows, end + 2) };
    const auto exposeBy = [&](auto kind)
    {
      constexpr int planes = decltype(kind)::channels;
      if (Table* table = tableOf(kind))
      {
        *table = memory_->copyOf(*table);
      }
      const std::int64_t shadedRows = rays.endShaded - rays.firstShaded;
      const ShadedRays<planes> shaded{ rays,
        memory_->raysAtFilm<planes>(columns * std::min(rows, rowsPerBand + 3)),
        memory_->bentCells(columns * std::min(rows, rowsPerBand)) };
      launchKernel(shadeKernel<decltype(kind)>, rays.blocks(shadedRows), threadsPerBlock, 0,
        nullptr, kind, projection, shaded, sums);
      deposit<std::is_same_v<decltype(kind), FringePhase>>(shaded, sums);
    };
    std::visit(
      [&](const auto& kind)
      {
        if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, Interferogram>)
        {
          exposeBy(FringePhase{ kind });
        }
        else
        {
          exposeBy(kind);
        }
      },
      cutoff);
    checkCuda(cudaGetLastError(), "Starting the film's kernel");
  }
}

RayCounts CudaFilm::develop(Films& films) const
{
  const std::size_t pixels = memory_->pixels;
  for (std::size_t plane = 0; plane < films.planes.size(); ++plane)
  {
    films.planes[plane].set(
      [&](std::int64_t* light, LightSums& sums)
      {
        fetch(light, memory_->light.data() + plane * pixels, pixels * sizeof(Counter));
        fetch(&sums, memory_->planes.data() + plane, sizeof(LightSums));
      });
  }
  RayCounts counts;
  fetch(&counts, memory_->counts.data(), sizeof(RayCounts));
  return counts;
}

void CudaFilm::developCentres(Image& image) const
{
  const std::size_t pixels = memory_->pixels;
  const CentreArrays onHost = centreArraysOf(image, pixels);
  // In the room of shaded rays, which have been deposited: there may be no other.
  constexpr std::size_t bytesPerPixel = sizeof(double) + 5 * sizeof(float);
  const std::size_t mostAtOnce = memory_->shadedBytes / bytesPerPixel;
  for (std::size_t first = 0; first < pixels; first += mostAtOnce)
  {
    const std::size_t count = std::min(mostAtOnce, pixels - first);
    auto* const paths = reinterpret_cast<double*>(memory_->shaded->data());
    auto* const others = reinterpret_cast<float*>(paths + count);
    const CentreArrays onDevice{ others, others + 2 * count, paths, others + 4 * count };
    launchKernel(centresKernel,
      static_cast<unsigned>((count + threadsPerBlock - 1) / threadsPerBlock), threadsPerBlock, 0,
      nullptr, static_cast<const PixelRays*>(memory_->sums.data()) + first,
      static_cast<std::int64_t>(count), onDevice);
    checkCuda(cudaGetLastError(), "Starting the kernel of pixels' centres");
    fetch(onHost.deflection + 2 * first, onDevice.deflection, 2 * count * sizeof(float));
    fetch(onHost.displacement + 2 * first, onDevice.displacement, 2 * count * sizeof(float));
    fetch(onHost.opticalPathDifference + first, paths, count * sizeof(double));
    fetch(onHost.blockedFraction + first, onDevice.blockedFraction, count * sizeof(float));
  }
}

} // namespace schlieren
