// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The tracer over arrays: schlieren_core/__init__.py checks what users give, and has the documentation.
#include "Schlieren.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <initializer_list>
#include <map>
#include <optional>
#include <string>

namespace nb = nanobind;
using namespace schlieren;

namespace
{

/// Hands an image's array over to NumPy.
template <class Value>
nb::object array(PixelArray<Value>& values, std::initializer_list<std::size_t> shape)
{
  if (values.empty())
  {
    return nb::none();
  }
  Value* data = values.release();
  const nb::capsule owner(
    data, [](void* memory) noexcept { delete[] static_cast<Value*>(memory); });
  return nb::cast(nb::ndarray<nb::numpy, Value>(data, shape, owner));
}

nb::dict imageOf(const Field& field, const Scene& scene)
{
  Image image;
  {
    const nb::gil_scoped_release others;
    Monitor monitor;
    monitor.aborted = []
    {
      const nb::gil_scoped_acquire python;
      return PyErr_CheckSignals() != 0;
    };
    image = Bench().render(field, scene, monitor);
  }
  if (image.aborted)
  {
    throw nb::python_error();
  }
  const auto rows = static_cast<std::size_t>(image.height);
  const auto columns = static_cast<std::size_t>(image.width);
  nb::dict made;
  made["intensity"] = array(image.intensity, { rows, columns });
  made["color"] = array(image.color, { rows, columns, 3 });
  made["deflection"] = array(image.deflection, { rows, columns, 2 });
  made["optical_path_difference"] = array(image.opticalPathDifference, { rows, columns });
  made["displacement"] = array(image.displacement, { rows, columns, 2 });
  made["blocked_fraction"] = array(image.blockedFraction, { rows, columns });
  made["origin"] = nb::make_tuple(image.frame.origin[0], image.frame.origin[1]);
  made["pixel_size"] = image.frame.pixelSize;
  made["k"] = image.kScale;
  made["ambient"] = image.ambient;
  return made;
}

/// The value that a word stands for.
template <class Value>
Value choice(const char* name, const std::string& word, const std::map<std::string, Value>& choices)
{
  if (const auto found = choices.find(word); found != choices.end())
  {
    return found->second;
  }
  std::string all;
  for (const auto& [known, value] : choices)
  {
    all += (all.empty() ? "'" : ", '") + known + "'";
  }
  throw Error(std::string(name) + " is '" + word + "'. Choose one of " + all + ".");
}

/// What schlieren_core.trace takes, in its order.
nb::dict traceSamples(
  const nb::ndarray<nb::ro, nb::ndim<3>, nb::c_contig, nb::device::cpu>& samples,
  const Vector& spacing, const Vector& origin, std::optional<double> ambient, double lengthScale,
  const Vector& viewDirection, const Vector& viewUp, std::optional<Vector> focalPoint,
  double parallelScale, const std::array<int, 2>& size, const std::string& cutoff,
  double knifeEdgeAngle, std::optional<double> k, std::optional<double> screenDistance,
  double wavelength, const std::string& path, const std::string& interpolation,
  const std::string& precision, double stepSize, int samplesPerPixel, int threads)
{
  Field field;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    field.grid.dimensions[axis] = static_cast<std::int64_t>(samples.shape(2 - axis));
  }
  field.grid.spacing = spacing;
  field.grid.origin = origin;
  field.ambient = ambient;
  field.lengthScale = lengthScale;
  if (samples.dtype() == nb::dtype<float>())
  {
    field.singles = static_cast<const float*>(samples.data());
  }
  else
  {
    field.doubles = static_cast<const double*>(samples.data());
  }

  Scene scene;
  scene.view.viewDirection = viewDirection;
  scene.view.viewUp = viewUp;
  scene.view.focalPoint = focalPoint;
  scene.view.parallelScale = parallelScale;
  scene.view.width = size[0];
  scene.view.height = size[1];
  scene.cutoff = choice<Cutoff>("cutoff", cutoff,
    { { "knife edge", Cutoff::KnifeEdge }, { "shadowgraph", Cutoff::Shadowgraph },
      { "circular", Cutoff::Circular }, { "dark field", Cutoff::CircularComplement },
      { "color filter", Cutoff::ColorFilter }, { "interferogram", Cutoff::Interferogram } });
  scene.knifeEdgeAngle = knifeEdgeAngle;
  scene.kScale = k;
  scene.screenDistance = screenDistance;
  scene.wavelength = wavelength;
  scene.pathModel = choice<PathModel>(
    "path", path, { { "straight", PathModel::Straight }, { "refracted", PathModel::Refracted } });
  scene.interpolation = choice<Interpolation>("interpolation", interpolation,
    { { "quadratic", Interpolation::Quadratic }, { "cubic", Interpolation::Cubic } });
  scene.precision = choice<Precision>(
    "precision", precision, { { "single", Precision::Single }, { "double", Precision::Double } });
  scene.stepSize = stepSize;
  scene.samplesPerPixel = samplesPerPixel;
  scene.threads = threads;
  return imageOf(field, scene);
}

} // namespace

NB_MODULE(_tracer, module)
{
  nb::exception<Error>(module, "Error", PyExc_ValueError);
  module.def("version", &version);
  module.def("trace", &traceSamples, nb::arg(), nb::arg(), nb::arg(), nb::arg().none(), nb::arg(),
    nb::arg(), nb::arg(), nb::arg().none(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
    nb::arg().none(), nb::arg().none(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
    nb::arg(), nb::arg());
}
