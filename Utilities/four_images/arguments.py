# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What the user requests: the command line of the demo. Needs no ParaView."""

import argparse
import ast
import math
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# The example: an axisymmetric jet.
JET = (os.path.join(ROOT, "Testing", "Data", "ladenburg_openfoam", "ladenburg.foam"), "--formula", "p/(287.1*T)",
       "--set", "Symmetry=Axisymmetric")
# In images of it the noise of its cells is removed, by a Gaussian whose standard deviation is one cell; it leaves nothing
# for which more than one ray per pixel would be needed.
SMOOTHED_JET = (*JET, "--set", "SmoothingRadius=7", "--set", "SamplesPerPixel=1")

# Index models, and the property that takes the array.
MODELS = {"Auto": "Density", "Gladstone-Dale": "Density", "Refractive Index": "IndexArray",
          "Refractivity": "IndexArray"}

# Sight lines by name: the direction of sight and what is up in the image.
VIEWS = {
    "x": ((-1, 0, 0), (0, 0, 1)), "-x": ((1, 0, 0), (0, 0, 1)),
    "y": ((0, 1, 0), (0, 0, 1)), "-y": ((0, -1, 0), (0, 0, 1)),
    "z": ((0, 0, -1), (0, 1, 0)), "-z": ((0, 0, 1), (0, 1, 0)),
}


class DemoError(Exception):
    """Something the user can put right. The text says what, why and how."""


def triple(text):
    numbers = [float(part) for part in text.split(",")]
    if len(numbers) != 3 or not all(map(math.isfinite, numbers)):
        raise ValueError
    return numbers


def view_direction(text):
    if text in VIEWS:
        return VIEWS[text]
    try:
        direction = triple(text)
        length = math.hypot(*direction)
        direction = [part / length for part in direction]
    except (ValueError, ZeroDivisionError):
        raise argparse.ArgumentTypeError(
            f"'{text}' is neither x, y, z, -x, -y, -z nor three numbers X,Y,Z")
    return direction, ((0, 0, 1) if abs(direction[2]) < 0.9 else (0, 1, 0))


def vector(text):
    try:
        return triple(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not three numbers X,Y,Z")


def positive(text):
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number above 0")
    return number


def size(text):
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    numbers = tuple(map(int, match.groups())) if match else (0, 0)
    if not all(16 <= number <= 8192 for number in numbers):
        raise argparse.ArgumentTypeError(f"'{text}' is not WIDTHxHEIGHT, 16 to 8192 pixels each")
    return numbers


def setting(text):
    name, equals, value = text.partition("=")
    if not equals or not name.isidentifier():
        raise argparse.ArgumentTypeError(f"'{text}' is not PROPERTY=VALUE")
    try:
        value = value if value == "None" else ast.literal_eval(value)
    except (ValueError, SyntaxError):
        pass  # a word, such as Passes or None
    return name, list(value) if isinstance(value, tuple) else value


FOUR_IMAGES = """\
Writes one PNG with four images of the same view of a flow field: volume rendering, schlieren with
a vertical and with a horizontal knife edge, and shadowgraph. Without FILE: an under-expanded air
jet that comes with the sources. With --all as the first word: all images that the bench can make,
on a contact sheet."""


def parse_arguments(arguments, program="demo", description=FOUR_IMAGES, largest="880x640",
                    ending="_schlieren.png", example=SMOOTHED_JET):
    parser = argparse.ArgumentParser(
        prog=program, formatter_class=argparse.RawDescriptionHelpFormatter, description=description,
        epilog="""\
examples:
  %(prog)s
  %(prog)s flow.vtu --array rho --view y
  %(prog)s case.foam --formula 'p/(287.05*T)' --set Outside=Passes
  %(prog)s bluntfinxyz.bin --view y --density-scale 0.72 --length-scale 0.0127
  %(prog)s plume.vti --set Quality=Fine --set SamplesPerPixel=1""")
    add = parser.add_argument
    add("file", nargs="?", metavar="FILE",
        help="a data set, in any format that ParaView reads; of a PLOT3D pair, the grid file; the "
             "folder of an OpenFOAM case or an AMReX plotfile")
    add("--q", metavar="FILE",
        help="the solution file of a PLOT3D pair, where its name does not follow from the grid's")
    add("--time", type=float, metavar="T", help="the time to read; default: the last one")
    add("--array", metavar="NAME",
        help="point or cell array that holds the density, n or n - 1, as --model says; default: "
             "what the filter chooses by names")
    add("--formula", metavar="F",
        help="instead: computes it from the arrays as ParaView's Calculator does, for example "
             "'p/(287.05*T)'")
    add("--model", choices=MODELS, default="Auto",
        help="what the array holds; default: of --array and --formula, a density (Gladstone-Dale: "
             "n - 1 = K x density), else what its name says")
    add("--constant", type=positive, default=2.26e-4, metavar="K",
        help="Gladstone-Dale constant in m^3/kg; default: %(default)s, air in visible light")
    add("--density-scale", type=positive, default=0, metavar="S",
        help="kg/m^3 for a density of 1; default: by the unit in the array's name, or 1")
    add("--length-scale", type=positive, default=1, metavar="S",
        help="metres for a length of 1; default: 1")
    add("--view", type=view_direction, metavar="x|y|z|X,Y,Z",
        help="the axis to look along: x and z point at the viewer, y away from the viewer, a minus "
             "sign turns that round (--view=-x); or the direction of sight; default: z, of 2-D data "
             "across their plane")
    add("--up", type=vector, metavar="X,Y,Z", help="what is up in the image")
    add("--center", type=vector, metavar="X,Y,Z",
        help="the point in the middle of the image; default: the data's")
    add("--half-height", type=positive, metavar="H",
        help="half the image's height, in the data's unit; default: all of the data is seen")
    add("--size", type=size, metavar="WxH",
        help=f"pixels of each image; default: at most {largest}, in the data's proportions")
    add("--set", type=setting, action="append", default=[], metavar="PROPERTY=VALUE",
        dest="settings", help="any other property of the Schlieren filter; may be repeated")
    add("--output", metavar="PNG", help=f"default: FILE{ending} in the current folder")
    add("--plugin", default=os.environ.get("SCHLIEREN_PLUGIN"), metavar="SO",
        help="the plugin's file; default: the environment variable SCHLIEREN_PLUGIN, which "
             "Utilities/demo sets, else the package paraview-schlieren")
    add("--check", action="store_true", help="check the arguments and stop")
    options = parser.parse_args(arguments)
    if not options.file:
        array = options.array
        options = parser.parse_args([*example, *arguments])
        options.formula = None if array else options.formula

    options.largest = size(largest)
    if options.array and options.formula:
        raise DemoError("--array and --formula are two ways to say the same: give one of them.")
    for path in filter(None, (options.file, options.q)):
        if not os.path.exists(path):
            raise DemoError(f"There is no file '{path}'.")
        if not os.access(path, os.R_OK):
            raise DemoError(f"'{path}' may not be read by you.")
    if options.output is None:
        name = os.path.basename(os.path.abspath(options.file))
        options.output = os.path.splitext(name)[0] + ending
    folder = os.path.dirname(os.path.abspath(options.output))
    if not os.path.isdir(folder) or not os.access(folder, os.W_OK):
        raise DemoError(f"Cannot write '{options.output}': '{folder}' is no folder that you may "
                        "write to.")
    if not options.output.lower().endswith(".png"):
        raise DemoError(f"Cannot write '{options.output}': the image is a PNG, name it *.png.")
    if options.up:
        options.view = options.view or VIEWS["z"]
        cross = [options.view[0][(i + 1) % 3] * options.up[(i + 2) % 3]
                 - options.view[0][(i + 2) % 3] * options.up[(i + 1) % 3] for i in range(3)]
        if math.hypot(*cross) < 1e-6 * math.hypot(*options.up) or not any(options.up):
            raise DemoError("--up points along the line of sight, or nowhere: give another one.")
        options.view = (options.view[0], options.up)
    return options


def options_or_exit(parse):
    """What `parse` makes of the program's arguments; ends the program where they are wrong, or are only
    to be checked."""
    try:
        options = parse(sys.argv[1:])
    except DemoError as problem:
        sys.exit(f"error: {problem}")
    if options.check:
        sys.exit(0)
    return options
