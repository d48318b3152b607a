#pragma once
// The layout of a checkpoint, `checkpoint-*.h5` and `final.h5`: groups and attributes, what they tell, and
// who writes and reads them. The datasets are in README.md. test/stages/test_layout.cpp and test_cards.cpp
// hold both against the files of runs.
//
//   run level         solver/stages/checkpoint.cpp
//   /relaxation       solver/stages/relaxation.cpp
//   /output           solver/stages/observer_resume.cpp, slide.cpp, column_envelope.cpp;
//   io/results/history.cpp /motion           solver/stages/shaking.cpp, self_driven.cpp each domain
//   io/results/domain_state.cpp; its `boundary/NAME`, `energy`, `departed` and `rest` by the
//                     visit_... of what they hold, in boundaries/ and solver/mpm/

#include <array>
#include <string_view>

namespace mpm::checkpoint
{
/// The version of the layout. A state of another one is refused.
inline constexpr std::string_view schema = "seismpm-checkpoint/6";

// Objects of the root.
inline constexpr const char *case_text = "case", *case_resolved = "case_resolved", *overrides = "overrides",
                            *ground = "ground", *identity = "identity", *warnings = "warnings",
                            *clock = "clock", *relaxation = "relaxation", *output = "output",
                            *motion = "motion", *columns = "free_field";

// Objects of a domain.
inline constexpr const char *particles = "particles", *materials = "materials", *grid = "grid",
                            *boundary = "boundary", *gauges = "gauges", *departed = "departed",
                            *energy = "energy", *rest = "rest";

/// In which states an object is found.
enum class In
{
  both,    ///< of either stage
  statics, ///< of the static stage
  seismic, ///< of the seismic stage
};

/// A group, whose path ends with "/", or an attribute, whose name stands behind "@". A word in capitals
/// stands for any name.
struct Object
{
  std::string_view path;
  In in;
  std::string_view what;
};

/// What a state tells of its run. The groups of its ground are `of_domain`.
inline constexpr std::array of_run{
    Object{"@schema", In::both, "the version of the layout"},
    Object{"@program", In::both, "mpm-static or mpm-seismic"},
    Object{"@version", In::both, "of the program"},
    Object{"@git", In::both, "commit that the program was built from"},
    Object{"@build", In::both, "compiler and options"},
    Object{"@command", In::both, "the command line"},
    Object{"@created", In::both, "when the file was written, UTC"},
    Object{"@host", In::both, "machine"},
    Object{"@sign", In::both, "the sign convention"},
    Object{"case@path", In::both, "where the case file was read"},
    Object{"case@profile", In::both, "the profile that was applied"},
    Object{"case@sha256", In::both, "digest of its text"},
    Object{"clock/", In::both, "where the stage is"},
    Object{"clock@stage", In::both, "static or seismic"},
    Object{"clock@last", In::both, "1: the stage has ended, as in final.h5"},
    Object{"clock@vectors", In::both, "instructions that the run used; others round otherwise"},
    Object{"clock@step", In::both, "steps done"},
    Object{"clock@time", In::both, "time reached, s"},
    Object{"clock@dt", In::both, "time step, s"},
    Object{"clock@start_time", In::both, "time from which steps of dt count, s"},
    Object{"clock@start_step", In::both, "step from which they do"},
    Object{"relaxation/", In::statics, "how far the ground has settled"},
    Object{"relaxation@plastic", In::statics, "1: the laws may yield; 0: elastic so far"},
    Object{"relaxation@held", In::statics, "checks in a row at which the criteria held"},
    Object{"relaxation@unbalanced", In::statics, "unbalanced force ratio of the last check"},
    Object{"relaxation@kinetic", In::statics, "kinetic energy ratio of the last check"},
    Object{"output/", In::seismic, "what the run has written down"},
    Object{"output@gauge_time", In::seismic, "last sample of the gauges, s"},
    Object{"output/history/", In::seismic, "rows of history.h5 so far, laid out as there"},
    Object{"output/columns/", In::seismic, "the greatest values of the free-field columns so far"},
    Object{"output/columns/SIDE/", In::seismic, "left or right"},
    Object{"output/slide/", In::seismic, "what measures of the run-out remember"},
    Object{"output/slide@time", In::seismic, "last sample of the slide, s"},
    Object{"motion/", In::seismic, "what the motion has come to"},
    Object{"motion@motion.horizontal", In::seismic, "samples and processing of the record, with digest"},
    Object{"motion@motion.vertical", In::seismic, "likewise"},
    Object{"motion@since", In::seismic, "since when the slide seems self-driven, s; NaN: it does not"},
    Object{"motion@decided", In::seismic, "when it was decided to be, s; NaN: not yet"},
    Object{"free_field/", In::both, "the columns, each with the groups of a domain"},
    Object{"free_field/SIDE/", In::both, "left or right"},
};

/// The state of a domain: of the ground in the root, of a column in its group.
inline constexpr std::array of_domain{
    Object{"particles/", In::both, "in the solver's order, in which sums are taken"},
    Object{"materials/", In::both, "which particles are of which material"},
    Object{"materials/NAME/", In::both, "a material of the case, or a mixture at an interface"},
    Object{"materials/NAME@model", In::both, "its law"},
    Object{"materials/NAME@material", In::both, "the case's material that it is, or is a mixture of"},
    Object{"materials/NAME@begin", In::both, "index of its first particle"},
    Object{"materials/NAME@end", In::both, "index behind its last one"},
    Object{"grid/", In::both, "where the grid is, and which blocks hold particles"},
    Object{"grid@spacing", In::both, "cell size, m"},
    Object{"grid@origin", In::both, "x, y of its node (0, 0), m"},
    Object{"grid@drift", In::both, "cells that a particle may have moved since the last sort"},
    Object{"boundary/", In::seismic, "what boundaries remember"},
    Object{"boundary/NAME/", In::seismic, "images, base, left or right"},
    Object{"gauges/", In::both, "none before the seismic stage, and in a column"},
    Object{"departed/", In::both, "particles that have left the model"},
    Object{"energy/", In::both, "the energy balance since the start of the stage"},
    Object{"rest/", In::both, "ground at rest"},
};
} // namespace mpm::checkpoint
