#pragma once

#include "problem/needs.h"

namespace plumbline::method
{
  using problem::all_but;
  using problem::all_capabilities;
  using problem::Capabilities;
  using problem::Capability;
} // namespace plumbline::method
