#include "io/results/files.hpp"
#include "test/sealed.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <cstring>
#include <numeric>
#include <sys/resource.h>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
std::vector<double> ramp(std::size_t count)
{
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), 0.5);
  return values;
}

void write_mass(const std::filesystem::path& path, const std::vector<double>& mass)
{
  write_file_atomically(path, [&](h5::File& file) { file.write("particles/mass", mass, {}, "kg"); });
}

/// Lets no file grow beyond `bytes` while it lives; stands in for a full disk.
struct SmallDisk
{
  rlimit before{};
  explicit SmallDisk(rlim_t bytes)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &before); }
};
} // namespace

TEST_CASE("numbers, texts and attributes come back as they were written", "[io]")
{
  const TemporaryFolder folder;
  const std::vector<double> stress = ramp(12);
  const std::vector<std::int64_t> ids = {1, -2, std::int64_t(1) << 60};
  const std::vector<std::uint8_t> flags = {0, 255};
  write_file_atomically(folder / "a.h5",
                        [&](h5::File& file)
                        {
                          h5::Group particles = file.create_group("state/particles");
                          particles.write("stress", stress, {3, 4}, "Pa");
                          particles.write("id", ids, {}, "1");
                          particles.write("flag", flags, {}, "1");
                          particles.attribute("layer", "soil", "stress");
                          file.write_text("case", "name: Hügel\n");
                          file.write_strings("names", {"crest", "Fuß", ""});
                          file.attribute("time", 0.1);
                          file.attribute("step", 42);
                          file.attribute("origin", std::vector<double>{1.5, -2});
                        });

  const h5::File file = open_complete(folder / "a.h5");
  const h5::Group particles = file.open_group("state/particles");
  CHECK(particles.read_doubles("stress") == stress);
  CHECK(particles.shape("stress") == std::vector<hsize_t>{3, 4});
  CHECK(particles.attribute_string("units", "stress") == "Pa");
  CHECK(particles.attribute_string("layer", "stress") == "soil");
  CHECK(particles.read_ints("id") == ids);
  CHECK(particles.read_ints("flag") == std::vector<std::int64_t>(flags.begin(), flags.end()));
  CHECK(particles.children() == std::vector<std::string>{"flag", "id", "stress"});
  CHECK(file.read_text("case") == "name: Hügel\n");
  CHECK(file.read_strings("names") == std::vector<std::string>{"crest", "Fuß", ""});
  CHECK(file.attribute_double("time") == 0.1);
  CHECK(file.attribute_int("step") == 42);
  CHECK(file.attribute_doubles("origin") == std::vector<double>{1.5, -2});
  CHECK(file.exists("state/particles/id"));
  CHECK_FALSE(file.exists("state/nothing/id"));
}

TEST_CASE("doubles larger than one chunk come back bit by bit", "[io]")
{
  const TemporaryFolder folder;
  const std::vector<double> values = ramp((std::size_t(1) << 20) * 5 / 2);
  write_file_atomically(folder / "a.h5",
                        [&](h5::File& file) {
                          file.write("v", values, {values.size() / 2, 2}, "m/s");
                        });
  CHECK(open_complete(folder / "a.h5").read_doubles("v") == values);
}

TEST_CASE("an empty dataset keeps its shape", "[io]")
{
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.h5",
                        [](h5::File& file)
                        {
                          file.write("points", std::vector<double>{}, {0, 3}, "m", {.compress = true});
                          file.write_strings("names", {});
                        });
  const h5::File file = open_complete(folder / "a.h5");
  CHECK(file.shape("points") == std::vector<hsize_t>{0, 3});
  CHECK(file.read_doubles("points").empty());
  CHECK(file.read_strings("names").empty());
}

TEST_CASE("a flipped byte in a dataset is reported, not read", "[io]")
{
  const TemporaryFolder folder;
  const std::vector<double> mass = ramp(1000);
  write_mass(folder / "a.h5", mass);

  std::string bytes = contents(folder / "a.h5");
  const std::string needle(reinterpret_cast<const char*>(&mass[500]), sizeof(double));
  const std::size_t offset = bytes.find(needle);
  REQUIRE(offset != std::string::npos);
  bytes[offset + 3] ^= 1;
  put(folder / "b.h5", bytes);

  const auto read = [&] { open_complete(folder / "b.h5").read_doubles("particles/mass"); };
  CHECK(code_of(read) == exit_code::bad_input);
  CHECK_THAT(message_of(read), Contains("b.h5: the file is damaged"));
  put(folder / "b.h5", sealed(unsealed(bytes))); // the dataset has a checksum of its own
  CHECK(code_of(read) == exit_code::bad_input);
  CHECK_THAT(message_of(read), Contains("b.h5: /particles/mass") && Contains("checksum"));
}

TEST_CASE("a flipped bit anywhere in a file, the loss of its end and more behind it are found", "[io][long]")
{
  const TemporaryFolder folder;
  write_mass(folder / "a.h5", ramp(20));
  const std::string whole = contents(folder / "a.h5");
  REQUIRE(unsealed(whole).size() == whole.size() - seal_length);
  const auto opens = [&](const std::string& bytes)
  {
    put(folder / "b.h5", bytes);
    return code_of([&] { open_complete(folder / "b.h5"); }) == 0;
  };
  REQUIRE(opens(whole));
  for (std::size_t bit = 0; bit < 8 * whole.size(); bit += 7) // every bit of a byte, and most bytes
  {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    INFO("bit " << bit);
    if (opens(flipped)) FAIL("it was not found");
  }
  for (const std::size_t lost :
       {std::size_t(1), seal_length, seal_length + 1, whole.size() - 8, whole.size()})
    CHECK_FALSE(opens(whole.substr(0, whole.size() - lost)));
  CHECK_FALSE(opens(whole + "\n"));
  CHECK_FALSE(opens(whole + whole.substr(whole.size() - seal_length)));
}

TEST_CASE("a file tells its digest, and HDF5 alone reads it all the same", "[io]")
{
  const TemporaryFolder folder;
  const std::string written = write_file_atomically(folder / "a.h5", [](h5::File& file)
                                                    { file.write("particles/mass", ramp(3), {}, "kg"); });
  std::string read;
  open_complete(folder / "a.h5", &read);
  CHECK(read == written);
  CHECK(read == sha256(unsealed(contents(folder / "a.h5"))));
  CHECK(h5::File::open(folder / "a.h5").read_doubles("particles/mass") == ramp(3));
}

TEST_CASE("a file that stands or is linked under the temporary name is not written into", "[io]")
{
  const TemporaryFolder folder;
  put(folder / "precious", "precious");
  std::filesystem::create_symlink(folder / "precious", folder / "a.h5.tmp");
  write_mass(folder / "a.h5", ramp(3));
  std::filesystem::create_hard_link(folder / "precious", folder / "a.txt.tmp");
  write_text_atomically(folder / "a.txt", "new");
  CHECK(contents(folder / "precious") == "precious");
  CHECK(open_complete(folder / "a.h5").read_doubles("particles/mass") == ramp(3));
  CHECK(contents(folder / "a.txt") == "new");
  std::filesystem::create_symlink(folder / "precious", folder / "link.txt");
  write_text_atomically(folder / "link.txt", "new"); // the name is ours, not what it pointed to
  CHECK(contents(folder / "precious") == "precious");
  CHECK(contents(folder / "link.txt") == "new");
}

TEST_CASE("a reader of an incomplete file is told so", "[io]")
{
  const TemporaryFolder folder;
  h5::File file = h5::File::in_memory(folder / "a.h5");
  file.write("mass", ramp(3), {}, "kg");
  const auto image = file.image();
  put(folder / "a.h5", std::string(reinterpret_cast<const char*>(image.data()), image.size()));

  const auto open = [&] { open_complete(folder / "a.h5"); };
  CHECK(code_of(open) == exit_code::bad_input);
  CHECK_THAT(message_of(open), Contains("not complete"));
}

TEST_CASE("a missing file, a cut one and one of another kind are told apart", "[io]")
{
  const TemporaryFolder folder;
  write_mass(folder / "a.h5", ramp(10000));
  const std::string bytes = contents(folder / "a.h5");
  put(folder / "cut.h5", bytes.substr(0, bytes.size() / 2));
  put(folder / "text.h5", "time,acceleration\n0,1\n");

  CHECK(code_of([&] { open_complete(folder / "none.h5"); }) == exit_code::input_missing);
  CHECK(code_of([&] { open_complete(folder / "cut.h5"); }) == exit_code::bad_input);
  CHECK_THAT(message_of([&] { open_complete(folder / "cut.h5"); }), Contains("not complete"));
  CHECK(code_of([&] { open_complete(folder / "text.h5"); }) == exit_code::bad_input);
  CHECK_THAT(message_of([&] { open_complete(folder / "text.h5"); }), Contains("not an HDF5 file"));
}

TEST_CASE("a missing dataset and one of the wrong kind are named", "[io]")
{
  const TemporaryFolder folder;
  write_mass(folder / "a.h5", ramp(3));
  const h5::File file = open_complete(folder / "a.h5");
  CHECK_THAT(message_of([&] { file.read_doubles("particles/volume"); }), Contains("/particles/volume"));
  CHECK(code_of([&] { file.read_doubles("particles/volume"); }) == exit_code::bad_input);
  CHECK(code_of([&] { file.read_ints("particles/mass"); }) == exit_code::bad_input);
  CHECK(code_of([&] { file.read_text("particles/mass"); }) == exit_code::bad_input);
  CHECK(code_of([&] { file.attribute_int("step"); }) == exit_code::bad_input);
}

TEST_CASE("a write that fails keeps the file that was there and leaves no debris", "[io]")
{
  const TemporaryFolder folder;
  write_mass(folder / "a.h5", ramp(3));
  {
    const SmallDisk disk(64 * 1024);
    const auto write = [&] { write_mass(folder / "a.h5", ramp(100000)); };
    CHECK(code_of(write) == exit_code::write_failed);
    CHECK_THAT(message_of(write), Contains("a.h5") && Contains(std::strerror(EFBIG)));
  }
  CHECK(open_complete(folder / "a.h5").read_doubles("particles/mass") == ramp(3));
  CHECK_FALSE(std::filesystem::exists(folder / "a.h5.tmp"));
}

TEST_CASE("a writer that gives up leaves the file that was there", "[io]")
{
  const TemporaryFolder folder;
  write_mass(folder / "a.h5", ramp(3));
  const auto give_up = [](h5::File&) { throw Error(exit_code::bug, "changed its mind"); };
  CHECK(code_of([&] { write_file_atomically(folder / "a.h5", give_up); }) == exit_code::bug);
  CHECK(open_complete(folder / "a.h5").read_doubles("particles/mass") == ramp(3));
}

TEST_CASE("a file in a folder that does not exist is a failed write", "[io]")
{
  const TemporaryFolder folder;
  CHECK(code_of([&] { write_mass(folder / "none/a.h5", ramp(3)); }) == exit_code::write_failed);
  CHECK(code_of([&] { write_text_atomically(folder / "none/a.txt", "a"); }) == exit_code::write_failed);
}

TEST_CASE("values that do not fill their shape are refused", "[io]")
{
  h5::File file = h5::File::in_memory("a.h5");
  CHECK(code_of([&] { file.write("v", ramp(5), {2, 3}, "m"); }) == exit_code::bug);
}

TEST_CASE("a file says who wrote it and which sign it uses", "[io]")
{
  const TemporaryFolder folder;
  const Provenance ours{"mpm-static", "1.2", "abc", "release", "mpm-static a.yaml", utc_now(), host_name()};
  write_file_atomically(folder / "a.h5",
                        [&](h5::File& file) { write_provenance(file, ours, "seismpm-checkpoint/1"); });
  const h5::File file = open_complete(folder / "a.h5");
  CHECK(file.attribute_string("schema") == "seismpm-checkpoint/1");
  CHECK(file.attribute_string("program") == "mpm-static");
  CHECK(file.attribute_string("sign") == "tension positive; x right, y up");
  CHECK(file.attribute_string("created").size() == std::string("2000-01-01T00:00:00Z").size());
}
