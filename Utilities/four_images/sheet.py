# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The sheet: four images with titles, axes and legends. Row 0 is the top one here."""

import os
import sys

from arguments import ROOT

sys.path.insert(0, os.path.join(ROOT, "Plugin"))

from schlieren_figure import Axes, FigureError, Sheet, axis_name, grey, prefix_of  # noqa: E402


def format_length(data_units, options):
    metres = data_units * options.length_scale
    prefix, factor = prefix_of(abs(metres) * 1.0001)
    return f"{metres / factor:.3g} {prefix}m"


def layout(frame):
    """The sheet's width and height, the upper left corners of its images, a column's width."""
    margin, head, foot, above, below = 64, 62, 30, 60, 116
    column = max(frame.width, 560) + margin
    row = above + frame.height + below
    corners = [(margin + i * column, head + j * row + above) for j in (0, 1) for i in (0, 1)]
    return 2 * column + 24, head + 2 * row + foot, corners, column


def compose(volume, medium, images, frame, used, options):
    _, low, clear, high = medium
    distance = images[2][1]["ScreenDistance"][0]
    titles = ["Schlieren, vertical knife edge", "Schlieren, horizontal knife edge",
              f"Shadowgraph, {format_length(distance, options)} behind the flow"]
    tiles = [(volume, "Volume rendering", None)] + [
        (grey(light, facts["WhiteLevel"][0]), title, facts) for (light, facts), title in zip(images, titles)]
    width, height, corners, column = layout(frame)
    sheet = Sheet(width, height)
    room = width - 48
    is_density = options.model == "Gladstone-Dale" or (
        options.model == "Auto" and (options.array or options.formula or used.startswith("Density")))
    law = f"n - 1 = {options.constant:g} m³/kg x density" if is_density and "fractions" not in used else \
        {"Refractive Index": "The array is n", "Refractivity": "The array is n - 1"}.get(options.model, "n - 1 of these")
    if is_density and options.density_scale > 0:
        law += f" ({options.density_scale:g} kg/m³ for 1)"
    sheet.text(24, 14, f"{os.path.basename(options.file)}: {used}", 26, room=room)
    looking = ", ".join(f"{part + 0.0:.3g}" for part in frame.direction)
    sheet.text(24, 44, f"Looking along ({looking}) through {format_length(frame.depth, options)}.  "
               f"{law}.", 15, sheet.DIM, room=room)
    axes = Axes(frame.left, frame.bottom, frame.pixel, (frame.width, frame.height),
                (axis_name(frame.u, "u"), axis_name(frame.v, "v")), options.length_scale)
    for (left, top), (tile, title, facts) in zip(corners, tiles):
        sheet.text(left, top - 50, title, 20, room=column - 48)
        sheet.image(left, top, tile, axes)
        below = top + frame.height + 46
        if facts:
            sheet.legend(left, below, facts, column - 48)
        else:
            sheet.text(left, below, f"n - 1 = {low:.3g} (blue) to {high:.3g} (red), clear at {clear:.3g}", 13,
                       sheet.DIM, room=column - 48)
    facts = images[0][1]
    sheet.text(width - 24, height - 26,
               f"{int(facts['RaysTraced'][0]):,} rays, {int(facts['StepsTaken'][0]):,} steps, traced on the "
               f"{facts['Device'][0]}", 13, sheet.DIM, "right")
    return sheet
