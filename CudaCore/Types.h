// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The ground that all folders stand on: vectors, errors, enumerations, and small values that pass through several stages.
//
// Vectors are in data coordinates. The image's axes are u (right), v (up) and w, the direction the
// light travels in, towards the viewer: w = -viewDirection, u = viewDirection x viewUp, v = u x
// viewDirection, all of unit length. A point x lands at the image coordinates (x.u, x.v).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

namespace schlieren
{

using Vector = std::array<double, 3>;

/// A mistake in what the caller requested. what() is written for the user: problem, why, what to do.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

enum class Interpolation
{
  Quadratic, ///< quadratic B-spline: 27 loads, continuous gradient, third-order values
  Cubic      ///< cubic B-spline: 64 loads, continuous second derivatives, fourth-order values
};

enum class PathModel
{
  Straight, ///< line of sight: the medium is looked at along the undisturbed ray
  Refracted ///< the ray bends
};

/// Chooses how a refracted ray takes its steps. A straight one always looks at their midpoints. Where the index changes
/// by more than a twentieth in a step, as at faces of glass, steps are adaptive.
enum class Integrator
{
  Leapfrog, ///< one gradient a step, second order, symplectic
  Adaptive ///< four gradients a step, third order; steps are as long as Scene::adaptiveTolerance allows
};

enum class Precision
{
  Single,
  Double
};

enum class Device
{
  Auto, ///< CUDA where a device answers, else the CPU
  Cpu,
  Cuda ///< an error where no device answers
};

enum class SourceShape
{
  Point,
  Slit, ///< a rectangle along the knife edge
  Disc
};

/// Where light comes from; sizes in radians, seen from the data. An extended source blurs what is not in focus,
/// and the fraction of its image that a knife edge lets pass follows from its shape.
struct LightSource
{
  /// Distance of a point source from the middle of the data, data units: more than half the depth. Unset: collimated.
  /// With a perspective the source is in the pupil, whatever this is. The source is where light leaves the data into.
  std::optional<double> distance;
  SourceShape shape = SourceShape::Point;
  /// Width of a slit across the knife edge, or diameter of a disc.
  double width = 0;
  double length = 0; ///< of a slit, along the knife edge
};

/// How light continues behind the flow.
enum class LightModel
{
  Rays, ///< straight: incoherent light
  Waves ///< diffracted: laser light, see WaveReport
};

/// A regular grid of sample points. Point (i, j, k) lies at origin + direction (i hx, j hy, k hz).
struct Grid
{
  std::array<std::int64_t, 3> dimensions{ 0, 0, 0 }; ///< points along each axis, at least 2
  Vector origin{ 0, 0, 0 };                          ///< data units
  Vector spacing{ 1, 1, 1 };                         ///< data units, positive
  /// Rotation from grid axes to data coordinates, row-major (as in vtkImageData).
  std::array<double, 9> direction{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
};

/// A camera, as vtkCamera describes it, and its image. With a perspective, the light is that of a point source in the
/// camera's pupil: it diverges from there through the flow to the film behind it, as in the shadowgraph with a
/// retroreflecting screen (Edgerton 1958). Light that takes these paths into the pupil is bent by the same angles.
struct View
{
  Vector viewDirection{ 0, 0, -1 };
  Vector viewUp{ 0, 1, 0 };
  std::optional<Vector> focalPoint; ///< unset: centre of the grid
  /// Half height of the image in the plane of the focal point, data units; 0: fit the grid.
  double parallelScale = 0;
  /// Between the lower and upper side of the image seen from the pupil, degrees, less than 170; 0: orthographic, as
  /// always where the grid has a single layer of cells (2-D data).
  double viewAngle = 0;
  int width = 512;  ///< pixels
  int height = 512; ///< pixels
};

/// Where the image of a view lies. u, v, w as above; half-open pixels, centres at origin + i size.
struct Frame
{
  Vector u, v, w;
  std::array<double, 2> origin{ 0, 0 }; ///< image coordinates of the centre of pixel (0, 0)
  double pixelSize = 1;                 ///< data units
  double entry = 0, exit = 0;           ///< the grid's extent along w: x.w of both ends, data units
  double pupil =
    0; ///< distance from the plane of the focal point along w, data units; 0: orthographic
  double focus = 0; ///< x.w of the focal point; 0 where there is no pupil
};

/// How far a render has come, and whether to stop. All are called by the calling thread only.
struct Monitor
{
  std::function<void(double fraction)> progress;
  std::function<bool()> aborted;  ///< gives the image up
  std::function<bool()> paused{}; ///< leaves the rest of it for Bench::resume
};

/// Where light meets the cutoff plane: how many rays of the image came there, by their deflection.
struct Histogram
{
  int size = 0;                   ///< bins along u and along v
  double range = 0;               ///< the bins cover -range ... range of both direction cosines
  std::vector<std::int64_t> rays; ///< of each bin; u runs fastest
};

/// Where light went, in rays of full light for each pixel and sample: emitted = onFilm + outside.
struct LightBalance
{
  double emitted = 0; ///< by rays that reach the film's plane, after the cutoff
  double onFilm = 0;
  double outside = 0; ///< of the image
};

/// How an image's light continues behind the flow as waves. Metres.
struct WaveReport
{
  double fresnelWidth =
    0; ///< sqrt(wavelength distance): how far waves carry light aside on their way; 0: not known
  double blur = 0; ///< width of a pixel and of the source's image on the screen, added as squares
  double plane =
    0; ///< on which light seems to be bent: its distance before where light leaves the data
  double leastTubeRatio = 1; ///< least ratio of the areas between rays there and where they start
  std::int64_t pointsPerPixel = 0;    ///< along each axis; 0: there is no wave
  std::int64_t columns = 0, rows = 0; ///< of points, with what is around the image
  std::int64_t raysPerPixel = 0;      ///< along each axis
};

/// A pixel's and source's blur by the Fresnel width from which on diffraction does not show: rays are right then.
constexpr double blurThatHidesWaves = 4;

/// What the medium of a Field's source consists of.
struct MediumStatistics
{
  int coarsestLevel = 0,
      finestLevel = 0;     ///< of leaves with voxels; those of the next level are half as large
  std::int64_t bricks = 0; ///< leaves with voxels
  std::int64_t constantLeaves = 0;
  std::int64_t voxels = 0;
  std::int64_t bytes = 0;
  double smallestVoxel = 0;     ///< data units, along the axis where it is smallest
  double largestDeflection = 0; ///< of straight rays of the last view
  /// Error that 99 % of the deflections of the last view keep, as third differences say. Voxels of the size of cells lack
  /// nothing.
  double deflectionError = 0;
  bool isMemoryShort = false; ///< for what the tolerance needs
};

} // namespace schlieren
