// States that are not as they were written: whatever byte has changed or is missing, they are refused, with
// the reason. The programs themselves meet such files in test/campaign.

#include "io/results/checkpoint_layout.hpp"
#include "test/sealed.hpp"
#include "test/stages/programs.hpp"

#include <fmt/format.h>
#include <fstream>
#include <random>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
/// A state whose bytes are changed, and read as a run reads them.
class Victim
{
public:
  explicit Victim(const fs::path& state) : path_(state), whole_(contents(state))
  {
    REQUIRE(refusal().empty());
  }

  std::size_t size() const { return whole_.size(); }

  /// The reason for which the file is refused; empty: it is not.
  std::string refusal() const
  {
    try
    {
      open_complete(path_);
      return {};
    }
    catch (const Error& error)
    {
      return error.code == exit_code::bad_input ? error.what() : "another exit code";
    }
  }

  /// Puts other bytes at a place, and the old ones back when they were refused.
  void replace(std::size_t at, const std::string& bytes)
  {
    const std::string old = whole_.substr(at, bytes.size());
    write(at, bytes);
    check(bytes == old, fmt::format("{} bytes at {} of {}", bytes.size(), at, size()));
    write(at, old);
  }
  void truncate(std::size_t length)
  {
    fs::resize_file(path_, length);
    check(false, fmt::format("cut after {} of {} bytes", length, size()));
  }
  char at(std::size_t k) const { return whole_[k]; }

private:
  void write(std::size_t at, const std::string& bytes) const
  {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(std::streamoff(at)).write(bytes.data(), std::streamsize(bytes.size()));
  }
  void check(bool unchanged, const std::string& what) const
  {
    const std::string why = refusal();
    INFO(what << ": " << why);
    const bool told = why.find("damaged") != why.npos || why.find("not complete") != why.npos;
    REQUIRE((unchanged ? why.empty() : why.starts_with(path_.string() + ": ") && told));
  }
  fs::path path_;
  std::string whole_;
};

void damage(Victim& victim, int flips, int stretches, std::size_t stride)
{
  std::mt19937_64 random(20230206);
  const auto below = [&](std::size_t most)
  { return std::uniform_int_distribution<std::size_t>(0, most - 1)(random); };
  for (int k = 0; k < flips; ++k)
  {
    const std::size_t at = below(victim.size());
    victim.replace(at, {char(victim.at(at) ^ (1 << below(8)))});
  }
  for (int k = 0; k < stretches; ++k)
  {
    const std::size_t at = below(victim.size()), length = std::min(victim.size() - at, 1 + below(4096));
    std::string bytes(length, '\0');
    if (k % 2)
      for (char& byte : bytes) byte = char(below(256));
    victim.replace(at, bytes);
  }
  // From the end: the file only gets shorter. All lengths of HDF5's own structures at the beginning, and of
  // the seal.
  for (std::size_t length = victim.size(); length-- > 0;)
    if (length % stride == 0 || length < 2048 / stride || length + 2 * seal_length / stride > victim.size())
      victim.truncate(length);
}

/// The states of both stages, small ones.
std::array<fs::path, 2> states(const Bench& bench)
{
  bench.make_static();
  REQUIRE(bench.run_seismic("a", {"--set", "seismic.duration=0.05 s"}).code == 0);
  return {bench / "static/final.h5", bench / "a/final.h5"};
}
} // namespace

TEST_CASE("a state with a flipped bit, an overwritten stretch or a lost end is refused with the reason",
          "[stages]")
{
  const Bench bench;
  for (const fs::path& state : states(bench))
  {
    Victim victim(state);
    damage(victim, 100, 20, 2048);
  }
}

TEST_CASE("campaign: 10 000 flipped bits, 1000 overwritten stretches and every length of both stages' states",
          "[.campaign]")
{
  const Bench bench;
  for (const fs::path& state : states(bench))
  {
    Victim victim(state);
    WARN(state.filename() << ": " << victim.size() << " bytes");
    damage(victim, 5000, 500, 1);
  }
}

TEST_CASE("a state of another version's layout is refused by its schema, and is kept for that version",
          "[stages]")
{
  const Bench bench;
  bench.make_static();
  terminate(bench, "mpm-seismic", bench.seismic_arguments("old"), bench / "old");
  const auto saved = checkpoints(bench / "old");
  for (const fs::path& state : saved) claim(state, "/", "schema", "seismpm-checkpoint/3");
  const auto refused = [&](int code, const std::string& what)
  {
    const Ending ending = bench.run_seismic(code == 73 ? "old" : "new");
    INFO(ending.said);
    CHECK(ending.code == code);
    CHECK_THAT(ending.said, Contains("its schema is seismpm-checkpoint/3, where this version reads " +
                                     std::string(checkpoint::schema)) &&
                                Contains(what));
  };
  refused(73, "finish the run with that, ");
  CHECK(checkpoints(bench / "old") == saved);
  claim(bench / "static/final.h5", "/", "schema", "seismpm-checkpoint/3");
  refused(65, "run mpm-static of this one");
}
