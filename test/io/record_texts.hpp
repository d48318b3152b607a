#pragma once
// What the tests of the record readers share.

#include "io/common/error.hpp"
#include "io/records/reader.hpp"

#include <catch2/catch.hpp>

#include <functional>

namespace mpm::test
{
struct Failure
{
  int code = 0;
  std::string message = "accepted";
};

inline Failure failure_of(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const Error& error)
  {
    return {error.code, error.what()};
  }
  return {};
}

inline std::string refusal(std::string_view text, const RecordSource& source)
{
  const Failure failure = failure_of([&] { parse_record(text, source); });
  CHECK(failure.code == exit_code::bad_input);
  return failure.message;
}

inline void check_values(const Record& record, const std::vector<double>& expected, double unit)
{
  REQUIRE(record.values.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(record.values[i] == Approx(expected[i] * unit).epsilon(1e-15)); // one product
}
} // namespace mpm::test
