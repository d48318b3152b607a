#pragma once
// Files and folders of a test's own, and how an action fails.

#include "io/common/error.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>

namespace mpm::test
{
/// An empty folder that goes away with its contents at the end of the scope.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = std::filesystem::temp_directory_path() / "seismpm-XXXXXX";
    if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot make a temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

inline std::string contents(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void put(const std::filesystem::path& path, const std::string& text)
{
  std::ofstream(path, std::ios::binary) << text;
}

/// A text with one part of it, which it must hold, replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("the text holds no '" + from + "'");
  return text.replace(at, from.size(), to);
}

/// The exit status of the error that `action` throws; 0 when it throws none.
template <class Action>
int code_of(const Action& action)
{
  try
  {
    action();
  }
  catch (const std::exception& error)
  {
    const auto* ours = dynamic_cast<const Error*>(&error);
    return ours ? ours->code : -1;
  }
  return 0;
}

/// The message of the error that `action` throws; empty when it throws none.
template <class Action>
std::string message_of(const Action& action)
{
  try
  {
    action();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return {};
}
} // namespace mpm::test
