#pragma once
// The README.md of a folder, as far as a test holds it to what the programs do.

#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace mpm::test
{
/// What stands on a card between the lines `<!-- NAME -->` and `<!-- end of NAME -->`.
inline std::string part_of_card(const std::string& card, const std::string& name)
{
  const std::string text = contents(std::filesystem::path(SOURCE_DIR) / card);
  const std::string begin = "<!-- " + name + " -->\n", end = "<!-- end of " + name + " -->\n";
  const std::size_t from = text.find(begin), to = text.find(end);
  INFO(card << " lacks " << begin);
  REQUIRE(from != text.npos);
  REQUIRE(to != text.npos);
  return text.substr(from + begin.size(), to - from - begin.size());
}

/// The cells of the tables in a text, row by row, without headings, rules and quotation marks.
inline std::vector<std::vector<std::string>> table_rows(const std::string& text)
{
  std::vector<std::vector<std::string>> rows;
  bool below_heading = false;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (line.starts_with("| ---"))
      below_heading = true;
    else if (!line.starts_with("|"))
      below_heading = false;
    else if (below_heading)
    {
      std::vector<std::string>& cells = rows.emplace_back();
      for (std::size_t bar = 0, next; (next = line.find('|', bar + 1)) != line.npos; bar = next)
      {
        std::string cell = line.substr(bar + 1, next - bar - 1);
        std::erase(cell, '`');
        const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
        cells.push_back(first == cell.npos ? "" : cell.substr(first, last - first + 1));
      }
    }
  }
  return rows;
}
} // namespace mpm::test
