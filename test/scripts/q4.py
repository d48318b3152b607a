"""A small explicit finite-element program, independent of the solver: the reference of the hill (V15).

Bilinear quadrilaterals (2 x 2 Gauss points), plane strain, small strains, linear elastic, lumped mass, central
differences. The base is compliant (Lysmer & Kuhlemeyer 1969), the sides are tied to one-dimensional columns (free
field). SI units, x right, y up, tension positive.
"""
import dataclasses

import numpy
import scipy.sparse


@dataclasses.dataclass
class Material:
    density: float  # kg/m3
    young: float  # Pa
    poisson: float

    @property
    def shear(self):
        return self.young / (2 * (1 + self.poisson))

    @property
    def lame(self):
        return self.young * self.poisson / ((1 + self.poisson) * (1 - 2 * self.poisson))

    @property
    def shear_impedance(self):
        return numpy.sqrt(self.density * self.shear)

    @property
    def pressure_impedance(self):
        return numpy.sqrt(self.density * (self.lame + 2 * self.shear))


class Mesh:
    """Columns of quadrilaterals between lines y(x). `lines` are functions of x from the bottom up; layer k, between
    lines k and k + 1, has rows[k] elements over its height and the material materials[k]."""

    def __init__(self, x, lines, rows, materials):
        heights = [numpy.broadcast_to(line(x), x.shape) for line in lines]
        y = [heights[0]]
        self.materials, self.layer_of_row = materials, []
        for k, count in enumerate(rows):
            for j in range(1, count + 1):
                y.append(heights[k] + (heights[k + 1] - heights[k]) * j / count)
                self.layer_of_row.append(k)
        self.y = numpy.array(y).T  # [column, node of the column]
        self.x = numpy.broadcast_to(x[:, None], self.y.shape)
        self.shape = self.y.shape
        number = numpy.arange(self.y.size).reshape(self.shape)
        corners = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
        self.elements = numpy.stack([c.ravel() for c in corners], axis=1)  # counter-clockwise
        self.layer = numpy.tile(self.layer_of_row, len(x) - 1)

    def nearest(self, x, y):
        """Number of the node nearest to a place, in m."""
        return int(numpy.argmin(numpy.hypot(self.x - x, self.y - y)))


def element_matrices(mesh):
    """Stiffness [element, 8, 8] and lumped masses (row sums) [element, 4] of all elements."""
    xy = numpy.stack([mesh.x.ravel()[mesh.elements], mesh.y.ravel()[mesh.elements]], axis=2)
    lame = numpy.array([m.lame for m in mesh.materials])[mesh.layer]
    shear = numpy.array([m.shear for m in mesh.materials])[mesh.layer]
    density = numpy.array([m.density for m in mesh.materials])[mesh.layer]
    D = numpy.zeros((len(lame), 3, 3))
    D[:, 0, 0] = D[:, 1, 1] = lame + 2 * shear
    D[:, 0, 1] = D[:, 1, 0] = lame
    D[:, 2, 2] = shear
    stiffness = numpy.zeros((len(lame), 8, 8))
    mass = numpy.zeros((len(lame), 4))
    sign = numpy.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    for a in (-1, 1):
        for b in (-1, 1):
            gauss = numpy.array([a, b]) / numpy.sqrt(3)
            slope = 0.25 * sign * (1 + sign[:, ::-1] * gauss[::-1])  # dN/d(xi, eta)
            jacobian = numpy.einsum("na,enb->eab", slope, xy)
            grad = numpy.einsum("eab,nb->ena", numpy.linalg.inv(jacobian), slope)
            size = numpy.linalg.det(jacobian)
            B = numpy.zeros((len(lame), 3, 8))
            B[:, 0, 0::2] = B[:, 2, 1::2] = grad[:, :, 0]
            B[:, 1, 1::2] = B[:, 2, 0::2] = grad[:, :, 1]
            stiffness += numpy.einsum("eki,ekl,elj,e->eij", B, D, B, size, optimize=True)
            mass += (density * size)[:, None] * 0.25 * numpy.prod(1 + sign * gauss, axis=1)
    return stiffness, mass


class Column:
    """The one-dimensional ground of a side: the mesh's outermost column of nodes, on a compliant base. Displacements
    and stresses of the elements between them."""

    def __init__(self, mesh, side):
        self.dy = numpy.diff(mesh.y[side])
        of_row = [mesh.materials[k] for k in mesh.layer_of_row]
        self.shear = numpy.array([m.shear for m in of_row])
        self.lame = numpy.array([m.lame for m in of_row])
        self.moduli = numpy.stack([self.shear, self.lame + 2 * self.shear], axis=1)
        half = 0.5 * numpy.array([m.density for m in of_row]) * self.dy
        self.mass = numpy.append(half, 0) + numpy.append(0, half)
        base = mesh.materials[0]
        self.dashpot = numpy.zeros((len(self.mass), 2))
        self.dashpot[0] = base.shear_impedance, base.pressure_impedance
        self.u = numpy.zeros((len(self.mass), 2))
        self.v = numpy.zeros_like(self.u)
        # Edge integrals of the elements' stress and impedance, for the side of the model.
        self.edge_shear = self._lump(numpy.array([m.shear_impedance for m in of_row]) * self.dy)
        self.edge_pressure = self._lump(numpy.array([m.pressure_impedance for m in of_row]) * self.dy)

    @staticmethod
    def _lump(integral):
        return 0.5 * (numpy.append(integral, 0) + numpy.append(0, integral))

    def traction(self):
        """Nodal forces (x, y) of sigma_xx and sigma_xy on a face that looks to +x, at the present displacements."""
        strain = numpy.diff(self.u, axis=0) / self.dy[:, None]
        return numpy.stack([self._lump(self.lame * strain[:, 1] * self.dy),
                            self._lump(self.shear * strain[:, 0] * self.dy)], axis=1)

    def step(self, incoming, dt):
        """Returns the velocity in the middle of the old and the new half step."""
        stress = self.moduli * numpy.diff(self.u, axis=0) / self.dy[:, None]
        force = numpy.zeros_like(self.u)
        force[:-1] += stress
        force[1:] -= stress
        force += 2 * self.dashpot * incoming
        old = self.v
        half = 0.5 * dt * self.dashpot
        self.v = ((self.mass[:, None] - half) * old + dt * force) / (self.mass[:, None] + half)
        self.u = self.u + dt * self.v
        return 0.5 * (old + self.v)


def shake(mesh, upgoing, duration, gauges, courant=0.9, load=None):
    """Velocities (m/s) of the nodes `gauges` under the upgoing wave: upgoing(t) gives its (x, y) velocity at the
    base, load(t) vertical forces (N per m) at the nodes of the surface. Returns times (s) and velocities
    [time, gauge, 2]."""
    stiffness, mass = element_matrices(mesh)
    nodes = mesh.shape[0] * mesh.shape[1]
    # The greatest frequency of any element bounds that of the mesh (Irons).
    root = numpy.repeat(1 / numpy.sqrt(mass), 2, axis=1)
    greatest = numpy.linalg.eigvalsh(root[:, :, None] * stiffness * root[:, None, :]).max()
    dt = courant * 2 / numpy.sqrt(greatest)
    steps = int(numpy.ceil(duration / dt))
    dt = duration / steps
    dof = numpy.stack([2 * mesh.elements, 2 * mesh.elements + 1], axis=2).reshape(-1, 8)
    K = scipy.sparse.csr_matrix((stiffness.ravel(), (numpy.repeat(dof, 8, axis=1).ravel(), numpy.tile(dof, 8).ravel())),
                                shape=(2 * nodes, 2 * nodes))
    M = numpy.zeros(nodes)
    numpy.add.at(M, mesh.elements, mass)
    M = M.reshape(mesh.shape)[:, :, None]
    C = numpy.zeros(mesh.shape + (2,))
    width = numpy.gradient(mesh.x[:, 0])
    width[[0, -1]] *= 0.5
    base = mesh.materials[0]
    C[:, 0, 0] += base.shear_impedance * width
    C[:, 0, 1] += base.pressure_impedance * width
    far = 2 * C[:, 0]  # times the incoming velocity: the force at the base
    columns = [(side, -1 if side == 0 else 1, Column(mesh, side)) for side in (0, -1)]
    for side, _, column in columns:
        C[side, :, 0] += column.edge_pressure
        C[side, :, 1] += column.edge_shear
    u, v = numpy.zeros(mesh.shape + (2,)), numpy.zeros(mesh.shape + (2,))
    light, heavy = M - 0.5 * dt * C, M + 0.5 * dt * C
    result = numpy.zeros((steps, len(gauges), 2))
    for k in range(steps):
        incoming = numpy.asarray(upgoing(k * dt))
        force = -(K @ u.ravel()).reshape(u.shape)
        force[:, 0] += far * incoming
        if load is not None:
            force[:, -1, 1] += load(k * dt)
        for side, outward, column in columns:
            force[side] += outward * column.traction()
            middle = column.step(incoming, dt)
            force[side, :, 0] += column.edge_pressure * middle[:, 0]
            force[side, :, 1] += column.edge_shear * middle[:, 1]
        v = (light * v + dt * force) / heavy
        u += dt * v
        result[k] = v.reshape(-1, 2)[gauges]
    return (numpy.arange(steps) + 0.5) * dt, result
