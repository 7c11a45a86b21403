# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A simulation that is looked at while it runs: a shock in air meets a bubble of hot gas.

    mpiexec -np 4 pvbatch --sym Examples/in_situ/shock_and_bubble.py          (writes schlieren_0000.png and so on)

Each rank computes a slab of the box and hands it to ParaView Catalyst, which runs schlieren_catalyst.py beside this
file. The solver is a short one of the Euler equations in three dimensions: finite volumes, van Leer's slopes, HLLC
fluxes (Toro 2009, ch. 10), two stages of Runge and Kutta a step. Arrays hold density, the three velocities and the
pressure: [5, x, y, z], with two cells of the neighbours around.
"""

import argparse
import os

import numpy as np
from mpi4py import MPI
from paraview.catalyst import bridge
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

GAMMA = 1.4
AIR = np.array([1.2, 0, 0, 0, 101325])  # kg/m^3, m/s, Pa
MACH = 1.5
LENGTH, WIDTH = 0.12, 0.06  # m, of the box
SHOCK_AT, BUBBLE_AT, BUBBLE_RADIUS = 0.012, 0.04, 0.012
HALO = 2


def behind_shock():
    """Rankine and Hugoniot: what is behind a shock that runs to the right into air at rest."""
    square = MACH**2
    density = AIR[0] * (GAMMA + 1) * square / ((GAMMA - 1) * square + 2)
    pressure = AIR[4] * (1 + 2 * GAMMA / (GAMMA + 1) * (square - 1))
    speed = MACH * np.sqrt(GAMMA * AIR[4] / AIR[0]) * (1 - AIR[0] / density)
    return np.array([density, speed, 0, 0, pressure])


def conserved(state):
    density, pressure = state[0], state[4]
    energy = pressure / (GAMMA - 1) + density * (state[1:4]**2).sum(axis=0) / 2
    return np.concatenate([density[None], density * state[1:4], energy[None]])


def primitive(totals):
    density, velocity = totals[0], totals[1:4] / totals[0]
    pressure = (GAMMA - 1) * (totals[4] - density * (velocity**2).sum(axis=0) / 2)
    return np.concatenate([density[None], velocity, pressure[None]])


def hllc(left, right, axis):
    """Fluxes through faces between two states along an axis."""
    normal = 1 + axis
    sound = [np.sqrt(GAMMA * state[4] / state[0]) for state in (left, right)]
    slowest = np.minimum(left[normal] - sound[0], right[normal] - sound[1])
    fastest = np.maximum(left[normal] + sound[0], right[normal] + sound[1])
    through = [state[0] * (speed - state[normal]) for state, speed in ((left, slowest), (right, fastest))]
    pushed = right[4] - left[4] + left[normal] * through[0] - right[normal] * through[1]
    contact = pushed / (through[0] - through[1])
    flux = np.zeros_like(left)
    for state, mass, wave, is_here in ((left, through[0], slowest, contact >= 0),
                                       (right, through[1], fastest, contact < 0)):
        totals = conserved(state)
        of_state = totals * state[normal]
        of_state[normal] += state[4]
        of_state[4] += state[4] * state[normal]
        beside = np.empty_like(totals)
        beside[0] = mass / (wave - contact)
        beside[1:4] = beside[0] * state[1:4]
        beside[normal] = beside[0] * contact
        beside[4] = beside[0] * (totals[4] / state[0] + (contact - state[normal]) * (contact + state[4] / mass))
        is_outside = slowest >= 0 if state is left else fastest <= 0
        flux = np.where(is_here, np.where(is_outside, of_state, of_state + wave * (beside - totals)), flux)
    return flux


def change(state, spacing):
    """Of the totals in the inner cells, per second."""
    result = 0
    inner = slice(HALO, -HALO)
    for axis in range(3):
        here = [slice(None), inner, inner, inner]
        here[1 + axis] = slice(None)
        line = np.moveaxis(state[tuple(here)], 1 + axis, -1)
        ahead, behind = line[..., 2:] - line[..., 1:-1], line[..., 1:-1] - line[..., :-2]
        product = ahead * behind
        slope = np.where(product > 0, 2 * product / np.where(product > 0, ahead + behind, 1), 0)
        middle = line[..., 1:-1]
        flux = hllc((middle + slope / 2)[..., :-1], (middle - slope / 2)[..., 1:], axis)
        result = result - np.moveaxis(np.diff(flux, axis=-1), -1, 1 + axis) / spacing
    return result


class Slab:
    """The cells of a rank: those from `first` to before `last` along x, all along y and z."""

    def __init__(self, cells, ranks):
        self.ranks = ranks
        rank, number = ranks.Get_rank(), ranks.Get_size()
        self.cells = np.array([cells, cells // 2, cells // 2])
        self.spacing = LENGTH / cells
        self.first, self.last = cells * rank // number, cells * (rank + 1) // number
        x = (np.arange(self.first, self.last) + 0.5) * self.spacing
        across = (np.arange(cells // 2) + 0.5) * self.spacing - WIDTH / 2
        x, y, z = np.meshgrid(x, across, across, indexing="ij")
        bubble = np.exp(-((x - BUBBLE_AT)**2 + y**2 + z**2) / BUBBLE_RADIUS**2)
        self.state = np.empty((5, *x.shape))
        self.state[...] = AIR[:, None, None, None]
        self.state[0] -= 0.8 * AIR[0] * bubble
        self.state = np.where(x < SHOCK_AT, behind_shock()[:, None, None, None], self.state)

    def with_neighbours(self, state):
        """With two cells more on each side: of the ranks beside, or those that are next to the box's walls."""
        whole = np.pad(state, [(0, 0)] + 3 * [(HALO, HALO)], mode="edge")
        rank, number = self.ranks.Get_rank(), self.ranks.Get_size()
        below, above = (rank - 1 if rank > 0 else MPI.PROC_NULL), (rank + 1 if rank + 1 < number else MPI.PROC_NULL)
        for target, source, sent, got in ((below, above, slice(HALO, 2 * HALO), slice(-HALO, None)),
                                          (above, below, slice(-2 * HALO, -HALO), slice(0, HALO))):
            received = np.ascontiguousarray(whole[:, got])
            self.ranks.Sendrecv(np.ascontiguousarray(whole[:, sent]), target, 0, received, source, 0)
            whole[:, got] = received
        return whole

    def advance(self):
        """A step of all ranks. Returns how long it was."""
        speed = np.abs(self.state[1:4]).max(axis=0) + np.sqrt(GAMMA * self.state[4] / self.state[0])
        seconds = 0.3 * self.spacing / self.ranks.allreduce(speed.max(), MPI.MAX)
        before = conserved(self.state)
        first = primitive(before + seconds * change(self.with_neighbours(self.state), self.spacing))
        second = conserved(first) + seconds * change(self.with_neighbours(first), self.spacing)
        self.state = primitive((before + second) / 2)
        return seconds

    def for_vtk(self):
        """The slab as VTK has it, and the extent of the whole box."""
        image = vtkImageData()
        image.SetExtent(self.first, self.last, 0, int(self.cells[1]), 0, int(self.cells[2]))
        image.SetOrigin(0, -WIDTH / 2, -WIDTH / 2)
        image.SetSpacing(3 * [self.spacing])
        density = numpy_to_vtk(self.state[0].ravel(order="F"), deep=True)  # x first
        density.SetName("rho")
        image.GetCellData().AddArray(density)
        whole = [0, int(self.cells[0]), 0, int(self.cells[1]), 0, int(self.cells[2])]
        return image, whole


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, default=96, help="along the box (default: %(default)s), half as many across")
    parser.add_argument("--steps", type=int, default=240, help="of the simulation (default: %(default)s)")
    parser.add_argument("--every", type=int, default=20, help="so many steps Catalyst is called (default: %(default)s)")
    options = parser.parse_args()
    bridge.initialize()
    bridge.add_pipeline(os.path.join(os.path.dirname(os.path.abspath(__file__)), "schlieren_catalyst.py"), 2)
    slab = Slab(options.cells, MPI.COMM_WORLD)
    time = 0
    for step in range(options.steps + 1):
        if step % options.every == 0:
            image, whole = slab.for_vtk()
            bridge.coprocess(time, step, image, name="gas", wholeExtent=whole)
        time += slab.advance()
    bridge.finalize()


main()
