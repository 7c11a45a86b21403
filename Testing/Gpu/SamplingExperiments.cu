// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// How the medium is best read on a GPU: the same rays through the same medium, with samples taken
//   plainly from rows of memory, as the tracer does,
//   from bricks of 4^3 or 8^3 samples (and from rows with 32-bit indices, which are bricks of one),
//   from a texture that returns single samples, and
//   from a texture that interpolates by itself, with weights of 8 bits,
// with the rays of a warp in a row or in a tile of 8 x 4 pixels. Prints steps per second, and the errors of
// the deflection against plain samples in double precision, relative to the largest deflection.
//
//   SamplingExperiments [points per axis = 256]
//
// There is no interpolated gather from 3-D textures (tex2Dgather is for planes), hence none here.
#include "Device/CudaBuffer.h"
#include "Device/DeviceError.h"
#include "Medium/Medium.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace schlieren
{

namespace
{

constexpr int threadsPerBlock = 128;
constexpr int pixels = 1024; // a side of the image

// Where a sample is looked for. Each sampler returns value and gradient at a position within [1, last - 1].

/// As the tracer does.
template <class Scheme, class Real>
struct Rows
{
  MediumView<Real> medium;

  __device__ Sample<Real> at(const Vec3<Real>& x) const { return interpolate<Scheme>(medium, x); }
};

/// The grid point that a scheme counts from, and its weights.
template <class Scheme>
struct Weights
{
  int base[3];
  float w[3][Scheme::points], d[3][Scheme::points];

  __host__ __device__ explicit Weights(const Vec3<float>& position)
  {
    const float x[3] = { position.x, position.y, position.z };
    for (int axis = 0; axis < 3; ++axis)
    {
      base[axis] = static_cast<int>(Scheme::nearest ? x[axis] + 0.5f : x[axis]);
      Scheme::weights(x[axis] - static_cast<float>(base[axis]), w[axis], d[axis]);
      base[axis] += 1 + Scheme::first; // 1: the ghost layer
    }
  }

  /// `sample(i, j, k)`: the one at base + (i, j, k).
  template <class Fetch>
  __host__ __device__ Sample<float> sum(const Fetch& sample) const
  {
    Sample<float> all{ 0, { 0, 0, 0 } };
    for (int k = 0; k < Scheme::points; ++k)
    {
      float value = 0, byX = 0, byY = 0;
      for (int j = 0; j < Scheme::points; ++j)
      {
        float rowValue = 0, rowByX = 0;
        for (int i = 0; i < Scheme::points; ++i)
        {
          const float s = sample(i, j, k);
          rowValue += w[0][i] * s;
          rowByX += d[0][i] * s;
        }
        value += w[1][j] * rowValue;
        byX += w[1][j] * rowByX;
        byY += d[1][j] * rowValue;
      }
      all.value += w[2][k] * value;
      all.gradient += Vec3<float>{ w[2][k] * byX, w[2][k] * byY, d[2][k] * value };
    }
    return all;
  }
};

/// Samples in cubes of `edge`^3, a power of two, cube by cube, x fastest in and among them. Where a sample
/// lies is a sum of three terms, one for each axis.
template <int edge>
struct BrickLayout
{
  std::uint32_t stride[3]; ///< from a brick to the next along each axis, in samples
  std::size_t size;        ///< of all bricks, in samples

  explicit BrickLayout(const std::int64_t (&samples)[3])
  {
    std::int64_t next = std::int64_t{ edge } * edge * edge;
    for (int axis = 0; axis < 3; ++axis)
    {
      stride[axis] = static_cast<std::uint32_t>(next);
      next *= (samples[axis] + edge - 1) / edge;
    }
    size = static_cast<std::size_t>(next);
  }

  __host__ __device__ std::uint32_t offset(int axis, std::uint32_t i) const
  {
    const std::uint32_t within = axis == 0 ? 1 : axis == 1 ? edge : edge * edge;
    return i / edge * stride[axis] + i % edge * within;
  }
};

template <class Scheme, int edge>
struct Bricks
{
  const float* samples;
  BrickLayout<edge> layout;

  __device__ Sample<float> at(const Vec3<float>& x) const
  {
    const Weights<Scheme> weights(x);
    std::uint32_t offsets[3][Scheme::points];
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int i = 0; i < Scheme::points; ++i)
      {
        offsets[axis][i] = layout.offset(axis, static_cast<std::uint32_t>(weights.base[axis] + i));
      }
    }
    return weights.sum(
      [&](int i, int j, int k) { return samples[offsets[0][i] + offsets[1][j] + offsets[2][k]]; });
  }
};

/// From a texture with point filtering: the texture units find the sample.
template <class Scheme>
struct PointTexture
{
  cudaTextureObject_t texture;

  __device__ Sample<float> at(const Vec3<float>& x) const
  {
    const Weights<Scheme> weights(x);
    const float base[3] = { static_cast<float>(weights.base[0]) + 0.5f,
      static_cast<float>(weights.base[1]) + 0.5f, static_cast<float>(weights.base[2]) + 0.5f };
    return weights.sum(
      [&](int i, int j, int k)
      {
        return tex3D<float>(texture, base[0] + static_cast<float>(i),
          base[1] + static_cast<float>(j), base[2] + static_cast<float>(k));
      });
  }
};

/// Value and gradient of a scheme from trilinear values of the samples: `linear(x, y, z)`, in index
/// coordinates.
template <class Scheme>
struct FromLinear;

/// Trilinear: the values on the faces of the cell around the position.
template <>
struct FromLinear<LinearInterpolation>
{
  template <class Linear>
  __host__ __device__ static Sample<float> at(const Vec3<float>& x, const Linear& linear)
  {
    const Vec3<float> low{ floorf(x.x), floorf(x.y), floorf(x.z) };
    const float left = linear(low.x, x.y, x.z);
    const float right = linear(low.x + 1, x.y, x.z);
    return { left + (x.x - low.x) * (right - left),
      { right - left, linear(x.x, low.y + 1, x.z) - linear(x.x, low.y, x.z),
        linear(x.x, x.y, low.z + 1) - linear(x.x, x.y, low.z) } };
  }
};

/// Quadratic: by de Boor's algorithm (de Boor 1972) the spline along one axis is (1 - t) a + t b and its
/// derivative 2 (b - a), where t = f + 1/2 and a, b are linear interpolations of the first two and of the
/// last two coefficients. So the 27 samples take 8 trilinear values (Sigg & Hadwiger 2005 have the values
/// of the cubic spline from as many).
template <>
struct FromLinear<QuadraticInterpolation>
{
  template <class Linear>
  __host__ __device__ static Sample<float> at(const Vec3<float>& position, const Linear& linear)
  {
    const float x[3] = { position.x, position.y, position.z };
    float t[3], at[3][2];
    for (int axis = 0; axis < 3; ++axis)
    {
      const float nearest = floorf(x[axis] + 0.5f);
      t[axis] = x[axis] - nearest + 0.5f;
      at[axis][0] = nearest - 0.5f + 0.5f * t[axis];
      at[axis][1] = nearest + 0.5f * t[axis];
    }
    Sample<float> all{ 0, { 0, 0, 0 } };
    for (int k = 0; k < 2; ++k)
    {
      float value[2], byX[2];
      for (int j = 0; j < 2; ++j)
      {
        const float a = linear(at[0][0], at[1][j], at[2][k]);
        const float b = linear(at[0][1], at[1][j], at[2][k]);
        value[j] = a + t[0] * (b - a);
        byX[j] = 2 * (b - a);
      }
      const float sign = k == 0 ? -2.f : 2.f;
      const float weight = k == 0 ? 1 - t[2] : t[2];
      const float middle = value[0] + t[1] * (value[1] - value[0]);
      all.value += weight * middle;
      all.gradient.x += weight * (byX[0] + t[1] * (byX[1] - byX[0]));
      all.gradient.y += weight * 2 * (value[1] - value[0]);
      all.gradient.z += sign * middle;
    }
    return all;
  }
};

/// From a texture that interpolates linearly.
template <class Scheme>
struct LinearTexture
{
  cudaTextureObject_t texture;

  __device__ Sample<float> at(const Vec3<float>& x) const
  {
    constexpr float toTexture = 1.5f; // past the ghost layer, to the centre of the sample
    return FromLinear<Scheme>::at(x,
      [&](float i, float j, float k)
      { return tex3D<float>(texture, i + toTexture, j + toTexture, k + toTexture); });
  }
};

/// Rays side by side through the middle of a cube of samples, all of the same length.
template <class Real>
struct Bundle
{
  Vec3<Real> corner, perColumn, perRow, perStep; ///< index coordinates
  int steps;
};

/// Which pixel a thread has, when every warp has a tile of width x height pixels.
template <int width, int height>
struct Tiles
{
  static_assert(width * height == 32 && threadsPerBlock % 32 == 0);
  __host__ __device__ static int column(int warp, int lane)
  {
    return warp % (pixels / width) * width + lane % width;
  }
  __host__ __device__ static int row(int warp, int lane)
  {
    return warp / (pixels / width) * height + lane / width;
  }
};

/// Leapfrog in index coordinates; every ray takes all of its steps.
template <class Order, class Sampler, class Real>
__global__ void marchKernel(
  const Sampler sampler, const Bundle<Real> bundle, Vec3<Real>* deflections)
{
  const int thread = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int column = Order::column(thread / 32, thread % 32);
  const int row = Order::row(thread / 32, thread % 32);
  const Vec3<Real> start = bundle.corner + static_cast<Real>(column) * bundle.perColumn +
    static_cast<Real>(row) * bundle.perRow;
  const Real half = static_cast<Real>(0.5);
  Vec3<Real> offset{ 0, 0, 0 }, q{ 0, 0, 0 };
  for (int step = 0; step < bundle.steps; ++step)
  {
    offset += half * q;
    const Sample<Real> sample =
      sampler.at(start + (static_cast<Real>(step) + half) * bundle.perStep + offset);
    q += (1 + sample.value) * sample.gradient;
    offset += half * q;
  }
  deflections[row * pixels + column] = q;
}

/// The image fits into the ball within the cube, with a tenth of its radius to spare for bent rays.
template <class Real>
Bundle<Real> bundleAlong(const Vec3<double>& direction, std::int64_t points)
{
  const double radius = 0.5 * static_cast<double>(points - 1);
  const Vec3<double> w = (1 / length(direction)) * direction;
  const Vec3<double> other =
    std::abs(w.x) < 0.9 ? Vec3<double>{ 1, 0, 0 } : Vec3<double>{ 0, 1, 0 };
  const Vec3<double> across = cross(w, other);
  const Vec3<double> u = (1 / length(across)) * across;
  const Vec3<double> v = cross(w, u);
  const double halfLength = 0.7 * radius;
  const double halfWidth = 0.4 * radius;
  const double perPixel = 2 * halfWidth / pixels;
  const Vec3<double> centre{ radius, radius, radius };
  return { static_cast<Vec3<Real>>(centre - halfLength * w - halfWidth * u - halfWidth * v),
    static_cast<Vec3<Real>>(perPixel * u), static_cast<Vec3<Real>>(perPixel * v),
    static_cast<Vec3<Real>>(w), static_cast<int>(2 * halfLength) };
}

/// The samples as a texture, freed with it.
class Texture
{
public:
  Texture(const PaddedVolume<float>& volume, cudaTextureFilterMode filter)
  {
    try
    {
      make(volume, filter);
    }
    catch (...)
    {
      free();
      throw;
    }
  }
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;
  ~Texture() { free(); }

  cudaTextureObject_t object() const { return object_; }

private:
  void make(const PaddedVolume<float>& volume, cudaTextureFilterMode filter)
  {
    const auto edge = [&volume](std::size_t axis)
    { return static_cast<std::size_t>(volume.dimensions[axis] + 2); };
    const cudaExtent extent = make_cudaExtent(edge(0), edge(1), edge(2));
    const cudaChannelFormatDesc format = cudaCreateChannelDesc<float>();
    checkCuda(cudaMalloc3DArray(&array_, &format, extent), "Allocating a texture");
    cudaMemcpy3DParms copy{};
    // The runtime does not write to the source of this copy.
    copy.srcPtr = make_cudaPitchedPtr(
      const_cast<float*>(volume.samples.data()), edge(0) * sizeof(float), edge(0), edge(1));
    copy.dstArray = array_;
    copy.extent = extent;
    copy.kind = cudaMemcpyHostToDevice;
    checkCuda(cudaMemcpy3D(&copy), "Filling a texture");

    cudaResourceDesc resource{};
    resource.resType = cudaResourceTypeArray;
    resource.res.array.array = array_;
    cudaTextureDesc description{};
    for (cudaTextureAddressMode& mode : description.addressMode)
    {
      mode = cudaAddressModeClamp;
    }
    description.filterMode = filter;
    description.readMode = cudaReadModeElementType;
    checkCuda(
      cudaCreateTextureObject(&object_, &resource, &description, nullptr), "Making a texture");
  }

  void free()
  {
    if (object_ != 0)
    {
      cudaDestroyTextureObject(object_);
    }
    cudaFreeArray(array_);
  }

  cudaArray_t array_ = nullptr;
  cudaTextureObject_t object_ = 0;
};

template <int edge>
std::vector<float> inBricks(const PaddedVolume<float>& volume, const BrickLayout<edge>& layout)
{
  std::vector<float> bricks(layout.size, 0.f);
  const auto edgeOf = [&volume](std::size_t axis)
  { return static_cast<std::uint32_t>(volume.dimensions[axis] + 2); };
  std::size_t next = 0;
  for (std::uint32_t k = 0; k < edgeOf(2); ++k)
  {
    for (std::uint32_t j = 0; j < edgeOf(1); ++j)
    {
      const std::uint32_t row = layout.offset(1, j) + layout.offset(2, k);
      for (std::uint32_t i = 0; i < edgeOf(0); ++i)
      {
        bricks[row + layout.offset(0, i)] = volume.samples[next++];
      }
    }
  }
  return bricks;
}

struct March
{
  double seconds; ///< of the fastest of a few
  std::vector<Vec3<double>> deflections;
};

template <class Order, class Sampler, class Real>
March march(const Sampler& sampler, const Bundle<Real>& bundle)
{
  constexpr std::size_t rays = std::size_t{ pixels } * pixels;
  constexpr unsigned blocks = rays / threadsPerBlock;
  const CudaBuffer<Vec3<Real>> deflections(rays);
  cudaEvent_t begin{}, end{};
  checkCuda(cudaEventCreate(&begin), "Making an event");
  checkCuda(cudaEventCreate(&end), "Making an event");
  float fastest = INFINITY;
  constexpr int repetitions = 6;
  for (int n = 0; n < repetitions; ++n)
  {
    checkCuda(cudaEventRecord(begin), "Recording an event");
    marchKernel<Order><<<blocks, threadsPerBlock>>>(sampler, bundle, deflections.data());
    checkCuda(cudaGetLastError(), "Starting a kernel");
    checkCuda(cudaEventRecord(end), "Recording an event");
    checkCuda(cudaEventSynchronize(end), "Marching");
    float milliseconds = 0;
    checkCuda(cudaEventElapsedTime(&milliseconds, begin, end), "Timing");
    fastest = std::min(fastest, milliseconds);
  }
  cudaEventDestroy(begin);
  cudaEventDestroy(end);

  std::vector<Vec3<Real>> onHost(rays);
  checkCuda(cudaMemcpy(
              onHost.data(), deflections.data(), rays * sizeof(Vec3<Real>), cudaMemcpyDeviceToHost),
    "Copying deflections");
  March all{ 1e-3 * static_cast<double>(fastest), {} };
  all.deflections.reserve(rays);
  for (const Vec3<Real>& q : onHost)
  {
    all.deflections.push_back(static_cast<Vec3<double>>(q));
  }
  return all;
}

/// Relative to the largest deflection. Where the gradient jumps from cell to cell, single rays differ by
/// the jump, because rounding puts a step into the one or the other.
struct Differences
{
  double rms = 0, worst = 0;

  /// The larger ones.
  void include(const Differences& other)
  {
    rms = std::fmax(rms, other.rms);
    worst = std::fmax(worst, other.worst);
  }
};

Differences differences(
  const std::vector<Vec3<double>>& some, const std::vector<Vec3<double>>& truth)
{
  double most = 0, worst = 0, squares = 0;
  for (std::size_t ray = 0; ray < truth.size(); ++ray)
  {
    const double difference = length(some[ray] - truth[ray]);
    worst = std::fmax(worst, difference);
    squares += difference * difference;
    most = std::fmax(most, length(truth[ray]));
  }
  return { std::sqrt(squares / static_cast<double>(truth.size())) / most, worst / most };
}

/// A wavy blob, so weak that rays stay where they are looked for.
struct Blob
{
  explicit Blob(std::int64_t points)
  {
    field.grid.dimensions = { points, points, points };
    field.ambient = 0;
    samples.reserve(static_cast<std::size_t>(points * points * points));
    const auto coordinate = [points](std::int64_t i)
    { return 2 * static_cast<double>(i) / static_cast<double>(points - 1) - 1; };
    for (std::int64_t k = 0; k < points; ++k)
    {
      for (std::int64_t j = 0; j < points; ++j)
      {
        for (std::int64_t i = 0; i < points; ++i)
        {
          const double x = coordinate(i), y = coordinate(j), z = coordinate(k);
          samples.push_back(static_cast<float>(3e-4 * std::exp(-4 * (x * x + y * y + z * z)) *
            (1 + 0.3 * std::sin(12 * x + 7 * y) * std::cos(9 * z))));
        }
      }
    }
    field.singles = samples.data();
  }

  Field field;
  std::vector<float> samples;
};

struct View
{
  const char* name;
  Vec3<double> direction;
};
const View views[] = { { "along x", { 1, 0.01, 0.02 } }, { "along z", { 0.01, 0.02, 1 } },
  { "aslant", { 0.64, 0.6, 0.48 } } };

template <class Scheme>
struct Experiment
{
  Interpolation interpolation;
  const char* name;
  const Blob& blob;

  void run() const
  {
    const Medium<float> medium = buildMedium<float>(blob.field, interpolation, 0);
    const PaddedVolume<float>& volume = medium.volume;
    const std::int64_t samples[3] = { volume.dimensions[0] + 2, volume.dimensions[1] + 2,
      volume.dimensions[2] + 2 };

    const CudaBuffer<float> rows(
      volume.samples.data(), volume.samples.size(), "Copying the samples");
    MediumView<float> view = medium.view();
    view.samples = rows.data();
    each("rows", Rows<Scheme, float>{ view });
    each("rows, 32-bit indices", Bricks<Scheme, 1>{ rows.data(), BrickLayout<1>(samples) });
    inBricksOf<4>(volume, samples);
    inBricksOf<8>(volume, samples);
    {
      const Texture texture(volume, cudaFilterModePoint);
      each("texture, single samples", PointTexture<Scheme>{ texture.object() });
    }
    {
      const Texture texture(volume, cudaFilterModeLinear);
      each("texture that interpolates", LinearTexture<Scheme>{ texture.object() });
    }
  }

  template <int edge>
  void inBricksOf(const PaddedVolume<float>& volume, const std::int64_t (&samples)[3]) const
  {
    const BrickLayout<edge> layout(samples);
    const std::vector<float> bricks = inBricks(volume, layout);
    const CudaBuffer<float> onDevice(bricks.data(), bricks.size(), "Copying the bricks");
    each(
      "bricks of " + std::to_string(edge) + "^3", Bricks<Scheme, edge>{ onDevice.data(), layout });
  }

  template <class Sampler>
  void each(const std::string& how, const Sampler& sampler) const
  {
    report<Tiles<32, 1>>(how + ", warp 32 x 1", sampler);
    report<Tiles<8, 4>>(how + ", warp 8 x 4", sampler);
  }

  template <class Order, class Sampler>
  void report(const std::string& how, const Sampler& sampler) const
  {
    std::printf("%-10s %-42s", name, how.c_str());
    Differences errors;
    for (std::size_t n = 0; n < std::size(views); ++n)
    {
      const Bundle<float> bundle =
        bundleAlong<float>(views[n].direction, blob.field.grid.dimensions[0]);
      const March marched = march<Order>(sampler, bundle);
      const double steps = static_cast<double>(pixels) * pixels * bundle.steps;
      std::printf(" %12.3g", steps / marched.seconds);
      errors.include(differences(marched.deflections, truth[n]));
    }
    std::printf(" %8.1e %8.1e\n", errors.rms, errors.worst);
    std::fflush(stdout);
  }

  /// The deflections of each view, in double precision.
  std::vector<std::vector<Vec3<double>>> truth = findTruth();

  std::vector<std::vector<Vec3<double>>> findTruth() const
  {
    const Medium<double> medium = buildMedium<double>(blob.field, interpolation, 0);
    const CudaBuffer<double> rows(
      medium.volume.samples.data(), medium.volume.samples.size(), "Copying the medium");
    MediumView<double> view = medium.view();
    view.samples = rows.data();
    std::vector<std::vector<Vec3<double>>> all;
    for (const View& one : views)
    {
      all.push_back(march<Tiles<8, 4>>(Rows<Scheme, double>{ view },
        bundleAlong<double>(one.direction, blob.field.grid.dimensions[0]))
                      .deflections);
    }
    return all;
  }
};

void run(std::int64_t points)
{
  std::printf("%d^2 rays through %lld^3 points\n", pixels, static_cast<long long>(points));
  std::printf("%-10s %-42s", "scheme", "samples");
  for (const View& view : views)
  {
    std::printf(" %12s", view.name);
  }
  std::printf(" %8s %8s   (steps/s; errors)\n", "rms", "worst");
  const Blob blob(points);
  Experiment<LinearInterpolation>{ Interpolation::Linear, "Linear", blob }.run();
  Experiment<QuadraticInterpolation>{ Interpolation::Quadratic, "Quadratic", blob }.run();
}

} // namespace

} // namespace schlieren

int main(int argc, char** argv)
{
  const long points = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 256;
  if (points < 16 || points > 1024)
  {
    std::fprintf(stderr, "Give the points per axis, 16 to 1024.\n");
    return 2;
  }
  try
  {
    schlieren::run(points);
  }
  catch (const std::exception& failure)
  {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
  return 0;
}
