#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace plumbline::app
{
  /// What is wrong with the arguments of the command, and the remedy.
  std::string explain(const CLI::ParseError &error);
} // namespace plumbline::app
