// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
// What a scene needs of each stage.
#pragma once

#include "Bench/CutoffMaker.h"
#include "Bench/MovedLight.h"
#include "Film/Development.h"
#include "Film/Shading.h"
#include "Medium/Medium.h"
#include "Rays/Light.h"
#include "Rays/March/MakeTask.h"
#include "Schlieren.h"

#include <cstdint>
#include <vector>

namespace schlieren
{

/// How a scene's rays are to be traced where nu changes by no more than `steepest` from voxel to voxel: where that is too
/// much, as at faces of glass, steps are adaptive. What does not matter to them has its default, so that changing it needs
/// no re-tracing.
RaySettings settingsOf(const Scene& scene, double lengthScale, double steepest);

/// A deflection that the rounding of the samples alone can make: each step's gradient is wrong by one
/// rounding of N per voxel, and over a ray these errors add up like a random walk. With a margin of 16.
template <class Real>
double noiseFloor(const Medium<Real>& medium, const Field& field, const Light& light);

/// n - 1 of what light leaves the data into, where that of the surroundings is `ambient`.
double exitRefractivityOf(const Scene& scene, double ambient);

/// Where it does. With ExitInto::Auto the faces refract light if there is a liquid or a solid in it, N being `largestN`
/// at most: of gases, which mostly have no faces where the data end, that would change a deflection by its nu there.
ExitFaces exitFacesOf(const Scene& scene, double ambient, double largestN);

/// How far past the plane where rays leave the data they meet what the film shows: a screen; the background
/// that a camera sees; or (going back) the plane in focus of the other cutoffs' camera, where it seems to be from
/// outside. Data units. With a perspective rays leave the data at their far end, behind which a screen is, too.
double filmDistance(const Scene& scene, const Frame& frame, const ExitFaces& faces);

/// The aperture through which a scene is seen: a pinhole where there is no camera.
Aperture apertureOf(const Scene& scene, const Frame& frame, const ExitFaces& faces);

/// Pixels around the image from which light may be bent into it, by a coarse look at it: at most maxMargin(). At least one, because the film distributes a ray over four pixels. The same for all
/// cutoffs, so that changing the cutoff needs no re-tracing, but for a camera's rays, which stay in their pixel.
std::int64_t marginFor(
  const std::vector<MovedRay>& rays, const Scene& scene, const Frame& frame, const Light& light);

/// How far light is moved on the film of an image in focus, pixels.
double movedInFocus(
  const std::vector<MovedRay>& rays, const Scene& scene, const Frame& frame, const Light& light);

/// See Scene::choosesScreen. No further than where 1 % of the light is moved by maxMargin(), but one depth at least. Where
/// `rounding` of slopes, see noiseFloor, would be seen before, the light that changes most counts instead of 1 %.
double screenDistanceFor(const std::vector<MovedNeighbours>& neighbours, const Scene& scene,
  const Frame& frame, const Light& light, double rounding);

Light lightOf(const Scene& scene, const Grid& grid, const Frame& frame, const ExitFaces& faces);

/// Finds what a view sees of a source's medium, with the margin around the image and `around` more pixels.
Column columnOf(const Scene& scene, const Light& light, const Frame& frame, std::int64_t around);

/// What the pixels of a view show.
PixelPlaces pixelPlacesOf(const Frame& frame, const View& view, const Light& light);

FilmSettings filmSettingsOf(const Scene& scene);

/// Of the squares that an image's rays light, see sideOf(). 1 where rays each see another point of a source or an aperture, but
/// for those of a camera, which stay in their pixels; and of few rays with fringes, whose mean between four rays is known where
/// paths are straight. A screen shows how far rays part from their neighbours: there squares overlap.
double sideOnFilm(int raysPerPixel, const Scene& scene, const Light& light);

/// Of how many rays, of so many per pixel, the points in it are chosen together, see pixelOffset(): on a screen and with fringes. 1:
/// of a sequence, as in focus, and for rays that each see another point of a source or an aperture.
int pointsOfPixel(int samples, const Scene& scene, const Light& light);

/// Where a pass's rays, of `samples` per pixel, start in their pixels and at their source, and how much of a pixel they light.
void aimPass(Pass& pass, std::int64_t number, int samples, const Scene& scene, const Light& light);

/// `pathPerDataUnit`: see Projection.
Projection projectionOf(
  const Scene& scene, const Frame& frame, const Light& light, double pathPerDataUnit);

} // namespace schlieren
