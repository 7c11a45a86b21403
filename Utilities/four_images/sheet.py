# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The sheet: four images with titles and axes. Row 0 is the top one here."""

import math
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkTextProperty, vtkTextRenderer
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (draws the text)

from arguments import DemoError


def grey(intensity, white):
    """A pixel of the result for a pixel of the film: nothing is resampled."""
    level = np.clip(np.nan_to_num(intensity) / white, 0, 1)
    return np.repeat(np.rint(255 * level).astype(np.uint8)[..., None], 3, axis=2)


class Sheet:
    BACKGROUND = (24, 26, 31)
    FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
    BRIGHT, DIM = (240, 240, 240), (165, 172, 182)

    def __init__(self, width, height):
        self.pixels = np.full((height, width, 3), self.BACKGROUND, np.uint8)

    def paste(self, left, top, tile):
        self.pixels[top:top + tile.shape[0], left:left + tile.shape[1]] = tile

    def fill(self, left, top, width, height, color):
        self.pixels[max(top, 0):top + height, max(left, 0):left + width] = color

    def text(self, left, top, string, points, color=BRIGHT, anchor="left", room=None):
        """Draws a line of text; made smaller until it fits into `room` pixels."""
        image, dimensions = vtkImageData(), [0, 0]
        string = string.replace("|", "\u2223")  # VTK takes | for the border of a column
        while True:
            style = vtkTextProperty()
            if os.path.isfile(self.FONT):
                style.SetFontFamily(4)  # VTK_FONT_FILE
                style.SetFontFile(self.FONT)
            style.SetFontSize(points)
            style.SetColor(1, 1, 1)
            vtkTextRenderer.GetInstance().RenderString(style, string, image, dimensions, 72)
            columns, rows, _ = image.GetDimensions()
            if room is None or dimensions[0] <= room or points <= 8:
                break
            points -= 1
        ink = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)
        ink = ink[:dimensions[1], :dimensions[0], 3][::-1] / 255
        left -= {"left": 0, "middle": ink.shape[1] // 2, "right": ink.shape[1]}[anchor]
        left, top = max(left, 0), max(top, 0)
        place = self.pixels[top:top + ink.shape[0], left:left + ink.shape[1]]
        ink = ink[:place.shape[0], :place.shape[1], None]
        place[:] = np.rint(place * (1 - ink) + np.array(color) * ink).astype(np.uint8)

    def write(self, path):
        height, width, _ = self.pixels.shape
        image = vtkImageData()
        image.SetDimensions(width, height, 1)
        image.GetPointData().SetScalars(
            numpy_to_vtk(np.ascontiguousarray(self.pixels[::-1]).reshape(-1, 3), deep=True))
        writer = vtkPNGWriter()
        writer.SetFileName(path)
        writer.SetInputData(image)
        writer.Write()
        if not os.path.isfile(path) or writer.GetErrorCode():
            raise DemoError(f"Could not write '{path}'.")


def length_unit(metres):
    for name, factor in (("km", 1e3), ("m", 1), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9)):
        if metres >= factor:
            return name, factor
    return "m", 1


def round_step(span, wanted):
    """A step of 1, 2 or 5 times a power of ten that divides `span` into about `wanted` parts."""
    rough = span / wanted
    power = 10 ** math.floor(math.log10(rough))
    return power * min((1, 2, 5, 10), key=lambda digit: abs(math.log(digit * power / rough)))


def draw_axes(sheet, left, top, frame, options):
    """Ticks below and to the left of an image, in round steps of a unit of length."""
    extent = max(frame.right - frame.left, frame.top - frame.bottom) * options.length_scale
    unit, metres = length_unit(extent)
    scale = options.length_scale / metres
    bottom = top + frame.height

    def ticks(low, pixels):
        """(label, pixel) pairs. Pixel i reaches from low + i pixel to low + (i + 1) pixel."""
        step = round_step(pixels * frame.pixel * scale, max(3, pixels / 110))
        first = math.ceil(low * scale / step - 1e-6)
        last = math.floor((low + pixels * frame.pixel) * scale / step + 1e-6)
        for index in range(first, last + 1):
            place = math.floor((index * step / scale - low) / frame.pixel)
            yield f"{index * step:.10g}", min(max(place, 0), pixels - 1)

    for label, column in ticks(frame.left, frame.width):
        sheet.fill(left + column, bottom, 1, 5, sheet.DIM)
        sheet.text(left + column, bottom + 7, label, 13, sheet.DIM, "middle")
    for label, row in ticks(frame.bottom, frame.height):
        sheet.fill(left - 5, bottom - 1 - row, 5, 1, sheet.DIM)
        sheet.text(left - 8, bottom - 8 - row, label, 13, sheet.DIM, "right")
    sheet.text(left + frame.width, bottom + 22, f"{frame.axis_name(frame.u)} / {unit}", 13,
               sheet.DIM, "right")
    sheet.text(left - 8, top - 20, f"{frame.axis_name(frame.v)} / {unit}", 13, sheet.DIM, "right")


def format_length(data_units, options):
    metres = data_units * options.length_scale
    unit, factor = length_unit(abs(metres) * 1.0001)
    return f"{metres / factor:.3g} {unit}"


def layout(frame):
    """The sheet's width and height, the upper left corners of its images, a column's width."""
    margin, head, foot, above, below = 64, 62, 30, 84, 48
    column = max(frame.width, 560) + margin
    row = above + frame.height + below
    corners = [(margin + i * column, head + j * row + above) for j in (0, 1) for i in (0, 1)]
    return 2 * column + 24, head + 2 * row + foot, corners, column


def compose(volume, medium, images, frame, used, options):
    (vertical, facts), (horizontal, _), (shadow, _) = images
    k = facts["KScale"]
    _, low, clear, high = medium
    distance = dict(options.settings).get("ScreenDistance", -1)
    distance = frame.depth if distance < 0 else distance
    ends = f"k = {k:.4g}"
    if k > 0:
        ends += f": black to white is {-0.5 / k:.2g} to {0.5 / k:.2g} rad"
    tiles = [
        (volume, "Volume rendering",
         f"n - 1 = {low:.3g} (blue) to {high:.3g} (red), clear at {clear:.3g}"),
        (grey(vertical, 1), "Schlieren, vertical knife edge",
         f"Bright: light deflected to the right. {ends}"),
        (grey(horizontal, 1), "Schlieren, horizontal knife edge",
         f"Bright: light deflected upwards. {ends}"),
        (grey(shadow, 2), "Shadowgraph",
         f"Screen {format_length(distance, options)} behind the flow; black to white is 0 to 2 "
         "times the undisturbed light"),
    ]
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
    for (left, top), (tile, title, line) in zip(corners, tiles):
        sheet.text(left, top - 66, title, 20, room=column - 48)
        sheet.text(left, top - 40, line, 15, sheet.DIM, room=column - 48)
        sheet.paste(left, top, tile[::-1])
        draw_axes(sheet, left, top, frame, options)
    sheet.text(width - 24, height - 26,
               f"{int(facts['RaysTraced']):,} rays, {int(facts['StepsTaken']):,} steps, traced on the "
               f"{facts['Device']}", 13, sheet.DIM, "right")
    return sheet
