#pragma once

namespace plumbline::app
{
  /// The whole command. @return its exit code: 0; 1: a check failed; 2: bad input; 3: no result
  int command(int argc, char **argv);
} // namespace plumbline::app
