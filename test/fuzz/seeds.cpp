// Writes what fuzzing begins with: `fuzz-seeds FOLDER` fills FOLDER/TARGET with what the repository has, and
// writes the words of cases to FOLDER/case.dict.

#include "example.hpp"
#include "io/case/key_table.hpp"
#include "test/fuzz/states.hpp"
#include "test/fuzz/targets.hpp"
#include "test/io/record_samples.hpp"
#include "test/sealed.hpp"
#include "test/temporary_folder.hpp"

#include <fmt/format.h>

#include <iostream>
#include <set>

namespace
{
namespace fs = std::filesystem;
using namespace mpm;

class Seeds
{
public:
  Seeds(fs::path folder, const std::string& target) : folder_(folder / target)
  {
    fs::create_directories(folder_);
  }
  void add(const std::string& bytes) { test::put(folder_ / fmt::format("seed-{:03}", count_++), bytes); }

private:
  fs::path folder_;
  int count_ = 0;
};

/// A word as a dictionary of libFuzzer has it.
std::string entry(std::string_view word)
{
  std::string text;
  for (const char c : word) text += c == '"' || c == '\\' ? fmt::format("\\{}", c) : std::string(1, c);
  return "\"" + text + "\"\n";
}

void write_words(const fs::path& file)
{
  std::set<std::string> words{"%%% --set ",
                              "%%% --profile quick\n",
                              "%%% line.txt\n",
                              "%%% record.AT2\n",
                              "record + 10 s",
                              "built_in",
                              "&a ",
                              "*a",
                              "<<: *a",
                              "!!str ",
                              "? ",
                              "---\n"};
  for (const KeyDescription& key : case_keys())
  {
    const std::string name = key.path.substr(key.path.find_last_of(".]") + 1);
    words.insert({name + ": ", key.path.substr(0, key.path.find('['))});
    std::string word;
    for (const char c : key.form + " " + key.otherwise + " ")
      if (c == ' ' || c == ',')
      {
        if (!word.empty()) words.insert(word);
        word.clear();
      }
      else
        word += c;
  }
  std::string text;
  for (const std::string& word : words)
    if (word.find_first_not_of(
            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+-/%&*<>:!?\n ") == word.npos)
    {
      std::string one = entry(word);
      for (auto at = one.find('\n'); at + 1 < one.size(); at = one.find('\n')) one.replace(at, 1, "\\x0A");
      text += one;
    }
  test::put(file, text);
}

void write_cases(const fs::path& folder)
{
  Seeds seeds(folder, "case");
  seeds.add(std::string(example_case));
  for (const auto& file : fs::recursive_directory_iterator(SOURCE_DIR "/cases"))
    if (file.path().extension() == ".yaml")
      if (const std::string text = test::contents(file); text.find("seismpm-case/1") != text.npos)
        seeds.add(text);
}

void write_records(const fs::path& folder)
{
  Seeds seeds(folder, "record");
  for (const test::Sample& sample : test::samples())
  {
    const RecordSource& s = sample.source;
    const std::string dt = std::isnan(s.dt) ? "" : fmt::format("{}", s.dt);
    seeds.add(fmt::format("{}|{}|{}|{}|{}\n", s.file, s.format, dt, s.unit, s.component) + sample.text);
  }
  for (const auto& file : fs::directory_iterator(SOURCE_DIR "/test/io/records"))
    seeds.add(file.path().filename().string() + "|auto|||\n" + test::contents(file));
}

void write_states(const fs::path& folder)
{
  Seeds files(folder, "checkpoint"), edits(folder, "state");
  for (int kind = 0; kind < fuzz::state_kinds; ++kind)
  {
    const std::string& bytes = fuzz::state_bytes(static_cast<fuzz::StateKind>(kind));
    files.add(static_cast<char>(kind) + bytes);
    files.add(static_cast<char>(kind) + test::sealed(bytes));
    for (int what = 0; what < 12; ++what)
      edits.add({static_cast<char>(kind), static_cast<char>(what), static_cast<char>(what * 5),
                 static_cast<char>(what), 0, static_cast<char>(7 * what), 0, 0, 0, 0, 0, 0, 0, 0, 0, '\x40',
                 '\x3f'});
  }
}

void write_command_lines(const fs::path& folder)
{
  Seeds seeds(folder, "command_line");
  for (const char* line :
       {"static\ncase.yaml\n--out\nrun\n--set\ngrid.spacing=1 m\n--threads\n2\n--max-wall\n2h",
        "seismic\ncase.yaml\n--from\nfinal.h5\n--out\nrun\n--motion\na.AT2\n--scale\n-1.5e-1\n--record-dt\n0."
        "005\n"
        "--record-unit\ngal\n--record-component\nN\n--record-format\nshake\n--vertical\nb.AT2\n--vertical-"
        "component\nU",
        "static\ncase.yaml\n--check\n--quiet\n--profile\nquick",
        "seismic\ncase.yaml\n--print-case\n--verbose\n--fresh", "static\n--keys\nmaterials",
        "static\n--schema", "static\n--example", "static\n--help", "static\n--version",
        "static\n--complete\nno.yaml\n--set\n", "seismic\n--complete\n--pro"})
    seeds.add(line);
}
} // namespace

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: fuzz-seeds FOLDER\n";
    return 64;
  }
  const fs::path folder = argv[1];
  write_cases(folder);
  write_records(folder);
  write_states(folder);
  write_command_lines(folder);
  write_words(folder / "case.dict");
}
