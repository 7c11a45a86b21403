// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The roof, and the only header that others include: Bench takes a Field and a Scene and returns an Image. It exports
// what others need of the rooms below: MediumSource for data that are no regular grid, the index models, bodies in
// samples, ranks that trace rays and make bricks, the cutoffs' formulas.
#pragma once

#include "Device/Cores.h"
#include "Device/CudaDevice.h"
#include "Device/Parallel.h"
#include "Film/Image.h"
#include "Medium/Index/IndexModels.h"
#include "Medium/Samples/Ambient.h"
#include "Medium/Samples/Field.h"
#include "Medium/Samples/MediumSource.h"
#include "Medium/Samples/Prefilter.h"
#include "Medium/Samples/Solids.h"
#include "Medium/Tree/BrickMakers.h"
#include "Medium/Tree/RootCells.h"
#include "Optics/BrightField.h"
#include "Optics/KnifeEdge.h"
#include "Optics/NumericalSchlieren.h"
#include "Optics/Techniques.h"
#include "Rays/Light.h"
#include "Rays/Ranks/Processes.h"
#include "Rays/Ranks/RayWorker.h"
#include "Types.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace schlieren
{

/// Returns the version of the project, such as "0.1.0".
const char* version();

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

/// Red, green and blue, row by row, bottom row first; sRGB.
struct RgbImage
{
  int width = 0;                  ///< columns
  int height = 0;                 ///< rows
  std::vector<unsigned char> rgb; ///< 3 for each pixel
};

/// Fringes of an interferogram. The reference beam crosses the light at an angle beta where fringes are finite: their
/// spacing is wavelength / (2 sin(beta / 2)).
struct Fringes
{
  bool finite = false; ///< else undisturbed light has no fringes
  double spacing = 0;  ///< data units on the film, positive; of finite fringes
  double angle = 0;    ///< degrees: direction in which the carrier's phase grows, from u to v
};

/// A disc in the plane where undisturbed light is a point, which delays and weakens what meets it (Zernike 1942).
struct PhasePlate
{
  double diameter =
    0; ///< by the focal length, radians; 0: the undisturbed light of each point of the source alone
  double delay =
    0.25; ///< waves: of 1/4 the light is 1 + 2 phi of a small phase phi, of -1/4 it is 1 - 2 phi
  double transmission = 1; ///< of light, 0 ... 1; 0: an opaque stop
};

enum class PatternKind
{
  Dots,
  Stripes,
  Image
};

/// What is behind the flow for Cutoff::Background. Dots and stripes stand in the world: a corner of dots' cells and the middle
/// of a bright stripe are where u = v = 0.
struct BackgroundPattern
{
  PatternKind kind = PatternKind::Dots; ///< dots, stripes or `image`
  std::optional<double> distance; ///< from where the data begins, away from the viewer, in what
                                  ///< light leaves them into; unset: one depth
  /// Period of stripes, and of the cells that have a dot each: data units; 0: pixelsPerPeriod. What is finer than four
  /// pixels fades to grey, and is gone at two.
  double period = 0;
  double angle = 0; ///< of stripes, degrees: direction across them, from u to v
  std::shared_ptr<const RgbImage> image; ///< stretched over what the camera sees
  double pixelsPerPeriod = 8;            ///< where period is 0
};

/// The lens of a camera: that of Cutoff::Background and of views with a perspective. What is out of focus is blurred, each
/// pass being what one point of the aperture sees.
struct Lens
{
  double aperture =
    0; ///< diameter of the pupil, data units; of a view with a perspective. 0: a pinhole
  /// Of the telecentric lens of a parallel view: diameter of the pupil by focal length, which light from an object has as
  /// its full range of slopes. 0: a pinhole.
  double apertureRatio = 0;
  /// From the pupil to the plane in focus, data units, with a perspective; unset: Cutoff::Background the pattern, others
  /// what Scene::focusOffset says.
  std::optional<double> focusDistance;
};

/// Everything about the bench that is not the medium.
struct Scene
{
  View view; ///< the camera

  Cutoff cutoff = Cutoff::KnifeEdge; ///< the imaging technique
  double knifeEdgeAngle = 0;         ///< degrees; 0 measures the deflection along u, 90 along v
  double cutoffOffset = 0;      ///< how far the edge is in, as a fraction of the source's image
  std::optional<double> kScale; ///< k = f/a; unset: 99th percentile of |eps| is full scale, about
  /// Transmission at evenly spaced places from 0 to 1, linear in between; at least 2.
  std::vector<double> gradedFilter{ 0, 1 };
  std::shared_ptr<const RgbImage> colorFilter; ///< from k eps = (-1, -1) to (1, 1); null: the wheel
  double wavelength = 632.8e-9;                ///< of an interferogram and of waves, metres
  Fringes fringes;                             ///< of Cutoff::Interferogram
  PhasePlate phasePlate;                       ///< of Cutoff::PhaseContrast
  BackgroundPattern background;                ///< of Cutoff::Background
  /// Distance from where light leaves the data to the screen, data units, in what light leaves them into; unset: one
  /// data depth.
  std::optional<double> screenDistance;
  /// Where that is unset, a shadowgraph has the least distance, one data depth or more, at which 1 % of the light that has
  /// crossed the data has |I - 1| > 1/2, half of the scale: Image::screenDistance says it. 1/I is the area on which the
  /// light between three neighbouring rays lands by that of undisturbed light (Settles 2001), by a coarse look at the
  /// image. Hardly any rays cross then, but those that do so within a depth.
  bool choosesScreen = false;
  /// Distance of the plane in focus from the data's middle (with a perspective from the focal point) along w, data units.
  double focusOffset = 0;

  LightSource source; ///< collimated or diverging light, of a point, a slit or a disc
  Lens lens;          ///< of the camera

  ExitInto exitInto = ExitInto::Surroundings; ///< what light enters behind the data
  double exitRefractivity = airRefractivity;  ///< n - 1, of ExitInto::Custom

  /// Waves are for Cutoff::Shadowgraph, and of collimated light for KnifeEdge, BrightField, DarkField, GradedFilter,
  /// PhaseContrast and Interferogram: the light of each pixel is then that of a wave, for which there is one
  /// ray in each pixel. All else of the image remains that of rays.
  LightModel lightModel = LightModel::Rays;
  double smoothingRadius =
    0;                     ///< of the image, pixels: twice a Gaussian's standard deviation; 0: none
  int histogramSize = 0;   ///< bins along each axis of Image::histogram; 0: none
  int samplesPerPixel = 4; ///< rays, 1 or more
  int samplesAtEdges = 0;  ///< likewise, where edges of bodies are; 0: as many as elsewhere
  std::uint32_t seed = 1;  ///< of the rays' places in pixels and on the source

  /// The error that 99 % of the pixels whose light crosses the data shall keep; 0: that of the settings below. It chooses
  /// interpolation, stepSize, samplesPerPixel, samplesAtEdges, mediumTolerance (no coarser than 0.01) and precision,
  /// and says in Image::accuracy what is reached. Its unit is that which the image is read in: of an interferogram fringes;
  /// of Cutoff::Background pixels of displacement; else the fraction of full scale, of a shadowgraph of undisturbed light,
  /// not counting what light displaced by 0.05 pixels explains.
  double targetError = 0;

  PathModel pathModel = PathModel::Refracted;             ///< straight or refracted rays
  Integrator integrator = Integrator::Leapfrog;           ///< of refracted rays
  Interpolation interpolation = Interpolation::Quadratic; ///< between the samples
  Precision precision = Precision::Single;                ///< of the rays' numbers
  /// Voxels, 0.001 ... 16: length of one step in index space; of Integrator::Adaptive the longest. Where
  /// there are solids, no longer than 1.
  double stepSize = 1;
  /// For Integrator::Adaptive: the local error allowed in a step, relative to what the medium's steepest
  /// gradient would bend over the same length. 1e-12 ... 1.
  double adaptiveTolerance = 1e-5;
  /// Error of the deflection, of a strong one (full scale, about), that the voxels of a Field's source may make;
  /// 0: they are as fine as the data. 0 ... 1.
  double mediumTolerance = 0.01;
  /// Bytes that the voxels of a Field's source may take. Where they do not do, the tolerance is not met:
  /// see Image::medium.
  std::size_t mediumMemory = std::size_t{ 1 } << 30;
  Device device = Device::Auto; ///< where rays are traced; Auto: on a GPU where there is one
  int threads = 0;              ///< CPU threads; 0: all cores this process may use
  /// Bytes of rays that are cached for re-shading. The image does not depend on it.
  std::size_t memoryBudget = std::size_t{ 1 } << 30;
};

/// What an image's light stands for: the light of evenly spaced values of what makes it, as a legend shows it.
struct Legend
{
  /// What makes the light.
  enum class Quantity
  {
    None,            ///< of a pattern behind the flow: nothing that a scale could show
    Deflection,      ///< along the knife edge's normal, radians
    DeflectionSize,  ///< |eps|, radians
    DeflectionPlane, ///< along u and v, radians
    Light,           ///< by undisturbed light
    Path             ///< optical path difference, metres
  };

  Quantity quantity = Quantity::None; ///< what the values are of
  ///@{
  /// At the outer edges of the first and the last value, in the quantity's unit.
  double lowest = 0, highest = 0;
  ///@}
  ///@{
  /// Numbers of values, along u and, of DeflectionPlane, along v.
  int width = 0, height = 0;
  ///@}
  std::vector<float>
    light; ///< red, green and blue of each, linear, the lowest first; 1 is full light
};

/// The legend of a scene that has been validated, for its sensitivity k > 0 (where it has one). A knife edge's, a graded
/// filter's and a stop's goes from all of one end of their light to the other; a shadowgraph's from 0 to 2; an
/// interferogram's from a fringe below to one above undisturbed light. What is shown is the formula of the cutoff,
/// without a carrier.
Legend legendOf(const Scene& scene, double k);

/// What a Bench has done so far: lets a caller (and the tests) see that nothing is done twice.
struct Work
{
  std::int64_t mediumBuilds = 0; ///< not those that another Bench has made
  std::int64_t raySets =
    0; ///< how often rays had to be traced anew: for another view, another medium
  std::int64_t raysTraced = 0; ///< in all of these sets
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
  friend class MediumCache;
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
  ///@{
  /// What is moved from can be destroyed or assigned to, nothing else.
  Bench(Bench&&) noexcept;
  Bench& operator=(Bench&&) noexcept;
  ///@}

  /// The image of `field` on the bench `scene`. Throws Error.
  Image render(const Field& field, const Scene& scene, const Monitor& monitor = {});

  /// Resumes the image that the monitor paused in the last call, which any other call cancels: the
  /// same image, to the last bit, that render would have made without a pause. Each call makes some progress,
  /// however soon it is paused again: what is not cut into pieces is the medium, a pass on the GPU, and the
  /// development of an image. Throws Error.
  Image resume(const Monitor& monitor = {});
  bool isUnfinished() const; ///< whether there is an image that was paused
  void cancel();             ///< forgets it

  /// Sets the other ranks that trace rays for the next images, each with a RayWorker; null: there are none. The images
  /// are the same to the last bit.
  void setProcesses(Processes* processes);

  /// Takes the next media from these, or adds them. Field::version then has to differ between any two fields that benches
  /// are given, whatever their arrays' addresses.
  void setMedia(std::shared_ptr<SharedMedia> media);

  const Work& work() const; ///< since the bench was made

private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

} // namespace schlieren
