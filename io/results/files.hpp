#pragma once
// Result files: written whole or not at all, and signed by who wrote them.

#include "io/common/digest.hpp"
#include "io/results/hdf5.hpp"

#include <functional>

namespace mpm
{
/// Who wrote a file: the root attributes that all our files share.
struct Provenance
{
  std::string program; ///< mpm-static or mpm-seismic
  std::string version;
  std::string git;     ///< commit that was built
  std::string build;   ///< compiler and options
  std::string command; ///< as it was typed
  std::string created; ///< UTC, ISO 8601
  std::string host;
};

/// Now, as ISO 8601 writes it: "2024-05-17T09:30:00Z".
std::string utc_now();
std::string host_name();
/// Writes the attributes of `Provenance`, `schema` ("seismpm-checkpoint/1") and the sign convention.
void write_provenance(h5::Group& root, const Provenance&, std::string_view schema);

/// Calls `fill` with a new file and puts the result at `path`, synced, with a seal at its end: a line with
/// the SHA-256 of all before it, which HDF5 does not look at. Returns that digest. On failure the file that
/// was there before stays and `Error` write_failed is thrown. Needs memory for the whole file: so that a full
/// disk is met by one plain write, with its reason.
std::string write_file_atomically(const std::filesystem::path&, const std::function<void(h5::File&)>& fill);
/// The same for a text file, which has no seal.
void write_text_atomically(const std::filesystem::path&, std::string_view text);

/// What has been renamed and removed in a folder stays so, should the machine stop now. `Error` write_failed.
void sync_folder(const std::filesystem::path& folder);

/// Opens a file that `write_file_atomically` wrote, after a look at every byte of it. `digest`, if given,
/// gets the seal's. `Error`: input_missing when it is missing or unreadable, bad_input when it is not HDF5,
/// cut short or not what was written.
h5::File open_complete(const std::filesystem::path&, std::string* digest = nullptr);
} // namespace mpm
