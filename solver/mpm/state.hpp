#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mpm
{
/// Visits what an object remembers, by name: the same walk saves it to a checkpoint and loads it from one.
struct StateVisitor
{
  virtual ~StateVisitor() = default;
  virtual void doubles(std::string_view name, std::string_view unit, std::vector<double>& values) = 0;
  virtual void integers(std::string_view name, std::vector<std::int64_t>& values) = 0;
};

/// A list of records as one array per member. What is loaded has as many values of each member, or
/// std::runtime_error is thrown.
template <class T>
class RecordVisitor
{
public:
  RecordVisitor(StateVisitor& visitor, std::string prefix, std::vector<T>& list)
      : visitor_(visitor), prefix_(std::move(prefix)), list_(list)
  {
  }
  void member(std::string_view name, std::string_view unit, double T::*member)
  {
    each(name, unit, [member](T& item) -> double& { return item.*member; });
  }
  template <class Access>
  void each(std::string_view name, std::string_view unit, const Access& access)
  {
    std::vector<double> column;
    for (T& item : list_) column.push_back(access(item));
    visitor_.doubles(prefix_ + std::string(name), unit, column);
    resize(name, column.size());
    for (std::size_t k = 0; k < column.size(); ++k) access(list_[k]) = column[k];
  }
  template <class Access>
  void each_integer(std::string_view name, const Access& access)
  {
    std::vector<std::int64_t> column;
    for (T& item : list_) column.push_back(static_cast<std::int64_t>(access(item)));
    visitor_.integers(prefix_ + std::string(name), column);
    resize(name, column.size());
    for (std::size_t k = 0; k < column.size(); ++k)
    {
      access(list_[k]) = static_cast<std::decay_t<decltype(access(list_[k]))>>(column[k]);
      if (static_cast<std::int64_t>(access(list_[k])) != column[k])
        throw std::runtime_error(prefix_ + std::string(name) + " holds " + std::to_string(column[k]));
    }
  }

private:
  void resize(std::string_view name, std::size_t count)
  {
    if (visited_ && count != list_.size())
      throw std::runtime_error(prefix_ + std::string(name) + " has " + std::to_string(count) +
                               " values for " + std::to_string(list_.size()));
    list_.resize(count);
    visited_ = true;
  }

  StateVisitor& visitor_;
  std::string prefix_;
  std::vector<T>& list_;
  bool visited_ = false; ///< whether a member has fixed how many there are
};
} // namespace mpm
