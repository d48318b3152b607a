// Inputs are data: whatever stands in them, nothing is waited for, followed to elsewhere, taken at its word
// or obeyed.

#include "io/common/printable.hpp"
#include "io/results/files.hpp"
#include "io/run_folder/finish_mark.hpp"
#include "io/run_folder/run_folder.hpp"
#include "test/io/case_texts.hpp"
#include "test/sealed.hpp"

#include <sys/stat.h>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// What may stand in the place of a file; `make` puts it there.
struct Thing
{
  const char* name;
  std::function<void(const std::filesystem::path&)> make;
};
const std::vector<Thing> no_files{
    {"a folder", [](const auto& path) { std::filesystem::create_directory(path); }},
    {"a pipe", [](const auto& path) { REQUIRE(mkfifo(path.c_str(), 0600) == 0); }},
    {"a device", [](const auto& path) { std::filesystem::create_symlink("/dev/zero", path); }}};

/// A file of one dataset `x` of three numbers, changed by `edit(hid_t file)`, and what reading it says.
template <class Edit>
std::string said_of(const Edit& edit)
{
  const TemporaryFolder folder;
  const auto write = [](const std::filesystem::path& path)
  {
    write_file_atomically(path,
                          [](h5::File& file)
                          {
                            const std::vector<double> values{1, 2, 3};
                            file.write("x", std::span<const double>(values), {}, "1");
                            file.write_strings("words", {"a", "b"});
                          });
  };
  write(folder / "a.h5");
  write(folder / "secret.h5");
  edit_sealed(folder / "a.h5", [&](const h5::Handle& file) { edit(file.id()); });
  return message_of(
      [&]
      {
        const h5::File file = open_complete(folder / "a.h5");
        file.read_doubles("x");
        file.read_strings("words");
      });
}

/// A dataset `x` in the place of the one that is there.
void replace(hid_t file, std::vector<hsize_t> shape, hid_t type, const h5::Handle& layout)
{
  H5Ldelete(file, "x", H5P_DEFAULT);
  const h5::Handle space{H5Screate_simple(int(shape.size()), shape.data(), nullptr), H5Sclose};
  const h5::Handle data{H5Dcreate2(file, "x", type, space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT),
                        H5Dclose};
  REQUIRE(data.id() >= 0);
}

h5::Handle new_layout()
{
  return {H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
}
} // namespace

TEST_CASE("a folder, a pipe and a device are refused as each input, without waiting", "[io]")
{
  for (const Thing& thing : no_files)
  {
    INFO(thing.name);
    const TemporaryFolder folder;
    thing.make(folder / "thing");
    const std::string path = (folder / "thing").string();
    for (const std::string& message :
         {message_of([&] { load_case(path); }), message_of([&] { read_record({.file = path}); }),
          message_of([&] { open_complete(path); }),
          refusal(replaced(small, "points: [[0 m, 10 m]]", "file: " + path))})
      CHECK_THAT(message, Contains(std::string("is ") + thing.name));
  }
}

TEST_CASE("what is no file under a name of the output folder is refused, and links lead nowhere", "[io]")
{
  std::vector<Thing> things = no_files;
  things.push_back(
      {"a link", [](const auto& path) { std::filesystem::create_symlink("../precious", path); }});
  things.push_back(
      {"a link to nothing", [](const auto& path) { std::filesystem::create_symlink("../new", path); }});
  const RunFolder::Identity identity{{"stage", "static"}};
  for (const Thing& thing : things)
    for (const char* name :
         {".lock", "log.txt", "identity.json", "finished.json", "final.h5", "checkpoint-000000001.h5",
          "history.h5", "frame-00000.hdf", "frames.hdf.series", "summary.json", "case-resolved.yaml"})
    {
      INFO(thing.name << " as " << name);
      const TemporaryFolder folder;
      put(folder / "precious", "precious");
      std::filesystem::create_directory(folder / "out");
      thing.make(folder / "out" / name);
      const auto open = [&] { RunFolder(folder / "out", identity); };
      CHECK(code_of(open) != 0);
      CHECK_THAT(message_of(open), Contains(name) || Contains("cannot write"));
      CHECK(contents(folder / "precious") == "precious");
      CHECK_FALSE(std::filesystem::exists(folder / "new"));
    }
}

TEST_CASE("a finish mark that names files of another folder is none", "[io]")
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  put(folder / "out/summary.json", "{}");
  put(folder / "other", "{}");
  write_finish_mark(folder / "out", {"summary.json"});
  CHECK(broken_mark(folder / "out") == "");
  for (const char* other : {"../other", "/etc/hostname", "../out/summary.json"})
  {
    put(folder / "out/finished.json",
        replaced(contents(folder / "out/finished.json"), "summary.json", other));
    CHECK_THAT(broken_mark(folder / "out"), Contains("another folder"));
    write_finish_mark(folder / "out", {"summary.json"});
  }
}

TEST_CASE("links and values of a state that lead to another file are refused", "[io]")
{
  CHECK(said_of([](hid_t) {}) == "");
  CHECK_THAT(said_of(
                 [](hid_t file)
                 {
                   H5Ldelete(file, "x", H5P_DEFAULT);
                   H5Lcreate_external("secret.h5", "x", file, "x", H5P_DEFAULT, H5P_DEFAULT);
                 }),
             Contains("/x") && Contains("or a link"));
  CHECK_THAT(said_of(
                 [](hid_t file)
                 {
                   H5Lmove(file, "x", file, "y", H5P_DEFAULT, H5P_DEFAULT);
                   H5Lcreate_soft("/y", file, "x", H5P_DEFAULT, H5P_DEFAULT);
                 }),
             Contains("/x") && Contains("or a link"));
  CHECK_THAT(said_of(
                 [](hid_t file)
                 {
                   const h5::Handle layout = new_layout();
                   H5Pset_external(layout.id(), "secret.h5", 0, 24);
                   replace(file, {3}, H5T_IEEE_F64LE, layout);
                 }),
             Contains("/x") && Contains("another file"));
  CHECK_THAT(said_of(
                 [](hid_t file)
                 {
                   const h5::Handle layout = new_layout();
                   const hsize_t count = 3;
                   const h5::Handle space{H5Screate_simple(1, &count, nullptr), H5Sclose};
                   H5Pset_virtual(layout.id(), space.id(), "secret.h5", "x", space.id());
                   replace(file, {3}, H5T_IEEE_F64LE, layout);
                 }),
             Contains("/x") && Contains("another file"));
}

TEST_CASE("a state that claims more than it has room for is refused before memory is taken", "[io]")
{
  for (const hsize_t count : {hsize_t(1) << 20, hsize_t(1) << 30, hsize_t(1) << 50})
    for (const bool text : {false, true})
    {
      INFO(count << (text ? " texts" : " numbers"));
      CHECK_THAT(said_of(
                     [&](hid_t file)
                     {
                       const h5::Handle layout = new_layout(), type{H5Tcopy(H5T_C_S1), H5Tclose};
                       H5Tset_size(type.id(), H5T_VARIABLE);
                       const hsize_t chunk = 8;
                       H5Pset_chunk(layout.id(), 1, &chunk);
                       replace(file, {count}, text ? type.id() : H5T_IEEE_F64LE, layout);
                       if (!text) return;
                       H5Ldelete(file, "words", H5P_DEFAULT);
                       H5Lmove(file, "x", file, "words", H5P_DEFAULT, H5P_DEFAULT);
                       replace(file, {3}, H5T_IEEE_F64LE, new_layout());
                     }),
                 Contains("more than the file has room for"));
    }
}

TEST_CASE("YAML that unfolds, nests or goes on is refused before it is built", "[io]")
{
  std::string laughs = "a: &a0 [lol, lol, lol, lol, lol, lol, lol, lol, lol]\n";
  for (int k = 1; k < 12; ++k)
  {
    laughs += "b" + std::to_string(k) + ": &a" + std::to_string(k) + " [";
    for (int i = 0; i < 9; ++i) laughs += (i ? ", *a" : "*a") + std::to_string(k - 1);
    laughs += "]\n";
  }
  std::string many, wide = "a: [";
  for (int k = 0; k < 300'000; ++k)
  {
    many += "k" + std::to_string(k) + ": 1\n";
    wide += "[],";
  }
  const std::string deep = "a: " + std::string(15'000'000, '['), lists = []
  {
    std::string text;
    for (int k = 0; k < 1'000'000; ++k) text += "- ";
    return text;
  }();
  for (const std::string& text : {laughs, many, wide, deep, lists})
    CHECK_THAT(refusal(text), Contains("too large") || Contains("not YAML"));
  // What is just not too many is looked through once, not once for each key.
  const std::string told = refusal(many.substr(0, many.find("k90000:")));
  CHECK_THAT(told, Contains("unknown key 'k0'"));
}

TEST_CASE("what does not print is shown in messages, and no name of a case", "[io]")
{
  CHECK(printable("p\xc3\xa9 m\xc2\xb2 \xe5\x8f\xb0\n\t") == "p\xc3\xa9 m\xc2\xb2 \xe5\x8f\xb0\n\t");
  CHECK(printable("\x1b[2J \a\x7f\r") == "\\x1b[2J \\x07\\x7f\\x0d");
  CHECK(printable("\xc2\x9b \xe2\x80\xae \xff\xc3", "") == "\\xc2\\x9b \\xe2\\x80\\xae \\xff\\xc3");
  CHECK(printable("a\nb", "") == "a\\x0ab");
  // As keys, texts, paths and words, escaped by YAML or not.
  for (const char* sign : {"\x1b[2J",
                           "\xc2\x9b"
                           "2J",
                           "\x7f", "\xff", "\xe2\x80\xae"})
  {
    const std::string bad = "a" + std::string(sign) + "b";
    const auto shown = [&](const std::string& message)
    {
      CHECK(printable(message, "\n") == message);
      CHECK_THAT(message, Contains("\\x"));
      return message;
    };
    shown(refusal(small + "name: " + bad + "\n"));
    shown(refusal(small + bad + ": 1\n"));
    shown(refusal(replaced(small, "elastic", bad)));
    shown(refusal(replaced(small, "40 MPa", bad)));
    shown(refusal(small, {"name=" + bad}));
    shown(refusal(small, {"materials." + bad + ".density=1"}));
    shown(refusal(small, {}, bad));
    shown(message_of([&] { parse_record("1\n2\n" + bad + "\n", {.file = "a.txt", .dt = 1, .unit = "g"}); }));
  }
  const std::string escaped = refusal(small + "name: \"a\\e[2J\\nwarning: all is well\"\n");
  CHECK_THAT(escaped,
             Contains("name: has characters that do not print: 'a\\x1b[2J\\x0awarning: all is well'"));
}

TEST_CASE("names that cannot be told from paths are refused", "[io]")
{
  CHECK_THAT(refusal(small + "output: {gauges: {points: {'': [1 m, 9 m]}}}\n"),
             Contains("key without a name"));
  CHECK_THAT(refusal(small + "output: {gauges: {points: {'a\"b': [1 m, 9 m]}}}\n"),
             Contains("quotation mark"));
  for (const char* name : {"a/b", "/", "../../x", ".", "soil ~1"})
    CHECK_THAT(refusal(replaced(replaced(small, "soil:", std::string("'") + name + "':"), "material: soil",
                                std::string("material: '") + name + "'")),
               Contains("names a part of result files"));
}
