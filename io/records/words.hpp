#pragma once
// Inside the record reader: words in the prose of headers.

#include "io/records/text.hpp"
#include "io/records/units.hpp"

#include <initializer_list>

namespace mpm::records
{
using Names = std::initializer_list<std::string_view>;

/// Whether lower case text has one of the words.
bool has_word(std::string_view text, Names words);
/// What stands between blanks.
std::vector<std::string_view> words_of(std::string_view text);
/// The words up to a comma, a full stop, a wide gap or the end of a bracket.
std::string_view phrase(std::string_view text);
/// Text behind "of", "are", "is", "in", ":" and "=", which stand between a word as units and what it tells;
/// `joined`: whether there were any.
std::string_view without_joints(std::string_view text, bool& joined);
/// Index behind the word in, where blanks or a bracket follow it; npos if there is none. "in/s2" is a unit.
std::size_t behind_in(std::string_view text);

struct QuantityWord
{
  Quantity quantity;      ///< the one that the word names
  std::size_t begin, end; ///< of the word in the line
};
/// The quantity that lower case text names: "acceleration", "vel"; empty if it names none.
std::optional<QuantityWord> quantity_word(std::string_view text);
/// A component or a kind of processing in brackets, no unit: "(N45E)", "(corrected)", "(090)".
bool is_label(std::string_view text);
/// Whether words that are no known unit speak of one: "PERCENT G", "cm x sec", "G/7", "COUNTS".
bool hints_at_unit(std::string_view text);
} // namespace mpm::records
