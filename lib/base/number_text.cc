#include "base/number_text.h"

#include <iomanip>
#include <sstream>

namespace plumbline::base
{
  std::string to_text(double value, int n_digits)
  {
    std::ostringstream text;
    text << std::setprecision(n_digits) << value;
    return text.str();
  }

  std::string to_percent(double fraction)
  {
    return to_text(100 * fraction, 3) + " %";
  }
} // namespace plumbline::base
