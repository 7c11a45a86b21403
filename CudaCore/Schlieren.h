// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The one public header of the tracer: a Field and a Scene in, an Image out. It brings the index models
// with it, which make a Field's refractivity from the states of gases.
//
// Vectors are in data coordinates. The image's axes are u (right), v (up) and w, the direction the
// light travels in, towards the viewer: w = -viewDirection, u = viewDirection x viewUp, v = u x
// viewDirection, all of unit length. A point x lands at the image coordinates (x.u, x.v).
#pragma once

#include "Film/PixelArray.h"
#include "Medium/Index/IndexModels.h"
#include "Medium/Samples/MediumSource.h"
#include "Optics/Techniques.h"
#include "Rays/Ranks/Processes.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
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
  Linear,    ///< trilinear: 8 loads, gradient jumps from cell to cell (for drafts)
  Central,   ///< trilinear values, trilinear central differences as gradient: the paper's, 32 loads
  Cubic      ///< cubic B-spline: 64 loads, continuous second derivatives, fourth-order values
};

enum class PathModel
{
  Auto,     ///< Straight where its error is proven to be below Scene::pathTolerance, else Refracted
  Straight, ///< line of sight: the medium is looked at along the undisturbed ray
  Refracted ///< the ray bends
};

/// How a refracted ray takes its steps. A straight one always looks at their midpoints. Where the index changes by more
/// than a twentieth in a step, as at faces of glass, steps are adaptive but with Euler.
enum class Integrator
{
  Leapfrog, ///< one gradient a step, second order, symplectic
  Rk4,      ///< four gradients a step, fourth order
  Adaptive, ///< four gradients a step, third order; steps are as long as Scene::adaptiveTolerance allows
  Euler ///< one gradient a step, first order: the paper's, kept so that it can be reproduced
};

enum class Precision
{
  Single,
  Double
};

/// What light enters where it leaves the data: see ExitFaces.
enum class ExitInto
{
  /// Air where the surroundings are a liquid (more than leastOfLiquids); the surroundings, through a face, where something
  /// in the data is one; else as Surroundings.
  Auto,
  Surroundings, ///< without a face: the direction is that in the data
  Air,
  Custom ///< Scene::exitRefractivity
};

/// n - 1 of air at 20 degrees Celsius and 101325 Pa, dry, at 633 nm (Ciddor 1996).
constexpr double airRefractivity = 2.718e-4;

/// No gas has as much of n - 1, and few liquids less: liquid hydrogen 0.11, water 0.33.
constexpr double leastOfLiquids = 0.1;

enum class Device
{
  Auto, ///< CUDA where a device answers, else the CPU
  Cpu,
  Cuda ///< an error where no device answers
};

/// Red, green and blue, row by row, bottom row first; sRGB.
struct RgbImage
{
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb; ///< 3 for each pixel
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
  /// From a point source to the middle of the data, data units: more than half the depth. Unset: collimated. With a
  /// perspective the source is in the pupil, whatever this is. The source is where light leaves the data into.
  std::optional<double> distance;
  SourceShape shape = SourceShape::Point;
  /// Of a slit, across the knife edge; diameter of a disc.
  double width = 0;
  double length = 0; ///< of a slit, along the knife edge
};

/// Of an interferogram. The reference beam crosses the light at an angle beta where fringes are finite: their
/// spacing is wavelength / (2 sin(beta / 2)).
struct Fringes
{
  bool finite = false;
  double spacing = 0; ///< data units on the film, positive; of finite fringes
  double angle = 0;   ///< degrees: direction in which the carrier's phase grows, from u to v
  bool whiteLight =
    false; ///< all wavelengths of equal energy, seen as the CIE's standard observer does
  /// N at a wavelength (metres) by N at Scene::wavelength; of white light. Unset: 1.
  std::function<double(double wavelength)> dispersion;
};

enum class PatternKind
{
  Dots,
  Stripes,
  Image
};

/// What is behind the flow for Cutoff::Background.
struct BackgroundPattern
{
  PatternKind kind = PatternKind::Dots;
  std::optional<double> distance; ///< from where the data begins, away from the viewer, in what
                                  ///< light leaves them into; unset: one depth
  /// Of stripes, and of the cells that have a dot each: data units of the image; 0: eight pixels. What is finer than four
  /// pixels fades to grey, and is gone at two.
  double period = 0;
  double angle = 0; ///< of stripes, degrees: direction across them, from u to v
  std::shared_ptr<const RgbImage> image; ///< stretched over what the camera sees
};

/// How rays become an image.
enum class FilmEstimator
{
  Sheet, ///< the quadrilaterals between neighbouring rays carry the light, folds added up
  Photon ///< each ray's light is shared by the four pixels around where it lands
};

enum class NoiseFilter
{
  None,
  Gaussian, ///< standard deviation: half the radius
  Mean,     ///< over a disc
  Cone ///< Jensen 1996: a cone that encloses as many samples as the radius does of one per pixel
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

/// The gradients of the fields by whose colours an image is to be tinted; nothing by default. The array
/// belongs to the caller, as those of Field do. Where Field has a source, it is the source that knows the fields:
/// `count` of them, and `values` is null.
struct FieldGradients
{
  int count = 0; ///< fields
  /// |grad f| of each field, `count` values for each point of the grid, in units of 1 / smallest spacing
  /// (see gradientMagnitudes).
  const float* values = nullptr;
  std::uint64_t version = 0; ///< the same version, the same data
};

/// Of Field::valid: light passes a place that has no data.
constexpr unsigned char transparent = 2;

/// Refractivity N = n - 1. On a grid, x fastest: the arrays belong to the caller and are read during Bench::render
/// only; exactly one of the two sample pointers is set. Or of a source, which is queried as finely as the view and
/// Scene::mediumTolerance want it: then `grid` is coarsestGrid() of the source, and there are no arrays.
struct Field
{
  Grid grid;
  std::shared_ptr<const MediumSource> source;
  const float* singles = nullptr;
  const double* doubles = nullptr;
  /// Of the samples, which hold N less this. Near the surroundings' N it leaves single precision the digits of a weak
  /// flow. Not of a source.
  double offset = 0;
  /// 0: solid, blocks light. 1: gas (solid where the sample is not finite). 2 (transparent): no data, but
  /// light passes; the sample is not read, the gas around is continued. Null: 1 everywhere.
  const unsigned char* valid = nullptr;
  std::optional<double> ambient; ///< N outside; unset: the median over the domain's boundary
  double lengthScale = 1;        ///< metres per data unit
  FieldGradients gradients;      ///< of the fields that Scene::fieldColors belong to
  /// Changes whenever anything that the arrays hold has changed: the same version, the same data.
  std::uint64_t version = 0;
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

/// Everything about the bench that is not the medium.
struct Scene
{
  View view;

  Cutoff cutoff = Cutoff::KnifeEdge;
  double knifeEdgeAngle = 0;    ///< degrees; 0 measures the deflection along u, 90 along v
  double cutoffOffset = 0;      ///< how far the edge is in, as a fraction of the source's image
  bool invertCutoff = false;    ///< I becomes 1 - I (knife edge and graded filter)
  std::optional<double> kScale; ///< k = f/a; unset: 99th percentile of |eps| is full scale, about
  /// Transmission at evenly spaced places from 0 to 1, linear in between; at least 2.
  std::vector<double> gradedFilter{ 0, 1 };
  std::shared_ptr<const RgbImage> colorFilter; ///< from k eps = (-1, -1) to (1, 1); null: the wheel
  double wavelength = 632.8e-9;                ///< of an interferogram, metres
  Fringes fringes;
  BackgroundPattern background;
  /// From where light leaves the data to the screen, data units, in what light leaves them into; unset: one data depth.
  std::optional<double> screenDistance;
  /// Of the plane in focus from the data's middle (with a perspective from the focal point) along w, data units.
  double focusOffset = 0;

  LightSource source;

  ExitInto exitInto = ExitInto::Surroundings;
  double exitRefractivity = airRefractivity; ///< n - 1, of ExitInto::Custom

  /// Red, green and blue, 0 ... 1, of each of Field::gradients.
  std::vector<std::array<float, 3>> fieldColors;

  FilmEstimator filmEstimator = FilmEstimator::Sheet;
  NoiseFilter noiseFilter = NoiseFilter::None;
  double noiseFilterRadius = 2; ///< pixels
  int histogramSize = 0;        ///< bins along each axis of Image::histogram; 0: none
  int samplesPerPixel = 4;
  std::uint32_t seed = 1;

  PathModel pathModel = PathModel::Auto;
  Integrator integrator = Integrator::Leapfrog;
  Interpolation interpolation = Interpolation::Quadratic;
  Precision precision = Precision::Single;
  /// Voxels, 0.001 ... 16: length of one step in index space; of Integrator::Adaptive the longest. Where
  /// there are solids, no longer than 1.
  double stepSize = 1;
  /// Of Integrator::Adaptive: the local error allowed in a step, relative to what the medium's steepest
  /// gradient would bend over the same length. 1e-12 ... 1.
  double adaptiveTolerance = 1e-5;
  /// Rays cross a cube of cells in one step where the refractivity varies in it by no more than this, as a
  /// fraction of its range in the whole medium; 0: never. 0 ... 1.
  double homogeneityTolerance = 0;
  /// Error of the deflection, of the largest one, that the voxels of a Field's source may make, and of what rays gather
  /// of its fields, of the full colour; 0: they are as fine as the data. 0 ... 1.
  double mediumTolerance = 0.01;
  /// Bytes that the voxels of a Field's source may take. Where they do not do, the tolerance is not met:
  /// see Image::medium.
  std::size_t mediumMemory = std::size_t{ 1 } << 30;
  /// How far, in pixels, a straight ray may be from the refracted one for PathModel::Auto to take it.
  double pathTolerance = 0.01;
  Device device = Device::Auto;
  int threads = 0; ///< CPU threads; 0: all cores this process may use
  /// Bytes of rays that are cached for re-shading. The image does not depend on it.
  std::size_t memoryBudget = std::size_t{ 1 } << 30;
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
  /// Of the deflection of a ray of the last view, of the largest one, or of what it gathers of fields, of the full
  /// colour: the largest sum of what the leaves along a ray lack, as far as finer voxels would mend it. Voxels of the size
  /// of cells, or as fine as the view needs, lack nothing.
  double estimatedError = 0;
  double deflectionError = 0; ///< the same of deflections alone, not divided by the largest one
  bool isMemoryShort = false; ///< for what the tolerance needs
};

/// The image and what is known about it. Arrays are row-major, bottom row first.
struct Image
{
  int width = 0;
  int height = 0;
  Frame frame;

  PixelArray<float> intensity;  ///< per pixel; undisturbed: see Cutoff; luminance of a colour
  PixelArray<float> color;      ///< 3 per pixel, linear; empty where nothing colours
  PixelArray<float> background; ///< per pixel, of Cutoff::Background: the same without the flow
  /// 2 per pixel, data units, likewise: the place of the pattern that is seen, less the one seen without the
  /// flow. What is seen has moved the other way.
  PixelArray<float> backgroundDisplacement;
  /// 2 per pixel: direction cosines along u and v, in what light leaves the data into. This and the next two are those of
  /// the ray through the pixel's centre, from the middle of the light source; where that ends in a solid, the mean of
  /// the pixel's rays that do not.
  PixelArray<float> deflection;
  PixelArray<double> opticalPathDifference; ///< per pixel, metres, against undisturbed light
  /// 2 per pixel: at the exit plane, data units; with a perspective, and of Cutoff::Background, where rays go from the
  /// camera on, at the entry plane.
  PixelArray<float> displacement;
  PixelArray<float> blockedFraction; ///< per pixel: fraction of rays that a solid stopped

  Device device = Device::Cpu; ///< where the rays were traced
  int threads = 0;             ///< on the CPU
  int processes = 1;           ///< that traced rays
  std::string deviceNote;      ///< why Device::Auto left a device that answers; else empty
  PathModel pathModel = PathModel::Refracted;   ///< the one used: Straight or Refracted
  Integrator integrator = Integrator::Leapfrog; ///< the one used
  double kScale = 0;                            ///< the k used; 0 where there is no cutoff
  double undisturbedLevel = 1;                  ///< intensity of light that nothing bends
  /// Of the rays that start in the image and reach the film: cut off at the darkest or brightest light.
  double saturatedFraction = 0;
  LightBalance light;
  Histogram histogram;
  double ambient = 0;            ///< the ambient refractivity used
  double exitRefractivity = 0;   ///< of what light leaves the data into
  std::int64_t raysTraced = 0;   ///< rays of this image that crossed the grid
  std::int64_t stepsTaken = 0;   ///< integration steps of these rays
  std::int64_t raysBlocked = 0;  ///< rays that a solid stopped
  std::int64_t raysLost = 0;     ///< rays trapped in the medium (step limit) or turned back by it
  double traceSeconds = 0;       ///< spent tracing for it; 0 when cached rays were re-shaded
  double displacementBound = 0;  ///< no ray of this image is displaced further, data units
  double displacementWithin = 0; ///< the same up to where the medium bends it for the last time
  /// Skipping homogeneous cubes changes no deflection cosine by more than this, but for what the ray meets
  /// because it is elsewhere then, which is of second order.
  double skippingBound = 0;
  /// Worst | |p| / n - 1 | of refracted rays where they leave the grid: 0 for exact ones, so that it shows
  /// the error of steps and interpolation.
  double momentumDrift = 0;
  double steepestChange = 0; ///< of the index, by that of the surroundings, over one voxel
  Vector steepestPlace{};    ///< about where that is, data units
  MediumStatistics medium;   ///< of a Field's source
  bool aborted = false;      ///< the monitor stopped it; all arrays are empty

  /// False where the monitor has paused it, and Bench::resume continues it. The arrays then hold the image of
  /// the samples so far (the histogram may know of more), or are empty where this call has completed none.
  bool finished = true;
  int samples = 0; ///< per pixel, that the image is of
};

/// How far a render has come, and whether to stop. All are called by the calling thread only.
struct Monitor
{
  std::function<void(double fraction)> progress;
  std::function<bool()> aborted;  ///< gives the image up
  std::function<bool()> paused{}; ///< leaves the rest of it for Bench::resume
};

/// What a Bench has done so far: lets a caller (and the tests) see that nothing is done twice.
struct Work
{
  std::int64_t mediumBuilds = 0; ///< not those that another Bench has made
  std::int64_t raySets =
    0; ///< how often rays had to be traced anew: for another view, another medium
  std::int64_t raysTraced = 0;
};

/// Lets benches have one medium together where it is that of the same samples (or source), version, ambient
/// refractivity, interpolation, precision, tolerance and memory. It is there as long as one of them uses it, and of a
/// source it has the voxels of all their views. Where these do not fit in Scene::mediumMemory, or another bench is at
/// work in the medium (which calls this one from its monitor, or is used by another thread), a bench makes its own.
class SharedMedia
{
public:
  SharedMedia();
  ~SharedMedia();
  SharedMedia(const SharedMedia&) = delete;
  SharedMedia& operator=(const SharedMedia&) = delete;

  int count() const; ///< media that are there now

private:
  friend class Bench;
  struct Entries;
  std::unique_ptr<Entries> entries_;
};

/// Runs the stages in order and keeps their results until something upstream of them changes.
/// Not thread-safe: one Bench is used by one thread at a time.
class Bench
{
public:
  Bench();
  ~Bench();
  Bench(Bench&&) noexcept;
  Bench& operator=(Bench&&) noexcept;

  /// The image of `field` on the bench `scene`. Throws Error.
  Image render(const Field& field, const Scene& scene, const Monitor& monitor = {});

  /// Resumes the image that the monitor paused in the last call, which any other call cancels: the
  /// same image, to the last bit, that render would have made without a pause. Each call makes some progress,
  /// however soon it is paused again: what is not cut into pieces is the medium, a pass on the GPU, and the
  /// development of an image. What Field::gradients points to must still be there. Throws Error.
  Image resume(const Monitor& monitor = {});
  bool isUnfinished() const;
  void cancel(); ///< forgets it

  /// Other processes that trace rays for the next images, each with a RayWorker; null: there are none. The images are the
  /// same to the last bit.
  void setProcesses(Processes* processes);

  /// From the next medium on, it is one of these. Field::version then has to differ between any two fields that benches
  /// are given, whatever their arrays' addresses.
  void setMedia(std::shared_ptr<SharedMedia> media);

  const Work& work() const;

private:
  struct Unfinished;
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

/// The grid that a source is divided into at first: it covers its bounds. Throws Error where these are no box.
Grid coarsestGrid(const MediumSource& source);

/// The image plane of a view of a grid. Throws Error where the view is degenerate.
Frame frameOf(const Grid& grid, const View& view);

/// Writes the gradient of one of `count` fields into what will be FieldGradients::values: its length at
/// each point from central differences, or one-sided ones next to the grid's faces and to points where
/// `valid` (may be null) is 0 or the value is not finite; 0 at such points.
void gradientMagnitudes(const Grid& grid, const float* values, const unsigned char* valid,
  int threads, int count, int field, float* gradients);

/// The cores that this process may use: not the whole machine's where it is bound to some (taskset, a batch system)
/// or has a quota (a container).
int coresOfProcess();

/// Whether a CUDA device answers, which images are then made on in this thread: the one that SCHLIEREN_CUDA_DEVICE in the
/// environment numbers, else one for each rank of a machine in turn. When none does, `reason` (if given) says why. Throws
/// Error where there is no device of that number.
bool cudaAvailable(std::string* reason = nullptr);

} // namespace schlieren
