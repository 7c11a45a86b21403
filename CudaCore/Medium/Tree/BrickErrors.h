// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Decides how fine a node of the medium's tree needs to be.
#pragma once

namespace schlieren
{

/// Converts a range of nu within a node to the deflection that it may make there. A variation over the whole node makes
/// one as large as itself, one over a sixteenth of it, along the ray, 16 times as much.
inline constexpr double deflectionByRange = 8;

/// Boxes whose voxels are no larger than this fraction of a cell are not divided, so that voxels have 0.7 ... 1.4 cells
/// in the end. Of data that are linear in cells, finer voxels show the facets (a ball of width 0.2 and cells of 0.025,
/// rays along both: rms error 1.3e-2 with half a cell, 3.4e-3 with one, 5.9e-3 with 1.4; oblique 3e-3 with all).
inline constexpr double voxelByCell = 1.4;

/// The same where gas ends: with finer voxels, edges show nothing new.
inline constexpr double edgeVoxelByCell = 0.5;

/// Voxels this much coarser than cells may miss what cells have.
inline constexpr double coarseByCell = 2;

/// What the cells have beyond the range of the samples is taken for something that was missed where it is more
/// than this fraction of that range: peaks, too, lie between samples.
inline constexpr double missedByRange = 0.5;

} // namespace schlieren
