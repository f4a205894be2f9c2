#include "physics/coefficient.h"

#include "base/error.h"

#include <sstream>

namespace plumbline::physics
{
  double mean(Mean kind, double a, double b)
  {
    return kind == Mean::arithmetic ? (a + b) / 2 : 2 * a * b / (a + b);
  }

  double Coefficient::at(const Point<2> &x) const
  {
    const double value = a_(x);
    if (value > 0)
      return value;
    std::ostringstream message;
    message << "Kernel/coefficient = '" << text_ << "' is " << value << " at (" << x
            << "), but the operator needs it positive everywhere in the domain and its collar";
    throw InputError(message.str());
  }
} // namespace plumbline::physics
