"""The forty extremes, by number: the question, the bound with its reason, and what holds it.

`tests` are names of tests of seismpm-tests that are run (* stands for any text), `maps` maps of the atlas, whose points are
counted. `verdict` is what to say when all of them hold: *holds*, *falls short* (a weakness of the method that a test pins; `advice`
says what to do) or *not offered*.
"""
from dataclasses import dataclass


@dataclass(frozen=True)
class Extreme:
    """One of the forty."""
    number: int
    question: str
    bound: str
    tests: tuple = ()
    maps: tuple = ()
    verdict: str = "holds"
    advice: str = ""
    slow: tuple = ()  # tests that are left out by --quick


EXTREMES = [
    Extreme(1, "a free elastic block at Courant numbers up to 0.78, and beyond",
            "energy never above 1 + 1e-6 of the start up to 0.78; at 1.3 (lone particle) and 1.5 (block) caught within 1000 steps: frozen "
            "positions give 0.79 as the least limit", ("Up to the Courant number 0.78 a free elastic block never gains energy",
            "At the Courant number 1.3 a lone particle blows up*", "Two hundred random clusters*", "At the Courant number 1.5 a free elastic block*"), ("courant",)),
    Extreme(2, "the same with quadratic splines", "there are cubic ones only", verdict="not offered"),
    Extreme(3, "a stiffness contrast of 1e4", "no growth in 100 000 steps; damping as its formula says within 20 %",
            ("A block of halves of which one is ten thousand times as stiff*", "a standing wave is as slow and as damped as the formulas say",
             "With consistent inertia a ragged block of unlike halves*"), ("contrast",),
            advice="with apic waves in the soft layer fade: take flip"),
    Extreme(4, "a Poisson's ratio of 0.499", "settles as the closed form within 1 %; 0.5 is refused (the modulus is infinite)",
            ("Four and ten particles a cell*",), ("poisson",), advice="above 0.49 the programs warn: it costs 12 times the steps"),
    Extreme(5, "one particle a cell", "a column's settlement within 3 %: one point integrates a cell; its nodes never balance, since there are fewer "
            "stresses than nodes", ("known weakness: one particle a cell*",), ("particles",), verdict="falls short",
            advice="the static stage ends with 81, and the programs warn: take 2"),
    Extreme(6, "ten particles along a cell", "as four within 0.2 %, the order of the splines' own error", ("Four and ten particles a cell*",), ("particles",)),
    Extreme(7, "particles exactly on nodes, edges of cells and the corner", "as those 1e-12 m beside, within 1e-9: splines are continuous",
            ("Particles on nodes, edges of cells and the corner*",)),
    Extreme(8, "a particle at the last cell, and beyond", "the grid goes where the ground goes; what has jumped is named",
            ("The grid follows a body over a kilometre*", "Faults that are planted in the seismic stage*")),
    Extreme(9, "a single particle in free flight for 10 s", "the discrete parabola to 1e-12", ("A single particle flies on the discrete parabola*",)),
    Extreme(10, "two particles that approach", "no force beyond four cells, two splines' reach", ("Two particles that approach*",)),
    Extreme(11, "ground without any strength at a free surface", "finite; kinetic energy below the work of gravity",
            ("Ground without any strength flows*", "Water behind a broken dam*"), ("strength", "friction")),
    Extreme(12, "a critical slip of 1e-6 m", "stable: the return does not depend on how fast the friction falls",
            ("Weakening over a millionth of a metre is stable",), ("slip",)),
    Extreme(13, "equal peak and residual strength", "perfectly plastic to the last bit",
            ("Equal peak and residual strength are perfect plasticity*", "Equal peak and residual strength are perfectly plastic*",
             "Equal peak and residual friction*")),
    Extreme(14, "friction 0 and 60 degrees, dilation as great, cohesion 0 and without end, the apex in every step",
            "on or below the yield surface to 1e-9; elastic where cohesion has no end", ("Whatever the trial, Mohr-Coulomb*",
            "Below its surface Mohr-Coulomb is elastic*", "A heap of no cohesion on its apex*"), ("friction",)),
    Extreme(15, "motions of 5 and 50 g at 20 Hz", "elastic ground moves in proportion within 1 and 10 %, by its own strains of as much; clay stays finite",
            ("A motion of 5 and of 50 g at 20 Hz*",), ("strength",)),
    Extreme(16, "no input for 5 s", "velocities below 1e-6 m/s", ("level ground under gravity stays still without input",
            "level ground stays still after the switch*")),
    Extreme(17, "a record of 300 s", "the base moves by the integral of the input to 1e-3", ("after 300 s the base has moved by the integral*",)),
    Extreme(18, "gravity of 1e-6 and 1000 m/s2, and none", "strains in proportion (25 % at strains of a third); criteria end; without gravity no division by weight",
            ("Gravity of a millionth and of a hundred times*", "a case without gravity starts without a static state*"), ("gravity",)),
    Extreme(19, "momentum of a free block over 10 000 steps", "1e-13 linear, 1e-12 angular: round-off", ("A free elastic block keeps its linear and angular*",)),
    Extreme(20, "energy of a free block over a million steps", "never rises; fades as the transfers' damping says",
            ("The energy of a free elastic block never rises", "A wave in a free block fades*"),
            slow=("The energy of a free elastic block never rises in a million steps",)),
    Extreme(21, "a block that spins a hundred turns", "no stress but the centrifugal one: rotations are orthogonal to round-off",
            ("A block that spins a hundred turns*", "A hundred turns leave*", "A stressed block turns*")),
    Extreme(22, "everything moved by whole cells", "the same to round-off", ("A case_file moved by whole cells*",)),
    Extreme(23, "everything moving with 50 m/s", "elastic stresses as at rest within half a per cent: splines are not exactly Galilean within a cell",
            ("An elastic block that flies at 50 m/s*",)),
    Extreme(24, "the mirror image", "the same to round-off", ("A mirrored case_file*",)),
    Extreme(25, "turned by a right angle with gravity", "the same to round-off", ("A case_file turned by a right angle*",)),
    Extreme(26, "a restart", "the same to the last bit", ("a static run that was cut short*", "a seismic run that was cut short*")),
    Extreme(27, "one, two and three threads", "the same to the last bit", ("One, two and three threads give the same particles*",
            "a seismic run ends bit for bit the same on one thread and on two")),
    Extreme(28, "single precision", "there is double precision only", verdict="not offered"),
    Extreme(29, "the switch from walls to base and sides, and a base that moves over the grid",
            "1e-3 g where the surface slopes, 1e-6 g elsewhere: images balance to round-off but there",
            ("the switch leaves no acceleration behind*", "gravity adds nothing to the motion*")),
    Extreme(30, "a lasting load on a base of dashpots alone", "drifts at F / (rho c) within 1 %, as dashpots do",
            ("known weakness: a base on dashpots alone*", "under a lasting load F the spring lets the base go*"), verdict="falls short",
            advice="dashpots carry no lasting load; seismic.base.spring: auto, the default, does"),
    Extreme(31, "dashpots of 1e-3 to 1e3 times the impedance", "never give energy, wherever the face is: centred in time",
            ("A face's dashpots never give energy*", "A base gives no energy whatever its sides*"), ("base",)),
    Extreme(32, "pulses at normal incidence", "less than 0.5 % comes back", ("Upgoing waves double at the surface and do not come back*",)),
    Extreme(33, "level ground beside its free field", "all particles as the column to 1e-3: images carry the column's stress",
            ("A level layered model moves as its own free-field column*",)),
    Extreme(34, "sides of different height", "still without input", ("ground of different height at its sides stays still*",)),
    Extreme(35, "a slope that touches a side", "refused with the reason", ("A side that cuts a slope face is refused*",)),
    Extreme(36, "no particle, too many for any machine; records and numbers that are none", "refused by name, or run",
            ("Surfaces and regions have to fit together", "What is no finite number is refused", "A case that no machine holds is refused*",
             "Values that cannot be computed with are refused", "a record that is none exits with 65*")),
    Extreme(37, "debris of 66 and 100 m/s against a wall", "no particle more than half a distance beyond it; energy falls",
            ("Debris of 66 and 100 m/s*",), advice="ground of slow waves wants a smaller Courant number: above c_p / 4C it is caught"),
    Extreme(38, "torn to twice its volume and pressed together; stretched to 3, pressed to 0.2", "no pressure before it has closed; an affine motion within 2 % (with "
            "apic 5 %, volumes 35 %: set afterwards)",
            ("Debris pulled apart carries no pressure*", "Ground is stretched to three times its length*", "Ground that is pressed below a tenth*"),
            verdict="falls short", advice="with apic, whose C lags behind large strains; flip, the default, keeps 2 %"),
    Extreme(39, "gravity that comes in one step", "the same stresses to 1e-3", ("Gravity that comes in one step*",)),
    Extreme(40, "local damping of 0.99, and of 1", "the same stresses; 1 is refused: nothing would move", ("Gravity that comes in one step*",)),
]
