#include "analysis/record.h"

#include <cmath>

namespace plumbline::analysis
{
  bool Key::is_same_series(const Key &other) const
  {
    return analysis == other.analysis && method == other.method && problem == other.problem &&
           series == other.series && variant == other.variant;
  }

  bool Key::operator==(const Key &other) const
  {
    return is_same_series(other) && family == other.family && level == other.level &&
           h == other.h && horizon == other.horizon && value == other.value;
  }

  void Record::set(const std::string &name, double value, const std::string &unit)
  {
    if (std::isfinite(value))
      scalars[name] = {value, unit};
    else
      scalars.erase(name);
  }

  double Record::operator[](const std::string &name) const
  {
    const auto found = scalars.find(name);
    return found == scalars.end() ? std::numeric_limits<double>::quiet_NaN() : found->second.value;
  }

  std::size_t Record::count(const std::string &name) const
  {
    return has(name) ? static_cast<std::size_t>((*this)[name]) : 0;
  }

  const std::string &Record::text(const std::string &name) const
  {
    static const std::string none;
    const auto found = texts.find(name);
    return found == texts.end() ? none : found->second;
  }
} // namespace plumbline::analysis
