#include "io/common/printable.hpp"

#include <fmt/format.h>
#include <openssl/asn1.h>

#include <algorithm>

namespace mpm
{
namespace
{
/// Controls of ASCII and of Latin-1, line and paragraph separators, marks of direction (Unicode 15, tables
/// 2-3 and 23-3).
bool is_control(unsigned long code)
{
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}
} // namespace

std::string printable(std::string_view text, std::string_view kept)
{
  std::string shown;
  while (!text.empty())
  {
    unsigned long code = 0;
    const int read = UTF8_getc(reinterpret_cast<const unsigned char*>(text.data()),
                               static_cast<int>(std::min<std::size_t>(text.size(), 4)), &code);
    const std::string_view part = text.substr(0, static_cast<std::size_t>(std::max(read, 1)));
    if (read > 0 && (!is_control(code) || kept.find(part) != kept.npos))
      shown += part;
    else
      for (const char byte : part) shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    text.remove_prefix(part.size());
  }
  return shown;
}
} // namespace mpm
