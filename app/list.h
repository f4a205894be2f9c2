#pragma once

#include <string>

namespace plumbline::app
{
  /// Names and help of methods, kernels or scenes; what models and analyses can do.
  /// @throws InputError  another subject
  void list(const std::string &subject, bool as_matrix);
} // namespace plumbline::app
