# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A background-oriented (BOS) and a schlieren bench from their data sheets: pixels, blur, the least deflection that can be
seen, and what the flow must be for it. Documentation/bench.md explains the numbers.

    python3 Examples/bos_bench.py [--help]        (prints them; takes no ParaView)
"""

import argparse
from types import SimpleNamespace


def bos(pixels=(2448, 2048), pixel=3.45e-6, focal=0.05, f_number=8, to_flow=0.5, to_background=0.5, found=0.05, depth=0.1,
        constant=2.26e-4, wavelength=550e-9, density=1.2, temperature=293.15):
    """
    Numbers of a background-oriented bench, whose camera is focused on the background.

    pixels: of the sensor, columns and rows. pixel: their width, m. focal: of the lens, m. f_number: of the lens.
    to_flow: from the lens to the flow, m. to_background: from the flow to the background, m. found: the least
    displacement that the evaluation finds, pixels. depth: of the flow along the light, m. constant: of Gladstone and Dale,
    m^3/kg. wavelength: of the light, m. density, temperature: of the gas around, kg/m^3 and K.

    Deflection and displacement: Raffel 2015, Experiments in Fluids 56, 60. Circle of confusion and Airy disc: geometric and
    Fraunhofer optics of a thin lens. One quarter of a window: Keane and Adrian 1990, Measurement Science and Technology 1,
    1202. Lengths in m, angles in rad, densities in kg/m^3.
    """
    distance = to_flow + to_background
    if not (distance > focal > 0 and min(to_flow, to_background, pixel, f_number, depth) > 0):
        raise ValueError("The background must be further away than the focal length, and all lengths above 0.")
    bench = SimpleNamespace()
    bench.magnification = focal / (distance - focal)
    bench.pixel_background = pixel / bench.magnification
    bench.pixel_flow = bench.pixel_background * to_flow / distance
    bench.width_flow, bench.height_flow = (count * bench.pixel_flow for count in pixels)
    bench.blur_flow = focal / f_number * to_background / distance
    bench.airy = 2.44 * wavelength * f_number * (1 + bench.magnification)
    bench.pixels_per_radian = to_background / bench.pixel_background
    bench.least_deflection = found / bench.pixels_per_radian
    bench.largest_deflection = 8 / bench.pixels_per_radian  # a quarter of a window of 32 pixels
    bench.least_gradient = bench.least_deflection / (constant * depth)
    bench.least_change = bench.least_gradient * bench.blur_flow
    bench.least_heat = temperature * bench.least_change / density
    # The property SensorWidth is that of a lens focused on infinity: of this one, what has the same angle.
    bench.sensor_width = pixels[0] * pixel / (1 + bench.magnification)
    return bench


def schlieren(focal=1.0, source=1e-3, seen=0.01, depth=0.1, constant=2.26e-4):
    """
    Numbers of a bench with a knife edge: Settles 2001, Schlieren and Shadowgraph Techniques, chapter 3.

    focal: of the second mirror, m. source: width of the source's image across the edge, m. seen: the least change of the
    light that can be seen, of full scale. depth, constant: as of bos().
    """
    bench = SimpleNamespace(k=focal / source)
    bench.full_deflection = 0.5 / bench.k
    bench.least_deflection = seen / bench.k
    bench.least_gradient = bench.least_deflection / (constant * depth)
    return bench


def main():
    parser = argparse.ArgumentParser(description="Prints the numbers of a BOS bench and of a schlieren bench.")
    add = parser.add_argument
    add("--pixels", type=int, nargs=2, default=(2448, 2048), metavar=("COLUMNS", "ROWS"), help="default: 2448 2048")
    add("--pixel", type=float, default=3.45, help="width of a pixel, micrometres; default: %(default)s")
    add("--focal", type=float, default=50, help="focal length of the lens, mm; default: %(default)s")
    add("--f-number", type=float, default=8, help="default: %(default)s")
    add("--to-flow", type=float, default=0.5, help="from the lens to the flow, m; default: %(default)s")
    add("--to-background", type=float, default=0.5, help="from the flow to the background, m; default: %(default)s")
    add("--found", type=float, default=0.05, help="least displacement that is found, pixels; default: %(default)s")
    add("--depth", type=float, default=0.1, help="of the flow along the light, m; default: %(default)s")
    add("--mirror", type=float, default=1, help="focal length of the schlieren mirror, m; default: %(default)s")
    add("--source", type=float, default=1, help="width of the source's image, mm; default: %(default)s")
    options = parser.parse_args()
    try:
        b = bos(options.pixels, 1e-6 * options.pixel, 1e-3 * options.focal, options.f_number, options.to_flow,
                options.to_background, options.found, options.depth)
    except ValueError as problem:
        parser.error(str(problem))
    print(f"""\
BOS, camera focused on the background
  a pixel on the background     {1e6 * b.pixel_background:8.1f} um
  a pixel in the flow           {1e6 * b.pixel_flow:8.1f} um
  seen of the flow              {1e3 * b.width_flow:8.1f} mm x {1e3 * b.height_flow:.1f} mm
  blur in the flow              {1e3 * b.blur_flow:8.2f} mm = {b.blur_flow / b.pixel_flow:.0f} pixels
  Airy disc on the sensor       {1e6 * b.airy:8.1f} um = {b.airy / (1e-6 * options.pixel):.1f} pixels
  1 mrad moves the background   {1e-3 * b.pixels_per_radian:8.2f} pixels
  least deflection              {1e6 * b.least_deflection:8.2f} urad ({options.found:g} pixels)
  largest, windows of 32 pixels {1e3 * b.largest_deflection:8.2f} mrad (8 pixels)
  least density gradient        {b.least_gradient:8.3f} kg/m^4 over {options.depth:g} m of depth
  over the blur                 {b.least_change:8.5f} kg/m^3, or {b.least_heat:.2f} K in air at 20 C
  in ParaView                   Cutoff="Background Oriented", SensorWidth={1e3 * b.sensor_width:.4g}, \
LensFocalLength={options.focal:g}, FNumber={options.f_number:g},
                                ParallelScale={b.height_flow / 2:.4g}
""")
    s = schlieren(options.mirror, 1e-3 * options.source, depth=options.depth)
    print(f"""\
Knife edge
  k                             {s.k:8.0f} 1/rad
  grey to white                 {1e3 * s.full_deflection:8.2f} mrad
  least deflection              {1e6 * s.least_deflection:8.2f} urad (1 % of full scale)
  least density gradient        {s.least_gradient:8.3f} kg/m^4 over {options.depth:g} m of depth
  in ParaView                   Cutoff="Knife Edge", KMode="Bench", MirrorFocalLength={options.mirror:g}, SourceWidth={options.source:g}""")


if __name__ == "__main__":
    main()
