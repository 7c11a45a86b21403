#!/usr/bin/env pvpython
# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the flows of the examples, and compares each with what is known of it.

    pvpython Utilities/example_data/make.py FOLDER [FLOW...]        (bow_shock aerofoil shock_bubble plume mirage tank)
"""

import math
import os
import sys

import numpy as np
from PIL import Image, ImageDraw
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkStructuredGrid
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLStructuredGridWriter

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from euler import GHOSTS, Grid, advance, mirrored, steps_of  # noqa: E402

GAMMA = 1.4
GAS_CONSTANT = 287.05  # J/(kg K), of air


def rounded(values, bits=13):
    """With so many bits of the mantissa, so that files are small."""
    kept = np.asarray(values, np.float32)
    mask = np.uint32(0xFFFFFFFF << (23 - bits) & 0xFFFFFFFF)
    return ((kept.view(np.uint32) + np.uint32(1 << (22 - bits))) & mask).view(np.float32)


def add_arrays(data, arrays, bits=13):
    for name, values in arrays.items():
        array = numpy_to_vtk(rounded(values, bits).ravel(order="F"), deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)


def write(writer, path, data):
    writer.SetFileName(path)
    writer.SetInputData(data)
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToLZMA()
    writer.SetCompressionLevel(9)
    writer.Write()
    print(f"{path}: {os.path.getsize(path) / 1e3:.0f} kB", flush=True)


def write_image(path, origin, spacing, bits=13, **arrays):
    """Arrays [x, y] or [x, y, z]."""
    image = vtkImageData()
    shape = next(iter(arrays.values())).shape
    image.SetDimensions(*shape, *(3 - len(shape)) * (1,))
    image.SetOrigin(*origin)
    image.SetSpacing(*spacing)
    add_arrays(image, arrays, bits)
    write(vtkXMLImageDataWriter(), path, image)


def write_grid(path, x, y, **arrays):
    """Points and arrays [i, j]."""
    grid = vtkStructuredGrid()
    grid.SetDimensions(*x.shape, 1)
    points = vtkPoints()
    places = np.stack([values.ravel(order="F") for values in (x, y, 0 * x)], axis=1).astype(np.float32)
    points.SetData(numpy_to_vtk(places, deep=True))
    grid.SetPoints(points)
    add_arrays(grid, arrays)
    write(vtkXMLStructuredGridWriter(), path, grid)


def at_nodes(values, periodic=False):
    """Of cells [i, j]: means of the cells around each node; at borders those of the cells there, continued."""
    padded = np.pad(values, 1, mode="reflect", reflect_type="odd")
    if periodic:
        padded[0], padded[-1] = padded[-2], padded[1]
    return (padded[1:, 1:] + padded[:-1, 1:] + padded[1:, :-1] + padded[:-1, :-1]) / 4


def settle(state, grid, surround, count, contact, courant=0.7):
    for step in range(count):
        before = state[0]
        state = advance(state, grid, surround, steps_of(state, grid, GAMMA, courant), contact=contact)
        if (step + 1) % 500 == 0:
            print(f"  step {step + 1}: {np.abs(state[0] / before - 1).max():.1e}", flush=True)
    return state


def finer(state):
    """On a grid of twice as many cells along each axis."""
    return state.repeat(2, axis=1).repeat(2, axis=2)


def bow_shock(folder):
    """A sphere, 20 mm wide, at Mach 2 through air of 101325 Pa and 288.15 K."""
    mach, radius, density, pressure = 2, 0.01, 1.225, 101325
    free = np.array([density, mach * np.sqrt(GAMMA * pressure / density), 0, pressure])
    # F. S. Billig 1967, J. Spacecraft Rockets 4, 822: the shock before a sphere, in radii.
    distance = 0.143 * np.exp(3.24 / mach**2)
    curvature = 1.143 * np.exp(0.54 / (mach - 1)**1.2)
    slope = np.arcsin(1 / mach)

    def grid_of(around, across):
        angle = np.linspace(np.pi, 0, around + 1)
        far = np.linspace(1, 9, 8001)[:, None]
        x, y = far * np.cos(angle), far * np.sin(angle)
        # The border is outside of this shock, to 4 radii behind the middle.
        shock = -1 - 1.35 * distance + 1.1 * curvature / np.tan(slope)**2 * (
            np.sqrt(1 + (y * np.tan(slope) / (1.1 * curvature))**2) - 1)
        border = far[np.argmax((x < shock) | (x > 4), axis=0), 0]
        fraction = np.linspace(0, 1, across + 1)
        out = 1 + (border - 1)[:, None] * fraction
        return Grid(radius * out * np.cos(angle)[:, None], radius * out * np.maximum(np.sin(angle), 0)[:, None], True)

    def surround(state, axis):
        if axis == 0:  # the axis of symmetry
            flip = np.ones((4, 1, 1))
            flip[2] = -1
            return np.concatenate([flip * state[:, GHOSTS - 1::-1], state, flip * state[:, :-GHOSTS - 1:-1]], axis=1)
        wall = mirrored(state[:, :, GHOSTS - 1::-1], grid.normals[1][:, :, :1])
        enters = grid.normals[1][0, :, -1] <= 0
        out = np.where(enters | (grid.x[1:, -1] < 3.9 * radius), free[:, None], state[:, :, -1])
        return np.concatenate([wall, state] + GHOSTS * [out[:, :, None]], axis=2)

    state = None
    for fineness, count in ((1, 1500), (2, 1500), (4, 2000)):
        grid = grid_of(50 * fineness, 40 * fineness)
        state = np.tile(free[:, None, None], (1, 50, 40)) if state is None else finer(state)
        state = settle(state, grid, surround, count, contact=False)
    # The shock ahead of the nose is where the density passes the mean of both sides.
    jump = (GAMMA + 1) * mach**2 / ((GAMMA - 1) * mach**2 + 2)
    line, x = state[0, 0, ::-1] / density, grid.centres[0][0, ::-1]
    place = np.interp((1 + jump) / 2, line[:np.argmax(line)], x[:np.argmax(line)])
    print(f"Bow shock: {-place / radius - 1:.4f} radii ahead of the nose; Billig: {distance:.4f}")
    total = pressure * ((GAMMA + 1)**2 * mach**2 / (4 * GAMMA * mach**2 - 2 * (GAMMA - 1)))**(GAMMA / (GAMMA - 1)) * (
        (1 - GAMMA + 2 * GAMMA * mach**2) / (GAMMA + 1))
    print(f"Pressure at the nose: {state[3, 0, 0] / pressure:.4f}; Rayleigh: {total / pressure:.4f}")
    write_grid(os.path.join(folder, "bow_shock.vts"), grid.x, grid.y, rho=at_nodes(state[0]))


def aerofoil(folder):
    """NACA 0012, a chord of 0.1 m, at Mach 0.8 and 1.25 degrees in air of 101325 Pa and 288.15 K."""
    mach, incidence, chord, density, pressure = 0.8, np.radians(1.25), 0.1, 1.225, 101325
    speed = mach * np.sqrt(GAMMA * pressure / density)
    free = np.array([density, speed * np.cos(incidence), speed * np.sin(incidence), pressure])

    def grid_of(around, across):
        # The surface in the plane where the line from within the nose to the trailing edge is a circle.
        t = np.linspace(0, 2 * np.pi, 20001)[1:-1]
        x = (1 + np.cos(t)) / 2
        y = -np.sign(np.sin(t)) * 0.6 * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
        nose, half = 0.0079, (1 - 0.0079) / 2
        plane = (x - nose) / half - 1 + 1j * y / half
        root = np.sqrt(plane - 1) * np.sqrt(plane + 1)
        circle = plane + np.where((root * plane.conj()).real >= 0, root, -root)
        angle = np.unwrap(np.angle(circle))
        order = np.argsort(angle)
        angle, size = angle[order], np.abs(circle)[order]
        a = np.linspace(0, -2 * np.pi, around + 1)  # clockwise
        surface = np.interp(a, np.concatenate([angle - 2 * np.pi, angle, angle + 2 * np.pi]), np.tile(size, 3))
        surface[[0, -1]] = 1
        fraction = np.linspace(0, 1, across + 1)
        far = surface[:, None] * (100 / surface[:, None])**(fraction**1.15)
        zeta = far * np.exp(1j * a)[:, None]
        z = (zeta + 1 / zeta) / 2
        z[-1] = z[0]
        return Grid(chord * (nose + half * (1 + z.real)), chord * half * z.imag)

    def surround(state, axis):
        if axis == 0:
            return np.concatenate([state[:, -GHOSTS:], state, state[:, :GHOSTS]], axis=1)
        wall = mirrored(state[:, :, GHOSTS - 1::-1], grid.normals[1][:, :, :1])
        return np.concatenate([wall, state] + GHOSTS * [np.tile(free[:, None, None], (1, state.shape[1], 1))], axis=2)

    state = None
    for fineness, count in ((1, 3000), (2, 3000), (4, 3000)):
        grid = grid_of(64 * fineness, 32 * fineness)
        state = np.tile(free[:, None, None], (1, 64, 32)) if state is None else finer(state)
        state = settle(state, grid, surround, count, contact=True)
        force = (state[3, :, 0] * grid.normals[1][:, :, 0]).sum(axis=1) / (0.5 * density * speed**2 * chord)
        lift = -(force[1] * np.cos(incidence) - force[0] * np.sin(incidence))
        pressures = (state[3, :, 0] - pressure) / (0.5 * density * speed**2)
        x = grid.centres[0][:, 0] / chord
        upper = grid.centres[1][:, 0] > 0
        steepest = x[upper][np.argmax(np.gradient(pressures[upper], x[upper]) * (x[upper] < 0.95) * (x[upper] > 0.2))]
        print(f"Aerofoil: lift {lift:.3f}, drag {-(force[0] * np.cos(incidence) + force[1] * np.sin(incidence)):.4f}, "
              f"shock at {steepest:.3f} chords (AGARD AR-211: 0.35 to 0.36, 0.022 to 0.023, 0.62 to 0.63)")
    near = np.argmax(np.hypot(grid.x[0] - chord / 2, grid.y[0]) > 2.2 * chord) + 1
    write_grid(os.path.join(folder, "aerofoil.vts"), grid.x[:, :near], grid.y[:, :near],
               rho=at_nodes(state[0], periodic=True)[:, :near])


def shock_bubble(folder):
    """A shock of Mach 1.22 meets a cylinder of helium, 50 mm wide, in a tube of 89 mm (J.-F. Haas and B. Sturtevant 1987, J.
    Fluid Mech. 181, 41), whose helium had 28 % of air in it, by mass."""
    mach, density, pressure, spacing = 1.22, 1.2041, 101325, 0.5e-3
    air, helium, fraction = 28.964, 4.0026, 0.72
    columns, rows = 400, 89  # the upper half
    nodes = np.meshgrid(spacing * np.arange(columns + 1), spacing * np.arange(rows + 1), indexing="ij")
    grid = Grid(*nodes)
    x, y = grid.centres
    moles = fraction / helium / (fraction / helium + (1 - fraction) / air)
    radius = np.hypot(x - 0.065, y)
    share = np.clip((0.025 - radius) / spacing + 0.5, 0, 1)  # of each cell's volume that is in the bubble
    light = density / air / (fraction / helium + (1 - fraction) / air)
    rho = density + share * (light - density)
    inverse = 2.5 + share * moles * (1.5 - 2.5)  # by volume, at one pressure
    at_rest = np.stack([rho, 0 * x, 0 * x, 0 * x + pressure, share * light * fraction / rho, inverse])
    square = mach**2
    behind = density * (GAMMA + 1) * square / ((GAMMA - 1) * square + 2)
    celerity = mach * np.sqrt(GAMMA * pressure / density)
    shocked = np.array([behind, celerity * (1 - density / behind), 0,
                        pressure * (1 + 2 * GAMMA / (GAMMA + 1) * (square - 1)), 0, 2.5])
    start = 0.03
    state = np.where(x < start, shocked[:, None, None], at_rest)

    def surround(state, axis):
        if axis == 0:
            return np.concatenate(GHOSTS * [state[:, :1]] + [state] + GHOSTS * [state[:, -1:]], axis=1)
        flip = np.ones((6, 1, 1))
        flip[2] = -1
        return np.concatenate([flip * state[:, :, GHOSTS - 1::-1], state, flip * state[:, :, :-GHOSTS - 1:-1]], axis=2)

    shown = np.arange(16) * 25e-6 + 15e-6
    times, time = [], 0
    front = []
    for number, moment in enumerate(shown):
        while time < moment:
            seconds = min(steps_of(state, grid, GAMMA, 0.6).min(), moment - time)
            state = advance(state, grid, surround, seconds)
            time += seconds
        if number < 4:  # what has crossed the bubble, and is faster, is not yet at the wall
            along, level = state[3, :, -1], (pressure + shocked[3]) / 2
            ahead = np.flatnonzero(along > level)[-1] + np.array([1, 0])
            front.append(np.interp(level, along[ahead], x[ahead, 0]))
        whole = [np.concatenate([state[row][:, ::-1], state[row]], axis=1) for row in (0, 4)]
        name = f"shock_bubble_{number:02d}.vti"
        write_image(os.path.join(folder, name), (spacing / 2, spacing * (0.5 - rows), 0), 3 * (spacing,), rho=whole[0],
                    Y_He=np.where(whole[1] > 1e-6, whole[1], 0))
        times.append(f'    <DataSet timestep="{moment:.3e}" file="{name}"/>\n')
    with open(os.path.join(folder, "shock_bubble.pvd"), "w", encoding="utf-8") as file:
        file.write(f'<VTKFile type="Collection">\n  <Collection>\n{"".join(times)}  </Collection>\n</VTKFile>\n')
    found = np.polyfit(shown[:4], front, 1)[0]
    print(f"Shock at the wall: {found:.1f} m/s, {celerity:.1f} by its Mach number")


def plume(folder):
    """The laminar plume above a heater of 1 W in air of 293.15 K and 101325 Pa, from 75 mm above its origin on.

    For a Prandtl number of 1 (that of air is 0.71) and small differences of temperature it has a closed form (C.-S. Yih 1951,
    Proc. 1st US Nat. Congr. Appl. Mech., 941): with s = (r / width)^2, width^2 = 12 nu z / w0, the speed is w0 / (1 + s)^2 and
    the excess temperature t0 / (1 + s)^3, where t0 = heat / (3 pi rho c nu z) and w0^2 = 3 g z t0 / (2 T).
    """
    heat, viscosity, ambient = 1, 1.5e-5, 293.15
    capacity = 101325 / (GAS_CONSTANT * ambient) * 1006  # J/(m^3 K)
    spacing = 0.25e-3
    r, z = np.meshgrid(spacing * np.arange(81), 0.075 + spacing * np.arange(161), indexing="ij")
    excess = heat / (3 * np.pi * capacity * viscosity * z)
    speed = np.sqrt(3 * 9.81 * z * excess / (2 * ambient))
    square = r**2 * speed / (12 * viscosity * z)
    temperature = ambient + excess / (1 + square)**3
    carried = (2 * np.pi * r * capacity * (temperature - ambient) * speed / (1 + square)**2).sum(axis=0) * spacing
    print(f"Plume: {excess[0, 0]:.0f} to {excess[0, -1]:.0f} K at {speed[0, 0]:.2f} m/s; carries {carried[0]:.4f} to "
          f"{carried[-1]:.4f} W of {heat}")
    write_image(os.path.join(folder, "plume.vti"), (0, z[0, 0], 0), 3 * (spacing,), T=temperature)


def mirage(folder):
    """The air over 300 m of a road that is 30 K hotter: the excess falls to 1/e in 20 mm. Beside it what is behind the road, as an
    eye 0.25 m above it sees it: an image, 15.7 x 7.9 m large, of a car, two posts and trees."""
    y = np.arange(0, 0.501, 0.004)
    temperature = 303.15 + 30 * np.exp(-y / 0.02)
    write_image(os.path.join(folder, "mirage.vti"), (-10, 0, -300), (10, y[1], 150),
                T=np.tile(temperature[None, :, None], (3, 1, 3)))
    size, metre = 512, 1024 / 15.76
    scene = Image.new("RGB", (2 * size, size), (118, 116, 112))
    draw = ImageDraw.Draw(scene)
    ground = size / 2 + 0.25 * metre

    def put(shape, left, low, right, high, color):
        """In metres, from the middle to the right and from the ground up."""
        shape((size + left * metre, ground - high * metre, size + right * metre, ground - low * metre), fill=color)

    for row in range(int(ground) + 1):
        color = tuple(round(first + (last - first) * row / ground) for first, last in ((92, 214), (142, 228), (206, 240)))
        draw.line((0, row, 2 * size, row), fill=color)
    for left, high in ((-7, 3), (-5.2, 3.6), (-3.6, 2.8), (2.6, 3.2), (4.3, 2.6), (5.8, 3.7)):
        put(draw.rectangle, left + 0.5, 0, left + 0.65, high / 2, (70, 52, 36))
        put(draw.ellipse, left, high / 3, left + 1.15, high, (38, 82, 44))
    for left in (-1.9, 1.8):
        put(draw.rectangle, left, 0, left + 0.12, 1, (240, 240, 240))
        put(draw.rectangle, left, 0.65, left + 0.12, 0.85, (200, 30, 30))
    put(draw.rectangle, -0.8, 0, -0.5, 0.4, (25, 25, 25))
    put(draw.rectangle, 0.5, 0, 0.8, 0.4, (25, 25, 25))
    put(draw.rounded_rectangle, -0.7, 0.7, 0.7, 1.45, (150, 20, 20))
    put(draw.rectangle, -0.55, 0.9, 0.55, 1.32, (190, 215, 230))
    put(draw.rounded_rectangle, -0.9, 0.25, 0.9, 0.9, (175, 25, 25))
    for left in (-0.75, 0.45):
        put(draw.ellipse, left, 0.5, left + 0.3, 0.8, (255, 250, 200))
    scene.quantize(64).save(os.path.join(folder, "mirage.png"), optimize=True)


def tank(folder):
    """Salt water of 35 kg/m^3 below fresh water, an hour after a wall between them was pulled out: salt diffuses.

    The density has the shape of the error function, whose scale is sqrt(4 D t) (D = 1.5e-9 m^2/s, of sodium chloride); the index
    is that of S. B. Dalziel, G. O. Hughes and B. R. Sutherland 2000 (Exp. Fluids 28, 322).
    """
    y = np.linspace(-0.03, 0.03, 241)
    scale = np.sqrt(4 * 1.5e-9 * 3600)
    salt = 12.5 * np.array([math.erfc(height / scale) for height in y])
    index = np.tile((1.3332 + 2.457e-4 * salt)[None, :, None], (3, 1, 3))
    write_image(os.path.join(folder, "tank.vti"), (-0.05, y[0], -0.01), (0.05, y[1] - y[0], 0.01), bits=21, n=index)


def main():
    folder, chosen = sys.argv[1], sys.argv[2:]
    for flow in (bow_shock, aerofoil, shock_bubble, plume, mirage, tank):
        if not chosen or flow.__name__ in chosen:
            flow(folder)


if __name__ == "__main__":
    main()
