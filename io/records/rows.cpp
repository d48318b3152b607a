// Input motions of SHAKE: Schnabel, P. B., Lysmer, J. and Seed, H. B. (1972), SHAKE: a computer program
// for earthquake response analysis of horizontally layered sites, report EERC 72-12, University of
// California, Berkeley. Lines of text, then values row by row, as (8F10.6) prints them, perhaps numbered
// in a last column. What they are is told to SHAKE beside the file, so that this format has to be named,
// with dt and unit.

#include "io/records/formats.hpp"

#include <algorithm>

namespace mpm::records
{
namespace
{
using Rows = std::vector<std::vector<double>>;

/// The index of the first line of numbers.
std::size_t first_row(const RecordSource& source, const std::vector<Line>& lines)
{
  const auto found =
      std::ranges::find_if(lines, [](const Line& line) { return numbers_in(line.text).has_value(); });
  if (found == lines.end()) refuse(source, "no line of numbers; not a record");
  return std::size_t(found - lines.begin());
}

/// Takes the numbers 1, 2, 3 ... of the rows off their ends, if all have them.
void drop_numbering(Rows& rows)
{
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k].size() < 2 || rows[k].back() != double(k + 1)) return;
  for (std::vector<double>& row : rows) row.pop_back();
}
} // namespace

Record read_rows(const RecordSource& source, const std::vector<Line>& lines)
{
  refuse_component(source);
  const std::size_t first = first_row(source, lines);
  const std::vector<Line> header(lines.begin(), lines.begin() + long(first));
  Rows rows;
  for (std::size_t k = first; k < lines.size(); ++k) rows.push_back(numbers_at(source, lines[k]));
  if (rows.size() > 2) drop_numbering(rows); // two could be values
  std::vector<double> values;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    // Only the last row may be short. A longer one is a header line that happens to be all numbers.
    const std::size_t usual = rows.front().size();
    if (rows[k].size() > usual || (rows[k].size() < usual && k + 1 < rows.size()))
      refuse(source, lines[first + k],
             "holds " + std::to_string(rows[k].size()) + " numbers where the first row holds " +
                 std::to_string(usual) +
                 "; a line of numbers above the values, or a damaged row, is to be removed or mended");
    values.insert(values.end(), rows[k].begin(), rows[k].end());
  }
  if (rows.front().size() < 2) refuse(source, "has one value a line; use format: column");
  if (std::isnan(source.dt))
    refuse(source, "rows of values do not hold their time step; give dt, e.g. dt: 0.02 s");
  check_steps(source, header, source.dt);
  return finished(source, "shake", agreed_unit(source, said_by(source, header), {}), source.dt,
                  std::move(values));
}
} // namespace mpm::records
