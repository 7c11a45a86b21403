# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The first image of the README: five seconds of a jet, whose knife edge is turned once, and which is then turned itself.

    pvpython Documentation/scripts/animation.py [FILE]        (writes jet.webp)

The corner shows the knife edge in the cutoff plane: black is what it covers.
"""

import math
import os
import sys

from paraview import servermanager
from paraview.simple import *
from PIL import Image, ImageDraw

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "Examples"))
from load_schlieren import load_schlieren  # noqa: E402

load_schlieren(globals())
from schlieren_figure import pixels_of  # noqa: E402, which comes with the plugin

SECONDS, PER_SECOND = 5, 12
RADIUS, ZOOM = 26, 4  # of the cutoff plane in the corner, pixels; smoothed by so many points along each


def with_knife(pixels, degrees):
    """An image (rows x columns x 3 bytes, lowest row first) with the knife edge in its lower right corner."""
    image = Image.fromarray(pixels[::-1])
    plane = Image.new("L", 2 * (2 * RADIUS * ZOOM,), 255)
    # Light that is bent towards the angle passes, so that the knife is on the other side. Angles of PIL run clockwise.
    middle = 180 - degrees
    ImageDraw.Draw(plane).pieslice((0, 0, plane.width - 1, plane.height - 1), middle - 90, middle + 90, fill=0)
    disc = Image.new("L", plane.size, 0)
    ImageDraw.Draw(disc).ellipse((0, 0, plane.width - 1, plane.height - 1), fill=255)
    size = 2 * (2 * RADIUS,)
    image.paste(plane.resize(size, Image.LANCZOS).convert("RGB"),
                tuple(whole - own - 10 for whole, own in zip(image.size, size)), disc.resize(size, Image.LANCZOS))
    return image


def main(path):
    jet = OpenFOAMReader(FileName=os.path.join(ROOT, "Testing", "Data", "ladenburg_openfoam", "ladenburg.foam"))
    jet.CellArrays = ["p", "T"]
    last = jet.TimestepValues[-1]
    jet.UpdatePipeline(last)
    schlieren = Schlieren(Input=jet, KMode="Value", KScale=250, ImageSize=[560, 300],  # noqa: F821
                          FocalPoint=[0.0135, 0, 0], ParallelScale=0.0076, Quality="Fine")
    frames = []
    for frame in range(SECONDS * PER_SECOND):
        time = frame / PER_SECOND
        edge = 90 + 360 * min(time / 2, 1)
        turned = math.radians(70) * math.sin(math.pi * max(time - 2, 0) / 3) ** 2
        schlieren.KnifeEdgeAngle = edge % 360
        schlieren.ViewDirection = [math.sin(turned), 0, -math.cos(turned)]
        schlieren.UpdatePipeline(last)
        frames.append(with_knife(pixels_of(servermanager.Fetch(schlieren)), edge))
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=1000 // PER_SECOND, loop=0, quality=95, method=6)
    print(f"{os.path.abspath(path)}: {len(frames)} images, {os.path.getsize(path) / 1e6:.2f} MB")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "jet.webp")
