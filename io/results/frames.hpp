#pragma once
// Result frames: one small file each, which ParaView draws and h5py reads under plain names.

#include "io/results/files.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mpm
{
/// The particles at one time.
struct Frame
{
  struct Field
  {
    std::string name;
    std::string unit;
    int components = 1;         ///< 1, 3 for vectors as VTK has them, 4 for stresses
    std::vector<double> values; ///< [particle, component]
    /// What the components are called, which ParaView cannot be told: each is written as NAME_COMPONENT too.
    std::vector<std::string> component_names = {};
  };

  double time = 0; ///< s
  std::int64_t step = 0;
  std::vector<double> points; ///< [particle, 3], m; the third is 0
  std::vector<Field> fields;
  std::vector<std::int64_t> ids;       ///< each once; left empty: not written
  std::vector<std::int64_t> materials; ///< indices among the names; left empty: not written
  std::vector<std::string> material_names;
};

/// "frame-00042.hdf"
std::string frame_name(std::int64_t number);

/// A VTKHDF 1.0 unstructured grid of vertices in 32-bit floats, the particles in the order of their ids,
/// which are the points' global ids; the same data as /particles/NAME. Returns the file's digest.
std::string write_frame(const std::filesystem::path&, const Frame&, const Provenance&);

/// FOLDER/frames.hdf.series, which gives ParaView the frames' times. `frames`: file name, time in s.
void write_series(const std::filesystem::path& folder,
                  const std::vector<std::pair<std::string, double>>& frames);
} // namespace mpm
