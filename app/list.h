#pragma once

#include <string>

namespace plumbline::app
{
  /// Whether there is a list of this subject, in any case.
  bool is_listed(const std::string &subject);

  /// Names and help of methods, kernels, scenes or certified problems; what models and analyses can
  /// do.
  /// @throws InputError  another subject
  void list(const std::string &subject, bool as_matrix);
} // namespace plumbline::app
