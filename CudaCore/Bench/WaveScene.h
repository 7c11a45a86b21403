// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Of which scenes waves can be made.
#pragma once

#include "Rays/Light.h"
#include "Schlieren.h"

#include <cstdint>
#include <string>

namespace schlieren
{

/// The beginning of messages about waves.
std::string thatWaves(const Scene& scene);
/// Their end: what else can be done.
std::string orRays(const Scene& scene);

/// A knife edge's source is as wide as k says.
LightSource sourceOfWaves(const Scene& scene);

/// Why no waves can be made of a scene, and what to do; empty where they can.
std::string problemOfWaves(const Scene& scene, const Frame& frame);

/// Pixels around an image from which waves may carry light into it besides what is bent; 0 of LightModel::Rays.
std::int64_t pixelsOfFresnelMargin(
  const Field& field, const Scene& scene, const Frame& frame, const ExitFaces& faces);

} // namespace schlieren
