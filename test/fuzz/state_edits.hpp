#pragma once
// Changes to a result file through HDF5, so that what comes of them is well-formed and may be anything else.

#include <string>
#include <string_view>

namespace mpm::fuzz
{
/// What the bytes ask for, done to a file that is given and returned as bytes: values, shapes, types and
/// names of datasets and attributes, links to elsewhere, sizes without data. Sixteen bytes make a change.
std::string edited(const std::string& file, std::string_view changes);
} // namespace mpm::fuzz
