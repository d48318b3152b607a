#include "io/run_folder/run_folder.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
const RunFolder::Identity soft = {{"name", "slope"}, {"materials.soil.young_modulus", "40 MPa"}};
const RunFolder::Identity stiff = {{"name", "slope"}, {"materials.soil.young_modulus", "80 MPa"}};

/// Another process that holds a folder until it is killed.
class Holder
{
public:
  explicit Holder(const std::filesystem::path& folder)
  {
    int ready[2];
    if (pipe(ready) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0)
    {
      const RunFolder held(folder, soft);
      if (write(ready[1], "!", 1) == 1) pause();
      _exit(0);
    }
    char byte;
    if (read(ready[0], &byte, 1) != 1) throw std::runtime_error("no holder");
    close(ready[0]);
    close(ready[1]);
  }
  ~Holder() { crash(); }
  void crash()
  {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  pid_t pid() const { return pid_; }

private:
  pid_t pid_ = -1;
};
} // namespace

TEST_CASE("digests are SHA-256, of a text as of a file", "[io]")
{
  const TemporaryFolder folder;
  const std::string abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"; // FIPS 180-2
  CHECK(sha256("abc") == abc);
  put(folder / "a", "abc");
  CHECK(sha256_file(folder / "a") == abc);
  put(folder / "empty", "");
  CHECK(sha256_file(folder / "empty") == sha256(""));
  const std::string large(3'000'000, 'x');
  put(folder / "large", large);
  CHECK(sha256_file(folder / "large") == sha256(large));
  CHECK(code_of([&] { sha256_file(folder / "none"); }) == exit_code::input_missing);
}

TEST_CASE("a folder is made, and the same run goes on in it", "[io]")
{
  const TemporaryFolder folder;
  {
    const RunFolder run(folder / "runs/a", soft);
    CHECK(run.states().empty());
    CHECK(run.locked());
    put(run / "final.h5", "x");
  }
  CHECK(RunFolder(folder / "runs/a", soft).states().size() == 1);
}

TEST_CASE("a folder held by another live run is refused with 73", "[io]")
{
  const TemporaryFolder folder;
  Holder other(folder.path());
  const auto open = [&] { RunFolder(folder.path(), soft); };
  CHECK(code_of(open) == exit_code::folder_taken);
  CHECK_THAT(message_of(open), Contains("pid " + std::to_string(other.pid())));
  CHECK(code_of([&] { RunFolder(folder.path(), soft, true); }) == exit_code::folder_taken);
}

TEST_CASE("a folder is free again after its run has crashed", "[io]")
{
  const TemporaryFolder folder;
  Holder other(folder.path());
  other.crash();
  CHECK(code_of([&] { RunFolder(folder.path(), soft); }) == 0);
}

TEST_CASE("a folder of another case is refused, and the key and both values named", "[io]")
{
  const TemporaryFolder folder;
  RunFolder(folder.path(), soft);
  const auto open = [&] { RunFolder(folder.path(), stiff); };
  CHECK(code_of(open) == exit_code::folder_taken);
  CHECK_THAT(message_of(open), Contains("materials.soil.young_modulus") && Contains("40 MPa") &&
                                   Contains("80 MPa") && Contains("--fresh"));
}

TEST_CASE("a key that was added or taken away makes another run", "[io]")
{
  const TemporaryFolder folder;
  RunFolder(folder.path(), soft);
  RunFolder::Identity more = soft;
  more.emplace_back("seismic.duration", "40 s");
  CHECK_THAT(message_of([&] { RunFolder(folder.path(), more); }), Contains("seismic.duration"));
  CHECK_THAT(message_of([&] { RunFolder(folder.path(), {soft[0]}); }), Contains("young_modulus"));
}

TEST_CASE("starting fresh removes our results and nothing else", "[io]")
{
  const TemporaryFolder folder;
  RunFolder(folder.path(), soft);
  for (const char* name : {"final.h5", "checkpoint-000000100.h5", "history.h5", "frame-00000.hdf", "log.txt",
                           "frames.hdf.series", "summary.json", "final.h5.tmp"})
    put(folder / name, "ours");
  for (const char* name : {"case.yaml", "frame-notes.hdf", "other.h5", "notes.tmp", "checkpoint-.h5"})
    put(folder / name, "theirs");

  const RunFolder run(folder.path(), stiff, true);
  CHECK(run.states().empty());
  CHECK_FALSE(std::filesystem::exists(folder / "final.h5"));
  CHECK_FALSE(std::filesystem::exists(folder / "checkpoint-000000100.h5"));
  CHECK_FALSE(std::filesystem::exists(folder / "frame-00000.hdf"));
  CHECK_FALSE(std::filesystem::exists(folder / "final.h5.tmp"));
  for (const char* name : {"case.yaml", "frame-notes.hdf", "other.h5", "notes.tmp", "checkpoint-.h5"})
    CHECK(contents(folder / name) == "theirs");
}

TEST_CASE("results of an unknown run are not overwritten, other files are no obstacle", "[io]")
{
  const TemporaryFolder folder;
  put(folder / "case.yaml", "");
  put(folder / "identity.json.tmp", ""); // of a run killed at its very start
  CHECK(code_of([&] { RunFolder(folder.path(), soft); }) == 0);
  std::filesystem::remove(folder / "identity.json");
  put(folder / "final.h5", "");
  CHECK(code_of([&] { RunFolder(folder.path(), soft); }) == exit_code::folder_taken);
}

TEST_CASE("checkpoints are listed newest first and pruned from the old end", "[io]")
{
  const TemporaryFolder folder;
  const RunFolder run(folder.path(), soft);
  for (const std::int64_t step : {500, 20, 1000000000, 7}) put(run / checkpoint_name(step), "");
  put(run / "checkpoint-x.h5", "");
  REQUIRE(run.checkpoints().size() == 4);
  CHECK(run.checkpoints()[0].filename() == "checkpoint-1000000000.h5");
  CHECK(run.checkpoints()[3].filename() == checkpoint_name(7));
  run.prune(2);
  CHECK(run.checkpoints().size() == 2);
  CHECK(run.checkpoints()[1].filename() == checkpoint_name(500));
}

TEST_CASE("links in the place of the lock and the log are refused, and what they lead to is left alone",
          "[io]")
{
  for (const char* name : {".lock", "log.txt"})
    for (const bool hard : {false, true})
    {
      const TemporaryFolder folder;
      std::filesystem::create_directory(folder / "out");
      put(folder / "precious", "precious");
      if (hard)
        std::filesystem::create_hard_link(folder / "precious", folder / "out" / name);
      else
        std::filesystem::create_symlink("../precious", folder / "out" / name);
      const auto open = [&] { RunFolder(folder / "out", soft); };
      CHECK(code_of(open) == exit_code::folder_taken);
      CHECK_THAT(message_of(open), Contains(name));
      CHECK(contents(folder / "precious") == "precious");
    }
}

TEST_CASE("a file in the place of the folder is a failed write", "[io]")
{
  const TemporaryFolder folder;
  put(folder / "out", "");
  CHECK(code_of([&] { RunFolder(folder / "out", soft); }) == exit_code::write_failed);
}
