#pragma once

#include <stdexcept>

namespace plumbline
{
  /// The user's input cannot be used. The message names the key, its value, what is allowed and the
  /// remedy. The command turns it into exit code 2.
  class InputError : public std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /// The input is sound but the numbers do not come out: no convergence, a singular family, a value
  /// that is not a number. The command turns it into exit code 3.
  class NumericalError : public std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /// Memory ran out on the way. Exit code 3, too.
  class MemoryError : public NumericalError
  {
    using NumericalError::NumericalError;
  };
} // namespace plumbline
