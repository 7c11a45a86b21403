// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Compiled with -fmad=false (see CMakeLists.txt).
#include "Film/CudaFilm.h"

#include "Device/CudaBuffer.h"
#include "Device/CudaLaunch.h"
#include "Film/CentreValues.h"
#include "Film/Sheet.h"

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

// A block works for a tile of rays that start near each other.
constexpr int tileColumns = 32, tileRows = 4;
constexpr int threadsPerBlock = tileColumns * tileRows;

/// Fewest rows of a band, of which three more are shaded.
constexpr std::int64_t fewestRows = 16;

/// Limits the blocks of bentKernel, however many cells there are.
constexpr unsigned maxBlocksOfBent = 1024;

/// What atomicAdd takes; whole numbers wrap, so that the sum's bits are those of signed ones.
using Counter = unsigned long long;

struct Sums
{
  FilmSize film;
  Counter* light; ///< plane by plane
  PixelRays* pixels;
  RayCounts* counts;
  LightSums* planes;
};

__device__ void add(std::int64_t* to, std::int64_t number)
{
  static_assert(sizeof(Counter) == sizeof(std::int64_t));
  if (number != 0)
  {
    atomicAdd(reinterpret_cast<Counter*>(to), static_cast<Counter>(number));
  }
}

/// What one thread adds. As Sheet wants it.
template <int planes>
struct DeviceDeposit
{
  const Sums& sums;
  LightSums all[planes]{};

  __device__ void emitted(int plane, std::int64_t light) { all[plane].emitted += light; }
  __device__ void outside(int plane, std::int64_t light) { all[plane].outside += light; }
  __device__ void pixel(int plane, std::int64_t column, std::int64_t row, std::int64_t light)
  {
    if (light != 0)
    {
      atomicAdd(sums.light + (plane * sums.film.rows + row) * sums.film.columns + column,
        static_cast<Counter>(light));
    }
  }
  __device__ void block(
    int plane, std::int64_t column, std::int64_t row, const Contributions& contributions)
  {
    anywhere(plane, column, row, contributions.lowerLeft);
    anywhere(plane, column + 1, row, contributions.lowerRight);
    anywhere(plane, column, row + 1, contributions.upperLeft);
    anywhere(plane, column + 1, row + 1, contributions.upperRight);
  }

private:
  __device__ void anywhere(int plane, std::int64_t column, std::int64_t row, std::int64_t light)
  {
    if (column >= 0 && column < sums.film.columns && row >= 0 && row < sums.film.rows)
    {
      pixel(plane, column, row, light);
    }
    else
    {
      outside(plane, light);
    }
  }
};

template <int planes, bool isOfPhase>
using DeviceSheet = Sheet<planes, DeviceDeposit<planes>, 1, isOfPhase>;

__device__ std::int64_t sumOverWarp(std::int64_t number)
{
  constexpr unsigned all = 0xffffffff;
  for (int lanes = 16; lanes > 0; lanes /= 2)
  {
    number += __shfl_down_sync(all, number, lanes);
  }
  return number;
}

/// A pass with the rays of the image and its margin, some rows of which are shaded at a time.
struct RaysOnDevice
{
  const RayExit* exits;
  Pass pass;
  std::int64_t margin;
  std::int64_t columns, rows;    ///< the margin among them
  std::int64_t firstRow, endRow; ///< that are added; cells belong to the row of their lower rays
  std::int64_t firstShaded, endShaded; ///< rows that this takes

  __device__ const RayExit& exit(std::int64_t column, std::int64_t row) const
  {
    return exits[(row - margin - pass.firstRow) * pass.columns + column - margin -
      pass.firstColumn];
  }
  /// Counts the blocks that work for rows.
  unsigned blocks(std::int64_t rowCount) const
  {
    return static_cast<unsigned>(
      (columns + tileColumns - 1) / tileColumns * ((rowCount + tileRows - 1) / tileRows));
  }
  /// Where the ray, and the cell that it is the lower left one of, is that this thread works for, if the first block
  /// works for row `first`; it may be outside.
  __device__ void place(std::int64_t first, std::int64_t& column, std::int64_t& row) const
  {
    const std::int64_t along = (columns + tileColumns - 1) / tileColumns;
    column = blockIdx.x % along * tileColumns + threadIdx.x % tileColumns;
    row = first + blockIdx.x / along * tileRows + threadIdx.x / tileColumns;
  }
};

/// Shaded rays, and the cells between them that are added by bentKernel.
template <int planes>
struct ShadedRays
{
  RaysOnDevice rays;
  FilmRay<planes>* shaded; ///< rows firstShaded ... endShaded - 1
  unsigned* bent;          ///< first how many, then which: numbers of their lower left rays

  /// Reads a ray, one that does not arrive where there is none.
  __device__ FilmRay<planes> at(std::int64_t column, std::int64_t row) const
  {
    return column >= 0 && column < rays.columns && row >= rays.firstShaded && row < rays.endShaded
      ? shaded[(row - rays.firstShaded) * rays.columns + column]
      : FilmRay<planes>{};
  }
  /// Calls use(the rays of a cell, the rays around it).
  template <bool isOfPhase, class Use>
  __device__ void useCell(std::int64_t column, std::int64_t row, const Use& use) const
  {
    const auto ray = [&](std::int64_t right, std::int64_t up)
    { return at(column + right, row + up); };
    const auto smooth = [&ray](std::int64_t right, std::int64_t up)
    {
      return sheetRay<isOfPhase>(ray(right, up), ray(right - 1, up), ray(right + 1, up),
        ray(right, up - 1), ray(right, up + 1));
    };
    use(smooth(0, 0), smooth(1, 0), smooth(0, 1), smooth(1, 1), ray);
  }
};

/// Turns rays into what the film gets of them, and sums up what is known of each without the others. All threads of a
/// block come to its end.
template <class CutoffKind>
__global__ void shadeKernel(const CutoffKind cutoff, const Projection projection,
  const ShadedRays<CutoffKind::channels> to, const Sums sums)
{
  const RaysOnDevice& rays = to.rays;
  std::int64_t i, j;
  rays.place(rays.firstShaded, i, j);
  RayCounts counts;
  if (i < rays.columns && j < rays.endShaded)
  {
    const RayExit& exit = rays.exit(i, j);
    const std::int64_t column = i - rays.margin, row = j - rays.margin;
    if (j >= rays.firstRow && j < rays.endRow) // others are counted with their own
    {
      counts.add(exit);
      if (column >= 0 && column < sums.film.columns && row >= 0 && row < sums.film.rows)
      {
        // No other thread has this pixel.
        sums.pixels[row * sums.film.columns + column].add(exit, projection.pupilTilt > 0);
        counts.addShaded(exit, cutoff);
      }
    }
    // Rounded as on the CPU.
    const double startColumn = static_cast<double>(-rays.margin) + rays.pass.offset.column;
    const double startRow = static_cast<double>(row) + rays.pass.offset.row;
    to.shaded[(j - rays.firstShaded) * rays.columns + i] = shade(
      exit, startColumn + static_cast<double>(i), startRow, rays.pass.tilt, projection, cutoff);
  }
  const int crossed = __syncthreads_count(counts.crossed != 0);
  const int blocked = __syncthreads_count(counts.blocked != 0);
  const int lost = __syncthreads_count(counts.lost != 0);
  const int bright = __syncthreads_count(counts.shaded != 0);
  const int saturated = __syncthreads_count(counts.saturated != 0);
  const std::int64_t steps = sumOverWarp(counts.steps);
  if (threadIdx.x == 0)
  {
    add(&sums.counts->crossed, crossed);
    add(&sums.counts->blocked, blocked);
    add(&sums.counts->lost, lost);
    add(&sums.counts->shaded, bright);
    add(&sums.counts->saturated, saturated);
  }
  if (threadIdx.x % 32 == 0)
  {
    add(&sums.counts->steps, steps);
  }
}

/// Adds the light that threads have emitted. All threads of a block come to its end.
template <int planes>
__device__ void addSums(const DeviceDeposit<planes>& deposit)
{
  for (int plane = 0; plane < planes; ++plane)
  {
    const std::int64_t emitted = sumOverWarp(deposit.all[plane].emitted);
    const std::int64_t outside = sumOverWarp(deposit.all[plane].outside);
    if (threadIdx.x % 32 == 0)
    {
      add(&deposit.sums.planes[plane].emitted, emitted);
      add(&deposit.sums.planes[plane].outside, outside);
    }
  }
}

/// Deposits the light of plain cells on the film. All threads of a block come to its end.
template <int planes, bool isOfPhase>
__global__ void depositKernel(const ShadedRays<planes> from, const Sums sums)
{
  const RaysOnDevice& rays = from.rays;
  std::int64_t i, j;
  rays.place(rays.firstRow, i, j);
  DeviceDeposit<planes> deposit{ sums };
  if (i + 1 < rays.columns && j < rays.endRow && j + 1 < rays.rows)
  {
    from.template useCell<isOfPhase>(i, j,
      [&](const auto& lowerLeft, const auto& lowerRight, const auto& upperLeft,
        const auto& upperRight, const auto&)
      {
        if (!DeviceSheet<planes, isOfPhase>(sums.film, deposit)
               .addPlain(lowerLeft, lowerRight, upperLeft, upperRight))
        {
          const unsigned n = atomicAdd(from.bent, 1u);
          from.bent[1 + n] = static_cast<unsigned>((j - rays.firstRow) * rays.columns + i);
        }
      });
  }
  addSums(deposit);
}

/// Deposits the light of single rays on the film. All threads of a block come to its end.
template <int planes>
__global__ void boxKernel(const ShadedRays<planes> from, const Sums sums)
{
  const RaysOnDevice& rays = from.rays;
  std::int64_t i, j;
  rays.place(rays.firstRow, i, j);
  DeviceDeposit<planes> deposit{ sums };
  if (i < rays.columns && j < rays.endRow)
  {
    RayBox<planes, DeviceDeposit<planes>, 1>(sums.film, deposit)
      .add(from.at(i, j), from.at(i - 1, j), from.at(i + 1, j), from.at(i, j - 1),
        from.at(i, j + 1), rays.pass.side);
  }
  addSums(deposit);
}

/// The light of other cells, a thread for each part of them. All threads of a block come to its end.
template <int planes, bool isOfPhase>
__global__ void bentKernel(const ShadedRays<planes> from, const Sums sums)
{
  constexpr unsigned parts = 4;
  const RaysOnDevice& rays = from.rays;
  DeviceDeposit<planes> deposit{ sums };
  for (unsigned n = blockIdx.x * blockDim.x + threadIdx.x; n < parts * from.bent[0];
       n += gridDim.x * blockDim.x)
  {
    const unsigned cell = from.bent[1 + n / parts];
    from.template useCell<isOfPhase>(cell % rays.columns, rays.firstRow + cell / rays.columns,
      [&](const auto& lowerLeft, const auto& lowerRight, const auto& upperLeft,
        const auto& upperRight, const auto& around)
      {
        DeviceSheet<planes, isOfPhase>(sums.film, deposit)
          .addOther(
            static_cast<int>(n % parts), lowerLeft, lowerRight, upperLeft, upperRight, around);
      });
  }
  addSums(deposit);
}

/// Writes what pixels' rays carry into arrays.
__global__ void centresKernel(
  const PixelRays* pixels, const std::int64_t count, const CentreArrays arrays)
{
  const std::int64_t pixel = blockIdx.x * static_cast<std::int64_t>(threadsPerBlock) + threadIdx.x;
  if (pixel < count)
  {
    arrays.set(pixel, pixels[pixel]);
  }
}

void fetch(void* to, const void* from, std::size_t bytes)
{
  checkCuda(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost), "Fetching the image");
}

template <bool isOfPhase, int planes>
void deposit(const ShadedRays<planes>& shaded, const Sums& sums)
{
  const unsigned blocks = shaded.rays.blocks(shaded.rays.endRow - shaded.rays.firstRow);
  if (!isOfPhase && shaded.rays.pass.side < 1)
  {
    launchKernel(boxKernel<planes>, blocks, threadsPerBlock, 0, nullptr, shaded, sums);
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
