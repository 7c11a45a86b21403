// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes of flows within, around and beside things, and what light does where they have no cells.
#pragma once

#include "BoundaryMeshes.h"

#include <string>
#include <utility>
#include <vector>

/// A mesh and places of it. Whether light passes at each is what an engineer expects.
struct OutsideShape
{
  std::string name;
  std::vector<Data> blocks;
  std::vector<std::pair<Vec, bool>> places;
  bool isLayer = false; // of a plane
};

namespace shapes
{

using Curve = std::function<Vec(double s)>; // s: 0 ... 1; z: 0

constexpr bool stops = false, passes = true;

/// The plane between two curves.
inline std::vector<Data> between(const Curve& low, const Curve& high, int along, int across)
{
  return { curvilinear(along, across, 2,
    [&](double i, double j, double k)
    {
      const Vec a = low(i), b = high(i);
      return Vec{ a[0] + j * (b[0] - a[0]), a[1] + j * (b[1] - a[1]), 0.1 * (k - 0.5) };
    }) };
}

inline Curve arc(double radius, double from, double to, const Vec& middle = { 0, 0, 0 })
{
  return [=](double s)
  {
    const double angle = pi * (from + s * (to - from));
    return Vec{ middle[0] + radius * std::cos(angle), middle[1] + radius * std::sin(angle), 0 };
  };
}

/// Straight from point to point, which follow at these s.
inline Curve polygon(const std::vector<std::pair<double, Vec>>& points)
{
  return [=](double s)
  {
    std::size_t i = 1;
    while (i + 1 < points.size() && s > points[i].first)
    {
      ++i;
    }
    const auto& [s0, a] = points[i - 1];
    const auto& [s1, b] = points[i];
    const double part = (s - s0) / (s1 - s0);
    return Vec{ a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), 0 };
  };
}

inline Curve over(double from, double to, const std::function<double(double x)>& y)
{
  return [=](double s)
  {
    const double x = from + s * (to - from);
    return Vec{ x, y(x), 0 };
  };
}

/// Around a profile from the wake's lower side to its upper one.
inline std::vector<Data> cGrid(double thickness)
{
  const auto profile = [=](double s)
  {
    const double x = 0.5 * (1 + std::cos(2 * pi * s));
    const double y = 5 * thickness *
      (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x -
        0.1036 * x * x * x * x);
    return Vec{ x, s < 0.5 ? -y : y, 0 };
  };
  const auto parts = [](const Curve& before, const Curve& middle, const Curve& after)
  {
    return [=](double s)
    { return s < 0.25 ? before(4 * s) : (s > 0.75 ? after(4 * s - 3) : middle(2 * s - 0.5)); };
  };
  const auto wake = [](double y, bool isInward)
  { return over(isInward ? 6 : 1, isInward ? 1 : 6, [=](double) { return y; }); };
  return between(parts(wake(0, true), profile, wake(0, false)),
    parts(wake(-5, true), arc(5, -0.5, -1.5, { 1, 0, 0 }), wake(5, false)), 201, 50);
}

/// A duct of square section along a path of the plane, or a round one; with an axis of cells.
inline std::vector<Data> pipe(const Curve& path, const std::function<double(double s)>& radius,
  int along, int around, double turn = 0)
{
  return { curvilinear(along, 9, around + 1,
    [&](double i, double j, double k)
    {
      const Vec at = path(i), ahead = path(i + 1e-4), behind = path(i - 1e-4);
      const Vec t = unit({ ahead[0] - behind[0], ahead[1] - behind[1], 0 });
      const double r = radius(i) * (0.02 + 0.98 * j), phi = 2 * pi * k + turn;
      return Vec{ at[0] - t[1] * r * std::cos(phi), at[1] + t[0] * r * std::cos(phi),
        r * std::sin(phi) };
    }) };
}

inline std::vector<Data> extruded(const Curve& low, const Curve& high, double depth)
{
  return { curvilinear(121, 31, 6,
    [&](double i, double j, double k)
    {
      const Vec a = low(i), b = high(i);
      return Vec{ a[0] + j * (b[0] - a[0]), a[1] + j * (b[1] - a[1]), depth * k };
    }) };
}

inline std::vector<Data> sphereSector(double far, double part, int n = 24)
{
  return { sphereMesh(n, far, VTK_DOUBLE, part) };
}

/// Over a double cone, whose free stream waves by so much of its length.
inline std::vector<Data> doubleCone(double wave)
{
  const Curve body = polygon({ { 0, { 0, 0, 0 } }, { 0.47, { 0.0918, 0.0428, 0 } },
    { 0.86, { 0.1538, 0.1309, 0 } }, { 1, { 0.19576, 0.1309, 0 } } });
  const Curve far = [=](double s)
  {
    const double w = 0.24 * wave * std::sin(2 * pi * s);
    return Vec{ -0.00457 + 0.14725 * s + 0.79 * w, 0.19014 * s - 0.61 * w, 0 };
  };
  return between(body, far, 129, 64);
}

/// The section of a double cone on an axis, which wedges of one cell become.
inline std::vector<Data> biconic()
{
  const auto body = [](double x)
  {
    const double kink = 0.09, steep = std::tan(55 * pi / 180), flat = std::tan(25 * pi / 180);
    return std::min(0.13, x < 0 ? 0 : flat * std::min(x, kink) + steep * std::max(0., x - kink));
  };
  std::vector<Data> halves;
  for (const double side : { -1., 1. })
  {
    halves.push_back(between(over(-0.02, 0.2, [=](double x) { return side * body(x); }),
      over(-0.02, 0.2, [=](double) { return side * 0.2; }), 161, 61)[0]);
  }
  return halves;
}

inline std::vector<OutsideShape> inPlanes()
{
  const auto flat = [](double y) { return [=](double) { return y; }; };
  const double slope = std::tan(pi / 12), turn = std::tan(50 * pi / 180);
  const auto narrow = [](double x)
  { return 0.5 + 0.5 * (1 - 0.7 * std::exp(-(x - 1.2) * (x - 1.2) / 0.25)); };
  const auto nozzle = [](double x)
  {
    const double in = std::sin((x - 1) / 0.8 * pi / 2);
    return x < 1 ? 1 : (x < 1.8 ? 1 - 0.7 * in * in : 0.3 + 0.4 * (x - 1.8) / 1.2);
  };
  const auto channel = [](const std::function<double(double)>& wall)
  { return between(over(0, 3, [=](double x) { return -wall(x); }), over(0, 3, wall), 121, 41); };
  const auto above = [&](double from, double to, double top, const std::function<double(double)>& y)
  { return between(over(from, to, y), over(from, to, flat(top)), 121, 41); };
  const auto bend = [](double r)
  {
    const Curve round = arc(r, 1, 0.5);
    return [=](double s)
    {
      return s < 0.25 ? Vec{ -r, 8 * s - 2, 0 }
                      : (s > 0.75 ? Vec{ 8 * s - 6, r, 0 } : round(2 * s - 0.5));
    };
  };
  const auto passage = [](const Curve& low)
  {
    return between(
      low,
      [=](double s)
      {
        const Vec at = low(s);
        return Vec{ at[0], at[1] + 1, 0 };
      },
      121, 41);
  };
  const auto curved = [](double x)
  { return 1.2 * std::pow(std::sin(pi * x / 4), 2) - 1.5 * x / 4; };
  const auto thin = [](double x) { return std::max(0., 0.004 - 0.016 * (x - 1) * (x - 1)); };
  const Curve sting = [](double s)
  {
    const double angle = 0.3047 + (2 * s - 1) * (pi - 0.3047);
    return s < 0.5 ? Vec{ 20 - 38.09 * s, 0.3, 0 } : Vec{ std::cos(angle), std::sin(angle), 0 };
  };
  const auto of = [](std::string name, std::vector<Data> mesh,
                    std::vector<std::pair<Vec, bool>> places) {
    return OutsideShape{ std::move(name), std::move(mesh), std::move(places), true };
  };
  std::vector<Data> plate = between(over(0, 2, flat(0)), over(0, 2, flat(1)), 41, 21);
  plate.push_back(between(over(0, 2, flat(-1)), over(0, 2, flat(0)), 41, 21)[0]);
  std::vector<Data> wing = above(-1, 3, 1, thin);
  wing.push_back(
    between(over(-1, 3, flat(-1)), over(-1, 3, [=](double x) { return -thin(x); }), 121, 21)[0]);
  const Data duct =
    blocks({ 60, 40, 1 }, { 3, 3, 0.06 }, [](const Vec& x) { return x[0] < 1 || x[1] < 1; });
  const Data tunnel = blocks({ 90, 90, 1 }, { 3, 3, 0.03 },
    [](const Vec& x)
    {
      return std::hypot(std::max(0., std::abs(x[0] - 1.5) - 1),
               std::max(0., std::abs(x[1] - 1.5) - 1)) < 0.5;
    });
  const auto cone = [&](const std::string& name, double wave)
  {
    return of(name, doubleCone(wave),
      { { { 0.17, 0.05, 0 }, stops }, { { 0.03, 0.12, 0 }, passes },
        { { 0.18, 0.185, 0 }, passes } });
  };
  return {
    of("cylinder", between(arc(1, 0, 2), arc(20, 0, 2), 97, 60),
      { { { 0, 0.2, 0 }, stops }, { { 18, 18, 0 }, passes } }),
    of("wedge", biconic(),
      { { { 0.15, 0.04, 0 }, stops }, { { 0.19, -0.1, 0 }, stops },
        { { 0.05, 0.19, 0 }, passes } }),
    of("half cylinder", between(arc(1, 0, 1), arc(5, 0, 1), 49, 40),
      { { { 0, 0.4, 0 }, stops }, { { 4.6, 4.6, 0 }, passes } }),
    of("blunt body",
      between(
        arc(1, 1, 0.5),
        [](double s)
        {
          const double a = pi * (1 - s / 2);
          return Vec{ 1.5 * std::cos(a), 2.4 * std::sin(a), 0 };
        },
        41, 40),
      { { { -0.3, 0.3, 0 }, stops }, { { -0.05, 0.05, 0 }, stops }, { { -1.4, 2.2, 0 }, passes } }),
    of("airfoil", cGrid(0.12),
      { { { 0.4, 0, 0 }, stops }, { { -3.7, 4.7, 0 }, passes }, { { -3.7, -4.7, 0 }, passes } }),
    of("airfoil of 1 %", cGrid(0.01), { { { 0.4, 0, 0 }, stops }, { { -3.7, 4.7, 0 }, passes } }),
    of("nozzle", channel(narrow), { { { 1.2, 0.8, 0 }, stops }, { { 1.2, -0.8, 0 }, stops } }),
    of("nozzle with a straight inlet", channel(nozzle),
      { { { 1.9, 0.8, 0 }, stops }, { { 1.9, -0.8, 0 }, stops }, { { 2.9, 0.95, 0 }, stops } }),
    of("duct of one layer", { duct }, { { { 2, 2, 0.03 }, stops }, { { 2.9, 1.1, 0.03 }, stops } }),
    of("elbow", between(bend(1), bend(2), 121, 21),
      { { { 1, -1, 0 }, stops }, { { -1.9, 1.8, 0 }, stops } }),
    of("ramp up to the outlet",
      above(-0.15, 0.3, 0.15, [=](double x) { return slope * std::max(0., x); }),
      { { { 0.25, 0.02, 0 }, stops }, { { 0.29, 0.07, 0 }, stops } }),
    of("ramp with a flat end",
      above(-0.15, 0.3, 0.15, [=](double x) { return slope * std::clamp(x, 0., 0.2); }),
      { { { 0.25, 0.02, 0 }, stops }, { { 0.05, 0.003, 0 }, stops } }),
    of("ramp from the inlet on",
      above(-0.15, 0.3, 0.25, [=](double x) { return slope * (x + 0.15); }),
      { { { 0.25, 0.02, 0 }, stops } }),
    of("bump", above(0, 3, 1, [](double x) { return 0.1 * std::exp(-std::pow(2 * x - 3, 2)); }),
      { { { 1.5, 0.05, 0 }, stops }, { { 1.2, 0.01, 0 }, stops } }),
    of("cascade", passage(over(0, 4, [=](double x) { return -turn * std::max(0., x - 3); })),
      { { { 1, -0.7, 0 }, passes }, { { 3.8, 0.6, 0 }, passes } }),
    of("curved cascade", passage(over(0, 4, curved)),
      { { { 0.8, -1, 0 }, passes }, { { 3.6, 0.6, 0 }, passes } }),
    cone("double cone", 0),
    cone("double cone", 1e-4),
    cone("double cone", -1e-4),
    cone("double cone", 1e-3),
    of("annulus", between(arc(1, 0, 2), arc(1.5, 0, 2), 97, 20),
      { { { 0, 0.2, 0 }, stops }, { { 1.4, 1.4, 0 }, passes } }),
    of("annulus of 1 %", between(arc(1, 0, 2), arc(1.01, 0, 2), 97, 8),
      { { { 0, 0.2, 0 }, stops }, { { 0.7, 0.69, 0 }, stops }, { { 0.9, 0.9, 0 }, passes } }),
    of("sting", between(sting, arc(20, 0.005, 1), 119, 60),
      { { { 0, 0.5, 0 }, stops }, { { 10, 0.15, 0 }, stops }, { { 18, 18, 0 }, passes } }),
    of("plate without thickness", plate, { { { 1, 0.5, 0 }, passes } }),
    of("wing of 0.4 %", wing, { { { 1, 0, 0 }, stops } }),
    of("tunnel with rounded corners", { tunnel }, { { { 0.04, 0.04, 0.015 }, passes } }),
  };
}

inline std::vector<OutsideShape> inSpace()
{
  const auto flat = [](double y) { return [=](double) { return y; }; };
  const auto nozzle = [](double x)
  {
    const double in = std::sin((x - 1) / 0.8 * pi / 2);
    return x < 1 ? 1 : (x < 1.8 ? 1 - 0.7 * in * in : 0.3 + 0.4 * (x - 1.8) / 1.2);
  };
  const Curve straight = [](double s) { return Vec{ 3 * s, 0, 0 }; };
  const Curve round = arc(1.5, 1, 0.5);
  const Curve bend = [=](double s)
  {
    return s < 0.25 ? Vec{ -1.5, 8 * s - 2, 0 }
                    : (s > 0.75 ? Vec{ 8 * s - 6, 1.5, 0 } : round(2 * s - 0.5));
  };
  const auto box = [](const std::array<int, 3>& cells, const Vec& lengths,
                     const std::function<bool(const Vec&)>& isGas)
  { return std::vector<Data>{ blocks(cells, lengths, isGas) }; };
  const auto cube = [](double x, double y)
  {
    return Data(curvilinear(11, 11, 11,
      [=](double i, double j, double k) {
        return Vec{ x + i, y + j, k };
      }));
  };
  const auto beside = [](const Vec& x, double a, double b)
  { return std::abs(x[0] - 1) > a || std::abs(x[1] - 1) > b; };
  return {
    { "sphere", sphereSector(4, 1),
      { { { 0.1, 0.1, 0.1 }, stops }, { { 3.6, 3.6, 0 }, passes }, { { 0, 2, 3.9 }, passes } } },
    { "half sphere", sphereSector(4, 0.5),
      { { { 0.1, 0.3, 0.1 }, stops }, { { 3.6, 3.6, 0 }, passes } } },
    { "quarter of a sphere", sphereSector(4, 0.25),
      { { { 0.3, 0.3, 0.1 }, stops }, { { 3.6, 3.6, 0 }, passes } } },
    { "sector of a sphere", sphereSector(4, 1. / 6),
      { { { 0.5, 0.3, 0.1 }, stops }, { { 0.3, 3, 0 }, passes }, { { 3.9, 3.3, 0 }, passes } } },
    { "shell of 1 %", sphereSector(1.01, 1, 8),
      { { { 0.1, 0.1, 0.1 }, stops }, { { 0.9, 0.9, 0 }, passes }, { { 0, 0.8, 0.9 }, passes } } },
    { "round nozzle",
      pipe(
        straight, [&](double s) { return nozzle(3 * s); }, 121, 32),
      { { { 1.9, 0.9, 0.1 }, passes }, { { 1.9, 0.1, 0.9 }, passes },
        { { 0.5, 0.9, 0.9 }, passes } } },
    { "nozzle of square section",
      extruded(over(0, 3, [&](double x) { return -nozzle(x); }), over(0, 3, nozzle), 1),
      { { { 1.9, 0.8, 0.5 }, stops }, { { 1.9, -0.8, 0.5 }, stops } } },
    { "duct", box({ 40, 40, 6 }, { 3, 3, 0.6 }, [](const Vec& x) { return x[0] < 1 || x[1] < 1; }),
      { { { 2, 2, 0.3 }, stops }, { { 2.9, 1.1, 0.3 }, stops } } },
    { "pipe with a bend",
      pipe(
        bend, [](double) { return 0.5; }, 101, 32),
      { { { -1.9, -1, 0.48 }, passes }, { { 1, 1.9, 0.48 }, passes }, { { 1, -1, 0 }, passes },
        { { -1.9, 1.8, 0 }, passes } } },
    { "pipe of 24 facets",
      pipe(
        [](double s) {
          return Vec{ 5 * s, 0, 0 };
        },
        [](double) { return 1.; }, 41, 24, pi / 24),
      { { { 2.5, 0.9, 0.9 }, passes }, { { 2.5, -0.9, 0.9 }, passes } } },
    { "ring of gas",
      pipe(
        arc(2, 0, 2), [](double) { return 0.5; }, 65, 24),
      { { { 0, 0, 0 }, passes }, { { 2.4, 2.4, 0 }, passes } } },
    { "ramp up to the outlet in space",
      extruded(over(-0.15, 0.3, [](double x) { return std::tan(pi / 12) * std::max(0., x); }),
        over(-0.15, 0.3, flat(0.15)), 0.1),
      { { { 0.25, 0.02, 0.05 }, stops }, { { 0.29, 0.07, 0.01 }, stops } } },
    { "step forward",
      box({ 60, 20, 6 }, { 3, 1, 0.3 }, [](const Vec& x) { return x[0] < 0.6 || x[1] > 0.2; }),
      { { { 2, 0.1, 0.15 }, stops }, { { 0.8, 0.01, 0.01 }, stops } } },
    { "step backward",
      box({ 60, 20, 6 }, { 3, 1, 0.3 }, [](const Vec& x) { return x[0] > 0.6 || x[1] > 0.5; }),
      { { { 0.3, 0.2, 0.15 }, stops }, { { 0.01, 0.45, 0.01 }, stops } } },
    { "hole",
      box({ 24, 24, 24 }, { 1, 1, 1 },
        [](const Vec& x) {
          return std::max({ std::abs(x[0] - 0.5), std::abs(x[1] - 0.5), std::abs(x[2] - 0.5) }) >
            0.13;
        }),
      { { { 0.5, 0.5, 0.5 }, stops }, { { 0.4, 0.6, 0.6 }, stops } } },
    { "cube on the floor",
      box({ 40, 40, 20 }, { 2, 2, 1 },
        [&](const Vec& x) { return beside(x, 0.3, 0.3) || x[2] > 0.4; }),
      { { { 1, 1, 0.2 }, stops }, { { 1.2, 0.8, 0.01 }, stops } } },
    { "wing from side to side",
      box({ 40, 40, 20 }, { 2, 2, 1 }, [&](const Vec& x) { return beside(x, 0.3, 0.15); }),
      { { { 1, 1, 0.5 }, stops }, { { 1.2, 0.9, 0.01 }, stops } } },
    { "two blocks", { cube(0, 0), cube(2, 0) }, { { { 1.5, 0.5, 0.5 }, passes } } },
    { "two blocks aside", { cube(0, 0), cube(2, 0.7) },
      { { { 1.5, 0.5, 0.5 }, passes }, { { 0.5, 1.3, 0.5 }, passes } } },
  };
}

} // namespace shapes
